// A plot of curves: two linear axes, lines with gaps, and an optional drawing on top. Each change redraws it.
import {element, signed} from "./page";

export interface Axis {
    label?: string;
    color: () => string;
    /** Color of the grid; without one there is no grid. */
    grid?: () => string;
    /** Pixels for the numbers, and for the label. */
    size?: number;
    labelSize?: number;
    /** The range of the axis for the lowest and the highest value on it. */
    range?: (lowest: number, highest: number) => [number, number];
    /** Whether only whole numbers are labelled. */
    isWhole?: () => boolean;
}

export interface Line {
    color: () => string;
    width: number;
    dash?: number[];
}

/** x, and a column for each line; null is a gap. */
export type Columns = (number | null)[][];

export interface PlotOptions {
    width: number;
    height: number;
    x: Axis;
    y: Axis;
    lines: Line[];
    /** Draws on top, within the axes. */
    draw?: (plot: Plot) => void;
}

const font = 12; // pixels
const margin = 14; // right of the axes and above them

/** Round numbers, at most `most`, that cover a range: multiples of 1, 2 or 5 times a power of ten. */
export function ticksOf(from: number, to: number, most: number): number[] {
    const least = (to - from) / Math.max(1, most);
    if (!(least > 0) || !Number.isFinite(least)) return [];
    const power = 10 ** Math.floor(Math.log10(least) + 1e-9);
    const step = power * ([1, 2, 5, 10].find((each) => each * power >= least * (1 - 1e-9)) ?? 10);
    const first = Math.ceil(from / step - 1e-9), last = Math.floor(to / step + 1e-9);
    return Array.from({length: last - first + 1}, (_, k) => Number(((first + k) * step).toPrecision(12)));
}

/** Tick labels with the same number of decimals. */
export function labelsOf(ticks: number[]): string[] {
    const decimals = Math.max(0, ...ticks.map((tick) => (String(tick).split(".")[1] ?? "").length));
    return ticks.map((tick) => signed(tick, decimals));
}

export class Plot {
    readonly canvas = element("canvas");
    /** In pixels of the canvas. */
    readonly area = {left: 0, top: 0, width: 0, height: 0};
    private columns: Columns = [[]];
    private ranges: {x: [number, number]; y: [number, number]} = {x: [0, 1], y: [0, 1]};

    constructor(private readonly options: PlotOptions, place: HTMLElement) {
        this.canvas.style.display = "block";
        place.append(this.canvas);
        // The colours of the page follow the system.
        matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
    }

    get context(): CanvasRenderingContext2D { return this.canvas.getContext("2d")!; }

    setData(columns: Columns): void {
        this.columns = columns;
        this.redraw();
    }

    setWidth(width: number): void {
        if (width === this.options.width) return;
        this.options.width = width;
        this.redraw();
    }

    /** The position of a value in pixels of the canvas. */
    at(value: number, axis: "x" | "y"): number {
        const {left, top, width, height} = this.area, [from, to] = this.ranges[axis], share = (value - from) / (to - from);
        return axis === "x" ? left + share * width : top + (1 - share) * height;
    }

    redraw(): void {
        const {options, canvas, context, area} = this, ratio = window.devicePixelRatio || 1;
        const {width, height, x, y, draw} = options;
        [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
        [canvas.style.width, canvas.style.height] = [`${width}px`, `${height}px`];
        area.left = ((y.size ?? 48) + (y.label ? y.labelSize ?? 20 : 0)) * ratio;
        area.top = margin * ratio;
        area.width = Math.max(1, canvas.width - area.left - margin * ratio);
        area.height = Math.max(1, canvas.height - area.top - ((x.size ?? 26) + (x.label ? x.labelSize ?? 20 : 0)) * ratio);
        this.ranges = {x: this.rangeOf(x, this.columns.slice(0, 1)), y: this.rangeOf(y, this.columns.slice(1))};
        this.drawAxes(ratio);
        context.save();
        context.beginPath();
        context.rect(area.left, area.top, area.width, area.height);
        context.clip();
        for (const [k, line] of options.lines.entries()) this.drawLine(line, this.columns[k + 1] ?? [], ratio);
        draw?.(this);
        context.restore();
    }

    private rangeOf({range}: Axis, columns: Columns): [number, number] {
        let [low, high] = [Infinity, -Infinity];
        for (const column of columns) for (const value of column) if (value !== null) {
            low = Math.min(low, value);
            high = Math.max(high, value);
        }
        if (!(low <= high)) [low, high] = [0, 1];
        const [from, to] = range ? range(low, high) : [low, high];
        return to > from ? [from, to] : [from - 0.5, from + 0.5];
    }

    private drawAxes(ratio: number): void {
        const {context, area, options: {x, y, height}} = this;
        context.font = `${font * ratio}px Inter, system-ui, sans-serif`;
        context.lineWidth = ratio;
        const bottom = area.top + area.height;
        const {x: span} = this.ranges, most = area.width / (52 * ratio);
        const xs = ticksOf(...span, x.isWhole?.() ? Math.min(most, span[1] - span[0]) : most), ys = ticksOf(...this.ranges.y, area.height / (30 * ratio));
        for (const [axis, ticks] of [[x, xs], [y, ys]] as const) {
            const vertical = axis === x;
            for (const [k, text] of labelsOf(ticks).entries()) {
                const at = Math.round(this.at(ticks[k]!, vertical ? "x" : "y"));
                if (axis.grid) {
                    context.strokeStyle = axis.grid();
                    context.beginPath();
                    context.moveTo(vertical ? at : area.left, vertical ? area.top : at);
                    context.lineTo(vertical ? at : area.left + area.width, vertical ? bottom : at);
                    context.stroke();
                }
                context.fillStyle = axis.color();
                context.textAlign = vertical ? "center" : "right";
                context.textBaseline = vertical ? "top" : "middle";
                context.fillText(text, vertical ? at : area.left - 6 * ratio, vertical ? bottom + 7 * ratio : at);
            }
        }
        context.textAlign = "center";
        context.font = `600 ${font * ratio}px Inter, system-ui, sans-serif`;
        context.textBaseline = "bottom";
        if (x.label) context.fillText(x.label, area.left + area.width / 2, height * ratio - ratio);
        if (!y.label) return;
        context.save();
        context.translate(2 * ratio, area.top + area.height / 2);
        context.rotate(-Math.PI / 2);
        context.textBaseline = "top";
        context.fillText(y.label, 0, 0);
        context.restore();
    }

    private drawLine({color, width, dash = []}: Line, values: (number | null)[], ratio: number): void {
        const {context} = this, xs = this.columns[0] ?? [];
        context.strokeStyle = color();
        context.lineWidth = width * ratio;
        context.lineJoin = "round";
        context.setLineDash(dash.map((each) => each * ratio));
        context.beginPath();
        let isGap = true;
        for (const [k, value] of values.entries()) {
            const at = xs[k] ?? null;
            if (value === null || at === null) {
                isGap = true;
                continue;
            }
            if (isGap) context.moveTo(this.at(at, "x"), this.at(value, "y"));
            else context.lineTo(this.at(at, "x"), this.at(value, "y"));
            isGap = false;
        }
        context.stroke();
        context.setLineDash([]);
    }
}
