// The angular velocity of the discs against the angle in the M-frame, next to that of the wall, as in the
// paper's Figure 3.
import type {Laboratory} from "./laboratory";
import type {Maps} from "./messages";
import {accent, element, ink, line, quiet} from "./page";
import {Plot} from "./plot";
import {symbols, texts} from "./texts";

const height = 220;

export class Profile {
    private readonly place = element("div", {id: "profile-plot"});
    private plot: Plot | undefined;
    readonly panel = element("details", {id: "profile-panel"},
        element("summary", {textContent: texts.profile}), this.place);

    constructor(lab: Laboratory) {
        lab.on("maps", (maps) => { if (this.panel.open) this.show(maps); });
    }

    private show({profile}: Maps): void {
        const known = [...profile.theta.keys()].filter((k) => Number.isFinite(profile.varpi[k]!));
        const column = (values: Float64Array): number[] => known.map((k) => values[k]!);
        const width = this.place.clientWidth || 400;
        this.plot ??= new Plot({
            width, height,
            x: {label: texts.theta, color: ink, grid: line, range: () => [0, 360]},
            y: {label: symbols.rotationM, color: ink, grid: line},
            lines: [{color: accent, width: 2}, {color: quiet, width: 1, dash: [5, 4]}],
        }, this.place);
        this.plot.setWidth(width);
        this.plot.setData([column(profile.theta), column(profile.varpi), column(profile.wall)]);
    }
}
