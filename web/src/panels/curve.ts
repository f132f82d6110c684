// The rotation rate period by period, with a mark where a parameter was changed.
import type {Rotation} from "../engine/engine";
import type {Laboratory} from "../engine/laboratory";
import {Chart, type ChartPoint} from "../elements/chart";
import {accent, byId, element, localized, quiet} from "../elements/page";
import {meansOf, periodsOf} from "../engine/series";
import {fill, symbols, texts} from "../texts/texts";

/** The axis ends here: a disc that passes the centre of mass makes single periods many times as
 *  large. */
const clippedAt = 1.5;
const remembered = 200; // periods before the last change

type Columns = [number[], (number | null)[], (number | null)[]];

/** Periods, values and means, after those of earlier parameters. */
export function joined(earlier: Columns, rotation: Rotation | undefined): Columns {
    if (!rotation) return earlier;
    const begin = earlier[0].at(-1) ?? 0;
    // A gap in the lines separates the parameters.
    const gap = earlier[0].length > 0 ? [null] : [];
    return [
        [
            ...earlier[0],
            ...gap.map(() => begin),
            ...periodsOf(rotation).map((period) => begin + period),
        ],
        [...earlier[1], ...gap, ...rotation.blocks],
        [...earlier[2], ...gap, ...meansOf(rotation)],
    ];
}

export class Curve {
    private readonly place = byId("curve");
    private readonly note = element("p", {className: "quiet"});
    private readonly chart: Chart;
    private earlier: Columns = [[], [], []];
    private shown: Columns = [[], [], []];
    private notes: {at: number; text: string}[] = [];
    private before: Record<string, string> = {}; // the parameters of the last values

    constructor(private readonly lab: Laboratory) {
        this.chart = new Chart(this.place, {
            height: 150,
            x: (low, high) => [low, high],
            y: (low, high) => [
                Math.max(Math.min(low, -0.1) - 0.05, -clippedAt),
                Math.min(Math.max(high, 0.1) + 0.05, clippedAt),
            ],
        });
        this.place.append(this.note);
        this.clear();
        lab.on("begin", () => this.clear());
        lab.on("changed", (byParameters) => {
            if (byParameters) this.mark();
            else this.clear();
        });
        lab.on("averages", (rotation) => this.show(rotation));
    }

    private clear(): void {
        this.earlier = this.shown = [[], [], []];
        this.notes = [];
        this.before = this.lab.configuration;
        this.place.hidden = true;
    }

    /** The values so far become those of earlier parameters. */
    private mark(): void {
        const {configuration} = this.lab,
            at = this.shown[0].at(-1) ?? 0;
        const changes = Object.keys(configuration)
            .filter(
                (name) =>
                    configuration[name] !== this.before[name] && this.before[name] !== undefined,
            )
            .map((name) => localized(`${texts.symbolOf[name] ?? name} = ${configuration[name]}`));
        this.before = configuration;
        this.earlier = this.shown.map((column) => column.slice(-remembered)) as Columns;
        if (at === 0 || changes.length === 0) return;
        if (this.notes.at(-1)?.at === at) this.notes.pop();
        this.notes.push({at, text: changes.join(", ")});
    }

    private show(rotation: Rotation): void {
        if (Object.keys(this.before).length === 0) this.before = this.lab.configuration;
        const columns = joined(this.earlier, rotation),
            blocks = columns[0].length;
        if (this.lab.isByHand || blocks === this.shown[0].length) return;
        this.shown = columns;
        this.place.hidden = blocks < 2;
        const of = (values: (number | null)[]): ChartPoint[] =>
            columns[0].map((x, k) => ({x, y: values[k] ?? NaN}));
        const beyond = columns[1].filter((each) => Math.abs(each ?? 0) > clippedAt).length;
        this.note.textContent =
            beyond > 0 ? fill(texts.clipped, {n: beyond, at: clippedAt}) : texts.perPeriod;
        this.chart.show(
            ["", symbols.rotation],
            [
                {name: "", points: of(columns[1]), line: {width: 1, color: quiet}},
                {name: "", points: of(columns[2]), line: {width: 2, color: accent}},
            ],
            {notes: this.notes},
            texts.perPeriod,
        );
    }
}
