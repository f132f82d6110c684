// Marks, arrows and arcs around the container: its wall, the direction of the swirl, and the turns
// of the cluster.
import look from "./look.json";
import type {Palette} from "./palette";
import type {Frame} from "./view";

/** A mark on the wall: a line away from the container's centre, between two distances from it. */
export function drawWallMark(
    context: CanvasRenderingContext2D,
    [cx, cy]: readonly [number, number],
    angle: number,
    from: number,
    to: number,
): void {
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    context.beginPath();
    context.moveTo(cx + from * c, cy + from * s);
    context.lineTo(cx + to * c, cy + to * s);
    context.stroke();
}

/** The direction in which the container moves on its path: an arrow, by default at the left edge of
 *  the image. */
export function drawSwirl(
    context: CanvasRenderingContext2D,
    radius: number,
    palette: Palette,
    hair: number,
    from = 0.8 * Math.PI,
    to = 1.25 * Math.PI,
): void {
    const [c, s] = [Math.cos(to), Math.sin(to)],
        length = 11 * hair;
    context.strokeStyle = context.fillStyle = palette.quiet;
    context.lineWidth = 3 * hair;
    context.beginPath();
    context.arc(0, 0, radius, from, to);
    context.stroke();
    context.beginPath();
    context.moveTo(radius * c - length * s, radius * s + length * c);
    for (const side of [-0.5, 0.5])
        context.lineTo((radius + side * length) * c, (radius + side * length) * s);
    context.fill();
}

/** An arc around the wall that starts at the top, as in movies: the fraction of the last turn of
 *  the cluster. Each whole turn is a ring outside the arc, up to three. The arc begins beyond the
 *  outer edge of the wall. */
export function drawTurns(
    context: CanvasRenderingContext2D,
    frame: Frame,
    turns: number,
    palette: Palette,
    hair: number,
    edge = 5 * hair,
): void {
    const whole = Math.trunc(turns),
        rest = turns - whole,
        radius = frame.radius + edge + 3 * hair;
    if (!(frame.radius > 20 * hair)) return; // the container is a dot at this scale
    if (Math.abs(turns) < look.leastTurns) return;
    const [cx, cy] = frame.centre,
        from = 0.5 * Math.PI,
        to = from + 2 * Math.PI * rest,
        way = Math.sign(turns);
    context.strokeStyle = context.fillStyle = turns < 0 ? palette.against : palette.with;
    context.lineWidth = hair;
    for (let ring = 0; ring < Math.min(3, Math.abs(whole)); ++ring) {
        context.beginPath();
        context.arc(cx, cy, radius + (4.2 + 1.7 * ring) * hair, 0, 2 * Math.PI);
        context.stroke();
    }
    context.lineWidth = 6 * hair;
    context.lineCap = "round";
    context.beginPath();
    context.arc(cx, cy, radius, from, to, rest < 0);
    context.stroke();
    context.lineCap = "butt";
    const [c, s] = [Math.cos(to), Math.sin(to)],
        length = 12 * hair;
    context.beginPath();
    context.moveTo(cx + radius * c - way * length * s, cy + radius * s + way * length * c);
    for (const side of [-0.6, 0.6])
        context.lineTo(cx + (radius + side * length) * c, cy + (radius + side * length) * s);
    context.fill();
}
