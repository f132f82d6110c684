// Draws a frame on a canvas, in the lab frame or in the M-frame. The M-frame's origin is the centre
// C of the container, and its −y axis points from S, the centre of the path, to C.
import {drawBall, inRotatedAxes, type Orientation} from "./ball";
import {frameDisc, frameHead, frameOrientation} from "../engine/engine";
import {drawLegend} from "./legend";
import {drawMap} from "./maps";
import {drawContacts, drawForces, drawHeld, drawMarks} from "./marks";
import {diverging, idColors, paletteOf, sectorColors, sequential, type Palette} from "./palette";
import {drawSwirl, drawTurns, drawWallMark} from "./turns";
import {head, shown, type DrawOptions, type Frame} from "./view";

const swirlInset = 6; // pixels of the page, from the edge to the arrow of the swirl
const border = 20; // pixels of the page: for the arc outside the wall, and the marks on it

/** The distance of the wall from S in a frame, or in the farthest position of the container, `room`
 *  from S. */
export const extentOf = (f: Float64Array, room: number): number =>
    f[7]! + Math.max(room, Math.hypot(f[3]!, f[4]!));

/** Length units per pixel of the page, for an image of this width. */
const unitsPerPixel = (extent: number, width: number, isSmall = false): number =>
    extent / Math.max(0.5 * width - (isSmall ? 2 : Math.min(border, 0.11 * width)), 0.25 * width);

/** The point of the lab frame at these coordinates of the window. */
export function pointedAt(
    canvas: HTMLCanvasElement,
    extent: number,
    clientX: number,
    clientY: number,
): [number, number] {
    const box = canvas.getBoundingClientRect();
    const scale = unitsPerPixel(extent, box.width);
    return [
        (clientX - box.left - box.width / 2) * scale,
        (box.top + box.height / 2 - clientY) * scale,
    ];
}

/** The disc at a point of the lab frame. */
export function discAt(f: Float64Array, x: number, y: number): number | undefined {
    for (let i = 0; i < f[10]!; ++i) {
        const k = frameHead + frameDisc * i;
        if (Math.hypot(f[k]! - x, f[k + 1]! - y) <= f[k + 6]!) return i;
    }
    return undefined;
}

/** The orientation of sphere i; undefined for particles that cannot roll. */
function orientationOf(f: Float64Array, i: number): Orientation | undefined {
    const k = frameHead + frameDisc * f[10]! + frameOrientation * i;
    return k < f.length ? [f[k]!, f[k + 1]!, f[k + 2]!, f[k + 3]!] : undefined;
}

function color(f: Float64Array, k: number, i: number, look: DrawOptions): string {
    const {coloring, sectors} = look;
    if (coloring === "sector") return sectorColors[sectors[i] ?? 0]!;
    if (coloring === "id") return idColors[i % idColors.length]!;
    if (coloring === "pinned") return paletteOf(look.dark)[f[k + 7] === 1 ? "pinned" : "loose"];
    const [vx, vy] = [f[k + 4]! - f[5]!, f[k + 5]! - f[6]!]; // relative to the container
    // Full colour at a spin of 1.3 Ω of the paper's container, or twice the container's speed.
    const shade =
        coloring === "speed" ? sequential(Math.hypot(vx, vy) / 2) : diverging(1.5 * f[k + 3]!);
    return `rgb(${shade.join(" ")})`;
}

const minBallRadius = 6; // pixels; the pattern of smaller spheres is invisible

/** Pixels of the canvas per pixel of the page; sets the canvas's size. */
function fit(canvas: HTMLCanvasElement): number {
    const ratio = window.devicePixelRatio || 1,
        size = Math.round(canvas.clientWidth * ratio);
    if (canvas.width !== size) canvas.width = canvas.height = size;
    return ratio;
}

export function draw(canvas: HTMLCanvasElement, f: Float64Array, look: DrawOptions): void {
    const context = canvas.getContext("2d");
    if (!context) return;
    const ratio = fit(canvas),
        size = canvas.width,
        frame = head(f),
        palette = paletteOf(look.dark);
    const extent = look.view === "lab" ? look.extent : frame.radius,
        scale = ratio / unitsPerPixel(extent, size / ratio, look.isSmall),
        hair = (1.2 * ratio) / scale;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = palette.paper; // so that a movie has it, too
    context.fillRect(0, 0, size, size);
    context.setTransform(scale, 0, 0, -scale, size / 2, size / 2);
    const frameAngle = look.view === "m" ? Math.atan2(frame.down[0], -frame.down[1]) : 0;
    if (look.view === "lab" && !look.isSmall)
        drawSwirl(context, (((0.5 * size) / ratio - swirlInset) * ratio) / scale, palette, hair);
    drawContainer(context, frame, look, palette, frameAngle, hair);
    if (look.map) drawMap(context, look.map, frame.radius, look.dark);
    if (look.view === "lab" && !look.isSmall) {
        drawPath(context, frame, palette, hair);
        drawTurns(context, frame, look.turns, palette, hair);
    }
    if (look.view === "lab" && !look.isSmall) drawMarks(context, frame, look, palette, hair);
    if (look.map) drawOutlines(context, f, frame, look, palette, hair);
    else drawDiscs(context, f, frame, look, frameAngle, scale, hair);
    if (look.coloring === "contacts") drawContacts(context, f, frame, look, palette, hair);
    if (look.view === "m" && look.omega > 0)
        drawForces(context, f, frame, look.omega, palette, hair);
    if (look.held !== undefined && look.held < frame.discs)
        drawHeld(context, f, frame, look, palette, look.held, hair);
    if (look.isSmall) return;
    if (look.view === "m") drawMarks(context, frame, look, palette, hair);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    drawLegend(context, size / ratio, look, palette);
}

/** The container and its wall. In the M-frame the wall moves, as twelve marks on it show. */
function drawContainer(
    context: CanvasRenderingContext2D,
    frame: Frame,
    {view, isSmall}: DrawOptions,
    palette: Palette,
    frameAngle: number,
    hair: number,
): void {
    const [cx, cy] = shown(frame, view, ...frame.centre);
    context.fillStyle = palette.floor;
    context.strokeStyle = palette.ink;
    context.lineWidth = (isSmall ? 1.2 : 2.6) * hair;
    context.beginPath();
    context.arc(cx, cy, frame.radius + 0.5 * context.lineWidth, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
    if (view === "lab" || isSmall) return;
    for (let k = 0; k < 12; ++k) {
        const angle = (k * Math.PI) / 6 - frameAngle;
        const [from, to] = [frame.radius + 2.6 * hair, frame.radius + (k === 0 ? 11 : 7) * hair];
        context.lineWidth = (k === 0 ? 5 : 2) * hair;
        drawWallMark(context, [cx, cy], angle, from, to);
    }
}

/** The path of the container's centre, with an arrow in its direction. */
function drawPath(
    context: CanvasRenderingContext2D,
    frame: Frame,
    palette: Palette,
    hair: number,
): void {
    const amplitude = Math.hypot(...frame.centre);
    if (!(amplitude > 3 * hair)) return;
    context.strokeStyle = context.fillStyle = palette.quiet;
    context.lineWidth = hair;
    context.setLineDash([3 * hair, 4 * hair]);
    context.beginPath();
    context.arc(0, 0, amplitude, 0, 2 * Math.PI);
    context.stroke();
    context.setLineDash([]);
}

function drawDiscs(
    context: CanvasRenderingContext2D,
    f: Float64Array,
    frame: Frame,
    look: DrawOptions,
    frameAngle: number,
    scale: number,
    hair: number,
): void {
    for (let i = 0; i < frame.discs; ++i) {
        const k = frameHead + frameDisc * i;
        const [x, y] = shown(frame, look.view, f[k]!, f[k + 1]!);
        const r = f[k + 6]!,
            angle = f[k + 2]! - frameAngle,
            orientation = orientationOf(f, i);
        context.fillStyle = color(f, k, i, look);
        if (orientation && r * scale > minBallRadius) {
            drawBall(context, x, y, r, inRotatedAxes(frameAngle, orientation));
            continue;
        }
        context.beginPath();
        context.arc(x, y, r, 0, 2 * Math.PI);
        context.fill();
        if (r * scale < 4) continue;
        context.lineWidth = Math.min(hair, 0.15 * r);
        context.strokeStyle = "rgb(0 0 0 / .4)";
        context.stroke();
        if (look.isSmall) continue;
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(x + r * Math.cos(angle), y + r * Math.sin(angle));
        context.stroke();
    }
}

/** On a map, discs are outlines; the pinned ones are marked. */
function drawOutlines(
    context: CanvasRenderingContext2D,
    f: Float64Array,
    frame: Frame,
    look: DrawOptions,
    palette: Palette,
    hair: number,
): void {
    for (let i = 0; i < frame.discs; ++i) {
        const k = frameHead + frameDisc * i,
            pinned = f[k + 7] === 1;
        context.strokeStyle = pinned ? palette.pinned : palette.ink;
        context.globalAlpha = pinned ? 1 : 0.35;
        context.lineWidth = (pinned ? 3 : 1) * hair;
        context.beginPath();
        context.arc(
            ...shown(frame, look.view, f[k]!, f[k + 1]!),
            f[k + 6]! - 0.5 * context.lineWidth,
            0,
            2 * Math.PI,
        );
        context.stroke();
    }
    context.globalAlpha = 1;
}

/** Position (lab frame) and radius of a disc. */
export function discOf(f: Float64Array, i: number): {x: number; y: number; radius: number} {
    const k = frameHead + frameDisc * i;
    return {x: f[k]!, y: f[k + 1]!, radius: f[k + 6]!};
}
