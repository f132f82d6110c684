// The charts of the page: curves of estimates with intervals, or lines with gaps, on two linear
// axes. Each change redraws the whole chart.
import {
    canvasFont,
    directionColor,
    element,
    ink,
    line as grid,
    localized,
    paper,
    quiet,
    signed,
} from "./page";

export interface ChartPoint {
    x: number;
    /** NaN is a gap in the line. */
    y: number;
    /** The interval. */
    lower?: number;
    upper?: number;
}

export interface ChartCurve {
    name: string;
    points: ChartPoint[];
    /** Drawn in grey behind the others. */
    isFaint?: boolean;
    /** Rotation rates: each point has the colour of its direction, and no line joins them, because
     *  it would lead from one direction to the other. */
    isRotation?: boolean;
    /** A line without points. */
    line?: {width: number; color: () => string; dash?: number[]};
}

/** Marks in addition to the curves. */
export interface ChartMarks {
    /** A vertical line at the present value. */
    at?: number | undefined;
    /** An estimate that is still growing; drawn as a ring. */
    live?: ChartPoint | undefined;
    /** The interval of x in which the curve crosses zero. */
    band?: [number, number] | undefined;
    /** Vertical lines with texts. */
    notes?: {at: number; text: string}[];
}

type Range = (lowest: number, highest: number) => [number, number];
export interface ChartOptions {
    height: number;
    /** The ranges of the axes for the lowest and the highest value; by default all values with a
     *  margin. */
    x?: Range;
    y?: Range;
}

/** Suited to colour-blind readers; contrast of at least 3 with white and black paper. */
export const curveColors = ["#c4500a", "#0072b2", "#008a63", "#b8609a", "#a87900"];

const margin = 14,
    numbersBelow = 26,
    numbersLeft = 44,
    labelSize = 20; // pixels
const pixelsOf = (css: number): number => css * (window.devicePixelRatio || 1);
const setFont = (context: CanvasRenderingContext2D, css: number, weight = 400): void => {
    context.font = canvasFont(weight, pixelsOf(css));
};

/** Round numbers, at most `most`, that cover a range: multiples of 1, 2 or 5 times a power of ten.
 *  */
export function ticksOf(from: number, to: number, most: number): number[] {
    const least = (to - from) / Math.max(1, most);
    if (!(least > 0) || !Number.isFinite(least)) return [];
    const power = 10 ** Math.floor(Math.log10(least) + 1e-9);
    const step = power * ([1, 2, 5, 10].find((each) => each * power >= least * (1 - 1e-9)) ?? 10);
    const first = Math.ceil(from / step - 1e-9),
        last = Math.floor(to / step + 1e-9);
    return Array.from({length: last - first + 1}, (_, k) =>
        Number(((first + k) * step).toPrecision(12)),
    );
}

/** Tick labels with the same number of decimals. */
export function labelsOf(ticks: number[]): string[] {
    const decimals = Math.max(0, ...ticks.map((tick) => (String(tick).split(".")[1] ?? "").length));
    return ticks.map((tick) => signed(tick, decimals));
}

function stroke(
    context: CanvasRenderingContext2D,
    points: [number, number][],
    dash: number[] = [],
): void {
    context.setLineDash(dash.map(pixelsOf));
    context.beginPath();
    let isGap = true;
    for (const [x, y] of points) {
        if (!Number.isNaN(y) && isGap) context.moveTo(x, y);
        else if (!isGap) context.lineTo(x, y);
        isGap = Number.isNaN(y);
    }
    context.stroke();
    context.setLineDash([]);
}

export class Chart {
    private readonly area = element("div");
    private readonly canvas = element("canvas");
    private readonly legend = element("p", {className: "legend"});
    private curves: ChartCurve[] = [];
    private marks: ChartMarks = {};
    private labels: [string, string] = ["", ""];
    /** The axes in pixels of the canvas, and their ranges. */
    private readonly box = {left: 0, top: 0, width: 0, height: 0};
    private ranges: {x: [number, number]; y: [number, number]} = {x: [0, 1], y: [0, 1]};

    constructor(
        private readonly place: HTMLElement,
        private readonly options: ChartOptions,
    ) {
        this.canvas.style.display = "block";
        this.area.setAttribute("role", "img");
        this.area.append(this.canvas);
        place.append(this.area, this.legend);
        if (globalThis.ResizeObserver) new ResizeObserver(() => this.redraw()).observe(place);
        // The colours of the page follow the system.
        matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
    }

    /** `description` is the text for readers who do not see the chart. */
    show(
        labels: [string, string],
        curves: ChartCurve[],
        marks: ChartMarks,
        description: string,
    ): void {
        [this.labels, this.curves, this.marks] = [labels, curves, marks];
        this.area.setAttribute("aria-label", description);
        this.redraw();
        const named = curves.filter(({line}) => !line?.dash && !curves.every((each) => each.line));
        this.legend.hidden = named.length < 2;
        this.legend.replaceChildren(
            ...named.map((curve) => {
                const k = curves.indexOf(curve),
                    shape = element("span", {className: `shape shape-${k % 3}`});
                shape.style.background = this.colorOf(k, curve);
                return element("span", {}, shape, localized(curve.name));
            }),
        );
    }

    /** The chart as a picture with this heading, on opaque paper. */
    picture(heading: string): string | undefined {
        const {canvas: from, curves} = this,
            canvas = element("canvas"),
            context = canvas.getContext("2d"),
            row = pixelsOf(24);
        const rows = 1.5 + (curves.length > 1 ? curves.length : 0);
        [canvas.width, canvas.height] = [from.width, from.height + row * rows];
        if (!context) return undefined;
        context.fillStyle = paper();
        context.fillRect(0, 0, canvas.width, canvas.height);
        context.drawImage(from, 0, row * rows);
        context.fillStyle = ink();
        setFont(context, 13, 600);
        context.fillText(localized(heading), pixelsOf(10), 0.8 * row, canvas.width - pixelsOf(20));
        setFont(context, 13);
        if (curves.length > 1)
            for (const [k, curve] of curves.entries()) {
                const y = (1.7 + k) * row;
                this.drawShape(context, pixelsOf(18), y, k, curve);
                context.fillStyle = ink();
                context.fillText(localized(curve.name), pixelsOf(32), y + pixelsOf(4));
            }
        return canvas.toDataURL("image/png");
    }

    /** The colour of a curve, or of its point with this value. */
    private colorOf(k: number, {isFaint, isRotation, line}: ChartCurve, y?: number): string {
        if (line) return line.color();
        if (isFaint) return quiet();
        if (isRotation) return y === undefined ? ink() : directionColor(y);
        return curveColors[k % curveColors.length]!;
    }

    private x(value: number): number {
        const {left, width} = this.box,
            [from, to] = this.ranges.x;
        return left + (width * (value - from)) / (to - from);
    }
    private y(value: number): number {
        const {top, height} = this.box,
            [from, to] = this.ranges.y;
        return top + (height * (to - value)) / (to - from);
    }

    private redraw(): void {
        const {canvas, box} = this,
            width = this.place.clientWidth || 320,
            {height} = this.options,
            context = canvas.getContext("2d");
        if (!context) return;
        [canvas.width, canvas.height] = [Math.round(pixelsOf(width)), Math.round(pixelsOf(height))];
        [canvas.style.width, canvas.style.height] = [`${width}px`, `${height}px`];
        box.left = pixelsOf(numbersLeft + (this.labels[1] ? labelSize : 0));
        box.top = pixelsOf(margin);
        box.width = Math.max(1, canvas.width - box.left - pixelsOf(margin));
        box.height = Math.max(
            1,
            canvas.height - box.top - pixelsOf(numbersBelow + (this.labels[0] ? labelSize : 0)),
        );
        this.ranges = {x: this.range("x"), y: this.range("y")};
        this.drawAxes(context);
        context.save();
        context.beginPath();
        context.rect(box.left, box.top, box.width, box.height);
        context.clip();
        this.drawMarks(context);
        for (const isFaint of [true, false])
            for (const [k, curve] of this.curves.entries())
                if (Boolean(curve.isFaint) === isFaint) this.drawCurve(context, k, curve);
        this.drawLive(context);
        context.restore();
    }

    /** The range of an axis: its values with a margin, and for a rotation rate the zero. */
    private range(axis: "x" | "y"): [number, number] {
        const main = this.curves.filter(({isFaint, line}) => !isFaint || line),
            {at, live} = this.marks;
        // Faint curves are cut where they would hide the others.
        const isKnown = axis === "y" && main.some(({points}) => points.length > 1);
        const points = [
            ...(isKnown ? main : this.curves).flatMap((each) => each.points),
            ...(live ? [live] : []),
        ];
        const values = points.map((point) => point[axis]).filter(Number.isFinite),
            set = this.options[axis];
        if (axis === "x" && at !== undefined) values.push(at);
        let [low, high] = values.reduce(
            ([a, b], each) => [Math.min(a, each), Math.max(b, each)],
            [Infinity, -Infinity],
        );
        if (set) {
            const [from, to] = low <= high ? set(low, high) : set(0, 1);
            return to > from ? [from, to] : [from - 0.5, from + 0.5];
        }
        if (!(low <= high)) return axis === "x" ? [0, 50] : [-0.1, 0.3];
        if (axis === "y") {
            if (low < 5) [low, high] = [Math.min(low, 0), Math.max(high, 0)];
            // An interval may extend the axis by half of the range of the values; wider ones are
            // cut.
            const reach = 0.5 * (high - low) || 0.05,
                ends = points
                    .flatMap(({y, lower = y, upper = y}) => [lower, upper])
                    .filter(Number.isFinite);
            [low, high] = [
                Math.max(low - reach, Math.min(low, ...ends)),
                Math.min(high + reach, Math.max(high, ...ends)),
            ];
        }
        const more =
            0.06 * (high - low) ||
            Math.max(0.1 * Math.abs(high), axis === "x" && at !== undefined ? 2 : 0) ||
            1;
        return [low - more, high + more];
    }

    private drawAxes(context: CanvasRenderingContext2D): void {
        const {
                box,
                ranges: {x: span, y: rise},
                labels,
            } = this,
            bottom = box.top + box.height,
            right = box.left + box.width;
        const most = box.width / pixelsOf(52);
        const xs = ticksOf(
            ...span,
            this.marks.at === undefined ? most : Math.min(most, span[1] - span[0]),
        ); // whole numbers of discs
        const ys = ticksOf(...rise, box.height / pixelsOf(30));
        setFont(context, 13);
        context.lineWidth = pixelsOf(1);
        context.strokeStyle = grid();
        context.fillStyle = ink();
        [context.textAlign, context.textBaseline] = ["center", "top"];
        for (const [k, text] of labelsOf(xs).entries()) {
            const x = Math.round(this.x(xs[k]!));
            stroke(context, [
                [x, box.top],
                [x, bottom],
            ]);
            context.fillText(text, x, bottom + pixelsOf(7));
        }
        [context.textAlign, context.textBaseline] = ["right", "middle"];
        for (const [k, text] of labelsOf(ys).entries()) {
            const y = Math.round(this.y(ys[k]!));
            stroke(context, [
                [box.left, y],
                [right, y],
            ]);
            context.fillText(text, box.left - pixelsOf(6), y);
        }
        setFont(context, 13, 600);
        [context.textAlign, context.textBaseline] = ["center", "bottom"];
        context.fillText(labels[0], box.left + box.width / 2, this.canvas.height - pixelsOf(1));
        context.save();
        context.translate(pixelsOf(2), box.top + box.height / 2);
        context.rotate(-Math.PI / 2);
        context.textBaseline = "top";
        context.fillText(labels[1], 0, 0);
        context.restore();
    }

    private drawMarks(context: CanvasRenderingContext2D): void {
        const {
                box,
                marks: {band, at, notes = []},
            } = this,
            bottom = box.top + box.height;
        if (band) {
            const [from, to] = band.map((each) => this.x(each)) as [number, number];
            context.globalAlpha = 0.18;
            context.fillStyle = quiet();
            context.fillRect(from, box.top, Math.max(to - from, 2), box.height);
            context.globalAlpha = 1;
        }
        context.lineWidth = pixelsOf(1);
        context.strokeStyle = context.fillStyle = ink();
        stroke(context, [
            [box.left, this.y(0)],
            [box.left + box.width, this.y(0)],
        ]);
        if (at !== undefined)
            stroke(
                context,
                [
                    [this.x(at), box.top],
                    [this.x(at), bottom],
                ],
                [4, 4],
            );
        setFont(context, 13);
        for (const note of notes) {
            const x = this.x(note.at),
                isLate = x > box.left + 0.6 * box.width;
            stroke(context, [
                [x, box.top],
                [x, bottom],
            ]);
            [context.textAlign, context.textBaseline] = [isLate ? "right" : "left", "alphabetic"];
            context.fillText(note.text, x + pixelsOf(isLate ? -4 : 4), box.top + pixelsOf(10));
        }
    }

    private drawCurve(context: CanvasRenderingContext2D, k: number, curve: ChartCurve): void {
        const {points, isFaint, isRotation, line} = curve;
        context.strokeStyle = this.colorOf(k, curve);
        context.lineJoin = "round";
        context.lineWidth = pixelsOf(line?.width ?? 1);
        context.globalAlpha = isFaint ? 0.5 : line ? 1 : 0.8;
        if (!isRotation)
            stroke(
                context,
                points.map(({x, y}) => [this.x(x), this.y(y)]),
                line?.dash,
            );
        context.globalAlpha = isFaint ? 0.6 : 1;
        context.lineWidth = pixelsOf(1.5);
        if (!line)
            for (const {x, y, lower = y, upper = y} of points) {
                context.strokeStyle = this.colorOf(k, curve, y);
                stroke(context, [
                    [this.x(x), this.y(lower)],
                    [this.x(x), this.y(upper)],
                ]);
                this.drawShape(context, this.x(x), this.y(y), k, curve, y);
            }
        context.globalAlpha = 1;
    }

    private drawLive(context: CanvasRenderingContext2D): void {
        const {live} = this.marks;
        if (!live) return;
        const {x, y, lower = y, upper = y} = live;
        context.strokeStyle = ink();
        context.fillStyle = paper();
        context.lineWidth = pixelsOf(1.5);
        stroke(context, [
            [this.x(x), this.y(lower)],
            [this.x(x), this.y(upper)],
        ]);
        context.beginPath();
        context.arc(this.x(x), this.y(y), pixelsOf(5), 0, 2 * Math.PI);
        context.fill();
        context.stroke();
    }

    /** Curves differ in colour and in the shape of their points. */
    private drawShape(
        context: CanvasRenderingContext2D,
        x: number,
        y: number,
        k: number,
        curve: ChartCurve,
        value?: number,
    ): void {
        const r = pixelsOf(curve.isFaint ? 2.5 : 4);
        context.fillStyle = this.colorOf(k, curve, value);
        context.beginPath();
        if (k % 3 === 1) context.rect(x - r, y - r, 2 * r, 2 * r);
        else if (k % 3 === 2) {
            context.moveTo(x, y - 1.3 * r);
            context.lineTo(x + 1.2 * r, y + r);
            context.lineTo(x - 1.2 * r, y + r);
        } else context.arc(x, y, r, 0, 2 * Math.PI);
        context.fill();
    }
}
