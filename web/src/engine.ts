// The interface to the WebAssembly engine (bindings/wasm/laboratory.cpp).

import {workerTexts} from "./texts";

/** An error message of the engine, with an optional hint in a second line. */
export class UsageError extends Error {}

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
}

export interface Estimate {
    mean: number | null;
    error: number | null;
    blocks: number;
}

/** The rotation rates: the mean over the discs and the rigid-body rate, by time and by event. */
export const rates = ["by_time", "by_event", "rigid_by_time", "rigid_by_event"] as const;
export type Rate = typeof rates[number];

export function perRate<T>(of: (rate: Rate) => T): Record<Rate, T> {
    return Object.fromEntries(rates.map((rate) => [rate, of(rate)])) as Record<Rate, T>;
}

export interface Rotation extends Record<Rate, Estimate> {
    warmup: number; // in periods
    /** Means over blocks of periods; the warm-up's come first. */
    blocks: (number | null)[];
    warmup_blocks: number;
    /** In the warm-up and after it. */
    periods_per_block: [number, number];
}

interface Exports {
    memory: WebAssembly.Memory;
    _initialize(): void;
    buffer_for(size: number): number;
    text(): number;
    parameters(): number;
    begin(): void;
    configuration(): number;
    run_events(count: number): void;
    advance_to(time: number, maximum: number): number;
    problem(atTheEnd: number): number;
    frame(time: number): number;
    frame_size(): number;
    event(): number;
    next_event(): number;
    time(): number;
    events(): number;
    state_hash(): bigint;
    rotation(): number;
    keeps_discs(): number;
    change(time: number): number;
    steer(time: number, x: number, y: number, duration: number): void;
    reverse(time: number): number;
    drag(time: number, i: number, x: number, y: number): void;
    result(): number;
    command(): number;
    report(): void;
    column(): number;
    values(): number;
    points(count: number): number;
    crossing(): number;
}

/** N_c, its standard error and its 95 % interval. If not every N in between was run, only the bracket is known. */
export interface Crossing {
    discs: number | null;
    error: number | null;
    lower: number;
    upper: number;
}

/** The layout of a frame: numbers in its head, per disc, and per orientation (a quaternion; only spheres
 *  have one). */
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
            throw new UsageError(this.read(at, size));
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
    /** Each value is one line for the engine and may come from the page's address. A control character in
     *  it could add further lines or hide text, so it is an error. */
    private writeLines(given: Record<string, string>): void {
        for (const [name, value] of Object.entries(given)) {
            const control = /[\p{Cc}\p{Cf}\p{Zl}\p{Zp}]/u.exec(value);
            if (control) throw new UsageError(workerTexts.control(name, control[0].codePointAt(0) ?? 0));
        }
        this.write(Object.entries(given).map(([name, value]) => `${name}=${value}\n`).join(""));
    }
    /** Throws UsageError; the engine cannot be used after that. */
    begin(given: Record<string, string>): void {
        this.writeLines(given);
        this.out.begin();
    }
    /** Whether change() would keep the discs. Throws UsageError. */
    keepsDiscs(given: Record<string, string>): boolean {
        this.writeLines(given);
        return this.out.keeps_discs() === 1;
    }
    /** The discs continue from `time`, the start of a period; false if the change needs a new simulation. */
    change(time: number, given: Record<string, string>): boolean {
        this.writeLines(given);
        return this.out.change(time) === 1;
    }
    /** From `time` on the container moves straight to a point. The engine's time restarts at 0. */
    steer(time: number, x: number, y: number, duration: number): void {
        this.out.steer(time, x, y, duration);
    }
    /** Reverses time from `time` on; false if energy is not conserved. The engine's time restarts at 0. */
    reverse(time: number): boolean {
        return this.out.reverse(time) === 1;
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
    /** Stores the current report of all measurements; column() reads it. */
    report(): void {
        this.out.report();
    }
    /** A column of the stored report, e.g. "density//by_time". */
    column(path: string): Float64Array {
        this.write(path);
        const size = this.out.column();
        return this.numbers(this.out.values(), size);
    }
    /** `points` are triples of N, ϖ/Ω and error. */
    crossing(points: number[]): Crossing | null {
        const at = this.out.points(points.length / 3);
        new Float64Array(this.out.memory.buffer, at, points.length).set(points);
        return JSON.parse(this.answer(this.out.crossing())) as Crossing | null;
    }
    /** All parameters, including those that were not given. */
    configuration(): Record<string, string> {
        const lines = this.answer(this.out.configuration()).split("\n").filter(Boolean);
        return Object.fromEntries(lines.map((line) => {
            const equals = line.indexOf("=");
            return [line.slice(0, equals), line.slice(equals + 1)];
        }));
    }
    runEvents(count: number): void {
        this.out.run_events(count);
    }
    advanceTo(time: number, maximum: number): boolean {
        return this.out.advance_to(time, maximum) === 1;
    }
    /** The error message with which a run of the command line would end here; empty if there is none. */
    problem(atTheEnd: boolean): string {
        return this.answer(this.out.problem(Number(atTheEnd)));
    }
    /** A copy of the state at `time`, see bindings/wasm/laboratory.cpp. */
    frame(time: number): Float64Array {
        const at = this.out.frame(time);
        return this.numbers(at, this.out.frame_size());
    }
    /** A copy of `size` numbers at `at`. The buffer is read after the call that wrote the numbers: memory
     *  that grows gets a new buffer. */
    private numbers(at: number, size: number): Float64Array {
        return new Float64Array(this.out.memory.buffer, at, size).slice();
    }
    event(): Float64Array {
        return this.numbers(this.out.event(), 9);
    }
    nextEvent(): Float64Array {
        return this.numbers(this.out.next_event(), 9);
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
