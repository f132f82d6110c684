// The explorer: ϖ/Ω or N_c against any parameter, with one curve or several. Points appear as the
// runs on all cores finish. With N on the axis it is the paper's Figure 5b.
import {UsageError, rates, type Crossing, type Parameter} from "../engine/engine";
import {controlling, searchCrossing, usualSearch} from "../engine/crossing_search";
import {intervalOf} from "../engine/estimates";
import {optionsOf, type Host, type Values} from "../dish/host";
import {
    button,
    element,
    localized,
    save,
    shownList,
    signed,
    typedList,
    withError,
} from "../elements/page";
import {Chart, type ChartCurve, type ChartPoint} from "../elements/chart";
import {Runs, seedsFrom, seedsPerPoint, type Crossings, type Estimates} from "../engine/runs";
import {commands as commandOf, optionOf} from "../texts/symbols";
import {fill, symbols, texts} from "../texts/texts";

export type Quantity = "rotation" | "crossing";

/** A curve of the plot: the parameters that it sets. */
export interface CurveValues {
    name: string;
    given: Values;
}

/** A point: the mean of runs with different seeds, or a search for N_c. */
export interface Point {
    curve: CurveValues;
    x: number;
    given: Values;
    done?: boolean;
    collapsed?: boolean;
    rotation?: Estimates;
    crossings?: Crossings;
    withinTolerance?: boolean;
    runs?: number;
    /** The command lines of exactly these runs. */
    command?: string;
}

const maxPoints = 400;
const defaultWarmup = 20; // periods, as the engine of the page

/** NaN for an empty text. */
const parseNumber = (text: string): number => (text.trim() === "" ? NaN : Number(text));

/** Parses numbers and ranges FROM:STEP:TO: "5, 10, 20:5:40". Undefined if the text is not valid. */
export function parseNumbers(text: string): number[] | undefined {
    const all: number[] = [];
    for (const part of text
        .split(",")
        .map((each) => each.trim())
        .filter(Boolean)) {
        const [from, by, to, more] = part.split(":").map(parseNumber) as [
            number,
            number?,
            number?,
            number?,
        ];
        if (!Number.isFinite(from) || more !== undefined) return undefined;
        if (by === undefined) all.push(from);
        else if (to === undefined || !(by > 0) || !(to >= from)) return undefined;
        // The value of a range is rounded to twelve digits, so that 0.3 is not 0.30000000000000004.
        else
            for (let k = 0; from + k * by <= to * (1 + 1e-12) && all.length <= maxPoints; ++k)
                all.push(Number((from + k * by).toPrecision(12)));
    }
    return all.length > 0 && all.length <= maxPoints ? [...new Set(all)] : undefined;
}

/** The curves for values of a parameter. For mu, DISC:WALL sets the two coefficients separately. An
 *  empty text gives one curve. Undefined if the text is not valid. */
export function parseCurves(parameter: string, text: string): CurveValues[] | undefined {
    if (!parameter) return [{name: "", given: {}}];
    const curves = new Map<string, CurveValues>();
    for (const part of text.split(",").filter((each) => each.trim())) {
        const pair = part.split(":").map(parseNumber);
        if (parameter === "mu" && pair.length === 2) {
            const [disc, wall] = pair as [number, number];
            if (!Number.isFinite(disc) || !Number.isFinite(wall)) return undefined;
            if (disc === wall)
                curves.set(`mu ${disc}`, {name: `mu ${disc}`, given: {mu: String(disc)}});
            else
                curves.set(`mu ${disc}:${wall}`, {
                    name: `mu_disc ${disc}, mu_wall ${wall}`,
                    given: {mu_disc: String(disc), mu_wall: String(wall)},
                });
            continue;
        }
        const numbers = parseNumbers(part);
        if (!numbers) return undefined;
        for (const value of numbers)
            curves.set(`${parameter} ${value}`, {
                name: `${parameter} ${value}`,
                given: {[parameter]: String(value)},
            });
    }
    return curves.size > 0 ? [...curves.values()] : undefined;
}

/** The parameters of a point. Each level replaces what is above it: `mu` also both of its parts. */
export function merged(...levels: Values[]): Values {
    const all: Values = {};
    for (const level of levels) {
        if (level["mu"] !== undefined) {
            delete all["mu_disc"];
            delete all["mu_wall"];
        }
        Object.assign(all, level);
    }
    // A coefficient in addition to mu stays, as on the command line.
    return all;
}

/** A list of numbers, or FROM:STEP:TO if their steps are equal. */
export function listOf(values: number[]): string {
    const step = values.length > 2 ? Number((values[1]! - values[0]!).toPrecision(12)) : 0;
    const even = values.every(
        (value, k) => k === 0 || Math.abs(value - values[k - 1]! - step) < 1e-9 * Math.abs(step),
    );
    return step > 0 && even ? `${values[0]}:${step}:${values.at(-1)}` : values.join(",");
}

/** The table of all points: the parameters on the axis and of the curves, the estimates, and their
 *  errors. */
export function tableOf(points: Point[], x: string, quantity: Quantity): string {
    const done = points.filter((each) => each.done);
    const names = [...new Set(done.flatMap(({curve}) => Object.keys(curve.given)))].filter(
        (name) => name !== x,
    );
    const columns =
        quantity === "rotation"
            ? [
                  "runs",
                  "collapsed",
                  ...rates.flatMap((rate) => [`varpi_${rate}`, `varpi_${rate}_error`]),
                  "command",
              ]
            : [
                  "verdict",
                  ...rates.flatMap((rate) =>
                      ["", "_error", "_lower", "_upper"].map((each) => `N_c_${rate}${each}`),
                  ),
              ];
    const rows = done.map(
        (point) =>
            [
                ...names.map((name) => point.curve.given[name] ?? ""),
                point.x,
                ...(quantity === "rotation"
                    ? [
                          seedsPerPoint,
                          point.collapsed ? 1 : 0,
                          ...rates.flatMap((rate) => [
                              point.rotation?.[rate].mean ?? "",
                              point.rotation?.[rate].error ?? "",
                          ]),
                          `"${point.command ?? ""}"`,
                      ]
                    : [
                          point.crossings?.[controlling].verdict ?? "",
                          ...rates.flatMap((rate) => {
                              const found = point.crossings?.[rate];
                              return [
                                  found?.discs ?? "",
                                  found?.error ?? "",
                                  found?.lower ?? "",
                                  found?.upper ?? "",
                              ];
                          }),
                      ]),
            ].join(",") + "\n",
    );
    return `${[...names, x, ...columns].join(",")}\n${rows.join("")}`;
}

/** Seven values of a parameter's slider, or the N of Figure 5b. */
export function proposedValues({name, slider}: Parameter): string {
    if (name === "discs" || !slider) return "5:6:53";
    if (name === "mu") return "0.2:0.2:1";
    const [from, to, step] = slider,
        by = Math.max(step, Math.round((to - from) / 6 / step) * step);
    return `${from > 0 ? from : by}:${Number(by.toPrecision(6))}:${to}`;
}

/** The largest number of discs for a search: two thirds of the container's area. */
export function densestSearch(configuration: Values): number {
    const ratio = Number(configuration["container_radius"]) / Number(configuration["radius"]);
    return Math.max(6, Math.floor(0.66 * ratio * ratio)) || usualSearch.to;
}

export class Explorer {
    readonly panel: HTMLElement;
    private readonly quantity = element("select", {id: "explorer-quantity"});
    private readonly x = element("select", {id: "explorer-x"});
    private readonly values = element("input", {
        type: "text",
        id: "explorer-values",
        value: "5:6:53",
    });
    private readonly curveOf = element("select", {id: "explorer-curve"});
    private readonly curveValues = element("input", {
        type: "text",
        id: "explorer-curves",
        value: shownList("0.1, 1"),
    });
    private readonly periods = element("input", {
        type: "text",
        id: "explorer-periods",
        value: "100",
        inputMode: "numeric",
    });
    private readonly status = element("p", {id: "explorer-status"});
    private readonly findings = element("div", {
        id: "explorer-findings",
        className: "findings",
        tabIndex: 0,
    });
    private readonly command = element("code", {id: "explorer-command"});
    private readonly start = button(texts.start, () => this.toggle(), "explorer-start");
    private readonly plot: Chart;
    private runs: Runs | undefined;
    private points: Point[] = [];
    private shown: {x: string; quantity: Quantity; curves: CurveValues[]} = {
        x: "discs",
        quantity: "rotation",
        curves: [],
    };

    constructor(
        place: HTMLElement,
        private readonly host: Host,
    ) {
        const field = (label: string, input: HTMLElement, title = ""): HTMLElement =>
            element("label", {title}, `${label} `, input);
        const option = (value: string, textContent: string) =>
            element("option", {value, textContent});
        this.quantity.append(
            option("rotation", symbols.rotation),
            option("crossing", texts.explorer.crossing),
        );
        this.quantity.addEventListener("change", () => this.chooseQuantity());
        this.x.addEventListener("change", () => this.propose());
        this.curveOf.addEventListener("change", () => {
            this.curveValues.disabled = this.curveOf.value === "";
        });
        const plotPlace = element("div", {id: "explorer-plot"});
        this.panel = element(
            "details",
            {id: "explorer"},
            element("summary", {textContent: texts.explorer.title}),
            element("p", {textContent: texts.explorer.help}),
            element(
                "div",
                {className: "bar"},
                field(texts.explorer.quantity, this.quantity),
                field(texts.explorer.against, this.x),
                field(texts.explorer.values, this.values, texts.explorer.valuesHelp),
            ),
            element(
                "div",
                {className: "bar"},
                field(texts.explorer.curves, this.curveOf),
                field(texts.explorer.values, this.curveValues, texts.explorer.curvesHelp),
                field(texts.periods, this.periods),
                this.start,
            ),
            this.status,
            plotPlace,
            this.findings,
            element("p", {}, texts.explorer.command, " ", this.command),
            element(
                "div",
                {className: "bar"},
                button(texts.explorer.table, () => this.saveTable(), "explorer-table"),
                button(texts.explorer.picture, () => this.savePicture(), "explorer-picture"),
            ),
        );
        this.command.parentElement!.hidden = true;
        this.plot = new Chart(plotPlace, {height: 280});
        place.append(this.panel);
        this.panel.addEventListener("toggle", () => {
            if ((this.panel as HTMLDetailsElement).open) this.draw();
        });
    }

    /** Fills the choices; call it when the table of parameters is there. */
    parametersKnown(): void {
        const numeric = this.host
            .parameters()
            .filter(
                ({slider, name, settable}) =>
                    slider &&
                    settable &&
                    !["events", "events_per_sample", "periods", "seed", "warmup"].includes(name),
            );
        const option = ({name}: Parameter): HTMLElement =>
            element("option", {
                value: name,
                textContent: this.labelOf(name),
                title: optionOf(name),
            });
        this.x.replaceChildren(...numeric.map(option));
        this.curveOf.replaceChildren(
            element("option", {value: "", textContent: texts.explorer.oneCurve}),
            ...numeric.map(option),
        );
        this.x.value = "discs";
        this.curveOf.value = "mu";
    }

    /** The everyday name of a parameter with its symbol. */
    private labelOf(name: string): string {
        const symbol = this.host.parameters().find((row) => row.name === name)?.symbol ?? "";
        return [texts.labels[name] ?? name, symbol].filter(Boolean).join(" ");
    }

    private chooseQuantity(): void {
        const discs = this.x.querySelector<HTMLOptionElement>('option[value="discs"]');
        const crossing = this.quantity.value === "crossing";
        if (discs) discs.disabled = crossing;
        if (crossing && this.x.value === "discs") {
            this.x.value = "mu";
            if (this.curveOf.value === "mu") this.curveOf.value = "";
            this.curveValues.disabled = this.curveOf.value === "";
            this.propose();
        }
    }

    private propose(): void {
        const row = this.host.parameters().find(({name}) => name === this.x.value);
        if (row) this.values.value = shownList(proposedValues(row));
    }

    private toggle(): void {
        if (this.runs) {
            this.stop();
            this.status.textContent = texts.stopped;
            return;
        }
        const values = parseNumbers(typedList(this.values.value));
        const curves = parseCurves(this.curveOf.value, typedList(this.curveValues.value));
        const quantity = this.quantity.value as Quantity,
            periods = Number(this.periods.value);
        if (!values || !curves || values.length * curves.length > maxPoints) {
            this.status.textContent = fill(texts.explorer.invalid, {most: maxPoints});
            return;
        }
        if (this.x.value === this.curveOf.value) {
            this.status.textContent = fill(texts.explorer.sameParameter, {name: this.x.value});
            return;
        }
        if (!(Number.isInteger(periods) && periods >= 10 && periods <= 100000)) {
            this.status.textContent = fill(texts.invalidPeriods, {text: this.periods.value});
            return;
        }
        this.shown = {x: this.x.value, quantity, curves};
        const base = this.host.given(),
            x = this.x.value;
        this.points = curves.flatMap((curve) =>
            values.map(
                (value): Point => ({
                    curve,
                    x: value,
                    given: merged(base, curve.given, {[x]: String(value)}),
                }),
            ),
        );
        this.findings.replaceChildren();
        this.showCommand(base, values, periods);
        void this.make(quantity, periods);
    }

    private async make(quantity: Quantity, periods: number): Promise<void> {
        const runs = new Runs(() => this.host.newWorker());
        this.runs = runs;
        this.start.textContent = texts.stop;
        this.report();
        // Runs with many discs take longest, so they come first.
        const byLength = [...this.points].sort(
            (a, b) => Number(b.given["discs"] ?? 0) - Number(a.given["discs"] ?? 0),
        );
        try {
            await Promise.all(
                byLength.map((point) =>
                    quantity === "rotation"
                        ? this.runPoint(runs, point, periods)
                        : this.searchPoint(runs, point),
                ),
            );
            if (quantity === "rotation" && this.shown.x === "discs")
                await this.findCrossings(runs, periods);
            if (this.runs === runs) this.stop();
        } catch (error) {
            if (this.runs !== runs) return;
            this.stop();
            if (!(error instanceof UsageError)) throw error;
            this.status.textContent = error.message;
        }
    }

    private async runPoint(runs: Runs, point: Point, periods: number): Promise<void> {
        const replicates = await runs.replicates(
            {...point.given, discs: this.discsOf(point)},
            periods,
        );
        const command = this.commandOf(
            point.given,
            periods,
            replicates?.map(({seed}) => seed!),
        );
        Object.assign(
            point,
            replicates ? {rotation: await runs.estimates(replicates)} : {collapsed: true},
            {done: true, command},
        );
        if (this.runs === runs) this.report();
    }

    private async searchPoint(runs: Runs, point: Point): Promise<void> {
        const {discs: _, seed, ...given} = point.given;
        const configuration = {...this.host.configuration(), ...given};
        const settings = {
            ...usualSearch,
            to: densestSearch(configuration),
            seed: Number(seed ?? usualSearch.seed),
        };
        const found = await searchCrossing(
            settings,
            {
                run: (n, replicate, length) =>
                    runs.run({...given, discs: String(n), seed: String(replicate)}, length),
                search: (rules, made) => runs.search(rules, made),
                crossings: (all) => runs.crossings(all),
            },
            (made) => {
                point.runs = made;
                if (this.runs === runs) this.report();
            },
        );
        Object.assign(point, {
            done: true,
            crossings: found.crossings,
            withinTolerance: found.withinTolerance,
        });
        if (this.runs !== runs) return;
        this.addFinding(
            [point.curve.name, `${this.shown.x} ${point.x}`].filter(Boolean).join(", "),
            found.crossings,
            found.withinTolerance ? "" : texts.explorer.imprecise,
        );
        this.report();
    }

    /** N_c of each curve ϖ(N). */
    private async findCrossings(runs: Runs, periods: number): Promise<void> {
        for (const curve of this.shown.curves) {
            const crossings = await runs.crossings(
                this.points.flatMap(({curve: of, x, rotation}) =>
                    of === curve && rotation ? [{discs: x, periods, rotation}] : [],
                ),
            );
            if (this.runs !== runs) return;
            this.addFinding(curve.name || texts.explorer.oneCurve, crossings);
        }
    }

    /** Adds a row to the table of N_c, one column for each rotation rate. */
    private addFinding(name: string, crossings: Crossings, note = ""): void {
        const head = (scope: string, textContent: string): HTMLElement =>
            element("th", {scope, textContent});
        if (this.findings.childElementCount === 0)
            this.findings.append(
                element(
                    "table",
                    {},
                    element(
                        "tr",
                        {},
                        head("col", symbols.crossing),
                        ...rates.map((rate) => head("col", texts.rateNames[rate])),
                    ),
                ),
            );
        this.findings.firstElementChild!.append(
            element(
                "tr",
                {},
                head("row", localized(name)),
                ...rates.map((rate) =>
                    element("td", {
                        textContent: crossingText(crossings[rate]),
                        title: rate === controlling ? note : "",
                    }),
                ),
            ),
        );
    }

    private stop(): void {
        this.runs?.stop();
        this.runs = undefined;
        this.start.textContent = texts.start;
    }

    private report(): void {
        const done = this.points.filter((each) => each.done).length;
        const collapsed = this.points.filter((each) => each.collapsed);
        const names = collapsed
            .map(({curve, x}) => [`${this.shown.x} ${x}`, curve.name].filter(Boolean).join(", "))
            .join("; ");
        const made = this.points.reduce((sum, point) => sum + (point.runs ?? 0), 0);
        this.status.textContent =
            (this.shown.quantity === "rotation"
                ? fill(texts.studyProgress, {done, all: this.points.length})
                : fill(texts.explorer.searches, {done, all: this.points.length, runs: made})) +
            (names ? ` ${fill(texts.collapsed, {runs: localized(names)})}` : "");
        this.draw();
    }

    private draw(): void {
        const {x, quantity, curves} = this.shown;
        const shown: ChartCurve[] = curves.map((curve) => ({
            name: curve.name,
            points: this.points
                .filter((point) => point.curve === curve && point.done)
                .sort((a, b) => a.x - b.x)
                .flatMap((point) => plottedPoint(point, quantity)),
        }));
        const found = shown.reduce((sum, {points}) => sum + points.length, 0);
        this.plot.show(
            [this.labelOf(x), quantity === "rotation" ? symbols.rotation : symbols.crossing],
            shown,
            {},
            fill(texts.explorer.description, {points: found, name: this.labelOf(x)}),
        );
    }

    private discsOf({given}: Point): string {
        return given["discs"] || this.host.configuration()["discs"]!;
    }

    /** The command lines of the runs of a point with this many periods after the warm-up. */
    private commandOf(given: Values, periods: number, seeds = seedsFrom(given["seed"])): string {
        const warmup =
            Number(given["warmup"]) >= 0 && given["warmup"]
                ? Number(given["warmup"])
                : defaultWarmup;
        return seeds
            .map((seed) =>
                commandOf.run(
                    optionsOf(
                        {...given, periods: String(periods + warmup), warmup: String(warmup), seed},
                        this.host.parameters(),
                    ),
                ),
            )
            .join(" && ");
    }

    /** Command lines for all points: a sweep, which has other seeds, or the searches. */
    private showCommand(base: Values, values: number[], periods: number): void {
        const {x, quantity, curves} = this.shown,
            rows = this.host.parameters();
        const warmup = Number(base["warmup"]) || defaultWarmup;
        // Curves that differ in one parameter become one list of it.
        const lists = new Map<string, Values>();
        for (const {given} of curves) {
            const [name, ...more] = Object.keys(given);
            const key = more.length > 0 || !name ? JSON.stringify(given) : name;
            const list = lists.get(key);
            if (list && name) list[name] += `,${given[name]}`;
            else lists.set(key, {...given});
        }
        const commands = [...lists.values()].map((curve, k) => {
            const given = merged(base, curve, {[x]: listOf(values)});
            const {discs: _, ...withoutDiscs} = given;
            return quantity === "crossing"
                ? commandOf.crossing(
                      [
                          optionsOf(withoutDiscs, rows),
                          "--to",
                          densestSearch({...this.host.configuration(), ...base}),
                      ].join(" "),
                  )
                : commandOf.sweep(
                      `${optionsOf({...given, periods: String(periods + warmup), warmup: String(warmup)}, rows)} ` +
                          `--replicates ${seedsPerPoint}`,
                      `study${k || ""}`,
                  );
        });
        this.command.textContent = commands.join("\n");
        this.command.parentElement!.hidden = false;
    }

    private saveTable(): void {
        save("explorer.csv", {
            text: tableOf(this.points, this.shown.x, this.shown.quantity),
            type: "text/csv",
        });
    }

    private savePicture(): void {
        const varied = [
            "discs",
            this.shown.x,
            ...this.shown.curves.flatMap(({given}) => Object.keys(given)),
        ];
        const others = Object.entries(this.host.given())
            .filter(([name]) => !varied.includes(name))
            .map(([name, value]) => `${name} ${value}`)
            .join(", ");
        const picture = this.plot.picture(`swirl: ${others || texts.discovery.defaults}`);
        if (picture) save("explorer.png", {href: picture});
    }
}

export function crossingText(found: Crossing): string {
    if (found.verdict !== "crosses") return texts.verdicts[found.verdict];
    return found.discs === null
        ? fill(texts.bracket, {lower: found.lower!, upper: found.upper!})
        : fill(texts.crossing, {
              discs: withError(found.discs, found.error, ""),
              lower: signed(found.lower!, 1),
              upper: signed(found.upper!, 1),
          });
}

/** 95 % intervals. A point without a result is not drawn. */
function plottedPoint(point: Point, quantity: Quantity): ChartPoint[] {
    if (quantity === "crossing") {
        const found = point.crossings?.[controlling];
        if (found?.verdict !== "crosses" || found.lower === null || found.upper === null) return [];
        return [
            {
                x: point.x,
                y: found.discs ?? 0.5 * (found.lower + found.upper),
                lower: found.lower,
                upper: found.upper,
            },
        ];
    }
    const {mean, error} = point.rotation?.[controlling] ?? {};
    if (mean == null || error == null) return [];
    return [
        {x: point.x, y: mean, lower: mean - intervalOf(error), upper: mean + intervalOf(error)},
    ];
}
