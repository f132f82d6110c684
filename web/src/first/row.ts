// The row of beads, which is a slider and a plot: one bead for each number of discs, and a bar at
// each number that was measured, upwards with the swirl and downwards against it.
import {canvasFont} from "../elements/page";
import type {Palette} from "../drawing/palette";
import {sized} from "./canvas";
import type {Point, Points} from "./points";

export const fewest = 3,
    most = 55;
const margin = 18; // pixels at both ends, half of the bead with the number
const thumb = 13;

/** The place of a number, in pixels from the left end of the row. */
export const placeOf = (n: number, width: number): number =>
    margin + ((n - fewest) * (width - 2 * margin)) / (most - fewest);

/** The number of discs at a place of the row, in pixels from its left end. */
export function numberAt(x: number, width: number): number {
    const share = (x - margin) / (width - 2 * margin);
    return Math.max(fewest, Math.min(most, Math.round(fewest + share * (most - fewest))));
}

export interface Row {
    n: number;
    measured: Points;
    /** Points of other frictions, drawn faintly. */
    others: readonly Points[];
    palette: Palette;
}

/** A bar is as tall as the root of its rate, so that weak counterrotation is visible; it is full at
 *  0.4 Ω. */
const heightOf = (rate: number, room: number): number =>
    Math.min(room, 1.6 * Math.sqrt(rate) * room);

export function drawRow(canvas: HTMLCanvasElement, {n, measured, others, palette}: Row): void {
    const {context, width, height} = sized(canvas),
        zero = height / 2,
        room = zero - thumb - 3,
        step = (width - 2 * margin) / (most - fewest),
        bar = Math.max(4, 0.7 * step);
    const {points, reversal} = measured;
    if (reversal) {
        // A bracket below the two numbers between which the direction changes.
        const [from, to] = reversal.map((number) => placeOf(number, width)) as [number, number];
        context.strokeStyle = palette.ink;
        context.lineWidth = 2;
        context.beginPath();
        context.moveTo(from, height - 8);
        context.lineTo(from, height - 2);
        context.lineTo(to, height - 2);
        context.lineTo(to, height - 8);
        context.stroke();
    }
    const drawBars = (all: ReadonlyMap<number, Point>, opacity: number): void => {
        context.globalAlpha = opacity;
        for (const [number, {mean, way}] of all) {
            const tall = Math.max(2, heightOf(Math.abs(mean), room));
            context.fillStyle = way === "still" ? palette.quiet : palette[way];
            const top = mean > 0 ? zero - thumb - tall : zero + thumb;
            context.fillRect(placeOf(number, width) - bar / 2, top, bar, tall);
        }
        context.globalAlpha = 1;
    };
    for (const {points: all} of others) drawBars(all, 0.25);
    drawBars(points, 1);
    for (let number = fewest; number <= most; ++number) {
        const point = points.get(number);
        context.fillStyle = point && point.way !== "still" ? palette[point.way] : palette.quiet;
        context.globalAlpha = number <= n || point ? 1 : 0.35;
        context.beginPath();
        context.arc(placeOf(number, width), zero, Math.min(0.36 * step, 5), 0, 2 * Math.PI);
        context.fill();
    }
    context.globalAlpha = 1;
    const x = placeOf(n, width);
    context.fillStyle = palette.ink;
    context.beginPath();
    context.arc(x, zero, thumb, 0, 2 * Math.PI);
    context.fill();
    context.fillStyle = palette.paper;
    context.font = canvasFont(700, 13);
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText(String(n), x, zero + 1);
}
