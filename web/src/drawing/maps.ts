// Averages in the M-frame behind the discs, as in the paper's Figures 2 and 5: density, flow
// relative to the container, and spin.
import type {Maps} from "../engine/messages";
import {element} from "../elements/page";
import {diverging, paletteOf} from "./palette";

export type MapKind = "density" | "flow" | "spin";
export interface MapLayer {
    kind: MapKind;
    maps: Maps | undefined;
    /** During the warm-up density and flow have no averages. */
    isEmpty: boolean;
}

const spinTo = 0.6; // Ω
const densityTo = 0.32; // discs per r²; a dense packing has 0.289

/** From the floor of the container to blue to its text colour: dense regions have the most
 *  contrast. */
export function mapColor(t: number, isDark: boolean): [number, number, number] {
    const stops = isDark
        ? [
              [29, 34, 38],
              [38, 96, 150],
              [200, 224, 246],
          ]
        : [
              [255, 255, 255],
              [124, 178, 220],
              [16, 52, 98],
          ];
    const [from, to, s] =
        t < 0.5 ? [stops[0]!, stops[1]!, 2 * t] : [stops[1]!, stops[2]!, 2 * t - 1];
    return [0, 1, 2].map((k) => from[k]! + s * (to[k]! - from[k]!)) as [number, number, number];
}

export function layerOf(kind: MapKind, maps: Maps | undefined): MapLayer {
    const values = maps && (kind === "flow" ? maps.flow.ux : maps[kind]);
    return {kind, maps, isEmpty: !values || !values.some(Number.isFinite)};
}

let painted: {of: Maps; kind: MapKind; isDark: boolean; image: HTMLCanvasElement} | undefined; // the last one

/** The values of a square grid as an image; rows count from below. */
function imageOf(maps: Maps, kind: "density" | "spin", isDark: boolean): HTMLCanvasElement {
    if (painted?.of === maps && painted.kind === kind && painted.isDark === isDark)
        return painted.image;
    const values = maps[kind],
        side = Math.round(Math.sqrt(values.length));
    const image = element("canvas", {width: side, height: side}),
        data = new ImageData(side, side);
    for (const [k, value] of values.entries()) {
        const shade =
            kind === "density"
                ? mapColor(Math.max(0, Math.min(1, value / densityTo)), isDark)
                : diverging(value / spinTo);
        data.data.set(
            Number.isFinite(value) ? [...shade, kind === "spin" ? 210 : 255] : [0, 0, 0, 0],
            4 * k,
        );
    }
    image.getContext("2d")?.putImageData(data, 0, 0);
    painted = {of: maps, kind, isDark, image};
    return image;
}

/** Draws in the M-frame, with the container's centre at the origin. */
export function drawMap(
    context: CanvasRenderingContext2D,
    {kind, maps}: MapLayer,
    radius: number,
    isDark: boolean,
): void {
    if (!maps) return;
    if (kind === "flow") return drawFlow(context, maps.flow, isDark);
    if (maps[kind].length === 0) return;
    context.save();
    context.beginPath();
    context.arc(0, 0, radius, 0, 2 * Math.PI);
    context.clip();
    context.drawImage(imageOf(maps, kind, isDark), -radius, -radius, 2 * radius, 2 * radius);
    context.restore();
}

function drawFlow(
    context: CanvasRenderingContext2D,
    {x, y, ux, uy}: Maps["flow"],
    isDark: boolean,
): void {
    const cell = x.length > 1 ? x[1]! - x[0]! : 0;
    context.strokeStyle = context.fillStyle = paletteOf(isDark).quiet;
    context.lineWidth = 0.12 * cell;
    for (let k = 0; k < x.length; ++k) {
        // The wall moves at about the speed of the container, 1: an arrow of one cell.
        const [dx, dy] = [ux[k]! * cell, uy[k]! * cell];
        if (!Number.isFinite(dx) || !Number.isFinite(dy)) continue;
        const [px, py] = [x[k]!, y[k]!];
        context.beginPath();
        context.moveTo(px - dx / 2, py - dy / 2);
        context.lineTo(px + dx / 3, py + dy / 3);
        context.stroke();
        context.beginPath();
        context.moveTo(px + dx / 2, py + dy / 2);
        context.lineTo(px + dx / 6 - dy / 5, py + dy / 6 + dx / 5);
        context.lineTo(px + dx / 6 + dy / 5, py + dy / 6 - dx / 5);
        context.fill();
    }
}
