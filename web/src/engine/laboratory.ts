// The simulation on the page: its parameters, its last frame and its averages. The engine runs in a
// worker; the parts of the page listen to what it reports.
import engineUrl from "../../generated/swirl.wasm.gz?url";
import EngineWorker from "./worker?worker&inline";
import {parameterOf, type Cause, type Parameter, type Rotation} from "./engine";
import type {Frame, FromWorker, Maps, ToWorker} from "./messages";
import {language} from "../texts/start";
import {counted, fill, engineMessage, nameParameters, texts} from "../texts/texts";

/** The reports of the laboratory. Each part of the page listens to some of them. */
export interface Reports {
    /** The engine is loaded, and `parameters` is complete. */
    ready: [];
    /** A new simulation was requested; there are no frames and averages until "started". */
    begin: [];
    /** A new simulation has begun; `configuration` is complete. */
    started: [];
    /** The same discs continue with other parameters or (by hand) another history; averages start
     *  again. */
    changed: [byParameters: boolean];
    frame: [frame: Frame];
    averages: [rotation: Rotation];
    maps: [maps: Maps];
    /** Some values that were given by the user have changed. */
    given: [];
    result: [text: string];
    progress: [unit: "events" | "periods", done: number, all: number];
    /** `parameter` is the name of the one whose value is wrong, if it is known. */
    error: [message: string, parameter?: string];
    warning: [message: string];
}
type Listeners = {[Kind in keyof Reports]?: ((...report: Reports[Kind]) => void)[]};

/** The engine is embedded in the page, compressed to a third of its size. */
async function unpacked(url: string): Promise<ArrayBuffer> {
    const packed = (await fetch(url)).body;
    if (!packed) throw new Error("empty");
    return new Response(packed.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

const settling = 350; // milliseconds between the last input and a new simulation
/** Denser packings of equal discs are known, but the engine finds hardly any. It gets a second
 *  then. */
const doubtfulPacking = 0.8,
    doubtfulTime = 1000; // milliseconds
const placingTime = 30_000; // milliseconds
const throttle = 120; // milliseconds between changes of the running simulation

export class Laboratory {
    /** The table of parameters. */
    parameters: Parameter[] = [];
    /** The values that were given: by the user, an example, the lesson or the page's address. */
    given: Record<string, string> = {};
    /** All values in effect. */
    configuration: Record<string, string> = {};
    /** Whether the engine has a parameter of this name. */
    readonly isParameter = (name: string): boolean =>
        this.parameters.some((row) => row.name === name && row.settable);
    last: Frame | undefined;
    averages: Rotation | undefined;
    cause: Cause | undefined;
    /** Whether a parameter that changes keeps the discs, if it can. */
    keepsDiscs = true;
    /** The simulation was changed, so no command line reproduces it. */
    wasChanged = false;
    /** Number of discs that still have to be added, because there was no free position. */
    missing = 0;
    isByHand = false;
    /** An error is shown, and there is no simulation. */
    hasFailed = false;
    /** The answer to a message is missing. */
    isWaiting = false;

    private readonly engine = unpacked(engineUrl);
    private worker = new EngineWorker({name: language});
    private readonly listeners: Listeners = {};
    private later: ReturnType<typeof setTimeout> | undefined;
    private soon: ReturnType<typeof setTimeout> | undefined;
    private run = 0; // number of the present simulation
    private placing: ReturnType<typeof setTimeout> | undefined; // the worker places discs; ends the attempt
    private waitsForWorker: ToWorker | undefined; // the beginning, until a new worker is ready

    constructor() {
        this.worker.onmessage = ({data}: MessageEvent<FromWorker>): void => this.hear(data);
        this.engine.then(
            (bytes) => this.send({kind: "engine", bytes}),
            () => this.fail(texts.noWebAssembly),
        );
    }

    on<Kind extends keyof Reports>(kind: Kind, listener: (...report: Reports[Kind]) => void): void {
        (this.listeners[kind] ??= [] as never[] as NonNullable<Listeners[Kind]>).push(listener);
    }

    /** These values with the present seed, so that examples of a new visitor are not always the
     *  same run. */
    withSeed(given: Record<string, string>): Record<string, string> {
        const {seed} = this.given;
        return seed ? {seed, ...given} : given;
    }

    /** A worker with the engine, for further simulations. */
    newWorker(): Worker {
        const created = new EngineWorker({name: language});
        void this.engine.then((bytes) =>
            created.postMessage({kind: "engine", bytes} satisfies ToWorker),
        );
        return created;
    }

    send(message: ToWorker): void {
        this.worker.postMessage(message);
    }

    /** Sends a message unless the answer to an earlier one is missing. Returns whether it was sent.
     *  */
    request(message: ToWorker): boolean {
        if (this.isWaiting) return false;
        this.isWaiting = true;
        this.send(message);
        return true;
    }

    /** Sets the given values, all or some, and applies them. An empty value is the default. With
     *  `restart` a new simulation begins at once. */
    set(values: Record<string, string>, options: {all?: boolean; restart?: boolean} = {}): void {
        const joined = options.all ? values : {...this.given, ...values};
        this.given = Object.fromEntries(Object.entries(joined).filter(([, value]) => value !== ""));
        this.report("given");
        if (options.restart) return this.begin();
        // After an error there is no simulation to continue.
        const continues =
            this.keepsDiscs &&
            this.last &&
            !this.isByHand &&
            !this.hasFailed &&
            this.packing() <= doubtfulPacking;
        if (!continues) this.beginSoon();
        else
            this.soon ??= setTimeout(() => {
                this.soon = undefined;
                this.send({kind: "change", given: this.given});
            }, throttle);
    }

    /** Starts a new simulation after the last input. */
    private beginSoon(): void {
        clearTimeout(this.later);
        this.later = setTimeout(() => this.begin(), settling);
    }

    /** Starts a new simulation and runs it to this number of events. */
    begin(events = 0): void {
        clearTimeout(this.later);
        clearTimeout(this.soon);
        this.soon = undefined;
        this.last = undefined;
        this.averages = this.cause = undefined;
        this.isWaiting = true;
        this.wasChanged = this.isByHand = this.hasFailed = false;
        const message: ToWorker = {kind: "begin", given: this.given, events, run: ++this.run};
        // A worker that still places the discs of an earlier request would answer late.
        if (this.placing !== undefined) this.renewWorker(message);
        else this.send(message);
        clearTimeout(this.placing);
        this.placing = setTimeout(
            () => this.endPlacing(),
            this.packing() > doubtfulPacking ? doubtfulTime : placingTime,
        );
        this.report("begin");
    }

    /** The share of the container that discs of one size cover. */
    private packing(): number {
        const of = (name: string): number => Number(this.given[name] || this.effectiveValue(name));
        return this.given["mixture"] || this.given["sizes"]
            ? 0
            : of("discs") * (of("radius") / of("container_radius")) ** 2;
    }

    private endPlacing(): void {
        this.renewWorker();
        this.placing = undefined;
        this.fail(
            fill(texts.tooDense, {
                particles: this.counted(
                    Number(this.given["discs"] || this.effectiveValue("discs")),
                    this.given,
                ),
                percent: Math.round(100 * this.packing()),
            }),
            "discs",
        );
    }

    private renewWorker(message?: ToWorker): void {
        this.worker.terminate();
        this.waitsForWorker = message;
        this.worker = this.newWorker();
        this.worker.onmessage = ({data}: MessageEvent<FromWorker>): void => this.hear(data);
    }

    /** The discs continue, but no command line reproduces them from here on. */
    resetAverages(byParameters = false): void {
        this.wasChanged = true;
        this.averages = this.cause = undefined;
        this.report("changed", byParameters);
    }

    setByHand(on: boolean): void {
        if (on === this.isByHand) return;
        if (!on) return this.begin();
        this.isByHand = true;
        this.resetAverages();
    }

    /** Shows a message; the simulation continues. */
    warn(message: string): void {
        this.report("warning", message);
    }

    fail(message: string, parameter?: string): void {
        this.isWaiting = false;
        this.hasFailed = true;
        this.report("error", message, parameter);
    }

    /** The value in effect if none is given: the preset's, or the default. Two coefficients are
     *  DISC:WALL. */
    effectiveValue(name: string): string {
        const {mu_disc, mu_wall, [name]: configured} = this.configuration;
        const both =
            name !== "mu" ? undefined : mu_disc === mu_wall ? mu_disc : `${mu_disc}:${mu_wall}`;
        return (
            configured ?? both ?? this.parameters.find((row) => row.name === name)?.default ?? ""
        );
    }
    value(name: string): number {
        return Number(this.configuration[name]);
    }

    /** "48 discs", "1 sphere": the number with the particles of this configuration. */
    counted(n: number, {preset, body}: Record<string, string> = this.configuration): string {
        const sphere = body === "sphere" || (preset === "experiment" && !body);
        return counted(n, texts.bodies[sphere ? "sphere" : "disc"]);
    }

    /** No contact and no floor dissipates energy. */
    conservesEnergy(): boolean {
        const {mu_disc, mu_wall, restitution, floor} = this.configuration;
        return (
            Number(mu_disc) === 0 &&
            Number(mu_wall) === 0 &&
            Number(restitution) === 1 &&
            (floor ?? "none") === "none"
        );
    }

    /** The largest distance of the container's centre from S; by hand, twice the amplitude. */
    maxDistance(): number {
        const amplitude = Number(this.configuration["amplitude"] ?? 0);
        return this.isByHand
            ? Math.max(2 * amplitude, 0.3 * this.value("container_radius"))
            : amplitude;
    }

    private report<Kind extends keyof Reports>(kind: Kind, ...report: Reports[Kind]): void {
        for (const listener of this.listeners[kind] ?? []) listener(...report);
    }

    private hear(data: FromWorker): void {
        // Ignores answers that belong to an earlier simulation.
        if ("run" in data && data.run !== this.run) return;
        switch (data.kind) {
            case "ready":
                if (this.waitsForWorker) this.send(this.waitsForWorker);
                this.waitsForWorker = undefined;
                if (this.parameters.length > 0) return;
                this.parameters = data.parameters;
                nameParameters(this.parameters);
                return this.report("ready");
            case "started":
                clearTimeout(this.placing);
                this.placing = undefined;
                this.configuration = data.configuration;
                this.missing = 0;
                return this.report("started");
            case "changed":
                if (!data.kept) return this.beginSoon();
                this.configuration = data.configuration;
                this.missing = data.missing;
                return this.resetAverages(true);
            case "result":
                return this.report("result", data.text);
            case "maps":
                return this.report("maps", data);
            case "unsupported":
                return this.fail(texts.noWebAssembly);
            case "rejected":
                clearTimeout(this.placing);
                this.placing = undefined;
                return this.fail(engineMessage(data.message), parameterOf(data.message.text));
            case "progress":
                return this.report("progress", data.unit, data.done, data.all);
            case "frame":
                this.isWaiting = false;
                if (data.rotation) [this.averages, this.cause] = [data.rotation, data.cause];
                this.last = data;
                this.report("frame", data);
                if (data.rotation) this.report("averages", data.rotation);
        }
    }
}
