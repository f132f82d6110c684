// A plot of estimates with intervals. Curves differ in colour and in the shape of their points.
import {element, ink, line, localized, paper, quiet} from "./page";
import {Plot} from "./plot";

export interface PlottedPoint {
    x: number;
    y: number;
    /** The interval. */
    lower: number;
    upper: number;
}

export interface Curve {
    name: string;
    points: PlottedPoint[];
    /** Drawn in grey behind the others. */
    faint?: boolean;
    /** A line without points, for which the axes have room. */
    isReference?: boolean;
}

/** Marks on the plot in addition to its curves. */
export interface Marks {
    /** A vertical line at the present value. */
    at?: number | undefined;
    /** An estimate that is still growing; drawn as a ring. */
    live?: PlottedPoint | undefined;
    /** The interval of x in which the curve crosses zero. */
    band?: [number, number] | undefined;
}

/** Suited to colour-blind readers; contrast of at least 3 with white and black paper. */
export const curveColors = ["#c4500a", "#0072b2", "#008a63", "#b8609a", "#a87900"];

const pixelsOf = (css: number): number => css * (window.devicePixelRatio || 1);

export class PointsPlot {
    private plot: Plot | undefined;
    private curves: Curve[] = [];
    private marks: Marks = {};
    private labels: [string, string] = ["", ""];
    private readonly legend = element("p", {className: "legend"});
    private readonly area = element("div");

    constructor(readonly place: HTMLElement, private readonly height: number) {
        this.area.setAttribute("role", "img");
        place.append(this.area, this.legend);
        if (globalThis.ResizeObserver) new ResizeObserver(() => this.resize()).observe(place);
    }

    /** `description` is the text for readers who do not see the plot. */
    show(labels: [string, string], curves: Curve[], marks: Marks, description: string): void {
        [this.curves, this.marks] = [curves, marks];
        this.area.setAttribute("aria-label", description);
        if (!this.plot || String(labels) !== String(this.labels)) this.create(labels);
        this.plot?.setData([this.xs()]);
        this.showLegend();
    }

    /** The plot as a picture with this heading, on opaque paper. */
    picture(heading: string): string | undefined {
        const from = this.plot?.canvas;
        if (!from) return undefined;
        const canvas = element("canvas"), context = canvas.getContext("2d"), row = pixelsOf(24);
        const rows = 1 + (this.curves.length > 1 ? this.curves.length : 0);
        [canvas.width, canvas.height] = [from.width, from.height + row * (rows + 0.5)];
        if (!context) return undefined;
        context.fillStyle = paper();
        context.fillRect(0, 0, canvas.width, canvas.height);
        context.drawImage(from, 0, row * (rows + 0.5));
        context.fillStyle = ink();
        context.font = `600 ${pixelsOf(13)}px system-ui, sans-serif`;
        context.fillText(localized(heading), pixelsOf(10), 0.8 * row, canvas.width - pixelsOf(20));
        if (rows === 1) return canvas.toDataURL("image/png");
        context.font = `${pixelsOf(13)}px system-ui, sans-serif`;
        for (const [k, curve] of this.curves.entries()) {
            const y = (1.7 + k) * row;
            this.drawShape(context, pixelsOf(18), y, k, curve);
            context.fillStyle = ink();
            context.fillText(localized(curve.name), pixelsOf(32), y + pixelsOf(4));
        }
        return canvas.toDataURL("image/png");
    }

    private xs(): number[] {
        const all = this.curves.flatMap(({points}) => points.map(({x}) => x));
        if (this.marks.live) all.push(this.marks.live.x);
        return [...new Set(all)].sort((a, b) => a - b);
    }

    private colorOf(k: number, curve: Curve): string {
        return curve.faint ? quiet() : curveColors[k % curveColors.length]!;
    }

    private create(labels: [string, string]): void {
        this.labels = labels;
        this.plot?.canvas.remove();
        this.plot = new Plot({
            width: this.place.clientWidth || 320, height: this.height,
            x: {label: labels[0], color: ink, grid: line, range: () => this.range("x"), isWhole: () => this.marks.at !== undefined},
            y: {label: labels[1], color: ink, grid: line, range: () => this.range("y")},
            lines: [], draw: (plot) => this.drawAll(plot),
        }, this.area);
    }

    /** The range of an axis: its values with a margin, and for y the zero. */
    private range(axis: "x" | "y"): [number, number] {
        const main = this.curves.filter((each) => !each.faint || each.isReference);
        // Faint curves are cut where they would hide the others.
        const isKnown = axis === "y" && main.some((each) => each.points.length > 1);
        const points = [...(isKnown ? main : this.curves).flatMap((each) => each.points),
                        ...(this.marks.live ? [this.marks.live] : [])];
        const values = axis === "x" ? points.map(({x}) => x)
            : points.flatMap(({y}) => [y]).concat(this.crossesZero() ? [0] : []);
        if (axis === "x" && this.marks.at !== undefined) values.push(this.marks.at);
        // An interval may extend the axis by half of the range of the values; wider ones are cut.
        const finite = values.filter(Number.isFinite);
        if (finite.length === 0) return axis === "x" ? [0, 50] : [-0.1, 0.3];
        let [low, high] = [Math.min(...finite), Math.max(...finite)];
        if (axis === "y") {
            const reach = 0.5 * (high - low) || 0.05;
            const ends = points.flatMap(({lower, upper}) => [lower, upper]).filter(Number.isFinite);
            [low, high] = [Math.max(low - reach, Math.min(low, ...ends)),
                           Math.min(high + reach, Math.max(high, ...ends))];
        }
        const margin = 0.06 * (high - low) || Math.max(0.1 * Math.abs(high), axis === "x" && this.marks.at !== undefined ? 2 : 0) || 1;
        return [low - margin, high + margin];
    }

    /** A rotation rate is compared with zero; other quantities are not. */
    private crossesZero(): boolean {
        const all = this.curves.flatMap(({points}) => points.map(({y}) => y));
        return all.length === 0 || Math.min(...all) < 5;
    }

    private resize(): void {
        if (this.place.clientWidth > 0) this.plot?.setWidth(this.place.clientWidth);
    }

    private drawAll(plot: Plot): void {
        const {context, area} = plot;
        const x = (value: number): number => plot.at(value, "x");
        const y = (value: number): number => plot.at(value, "y");
        if (this.marks.band) {
            const [from, to] = this.marks.band.map(x) as [number, number];
            context.globalAlpha = 0.18;
            context.fillStyle = curveColors[0]!;
            context.fillRect(from, area.top, Math.max(to - from, 2), area.height);
            context.globalAlpha = 1;
        }
        context.lineWidth = pixelsOf(1);
        context.strokeStyle = ink();
        stroke(context, [[area.left, y(0)], [area.left + area.width, y(0)]]);
        if (this.marks.at !== undefined) {
            context.setLineDash([pixelsOf(4), pixelsOf(4)]);
            stroke(context, [[x(this.marks.at), area.top], [x(this.marks.at), area.top + area.height]]);
            context.setLineDash([]);
        }
        for (const faint of [true, false])
            for (const [k, curve] of this.curves.entries()) if (Boolean(curve.faint) === faint) {
                context.strokeStyle = this.colorOf(k, curve);
                context.globalAlpha = faint ? 0.5 : 0.8;
                context.lineWidth = pixelsOf(curve.isReference ? 3 : 1);
                stroke(context, curve.points.map((point) => [x(point.x), y(point.y)]));
                context.globalAlpha = faint ? 0.6 : 1;
                if (!curve.isReference) for (const point of curve.points) {
                    context.strokeStyle = this.colorOf(k, curve);
                    context.lineWidth = pixelsOf(1.5);
                    stroke(context, [[x(point.x), y(point.lower)], [x(point.x), y(point.upper)]]);
                    this.drawShape(context, x(point.x), y(point.y), k, curve);
                }
                context.globalAlpha = 1;
            }
        if (this.marks.live) {
            const {live} = this.marks;
            context.strokeStyle = ink();
            context.lineWidth = pixelsOf(1.5);
            stroke(context, [[x(live.x), y(live.lower)], [x(live.x), y(live.upper)]]);
            context.beginPath();
            context.arc(x(live.x), y(live.y), pixelsOf(5), 0, 2 * Math.PI);
            context.fillStyle = paper();
            context.fill();
            context.stroke();
        }
    }

    private drawShape(context: CanvasRenderingContext2D, x: number, y: number, k: number, curve: Curve): void {
        const r = pixelsOf(curve.faint ? 2.5 : 4);
        context.fillStyle = this.colorOf(k, curve);
        context.beginPath();
        if (k % 3 === 1) context.rect(x - r, y - r, 2 * r, 2 * r);
        else if (k % 3 === 2) {
            context.moveTo(x, y - 1.3 * r);
            context.lineTo(x + 1.2 * r, y + r);
            context.lineTo(x - 1.2 * r, y + r);
        } else context.arc(x, y, r, 0, 2 * Math.PI);
        context.fill();
    }

    private showLegend(): void {
        this.legend.hidden = this.curves.length < 2;
        this.legend.replaceChildren(...this.curves.map((curve, k) => {
            const shape = element("span", {className: `shape shape-${k % 3}`});
            shape.style.background = this.colorOf(k, curve);
            return element("span", {}, shape, localized(curve.name));
        }));
    }
}

function stroke(context: CanvasRenderingContext2D, points: [number, number][]): void {
    context.beginPath();
    for (const [k, [x, y]] of points.entries()) if (k === 0) context.moveTo(x, y); else context.lineTo(x, y);
    context.stroke();
}
