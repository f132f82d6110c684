// The interface to the WebAssembly engine (bindings/wasm/laboratory.cpp).

import type {Message} from "../texts/message";
import {keyOf, optionOf} from "../texts/symbols";
import {fill, workerTexts} from "../texts/worker_texts";

export class UsageError extends Error {
    readonly said: Message;
    constructor(said: Message | string) {
        const message = typeof said === "string" ? {text: said, sentences: []} : said;
        super(message.text);
        this.said = message;
    }
}

/** The parameter that an error message names first: "--mu is …", or a number of discs. */
export function parameterOf(message: string): string | undefined {
    if (/^\d+ /.test(message)) return "discs";
    const option = /^.*?--([a-z-]+)/.exec(message)?.[1];
    return option && keyOf(option);
}

export interface Parameter {
    name: string;
    symbol: string;
    unit: string;
    form: string;
    description: string;
    group: string;
    default: string;
    lowest: number;
    highest: number;
    /** From, to, step; null if the parameter has no slider. */
    slider: [number, number, number] | null;
    settable: boolean;
    /** "main", or a key of texts.groups; null if the parameter is not on the page. */
    page_group: string | null;
    /** The everyday name in English. */
    label: string;
    applies_to: "every_run" | "floor" | "spheres" | "rolling_spheres" | "dissipation" | "polygons";
}

export interface Estimate {
    mean: number | null;
    error: number | null;
    effective_samples: number | null;
    blocks: number;
}

/** The rotation rates: the mean over the discs and the rigid-body rate, by time and by event. */
export const rates = ["mean_by_time", "mean_by_event", "rigid_by_time", "rigid_by_event"] as const;
export type Rate = (typeof rates)[number];

export function perRate<T>(of: (rate: Rate) => T): Record<Rate, T> {
    return Object.fromEntries(rates.map((rate) => [rate, of(rate)])) as Record<Rate, T>;
}

export interface Rotation extends Record<Rate, Estimate> {
    warmup: number; // unit: periods
    /** Means over blocks of periods, of the mean over the discs and of the rigid body; the
     *  warm-up's come first. */
    blocks: (number | null)[];
    rigid_blocks: (number | null)[];
    warmup_blocks: number;
    /** In the warm-up and after it. */
    periods_per_block: [number, number];
}

/** Averages that show why the cluster turns as it does; null where there is none. */
export interface Cause {
    slip: number | null;
    /** Of the cluster, in radii of a disc. */
    perimeter: number | null;
    /** Of touching discs: −1 for gears, 0 for independent spins. */
    spinCorrelation: number | null;
    spinCorrelationError: number | null;
    /** Shares of the collisions in which friction stops the slip. */
    discSticking: number | null;
    wallSticking: number | null;
}

/** The functions of laboratory.cpp; their arguments are in its comments. */
type Exports = {memory: WebAssembly.Memory; state_hash(): bigint} & Record<
    | "_initialize"
    | "buffer_for"
    | "text"
    | "parameters"
    | "begin"
    | "configuration"
    | "run_events"
    | "advance_to"
    | "problem"
    | "frame"
    | "frame_size"
    | "time"
    | "events"
    | "rotation"
    | "turns"
    | "cause"
    | "contacts"
    | "keeps_discs"
    | "change"
    | "steer"
    | "drag"
    | "result"
    | "command"
    | "report"
    | "show_maps"
    | "column"
    | "spin_map"
    | "values"
    | "runs"
    | "crossing"
    | "search_runs"
    | "search",
    (...numbers: number[]) => number
>;

/** The evaluation of runs with different N by one rotation rate, as `swirl crossing` does it. */
export interface Crossing {
    verdict: "crosses" | "always_rotates" | "always_counterrotates" | "undecided";
    /** N_c and its standard error. If not every N in the bracket was run, only the bracket is
     *  known. */
    discs: number | null;
    error: number | null;
    /** 95 % interval of N_c; the bracket if N_c is not known. */
    lower: number | null;
    upper: number | null;
    /** The bracket of N_c: the last N with certain rotation, and the next with certain
     *  counterrotation. */
    before: number | null;
    after: number | null;
    /** N whose direction of rotation is not certain. */
    undetermined: number[];
    /** N, ϖ/Ω and error at each N. */
    points: [number, number | null, number | null][];
}

/** One run for the evaluation: N, ϖ/Ω, error, periods after the warm-up, effective number of
 *  samples. */
export type RunNumbers = [number, number, number, number, number];

export interface SearchRules {
    from: number;
    to: number;
    /** Target standard error of N_c. */
    tolerance: number;
    /** Further runs at one number of discs, at most. */
    rounds: number;
}
/** A run of a search for N_c: N, periods after the warm-up, and for each of `rates` mean, error and
 *  effective number of samples; NaN if the run collapsed. */
export type SearchedNumbers = number[];
/** The next runs of a search: N, replicate, and how often their length is doubled; none at its end.
 *  */
export interface NextRuns {
    runs: [number, number, number][];
    within_tolerance: boolean;
}

/** The layout of a frame: numbers in its head, per disc, and per orientation (a quaternion; only
 *  spheres have one). */
export const frameHead = 11;
export const frameDisc = 8;
export const frameOrientation = 4;

/** System calls of the C library. A page has none; 52 is the error code for "not supported". */
const noSystem = new Proxy({}, {get: () => () => 52});

export class Engine {
    private readonly out: Exports;

    /** Throws if the browser has no WebAssembly or no SIMD. */
    static compile(bytes: BufferSource): Promise<WebAssembly.Module> {
        return WebAssembly.compile(bytes);
    }

    constructor(module: WebAssembly.Module) {
        const reject = (at: number, size: number): never => {
            throw new UsageError(JSON.parse(this.read(at, size)) as Message);
        };
        const instance = new WebAssembly.Instance(module, {
            wasi_snapshot_preview1: noSystem as WebAssembly.ModuleImports,
            page: {reject},
        });
        this.out = instance.exports as unknown as Exports;
        this.out._initialize();
    }

    private read(at: number, size: number): string {
        return new TextDecoder().decode(new Uint8Array(this.out.memory.buffer, at, size).slice());
    }
    private answer(size: number): string {
        return this.read(this.out.text(), size);
    }

    parameters(): Parameter[] {
        return JSON.parse(this.answer(this.out.parameters())) as Parameter[];
    }
    private write(text: string): void {
        const bytes = new TextEncoder().encode(text);
        const at = this.out.buffer_for(bytes.length);
        new Uint8Array(this.out.memory.buffer, at, bytes.length).set(bytes);
    }
    /** Each value is one line for the engine and may come from the page's address. A control
     *  character in it could add further lines or hide text, so it is an error. */
    private writeLines(given: Record<string, string>): void {
        for (const [name, value] of Object.entries(given)) {
            const control = /[\p{Cc}\p{Cf}\p{Zl}\p{Zp}]/u.exec(value);
            if (control)
                throw new UsageError(
                    fill(workerTexts.control, {
                        option: optionOf(name),
                        code: (control[0].codePointAt(0) ?? 0)
                            .toString(16)
                            .toUpperCase()
                            .padStart(4, "0"),
                    }),
                );
        }
        this.write(
            Object.entries(given)
                .map(([name, value]) => `${name}=${value}\n`)
                .join(""),
        );
    }
    /** Throws UsageError; the engine cannot be used after that. */
    begin(given: Record<string, string>): void {
        this.writeLines(given);
        this.out.begin();
    }
    /** Whether and when change() would keep the discs. Throws UsageError. */
    keepsDiscs(given: Record<string, string>): "no" | "now" | "later" {
        this.writeLines(given);
        return (["no", "now", "later"] as const)[this.out.keeps_discs()]!;
    }
    /** The discs continue from `time`. Returns the number of discs for which there is no room at
     *  this moment; undefined if the change needs a new simulation. */
    change(time: number, given: Record<string, string>): number | undefined {
        this.writeLines(given);
        const answer = this.out.change(time);
        return answer === 0 ? undefined : answer - 1;
    }
    /** From `time` on the container moves straight to a point. The engine's time restarts at 0. */
    steer(time: number, x: number, y: number, duration: number): void {
        this.out.steer(time, x, y, duration);
    }
    /** Moves a disc to the free position nearest to a point. The engine's time restarts at 0. */
    drag(time: number, disc: number, x: number, y: number): void {
        this.out.drag(time, disc, x, y);
    }
    /** The command line that reaches the last event, if the simulation was not changed. */
    command(): string {
        return this.answer(this.out.command());
    }
    /** As `swirl run --json` writes it. */
    result(): string {
        return this.answer(this.out.result());
    }
    /** Whether maps are measured, which costs several times the simulation. */
    showMaps(shown: boolean): void {
        if (shown) this.out.show_maps(1);
        else this.out.show_maps?.(0); // the engine of the first page has no maps
    }
    /** Stores the current report of the maps; column() reads it. */
    report(): void {
        this.out.report();
    }
    /** A column of the stored report, e.g. "density//by_time". */
    column(path: string): Float64Array {
        this.write(path);
        const size = this.out.column();
        return this.numbers(this.out.values(), size);
    }
    /** The mean spin in cells of the M-frame. */
    spinMap(): Float64Array {
        const size = this.out.spin_map();
        return this.numbers(this.out.values(), size);
    }
    /** Evaluates runs with different N. */
    crossing(runs: readonly RunNumbers[]): Crossing {
        const at = this.out.runs(runs.length);
        new Float64Array(this.out.memory.buffer, at, 5 * runs.length).set(runs.flat());
        return JSON.parse(this.answer(this.out.crossing())) as Crossing;
    }
    /** The next runs of a search for N_c, after those in `made`. */
    search({from, to, tolerance, rounds}: SearchRules, made: readonly SearchedNumbers[]): NextRuns {
        const numbers = made.flat(),
            at = this.out.search_runs(made.length);
        new Float64Array(this.out.memory.buffer, at, numbers.length).set(numbers);
        return JSON.parse(this.answer(this.out.search(from, to, tolerance, rounds))) as NextRuns;
    }
    /** All parameters, including those that were not given. */
    configuration(): Record<string, string> {
        const lines = this.answer(this.out.configuration()).split("\n").filter(Boolean);
        return Object.fromEntries(
            lines.map((line) => {
                const equals = line.indexOf("=");
                return [line.slice(0, equals), line.slice(equals + 1)];
            }),
        );
    }
    runEvents(count: number): void {
        this.out.run_events(count);
    }
    advanceTo(time: number, maximum: number): boolean {
        return this.out.advance_to(time, maximum) === 1;
    }
    /** The error message with which a run of the command line would end here. */
    problem(atTheEnd: boolean): Message | undefined {
        const json = this.answer(this.out.problem(Number(atTheEnd)));
        return json ? (JSON.parse(json) as Message) : undefined;
    }
    /** A copy of the state at `time`, see bindings/wasm/laboratory.cpp. */
    frame(time: number): Float64Array {
        const at = this.out.frame(time);
        return this.numbers(at, this.out.frame_size());
    }
    /** A copy of `size` numbers at `at`. The buffer is read after the call that wrote the numbers:
     *  memory that grows gets a new buffer. */
    private numbers(at: number, size: number): Float64Array {
        return new Float64Array(this.out.memory.buffer, at, size).slice();
    }
    /** Turns of the cluster since the averages, or the warm-up, began: the mean over the discs, and
     *  the rigid body. */
    turns(): [number, number] {
        return [...this.numbers(this.out.turns(), 2)] as [number, number];
    }
    cause(): Cause {
        const [
            slip,
            ,
            perimeter,
            ,
            spinCorrelation,
            spinCorrelationError,
            discSticking,
            ,
            wallSticking,
        ] = [...this.numbers(this.out.cause(), 10)].map((each) =>
            Number.isFinite(each) ? each : null,
        );
        return {
            slip,
            perimeter,
            spinCorrelation,
            spinCorrelationError,
            discSticking,
            wallSticking,
        } as Cause;
    }
    /** The collisions since the last call (contacts.ts). */
    contacts(): Float64Array {
        const size = this.out.contacts();
        return this.numbers(this.out.values(), size);
    }
    get time(): number {
        return this.out.time();
    }
    get events(): number {
        return this.out.events();
    }
    get stateHash(): string {
        return BigInt.asUintN(64, this.out.state_hash()).toString(16).padStart(16, "0");
    }
    rotation(): Rotation {
        return JSON.parse(this.answer(this.out.rotation())) as Rotation;
    }
}
