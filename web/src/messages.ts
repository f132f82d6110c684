// What the page and its worker say to each other.
import type {Crossing, Parameter, Rate, Rotation} from "./engine";

export type ToWorker =
    | {kind: "engine"; bytes: ArrayBuffer}
    | {kind: "begin"; given: Record<string, string>; events: number}
    /** Time has gone on by so many swirls. Answered by a frame. */
    | {kind: "tick"; swirls: number}
    | {kind: "step"}
    /** Other frictions or another path for the same discs, from the next swirl on. */
    | {kind: "change"; given: Record<string, string>}
    /** By hand: the container goes straight to a point, for so long a time. Answered by a frame. */
    | {kind: "steer"; x: number; y: number; duration: number}
    /** Time runs backwards from now on, where the dish allows that. */
    | {kind: "reverse"}
    /** A disc is taken as near to a point as there is room. Answered by a frame. */
    | {kind: "drag"; disc: number; x: number; y: number}
    | {kind: "result"}
    | {kind: "maps"}
    /** A run from beginning to end, of so many swirls after the warm-up. */
    | {kind: "point"; given: Record<string, string>; swirls: number}
    | {kind: "crossing"; curve: number; curves: Record<Rate, number[]>};

/** What fills up while the dish is swirled, in cells of the M-frame, and against θ. */
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
    /** What makes this dish on the command line, if it was not changed since its beginning. */
    command: string;
    /** The last event and the next one, where there was a single step. */
    event?: Float64Array;
    next?: Float64Array;
    /** Now and then. */
    rotation?: Rotation;
}

export type FromWorker =
    | {kind: "ready"; parameters: Parameter[]}
    | {kind: "begun"; configuration: Record<string, string>}
    | {kind: "refused"; sentence: string}
    /** On the way to the event that the address asks for. */
    | {kind: "progress"; done: number; all: number}
    /** The browser lacks what the engine needs. */
    | {kind: "unsupported"}
    /** Whether the discs have gone on with what was changed; if not, it is another dish. */
    | {kind: "changed"; kept: boolean; configuration: Record<string, string>}
    | {kind: "reversed"; done: boolean}
    /** JSON, as the command line writes it. */
    | {kind: "result"; text: string}
    | Maps
    /** Nothing is known of a dish that has collapsed. */
    | {kind: "point"; rotation: Rotation; collapsed: boolean}
    | {kind: "crossing"; curve: number; crossings: Record<Rate, Crossing | null>}
    | Frame;
