// Draws a frame on a canvas, in the lab frame or in the M-frame. The M-frame's origin is the centre
// C of the container, and its −y axis points from S, the centre of the path, to C.
import {drawBall, inRotatedAxes, type Orientation} from "./ball";
import {frameDisc, frameHead, frameOrientation} from "./engine";
import {symbols} from "./texts";

export type View = "lab" | "m";
export type Coloring = "spin" | "speed" | "pinned" | "id";

export interface DrawOptions {
    view: View;
    coloring: Coloring;
    trails: Float64Array[]; // earlier frames, the oldest first
    event: Float64Array | undefined;
    next: Float64Array | undefined; // the next event, whose particles are marked
    omega: number; // of the container's path; if above 0, forces are drawn in the M-frame
    dark: boolean;
    room: number; // largest distance of the container from S, for the scale of the lab frame
    clusterTurns: number; // rotation of the cluster, in turns; drawn as an arc in the lab frame
    held: number | undefined; // the disc selected by keys
}

interface Frame {
    centre: [number, number];
    radius: number;
    down: [number, number];
    discs: number;
}

function head(f: Float64Array): Frame {
    return {centre: [f[3]!, f[4]!], radius: f[7]!, down: [f[8]!, f[9]!], discs: f[10]!};
}

/** A point of the lab frame in the frame of the view. */
function shown(frame: Frame, view: View, x: number, y: number): [number, number] {
    if (view === "lab") return [x, y];
    const [dx, dy] = [x - frame.centre[0], y - frame.centre[1]];
    const [ex, ey] = frame.down;
    return [-dx * ey + dy * ex, -(dx * ex + dy * ey)];
}

/** Half the width of the image. */
function reachOf(frame: Frame, look: {view: View; room: number}): number {
    const room = Math.max(look.room, Math.hypot(...frame.centre));
    return (look.view === "lab" ? frame.radius + room : frame.radius) * 1.06;
}

/** The point of the lab frame at these coordinates of the window. */
export function pointedAt(canvas: HTMLCanvasElement, f: Float64Array, room: number, clientX: number,
                          clientY: number): [number, number] {
    const box = canvas.getBoundingClientRect();
    const scale = 2 * reachOf(head(f), {view: "lab", room}) / box.width;
    return [(clientX - box.left - box.width / 2) * scale,
            (box.top + box.height / 2 - clientY) * scale];
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

/** Rotation of the cluster about its centre of mass from one frame to a later one, in turns: the rigid
 *  rotation that fits the motion of the discs best. */
export function clusterTurnsBetween(a: Float64Array, b: Float64Array): number {
    if (a.length !== b.length) return 0;
    const discs = head(b).discs;
    const mean = (f: Float64Array, at: number): number => {
        let sum = 0;
        for (let i = 0; i < discs; ++i) sum += f[frameHead + frameDisc * i + at]!;
        return sum / discs;
    };
    const [ax, ay, bx, by] = [mean(a, 0), mean(a, 1), mean(b, 0), mean(b, 1)];
    let along = 0, across = 0;
    for (let i = 0; i < discs; ++i) {
        const k = frameHead + frameDisc * i;
        const [px, py, qx, qy] = [a[k]! - ax, a[k + 1]! - ay, b[k]! - bx, b[k + 1]! - by];
        along += px * qx + py * qy;
        across += px * qy - py * qx;
    }
    return Math.atan2(across, along) / (2 * Math.PI);
}

/** From blue (against the swirl) to grey to orange (with the swirl); suited to colour-blind readers. */
function diverging(x: number): string {
    const t = Math.max(-1, Math.min(1, x));
    const from = t < 0 ? [36, 99, 158] : [204, 92, 10];
    const grey = [188, 190, 192];
    const c = grey.map((g, k) => Math.round(g + Math.abs(t) * (from[k]! - g)));
    return `rgb(${c.join(" ")})`;
}

const names = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442"];

function color(f: Float64Array, k: number, i: number, coloring: Coloring): string {
    if (coloring === "id") return names[i % names.length]!;
    if (coloring === "pinned") return f[k + 7] === 1 ? "#d55e00" : "#56b4e9";
    if (coloring === "spin") return diverging(1.5 * f[k + 3]!); // full colour at 1.3 Ω of the paper's container
    const [vx, vy] = [f[k + 4]! - f[5]!, f[k + 5]! - f[6]!]; // relative to the container
    return diverging(Math.hypot(vx, vy) - 1);
}

const minBallRadius = 6; // pixels; the pattern of smaller spheres is invisible

export function draw(canvas: HTMLCanvasElement, f: Float64Array, look: DrawOptions): void {
    const context = canvas.getContext("2d");
    if (!context) return;
    const ratio = window.devicePixelRatio || 1;
    const size = canvas.clientWidth * ratio;
    if (canvas.width !== size) canvas.width = canvas.height = size;
    const frame = head(f);
    const amplitude = Math.hypot(...frame.centre);
    const scale = size / (2 * reachOf(frame, look));
    const ink = look.dark ? "#e8e6e3" : "#23272b";
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = look.dark ? "#15181a" : "#fbfaf8"; // so that a movie has it, too
    context.fillRect(0, 0, size, size);
    context.setTransform(scale, 0, 0, -scale, size / 2, size / 2);
    const hair = 1.2 * ratio / scale;

    const [cx, cy] = shown(frame, look.view, ...frame.centre);
    context.lineWidth = 2 * hair;
    context.strokeStyle = ink;
    context.fillStyle = look.dark ? "#1d2124" : "#fbfaf8";
    context.beginPath();
    context.arc(cx, cy, frame.radius, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
    if (look.view === "lab" && amplitude > 0) {
        context.lineWidth = hair;
        context.setLineDash([4 * hair, 4 * hair]);
        context.beginPath();
        context.arc(0, 0, amplitude, 0, 2 * Math.PI);
        context.stroke();
        context.setLineDash([]);
    }

    if (look.view === "lab") drawClusterTurns(context, frame, look.clusterTurns, hair);
    drawTrails(context, f, look, hair);
    const frameAngle = look.view === "m" ? Math.atan2(frame.down[0], -frame.down[1]) : 0;
    for (let i = 0; i < frame.discs; ++i) {
        const k = frameHead + frameDisc * i;
        const [x, y] = shown(frame, look.view, f[k]!, f[k + 1]!);
        const r = f[k + 6]!, angle = f[k + 2]! - frameAngle, orientation = orientationOf(f, i);
        context.fillStyle = color(f, k, i, look.coloring);
        if (orientation && r * scale > minBallRadius) {
            drawBall(context, x, y, r, inRotatedAxes(frameAngle, orientation));
            continue;
        }
        context.beginPath();
        context.arc(x, y, r, 0, 2 * Math.PI);
        context.fill();
        if (r * scale < 3) continue;
        context.lineWidth = Math.min(hair, 0.15 * r);
        context.strokeStyle = "#23272b";
        context.stroke();
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(x + r * Math.cos(angle), y + r * Math.sin(angle));
        context.stroke();
    }
    if (look.view === "m" && look.omega > 0) drawForces(context, f, frame, look.omega, hair);
    if (look.held !== undefined && look.held < frame.discs)
        drawHeld(context, f, frame, look, ink, look.held, hair);
    drawNext(context, f, frame, look, hair);
    drawEvent(context, f, frame, look, hair);
    drawMarks(context, frame, look, ink, hair);
}

function drawHeld(context: CanvasRenderingContext2D, f: Float64Array, frame: Frame, look: DrawOptions,
                  ink: string, held: number, hair: number): void {
    const k = frameHead + frameDisc * held;
    context.strokeStyle = ink;
    context.lineWidth = 3 * hair;
    context.beginPath();
    context.arc(...shown(frame, look.view, f[k]!, f[k + 1]!), f[k + 6]! + 2 * hair, 0, 2 * Math.PI);
    context.stroke();
}

/** Position (lab frame) and radius of a disc. */
export function discOf(f: Float64Array, i: number): {x: number; y: number; radius: number} {
    const k = frameHead + frameDisc * i;
    return {x: f[k]!, y: f[k + 1]!, radius: f[k + 6]!};
}

/** An arc along the wall that starts at the right: the rotation of the cluster. A circle stands for all
 *  whole turns. */
function drawClusterTurns(context: CanvasRenderingContext2D, frame: Frame, clusterTurns: number,
                    hair: number): void {
    const whole = Math.trunc(clusterTurns), rest = clusterTurns - whole;
    const radius = frame.radius - 4 * hair;
    if (!(radius > 5 * hair)) return; // the container is a dot at this scale
    context.strokeStyle = context.fillStyle = clusterTurns < 0 ? "#24639e" : "#cc5c0a";
    context.lineWidth = 4 * hair;
    context.globalAlpha = 0.8;
    if (whole !== 0) {
        context.beginPath();
        context.arc(...frame.centre, radius - 5 * hair, 0, 2 * Math.PI);
        context.stroke();
    }
    context.beginPath();
    context.arc(...frame.centre, radius, 0, 2 * Math.PI * rest, rest < 0);
    context.stroke();
    context.globalAlpha = 1;
}

/** The frames for the trails, oldest first: those at most `longest` before `now`. A fixed number of
 *  frames would cover the container if each takes much of a period. */
export function recent(history: Float64Array[], now: Float64Array, longest: number): Float64Array[] {
    return history.filter((f) => f[0]! >= now[0]! - longest);
}

function drawTrails(context: CanvasRenderingContext2D, f: Float64Array, look: DrawOptions,
                    hair: number): void {
    const frames = [...look.trails, f];
    for (let t = 1; t < frames.length; ++t) {
        const [a, b] = [frames[t - 1]!, frames[t]!];
        if (a.length !== b.length) continue;
        const [before, after] = [head(a), head(b)];
        context.globalAlpha = 0.6 * t / frames.length;
        context.lineWidth = hair;
        for (let i = 0; i < after.discs; ++i) {
            const k = frameHead + frameDisc * i;
            context.strokeStyle = color(b, k, i, look.coloring);
            context.beginPath();
            context.moveTo(...shown(before, look.view, a[k]!, a[k + 1]!));
            context.lineTo(...shown(after, look.view, b[k]!, b[k + 1]!));
            context.stroke();
        }
    }
    context.globalAlpha = 1;
}

/** Draws the impulse of an event as an arrow on the disc that received it. */
function drawEvent(context: CanvasRenderingContext2D, f: Float64Array, frame: Frame, look: DrawOptions,
                   hair: number): void {
    const e = look.event;
    if (!e || e[1]! >= 2) return; // without an impulse
    const wall = e[1] === 1;
    const k = frameHead + frameDisc * e[wall ? 2 : 3]!;
    const [nx, ny] = [e[4]!, e[5]!];
    const sign = wall ? -1 : 1; // on the disc, not on the wall
    const jx = sign * (e[6]! * nx + e[7]! * ny), jy = sign * (e[6]! * ny - e[7]! * nx);
    const [x, y] = [f[k]!, f[k + 1]!];
    const [ax, ay] = shown(frame, look.view, x, y);
    const [bx, by] = shown(frame, look.view, x + 3 * jx, y + 3 * jy);
    drawArrow(context, [ax, ay], [bx, by], "#b00020", 2 * hair);
}

function drawArrow(context: CanvasRenderingContext2D, [ax, ay]: [number, number],
                   [bx, by]: [number, number], color: string, width: number): void {
    const length = Math.hypot(bx - ax, by - ay), tip = Math.min(0.5, 0.4 * length);
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
function drawForces(context: CanvasRenderingContext2D, f: Float64Array, frame: Frame, omega: number,
                    hair: number): void {
    const amplitude = Math.hypot(...frame.centre), [sx, sy] = shown(frame, "m", 0, 0);
    for (let i = 0; i < frame.discs; ++i) {
        const k = frameHead + frameDisc * i, [x, y] = [f[k]!, f[k + 1]!];
        const at = shown(frame, "m", x, y);
        // The lab velocity without the rotation about S.
        const [vx, vy] = [f[k + 4]! + omega * y, f[k + 5]! - omega * x];
        const [ex, ey] = frame.down;
        const [wx, wy] = [-vx * ey + vy * ex, -(vx * ex + vy * ey)];
        const scale = 2 * f[k + 6]! / (omega * omega * (frame.radius + amplitude));
        const centrifugal = scale * omega * omega, coriolis = 2 * scale * omega;
        drawArrow(context, at, [at[0] + centrifugal * (at[0] - sx), at[1] + centrifugal * (at[1] - sy)],
                  "#8a5a00", 2 * hair);
        drawArrow(context, at, [at[0] + coriolis * wy, at[1] - coriolis * wx], "#a0307a", 2 * hair);
    }
}

/** Draws a ring around the disc or discs of the next event. */
function drawNext(context: CanvasRenderingContext2D, f: Float64Array, frame: Frame, look: DrawOptions,
                  hair: number): void {
    const e = look.next;
    if (!e || e[1] === 2) return; // a path vertex, which concerns all discs
    context.strokeStyle = "#b00020";
    context.lineWidth = 2 * hair;
    context.setLineDash([4 * hair, 3 * hair]);
    for (const i of e[1] === 0 ? [e[2]!, e[3]!] : [e[2]!]) {
        const k = frameHead + frameDisc * i;
        context.beginPath();
        context.arc(...shown(frame, look.view, f[k]!, f[k + 1]!), f[k + 6]! + 3 * hair, 0, 2 * Math.PI);
        context.stroke();
    }
    context.setLineDash([]);
}

/** S, the centre of the path; C, the centre of the container; M, the point of the wall farthest from S. */
function drawMarks(context: CanvasRenderingContext2D, frame: Frame, look: DrawOptions, ink: string,
                   hair: number): void {
    const m: [number, number] = [frame.centre[0] + frame.radius * frame.down[0],
                                 frame.centre[1] + frame.radius * frame.down[1]];
    const marks: [string, [number, number]][] = [
        [symbols.swirl, [0, 0]], [symbols.container, frame.centre], [symbols.farthest, m]];
    for (const [name, at] of marks) {
        const [x, y] = shown(frame, look.view, ...at);
        context.fillStyle = ink;
        context.beginPath();
        context.arc(x, y, 2.5 * hair, 0, 2 * Math.PI);
        context.fill();
        context.save();
        context.translate(x, y);
        context.scale(1, -1);
        context.font = `600 ${13 * hair}px system-ui, sans-serif`;
        context.lineWidth = 3 * hair;
        context.strokeStyle = look.dark ? "#1d2124" : "#fbfaf8";
        const [dx, dy] = at === m ? [-5 * hair, -7 * hair] : [5 * hair, -5 * hair];
        context.strokeText(name, dx, dy);
        context.fillText(name, dx, dy);
        context.restore();
    }
}
