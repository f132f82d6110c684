// The messages between the page and its worker.
import type {Crossing, Parameter, Rate, Rotation} from "./engine";

export type ToWorker =
    | {kind: "engine"; bytes: ArrayBuffer}
    | {kind: "begin"; given: Record<string, string>; events: number}
    /** Advances time by so many periods. Answered by a frame. */
    | {kind: "tick"; periods: number}
    | {kind: "step"}
    /** Other friction coefficients or another path for the same discs, from the next period on. */
    | {kind: "change"; given: Record<string, string>}
    /** By hand: the container moves straight to a point within `duration`. Answered by a frame. */
    | {kind: "steer"; x: number; y: number; duration: number}
    /** Reverses time, if energy is conserved. */
    | {kind: "reverse"}
    /** Moves a disc to the free position nearest to a point. Answered by a frame. */
    | {kind: "drag"; disc: number; x: number; y: number}
    | {kind: "result"}
    | {kind: "maps"}
    /** A whole run of so many periods after the warm-up. */
    | {kind: "point"; given: Record<string, string>; periods: number}
    | {kind: "crossing"; curve: number; curves: Record<Rate, number[]>};

/** Averages in cells of the M-frame, and against θ. */
export interface Maps {
    kind: "maps";
    density: Float64Array;
    flow: {x: Float64Array; y: Float64Array; ux: Float64Array; uy: Float64Array};
    profile: {theta: Float64Array; varpi: Float64Array; wall: Float64Array};
}

export interface Frame {
    kind: "frame";
    frame: Float64Array;
    events: number;
    hash: string;
    /** The command line that reproduces this state, if the simulation was not changed. */
    command: string;
    /** The last event and the next one, after a single step. */
    event?: Float64Array;
    next?: Float64Array;
    /** Only a few times per second. */
    rotation?: Rotation;
}

export type FromWorker =
    | {kind: "ready"; parameters: Parameter[]}
    | {kind: "started"; configuration: Record<string, string>}
    | {kind: "rejected"; message: string}
    /** On the way to the event in the page's address. */
    | {kind: "progress"; done: number; all: number}
    /** The browser cannot run the engine. */
    | {kind: "unsupported"}
    /** Whether the discs continue with the change; if not, a new simulation is needed. */
    | {kind: "changed"; kept: boolean; configuration: Record<string, string>}
    | {kind: "reversed"; done: boolean}
    /** JSON as the command line writes it. */
    | {kind: "result"; text: string}
    | Maps
    /** A collapsed run has no averages. */
    | {kind: "point"; rotation: Rotation; collapsed: boolean}
    | {kind: "crossing"; curve: number; crossings: Record<Rate, Crossing | null>}
    | Frame;
