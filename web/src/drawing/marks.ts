// Marks in the drawing of a frame: contacts, forces, the selected disc, and the points S, C
// and M.
import {frameDisc, frameHead} from "../engine/engine";
import {slidingColor, type Palette} from "./palette";
import {shown, type DrawOptions, type Frame} from "./view";
import {canvasFont} from "../elements/page";
import {symbols} from "../texts/texts";

/** Writes a text at a point, in pixels of the page, on a halo of the background. */
function write(
    context: CanvasRenderingContext2D,
    text: string,
    x: number,
    y: number,
    dx: number,
    dy: number,
    palette: Palette,
    hair: number,
): void {
    context.save();
    context.translate(x, y);
    context.scale(1, -1);
    context.font = canvasFont(600, (13 / 1.2) * hair);
    context.lineWidth = 3.5 * hair;
    context.lineJoin = "round";
    context.strokeStyle = palette.paper;
    context.strokeText(text, dx * hair, dy * hair);
    context.fillText(text, dx * hair, dy * hair);
    context.restore();
}

/** Contacts in which friction stopped the slip as bars that tie the surfaces together, and sliding
 *  ones as dots. */
export function drawContacts(
    context: CanvasRenderingContext2D,
    f: Float64Array,
    frame: Frame,
    {view, contacts = []}: DrawOptions,
    palette: Palette,
    hair: number,
): void {
    for (const {i, j, sticks} of contacts) {
        const a = frameHead + frameDisc * i,
            b = frameHead + frameDisc * j;
        const wall: [number, number] = [f[a]! - frame.centre[0], f[a + 1]! - frame.centre[1]];
        const [dx, dy] = i === j ? wall : [f[b]! - f[a]!, f[b + 1]! - f[a + 1]!],
            distance = Math.hypot(dx, dy),
            r = f[a + 6]!;
        const [x, y] = shown(
            frame,
            view,
            f[a]! + (r * dx) / distance,
            f[a + 1]! + (r * dy) / distance,
        );
        const [ex, ey] = shown(
            frame,
            view,
            f[a]! + ((r + 1) * dx) / distance,
            f[a + 1]! + ((r + 1) * dy) / distance,
        );
        context.strokeStyle = context.fillStyle = sticks ? palette.ink : slidingColor;
        context.lineWidth = 3 * hair;
        context.beginPath();
        if (sticks) {
            context.moveTo(x - 0.5 * r * (ex - x), y - 0.5 * r * (ey - y));
            context.lineTo(x + 0.5 * r * (ex - x), y + 0.5 * r * (ey - y));
            context.stroke();
        } else {
            context.arc(x, y, Math.max(3 * hair, 0.2 * r), 0, 2 * Math.PI);
            context.fill();
        }
    }
}

export function drawHeld(
    context: CanvasRenderingContext2D,
    f: Float64Array,
    frame: Frame,
    look: DrawOptions,
    palette: Palette,
    held: number,
    hair: number,
): void {
    const k = frameHead + frameDisc * held;
    context.strokeStyle = palette.ink;
    context.lineWidth = 3 * hair;
    context.beginPath();
    context.arc(...shown(frame, look.view, f[k]!, f[k + 1]!), f[k + 6]! + 2 * hair, 0, 2 * Math.PI);
    context.stroke();
}

function drawArrow(
    context: CanvasRenderingContext2D,
    [ax, ay]: [number, number],
    [bx, by]: [number, number],
    color: string,
    width: number,
): void {
    const length = Math.hypot(bx - ax, by - ay),
        tip = Math.min(0.5, 0.4 * length);
    context.strokeStyle = context.fillStyle = color;
    context.lineWidth = width;
    context.beginPath();
    context.moveTo(ax, ay);
    context.lineTo(bx, by);
    context.stroke();
    if (length === 0) return;
    const [ux, uy] = [(bx - ax) / length, (by - ay) / length];
    context.beginPath();
    context.moveTo(bx, by);
    context.lineTo(bx - tip * ux + 0.5 * tip * uy, by - tip * uy - 0.5 * tip * ux);
    context.lineTo(bx - tip * ux - 0.5 * tip * uy, by - tip * uy + 0.5 * tip * ux);
    context.fill();
}

/** Draws centrifugal and Coriolis force of each disc in the M-frame, on one scale: the largest
 *  centrifugal force in the container is two radii long. */
export function drawForces(
    context: CanvasRenderingContext2D,
    f: Float64Array,
    frame: Frame,
    omega: number,
    palette: Palette,
    hair: number,
): void {
    const amplitude = Math.hypot(...frame.centre),
        [sx, sy] = shown(frame, "m", 0, 0);
    for (let i = 0; i < frame.discs; ++i) {
        const k = frameHead + frameDisc * i,
            [x, y] = [f[k]!, f[k + 1]!];
        const at = shown(frame, "m", x, y);
        // The lab velocity without the rotation about S.
        const [vx, vy] = [f[k + 4]! + omega * y, f[k + 5]! - omega * x];
        const [ex, ey] = frame.down;
        const [wx, wy] = [-vx * ey + vy * ex, -(vx * ex + vy * ey)];
        const scale = (2 * f[k + 6]!) / (omega * omega * (frame.radius + amplitude));
        const centrifugal = scale * omega * omega,
            coriolis = 2 * scale * omega;
        drawArrow(
            context,
            at,
            [at[0] + centrifugal * (at[0] - sx), at[1] + centrifugal * (at[1] - sy)],
            palette.centrifugal,
            2 * hair,
        );
        drawArrow(
            context,
            at,
            [at[0] + coriolis * wy, at[1] - coriolis * wx],
            palette.coriolis,
            2 * hair,
        );
    }
}

/** S, the centre of the path; C, the centre of the container; M, the point of the wall farthest
 *  from S. They are labelled in the M-frame only, because they define it. */
export function drawMarks(
    context: CanvasRenderingContext2D,
    frame: Frame,
    {view}: DrawOptions,
    palette: Palette,
    hair: number,
): void {
    const m: [number, number] = [
        frame.centre[0] + frame.radius * frame.down[0],
        frame.centre[1] + frame.radius * frame.down[1],
    ];
    const marks: [string, [number, number], number, number][] = [
        [symbols.swirl, [0, 0], 6, -6],
        [symbols.container, frame.centre, 6, -6],
    ];
    if (view === "m") marks.push([symbols.farthest, m, -6, -9]);
    for (const [name, at, dx, dy] of marks) {
        const [x, y] = shown(frame, view, ...at);
        context.fillStyle = palette.ink;
        context.beginPath();
        context.arc(x, y, 2.5 * hair, 0, 2 * Math.PI);
        context.fill();
        if (view === "m") write(context, name, x, y, dx, dy, palette, hair);
    }
}
