// The images of a container on the page. With the stroboscope there is one per period; in the
// time-lapse, which has several per second, the discs glide from one image to the next on arcs
// about their centre of mass.
import {frameDisc, frameHead} from "../engine/engine";

/** The centre of mass of equal discs. */
export function centreOf(f: Float64Array): [number, number] {
    let [x, y] = [0, 0];
    for (let k = frameHead; k < frameHead + frameDisc * f[10]!; k += frameDisc) {
        x += f[k]! / f[10]!;
        y += f[k + 1]! / f[10]!;
    }
    return [x, y];
}

/** The frame at the share `t` of the way from `a` to `b`, between which the cluster rotates by
 *  `turns`. */
export function between(a: Float64Array, b: Float64Array, turns: number, t: number): Float64Array {
    if (a.length !== b.length || t >= 1) return b;
    const made = b.slice(),
        [from, to] = [centreOf(a), centreOf(b)],
        cluster = 2 * Math.PI * turns;
    for (let k = frameHead; k < frameHead + frameDisc * b[10]!; k += frameDisc) {
        const [ax, ay, bx, by] = [
            a[k]! - from[0],
            a[k + 1]! - from[1],
            b[k]! - to[0],
            b[k + 1]! - to[1],
        ];
        const begin = Math.atan2(ay, ax),
            more = Math.atan2(by, bx) - begin - cluster; // than the cluster
        const angle = begin + t * (cluster + Math.atan2(Math.sin(more), Math.cos(more)));
        const r = (1 - t) * Math.hypot(ax, ay) + t * Math.hypot(bx, by);
        made[k] = (1 - t) * from[0] + t * to[0] + r * Math.cos(angle);
        made[k + 1] = (1 - t) * from[1] + t * to[1] + r * Math.sin(angle);
        made[k + 2] = (1 - t) * a[k + 2]! + t * b[k + 2]!;
    }
    return made;
}

/** Whether a frame is at the end of a period, to a rounding error of its clock. */
export function isWholePeriod(f: Float64Array, period: number): boolean {
    const phase = f[2]! / period;
    return phase <= 1e-6 || phase >= 1 - 1e-6;
}

interface Image {
    frame: Float64Array;
    turns: number;
}

/** Glides from image to image, as long as they follow each other fast. */
export class Glide {
    private before: Image | undefined;
    private now: Image | undefined;
    private arrived = 0;
    private interval = 0; // milliseconds between the last two images

    /** The next image; without `glides` it replaces the present one at once. */
    add(frame: Float64Array, turns: number, glides: boolean): void {
        const time = performance.now();
        this.interval = glides ? Math.min(time - this.arrived, 250) : 0;
        [this.before, this.now, this.arrived] = [this.now, {frame, turns}, time];
    }

    clear(): void {
        this.before = this.now = undefined;
    }

    /** Whether the image changes until the next one arrives. */
    get isMoving(): boolean {
        return performance.now() - this.arrived < this.interval;
    }

    /** What is shown at this moment. */
    get image(): Image | undefined {
        const {before, now} = this,
            t =
                this.interval > 0
                    ? Math.min(1, (performance.now() - this.arrived) / this.interval)
                    : 1;
        if (!before || !now) return now;
        const turns = now.turns - before.turns;
        return {
            frame: between(before.frame, now.frame, turns, t),
            turns: now.turns - (1 - t) * turns,
        };
    }
}
