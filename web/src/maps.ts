// Averages in the M-frame as in the paper's Figures 2, 3 and 5: density, flow relative to the
// container, and the angular velocity against θ.
import uPlot from "uplot";
import type {Maps} from "./messages";
import {accent, dark, element, ink, line, quiet} from "./page";
import {symbols, texts} from "./texts";

const densityFrom = 0, densityTo = 0.32; // discs per r²; a dense packing has 0.289
const side = 100; // cells of the density map

/** From the page's background to blue to its text colour: dense regions have the most contrast. */
function shade(x: number): [number, number, number] {
    const t = Math.max(0, Math.min(1, (x - densityFrom) / (densityTo - densityFrom)));
    const stops = dark() ? [[21, 24, 26], [38, 96, 150], [240, 236, 225]]
                         : [[251, 250, 248], [86, 150, 204], [12, 34, 66]];
    const [from, to, s] = t < 0.5 ? [stops[0]!, stops[1]!, 2 * t] : [stops[1]!, stops[2]!, 2 * t - 1];
    return [0, 1, 2].map((k) => from[k]! + s * (to[k]! - from[k]!)) as [number, number, number];
}

function square(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
    const size = Math.round(canvas.clientWidth * (window.devicePixelRatio || 1));
    if (canvas.width !== size) canvas.width = canvas.height = size;
    return size > 0 ? canvas.getContext("2d") : null;
}

function drawWall(context: CanvasRenderingContext2D, size: number): void {
    context.strokeStyle = ink();
    context.lineWidth = size / 200;
    context.beginPath();
    context.arc(size / 2, size / 2, size / 2 - size / 200, 0, 2 * Math.PI);
    context.stroke();
    context.fillStyle = ink();
    context.font = `600 ${size / 18}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.fillText(symbols.farthest, size / 2, size * 0.985);
}

function drawDensity(canvas: HTMLCanvasElement, density: Float64Array): void {
    const context = square(canvas);
    if (!context || density.length !== side * side) return;
    const image = new ImageData(side, side);
    for (let row = 0; row < side; ++row)
        for (let column = 0; column < side; ++column) {
            const at = 4 * ((side - 1 - row) * side + column); // image rows count from above
            const value = density[row * side + column]!;
            image.data.set(Number.isFinite(value) ? [...shade(value), 255] : [0, 0, 0, 0], at);
        }
    const small = element("canvas", {width: side, height: side});
    small.getContext("2d")?.putImageData(image, 0, 0);
    const size = canvas.width;
    context.clearRect(0, 0, size, size);
    context.save();
    context.beginPath();
    context.arc(size / 2, size / 2, size / 2, 0, 2 * Math.PI);
    context.clip();
    context.imageSmoothingEnabled = false;
    context.drawImage(small, 0, 0, size, size);
    context.restore();
    drawWall(context, size);
}

function drawFlow(canvas: HTMLCanvasElement, {x, y, ux, uy}: Maps["flow"]): void {
    const context = square(canvas);
    if (!context || x.length === 0) return;
    const size = canvas.width, cell = size / Math.sqrt(x.length);
    const reach = Math.max(...x.map(Math.abs)) / (1 - 1 / Math.sqrt(x.length));
    context.clearRect(0, 0, size, size);
    context.strokeStyle = context.fillStyle = accent();
    context.lineWidth = size / 250;
    for (let k = 0; k < x.length; ++k) {
        const [u, v] = [ux[k]!, uy[k]!];
        if (!Number.isFinite(u) || !Number.isFinite(v)) continue;
        const px = (x[k]! / reach + 1) * size / 2, py = (1 - y[k]! / reach) * size / 2;
        // The wall moves at about the speed of the container, 1: an arrow of one cell.
        const [dx, dy] = [u * cell, -v * cell];
        context.beginPath();
        context.moveTo(px - dx / 2, py - dy / 2);
        context.lineTo(px + dx / 2, py + dy / 2);
        context.stroke();
        context.beginPath();
        context.moveTo(px + dx / 2, py + dy / 2);
        context.lineTo(px + dx / 6 - dy / 6, py + dy / 6 + dx / 6);
        context.lineTo(px + dx / 6 + dy / 6, py + dy / 6 - dx / 6);
        context.fill();
    }
    drawWall(context, size);
}

export class MapsPanel {
    private readonly density = element("canvas", {id: "density-map"});
    private readonly flow = element("canvas", {id: "flow-map"});
    private readonly plotPlace = element("div", {id: "profile"});
    private plot: uPlot | undefined;
    readonly panel: HTMLDetailsElement;

    constructor(opened: () => void) {
        const figure = (canvas: HTMLCanvasElement, caption: string): HTMLElement => {
            canvas.setAttribute("role", "img");
            canvas.setAttribute("aria-label", caption);
            return element("figure", {}, canvas, element("figcaption", {textContent: caption}));
        };
        this.panel = element("details", {id: "maps"},
            element("summary", {textContent: texts.maps}),
            element("div", {className: "views"}, figure(this.density, texts.density),
                    figure(this.flow, texts.flow)),
            this.plotPlace);
        this.panel.addEventListener("toggle", () => { if (this.panel.open) opened(); });
    }

    get open(): boolean { return this.panel.open; }

    show(maps: Maps): void {
        drawDensity(this.density, maps.density);
        drawFlow(this.flow, maps.flow);
        const known = [...maps.profile.theta.keys()].filter(
            (k) => Number.isFinite(maps.profile.varpi[k]!));
        const column = (values: Float64Array): number[] => known.map((k) => values[k]!);
        this.plot ??= new uPlot({
            width: this.plotPlace.clientWidth || 400, height: 190,
            scales: {x: {time: false, range: [0, 360]}},
            axes: [{label: texts.theta, stroke: ink, grid: {stroke: line}},
                   {label: symbols.rotationM, stroke: ink, grid: {stroke: line}}],
            series: [{label: symbols.theta}, {label: texts.discs, stroke: accent, width: 2},
                     {label: texts.wall, stroke: quiet, width: 1, dash: [5, 4]}],
        }, [[], [], []], this.plotPlace);
        this.plot.setSize({width: this.plotPlace.clientWidth || 400, height: 190});
        this.plot.setData([column(maps.profile.theta), column(maps.profile.varpi),
                           column(maps.profile.wall)]);
    }
}
