// The angular velocity of the discs against the angle in the M-frame, next to that of the wall, as
// in the paper's Figure 3.
import {Chart} from "../elements/chart";
import type {Laboratory} from "../engine/laboratory";
import type {Maps} from "../engine/messages";
import {accent, element, quiet} from "../elements/page";
import {symbols, texts} from "../texts/texts";

export class Profile {
    private readonly place = element("div", {id: "profile-plot"});
    readonly panel = element(
        "details",
        {id: "profile-panel"},
        element("summary", {textContent: texts.profile}),
        this.place,
    );
    private chart: Chart | undefined;

    constructor(lab: Laboratory) {
        lab.on("maps", ({profile}) => {
            if (this.panel.open) this.show(profile);
        });
    }

    private show({theta, varpi, wall}: Maps["profile"]): void {
        this.chart ??= new Chart(this.place, {height: 220, x: () => [0, 360]});
        const of = (values: Float64Array) =>
            [...theta]
                .map((x, k) => ({x, y: values[k]!}))
                .filter((_, k) => Number.isFinite(varpi[k]!));
        this.chart.show(
            [texts.theta, symbols.rotationM],
            [
                {name: texts.discs, points: of(varpi), line: {width: 2, color: accent}},
                {name: texts.wall, points: of(wall), line: {width: 1, color: quiet, dash: [5, 4]}},
            ],
            {},
            texts.profile,
        );
    }
}
