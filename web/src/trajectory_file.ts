// Reads trajectories of the command line (`swirl run --trajectory`): HDF5 files in the layout of
// src/swirl/io/trajectory.hpp.
import {File, type Dataset} from "jsfive";
import {frameDisc, frameHead, frameOrientation} from "./engine";

export interface Trajectory {
    /** In the layout of the engine's frames (engine.ts). */
    frames: Float64Array[];
    discs: number;
    period: number;
    /** Largest distance of the container's centre from S. */
    room: number;
    complete: boolean;
    /** The parameters of the run as JSON. */
    parameters: string;
}

/** More numbers would exceed the memory of a page. */
const maxNumbers = 5e7;

const particles = "particles/trajectory";

/** Thrown for a trajectory that has too many numbers. */
export class TooLarge extends Error {}

/** Throws an error if the file is damaged, or no trajectory. */
export function readTrajectory(bytes: ArrayBuffer, name: string): Trajectory {
    const file = new File(bytes, name);
    const dataset = (path: string): Dataset => {
        const found = file.get(path);
        if (!found || !("shape" in found)) throw new Error(path);
        return found;
    };
    /** Chunks that were never written read as zero. */
    const numbers = (path: string): Float64Array => {
        const {shape, value} = dataset(path), size = shape.reduce((a, b) => a * b, 1), all = new Float64Array(size);
        for (let k = 0; k < size; ++k) all[k] = Number(value[k] ?? 0);
        return all;
    };
    const [count = 0, discs = 0] = dataset(`${particles}/position/value`).shape;
    if (!(count * discs * 14 <= maxNumbers)) throw new TooLarge(name);
    const attributes = file.get("parameters")?.attrs ?? {};
    const columns = {
        position: numbers(`${particles}/position/value`), velocity: numbers(`${particles}/velocity/value`),
        angle: numbers(`${particles}/angle/value`), spin: numbers(`${particles}/angular_velocity/value`),
        radius: numbers(`${particles}/radius`), time: numbers(`${particles}/position/time`),
        periods: numbers("observables/swirls/value"), clock: numbers("observables/clock/value"),
        x: numbers("observables/container_x/value"), y: numbers("observables/container_y/value"),
        vx: numbers("observables/container_vx/value"), vy: numbers("observables/container_vy/value"),
    };
    const spheres = file.get(particles)?.keys?.includes("orientation") ?? false;
    const orientation = spheres ? numbers(`${particles}/orientation/value`) : undefined;
    const R = Number(attributes["container_radius"]), period = Number(attributes["period"]);
    if (!(R > 0 && period > 0) || columns.radius.length !== discs) throw new Error(name);
    let room = 0;
    const frames = Array.from({length: count}, (_, t) => {
        const frame = new Float64Array(frameHead + (frameDisc + (spheres ? frameOrientation : 0)) * discs);
        const [x, y] = [columns.x[t]!, columns.y[t]!], distance = Math.hypot(x, y);
        room = Math.max(room, distance);
        const down = distance > 0 ? [x / distance, y / distance] : [1, 0];
        frame.set([columns.time[t]!, columns.periods[t]!, columns.clock[t]!, x, y, columns.vx[t]!, columns.vy[t]!,
                   R, down[0]!, down[1]!, discs]);
        for (let i = 0; i < discs; ++i) {
            const k = t * discs + i;
            frame.set([columns.position[3 * k]!, columns.position[3 * k + 1]!, columns.angle[k]!, columns.spin[k]!,
                       columns.velocity[3 * k]!, columns.velocity[3 * k + 1]!, columns.radius[i]!, 0],
                      frameHead + frameDisc * i);
            if (orientation) frame.set(orientation.subarray(4 * k, 4 * k + 4), frameHead + frameDisc * discs + 4 * i);
        }
        return frame;
    });
    const parameters = dataset("parameters/parameters").value[0];
    return {frames, discs, period, room, complete: Number(attributes["complete"]) === 1,
            parameters: typeof parameters === "string" ? parameters : ""};
}
