// The messages between the page and its worker.
import type {
    Cause,
    Crossing,
    NextRuns,
    Parameter,
    Rate,
    Rotation,
    RunNumbers,
    SearchedNumbers,
    SearchRules,
} from "./engine";
import type {Message} from "../texts/message";

export type ToWorker =
    | {kind: "engine"; bytes: ArrayBuffer}
    /** Starts a simulation and executes this many events. Answers carry the number `run`. */
    | {kind: "begin"; given: Record<string, string>; events: number; run: number}
    /** Advances time by this many periods; with `strobe`, at most to the end of the present one.
     *  Answered by a frame. */
    | {kind: "tick"; periods: number; strobe?: boolean}
    /** Advances by this many whole periods without frames in between. Answered by progress and a
     *  frame. */
    | {kind: "skip"; periods: number}
    /** Other friction coefficients or another number for the same discs; another path from the next
     *  period on. */
    | {kind: "change"; given: Record<string, string>}
    /** By hand: the container moves straight to a point within `duration`. Answered by a frame. */
    | {kind: "steer"; x: number; y: number; duration: number}
    /** Moves a disc to the free position nearest to a point. Answered by a frame. */
    | {kind: "drag"; disc: number; x: number; y: number}
    | {kind: "result"}
    /** Whether maps and the pinned discs are measured from now on, and whether frames have the
     *  collisions before them. */
    | {kind: "measure"; maps: boolean; contacts: boolean}
    | {kind: "maps"}
    /** A whole run with this many periods after the warm-up. */
    | {kind: "point"; given: Record<string, string>; periods: number}
    /** Runs to exactly this event; answered by its result. */
    | {kind: "repeat"; given: Record<string, string>; events: number}
    | {kind: "crossing"; runs: Record<Rate, RunNumbers[]>}
    | {kind: "search"; rules: SearchRules; made: SearchedNumbers[]};

/** Averages in cells of the M-frame, and against θ. */
export interface Maps {
    kind: "maps";
    density: Float64Array;
    spin: Float64Array;
    flow: {x: Float64Array; y: Float64Array; ux: Float64Array; uy: Float64Array};
    profile: {theta: Float64Array; varpi: Float64Array; wall: Float64Array};
}

export interface Frame {
    kind: "frame";
    run: number;
    frame: Float64Array;
    /** Turns of the cluster since the averages began, or in the warm-up since its start: the mean
     *  over the discs, and the rigid body. */
    turns: [number, number];
    events: number;
    hash: string;
    /** The command line that reproduces this state, if the simulation was not changed. */
    command: string;
    /** Only a few times per second. */
    rotation?: Rotation;
    cause?: Cause;
    /** The collisions since the last frame (contacts.ts), if they are shown. */
    contacts?: Float64Array;
}

export type FromWorker =
    | {kind: "ready"; parameters: Parameter[]}
    | {kind: "started"; run: number; configuration: Record<string, string>}
    | {kind: "rejected"; run: number; message: Message}
    /** On the way to an event, or to the end of skipped periods (`unit`). */
    | {kind: "progress"; run: number; unit: "events" | "periods"; done: number; all: number}
    /** The browser cannot run the engine. */
    | {kind: "unsupported"}
    /** Whether the discs continue with the change; if not, a new simulation is needed. The missing
     *  discs are added when there is room. */
    | {
          kind: "changed";
          run: number;
          kept: boolean;
          missing: number;
          configuration: Record<string, string>;
      }
    /** JSON as the command line writes it. */
    | {kind: "result"; text: string}
    | Maps
    /** A collapsed run has no averages. */
    | {kind: "point"; rotation: Rotation; collapsed: boolean}
    | {kind: "crossing"; crossings: Record<Rate, Crossing>}
    | {kind: "search"; next: NextRuns}
    | Frame;
