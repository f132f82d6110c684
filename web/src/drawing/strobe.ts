// The images of a container on the page. With the stroboscope and in the time-lapse there is one per
// period. Nothing is interpolated: discs between two images would overlap.
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

/** Whether a frame is at the end of a period, to a rounding error of its clock. */
export function isWholePeriod(f: Float64Array, period: number): boolean {
    const phase = f[2]! / period;
    return phase <= 1e-6 || phase >= 1 - 1e-6;
}
