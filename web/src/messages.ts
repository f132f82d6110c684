// What the page and its worker say to each other.
import type {Parameter, Rotation} from "./engine";

export type ToWorker =
    | {kind: "engine"; bytes: ArrayBuffer}
    | {kind: "begin"; given: Record<string, string>; events: number}
    /** Time has gone on by so many swirls. Answered by a frame. */
    | {kind: "tick"; swirls: number}
    | {kind: "step"};

export interface Frame {
    kind: "frame";
    frame: Float64Array;
    events: number;
    hash: string;
    /** The last event, where there was a single step. */
    event?: Float64Array;
    /** Now and then. */
    rotation?: Rotation;
}

export type FromWorker =
    | {kind: "ready"; parameters: Parameter[]}
    | {kind: "begun"; configuration: Record<string, string>}
    | {kind: "refused"; sentence: string}
    | Frame;
