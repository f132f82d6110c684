// The engine behind its functions of plain numbers (bindings/wasm/laboratory.cpp).

import {workerTexts} from "./texts";

/** A sentence of the engine's: what was wrong, which value, what would be right. */
export class Refusal extends Error {}

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
    /** What a slider offers: from, to, step. */
    usual: [number, number, number] | null;
    given: boolean;
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
    warmup: number; // swirls
    /** Those of the warm-up first. */
    blocks: (number | null)[];
    warmup_blocks: number;
    /** In the warm-up and after it. */
    swirls_per_block: [number, number];
}

interface Exports {
    memory: WebAssembly.Memory;
    _initialize(): void;
    room(size: number): number;
    text(): number;
    parameters(): number;
    begin(): void;
    configuration(): number;
    run_events(count: number): void;
    advance_to(time: number, most: number): number;
    problem(atTheEnd: number): number;
    frame(time: number): number;
    frame_size(): number;
    event(): number;
    next_event(): number;
    time(): number;
    events(): number;
    state_hash(): bigint;
    rotation(): number;
    keeps(): number;
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

/** N_c, its standard error, its interval of 95 %. If not every N between was run, only the bracket is known. */
export interface Crossing {
    discs: number | null;
    error: number | null;
    lower: number;
    upper: number;
}

/** What a frame begins with, and what follows for every disc; then, of spheres that can roll, how each is
 *  turned: four numbers. */
export const frameHead = 11;
export const frameDisc = 8;
export const frameTurn = 4;

/** What the C library would ask of a system; a page has none, and 52 is its word for that. */
const noSystem = new Proxy({}, {get: () => () => 52});

export class Engine {
    private readonly out: Exports;

    /** Throws where WebAssembly or its vectors are missing. */
    static compile(bytes: BufferSource): Promise<WebAssembly.Module> {
        return WebAssembly.compile(bytes);
    }

    constructor(module: WebAssembly.Module) {
        const refuse = (at: number, size: number): never => {
            throw new Refusal(this.read(at, size));
        };
        const instance = new WebAssembly.Instance(module, {
            wasi_snapshot_preview1: noSystem as WebAssembly.ModuleImports,
            page: {refuse},
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
    private hand(text: string): void {
        const bytes = new TextEncoder().encode(text);
        const at = this.out.room(bytes.length);
        new Uint8Array(this.out.memory.buffer, at, bytes.length).set(bytes);
    }
    /** Values are lines for the engine, and one may come from an address: a control character in it would
     *  make it several, or another one than is shown. */
    private handLines(given: Record<string, string>): void {
        for (const [name, value] of Object.entries(given)) {
            const control = /[\p{Cc}\p{Cf}\p{Zl}\p{Zp}]/u.exec(value);
            if (control) throw new Refusal(workerTexts.control(name, control[0].codePointAt(0) ?? 0));
        }
        this.hand(Object.entries(given).map(([name, value]) => `${name}=${value}\n`).join(""));
    }
    /** Throws Refusal; the engine is then of no more use. */
    begin(given: Record<string, string>): void {
        this.handLines(given);
        this.out.begin();
    }
    /** Whether change() would keep the discs. Throws Refusal. */
    keeps(given: Record<string, string>): boolean {
        this.handLines(given);
        return this.out.keeps() === 1;
    }
    /** The same discs go on from a moment at which a swirl begins; false if that is another dish. */
    change(time: number, given: Record<string, string>): boolean {
        this.handLines(given);
        return this.out.change(time) === 1;
    }
    /** From a moment on the container goes straight to a point; the engine's time begins anew. */
    steer(time: number, x: number, y: number, duration: number): void {
        this.out.steer(time, x, y, duration);
    }
    /** Time runs backwards from a moment on; false if this dish does not allow that. Times begin anew. */
    reverse(time: number): boolean {
        return this.out.reverse(time) === 1;
    }
    /** A disc is put as near to a point as there is room. Times begin anew. */
    drag(time: number, disc: number, x: number, y: number): void {
        this.out.drag(time, disc, x, y);
    }
    /** The command line that comes to the last event; for a dish that has not been changed. */
    command(): string {
        return this.answer(this.out.command());
    }
    /** As `swirl run --json` writes it. */
    result(): string {
        return this.answer(this.out.result());
    }
    /** Of what is measured, as it is now; column() reads it. */
    report(): void {
        this.out.report();
    }
    /** Of the last report: "density//by_time". */
    column(path: string): Float64Array {
        this.hand(path);
        const size = this.out.column();
        return this.numbers(this.out.values(), size);
    }
    /** Of points N, ϖ/Ω, error, one after the other. */
    crossing(points: number[]): Crossing | null {
        const at = this.out.points(points.length / 3);
        new Float64Array(this.out.memory.buffer, at, points.length).set(points);
        return JSON.parse(this.answer(this.out.crossing())) as Crossing | null;
    }
    /** All parameters of the dish, also those that were not given. */
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
    advanceTo(time: number, most: number): boolean {
        return this.out.advance_to(time, most) === 1;
    }
    /** The sentence with which a run of the command line would have ended here; empty if it is sound. */
    problem(atTheEnd: boolean): string {
        return this.answer(this.out.problem(Number(atTheEnd)));
    }
    /** The dish at a moment, see bindings/wasm/laboratory.cpp; a copy. */
    frame(time: number): Float64Array {
        const at = this.out.frame(time);
        return this.numbers(at, this.out.frame_size());
    }
    /** Of numbers that a call has left there. Only now is the memory's buffer asked for: a call may have
     *  made it grow, and then it is another one. */
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
