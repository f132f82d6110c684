// Runs the engine in a worker, so that the page never waits for it.
import {Engine, UsageError, perRate} from "./engine";
import type {Frame, FromWorker, ToWorker} from "./messages";
import {fill, workerTexts} from "../texts/worker_texts";

/** Longest work per tick. Time that is not reached within it is skipped. */
const tickBudget = 12; // milliseconds
const eventsPerBatch = 500;
const averagesInterval = 200; // milliseconds
/** A period with this many discs takes seconds; with more there would be no visible motion. */
const maxDiscs = 20_000;

let module: WebAssembly.Module | undefined;
let engine: Engine | undefined;
let now = 0; // the time on display
let period = 1;
let runNumber = 0;
let lastAverages = -Infinity;
let change: Record<string, string> | undefined; // takes effect at the end of the period
let showsMaps = false;
let showsContacts = false;
let toFit: {given: Record<string, string>; tries: number} | undefined; // discs without room so far

const send = (message: FromWorker): void => postMessage(message);

function reject(error: unknown): void {
    engine = undefined;
    send({
        kind: "rejected",
        run: runNumber,
        message:
            error instanceof UsageError
                ? error.said
                : {text: fill(workerTexts.stopped, {error: String(error)}), sentences: []},
    });
}

/** Throws if the command line would end the run with an error. */
function requireNoProblem(simulation: Engine, atTheEnd: boolean): void {
    const problem = simulation.problem(atTheEnd);
    if (problem) throw new UsageError(problem);
}

function show(): void {
    if (!engine) return;
    const frame: Frame = {
        kind: "frame",
        run: runNumber,
        frame: engine.frame(now),
        turns: engine.turns(),
        events: engine.events,
        hash: engine.stateHash,
        command: engine.command(),
    };
    if (performance.now() - lastAverages > averagesInterval) {
        frame.rotation = engine.rotation();
        frame.cause = engine.cause();
        lastAverages = performance.now();
    }
    if (showsContacts) frame.contacts = engine.contacts();
    postMessage(frame, {transfer: [frame.frame.buffer]});
}

/** Starts a simulation. Throws UsageError for parameters that are not valid. */
function startSimulation(module: WebAssembly.Module, given: Record<string, string>): Engine {
    const discs = given["discs"] ?? "";
    if (Number(discs) > maxDiscs)
        throw new UsageError(fill(workerTexts.tooMany, {discs, most: maxDiscs}));
    const simulation = new Engine(module);
    simulation.begin(given);
    return simulation;
}

/** Executes `events` events and reports the progress. */
function run(simulation: Engine, events: number): void {
    let reported = performance.now();
    for (let done = 0; done < events; done += eventsPerBatch) {
        simulation.runEvents(Math.min(eventsPerBatch, events - done));
        requireNoProblem(simulation, false);
        if (performance.now() - reported < averagesInterval) continue;
        reported = performance.now();
        send({
            kind: "progress",
            run: runNumber,
            unit: "events",
            done: Math.min(done + eventsPerBatch, events),
            all: events,
        });
    }
    requireNoProblem(simulation, true);
}

function begin(given: Record<string, string>, events: number): void {
    if (!module) return;
    engine = startSimulation(module, given);
    engine.showMaps(showsMaps);
    now = 0;
    lastAverages = -Infinity;
    change = toFit = undefined;
    const configuration = engine.configuration();
    period = Number(configuration["period"]);
    send({kind: "started", run: runNumber, configuration});
    run(engine, events);
    now = engine.time;
    show();
}

/** Advances to `target` within tickBudget. Returns whether it was reached. */
function advance(simulation: Engine, target: number): boolean {
    const deadline = performance.now() + tickBudget;
    let arrived = false;
    do {
        arrived = simulation.advanceTo(target, eventsPerBatch);
        requireNoProblem(simulation, false);
    } while (!arrived && performance.now() < deadline);
    return arrived;
}

function tick(periods: number, strobe = false): void {
    if (!engine) return;
    const periodEnd = (Math.floor(now / period + 1e-9) + 1) * period;
    const target = Math.min(
        now + periods * period,
        change || strobe ? periodEnd : Infinity,
        toFit ? Math.max(period / 3, now) : Infinity,
    );
    const arrived = advance(engine, target);
    const reached = arrived ? target : Math.min(engine.time, target);
    now = Math.max(now, reached);
    if (change && now === periodEnd) applyChange(change);
    else if (toFit && now >= period / 3) applyChange(toFit.given, toFit.tries);
    show();
}

/** Advances by whole periods as fast as it can, and reports the progress. */
function skip(periods: number): void {
    if (!engine) return;
    const begun = Math.round(now / period);
    let reported = performance.now();
    while (now < (begun + periods) * period - 1e-9) {
        while (!engine.advanceTo(now + period, eventsPerBatch)) requireNoProblem(engine, false);
        now += period;
        if (performance.now() - reported < averagesInterval) continue;
        reported = performance.now();
        send({
            kind: "progress",
            run: runNumber,
            unit: "periods",
            done: Math.round(now / period) - begun,
            all: periods,
        });
    }
    lastAverages = -Infinity;
    show();
}

/** A change of the path takes effect at the end of the period; any other at once. */
function requestChange(given: Record<string, string>): void {
    if (!engine) return;
    change = undefined;
    const keeps = engine.keepsDiscs(given);
    if (keeps === "later") change = given;
    else if (keeps === "now") applyChange(given);
    else
        send({
            kind: "changed",
            run: runNumber,
            kept: false,
            missing: 0,
            configuration: engine.configuration(),
        });
}

const triesToFit = 12; // four periods

/** Discs without a free position at this moment are added a third of a period later. */
function applyChange(given: Record<string, string>, tries = triesToFit): void {
    if (!engine) return;
    change = undefined;
    const missing = engine.change(now, given),
        configuration = engine.configuration();
    if (missing !== undefined) {
        now = 0;
        period = Number(configuration["period"]);
    }
    toFit = missing && tries > 0 ? {given, tries: tries - 1} : undefined;
    // If some discs still have no free position after some periods, a new simulation places all
    // discs.
    send({
        kind: "changed",
        run: runNumber,
        kept: missing === 0 || toFit !== undefined,
        missing: missing ?? 0,
        configuration,
    });
    show();
}

function steer(x: number, y: number, duration: number): void {
    if (!engine) return;
    engine.steer(now, x, y, duration);
    period = Number.POSITIVE_INFINITY;
    now = advance(engine, duration) ? duration : engine.time;
    show();
}

function drag(disc: number, x: number, y: number): void {
    if (!engine) return;
    engine.drag(now, disc, x, y);
    now = 0;
    show();
}

function maps(): void {
    if (!engine) return;
    engine.report();
    const of = (column: string): Float64Array => engine!.column(column);
    send({
        kind: "maps",
        density: of("density//by_time"),
        spin: engine.spinMap(),
        flow: {x: of("flow//x"), y: of("flow//y"), ux: of("flow//u_x"), uy: of("flow//u_y")},
        profile: {
            theta: of("profile//theta"),
            varpi: of("profile//varpi_m"),
            wall: of("profile//wall"),
        },
    });
}

/** Runs a point of the study. The worker must not get other messages meanwhile. */
function point(given: Record<string, string>, periods: number): void {
    if (!module) return;
    const simulation = startSimulation(module, given),
        configuration = simulation.configuration();
    const end = (periods + simulation.rotation().warmup) * Number(configuration["period"]);
    while (!simulation.advanceTo(end, eventsPerBatch) && !simulation.problem(false));
    const collapsed = simulation.problem(true) !== undefined;
    send({kind: "point", rotation: simulation.rotation(), collapsed});
}

/** Runs to exactly this event in a simulation of its own. */
function repeat(given: Record<string, string>, events: number): void {
    if (!module) return;
    const simulation = startSimulation(module, given);
    run(simulation, events);
    send({kind: "result", text: simulation.result()});
}

const handlers: {
    [Kind in ToWorker["kind"]]: (message: Extract<ToWorker, {kind: Kind}>) => unknown;
} = {
    engine: async ({bytes}) => {
        module = await Engine.compile(bytes).catch(() => undefined);
        send(
            module
                ? {kind: "ready", parameters: new Engine(module).parameters()}
                : {kind: "unsupported"},
        );
    },
    begin: ({given, events, run: number}) => {
        runNumber = number;
        begin(given, events);
    },
    tick: ({periods, strobe}) => tick(periods, strobe),
    skip: ({periods}) => skip(periods),
    change: ({given}) => requestChange(given),
    steer: ({x, y, duration}) => steer(x, y, duration),
    drag: ({disc, x, y}) => drag(disc, x, y),
    result: () => engine && send({kind: "result", text: engine.result()}),
    measure: ({maps: shown, contacts}) => {
        [showsMaps, showsContacts] = [shown, contacts];
        engine?.showMaps(showsMaps);
    },
    maps: () => maps(),
    point: ({given, periods}) => point(given, periods),
    repeat: ({given, events}) => repeat(given, events),
    crossing: ({runs}) => {
        const evaluation = module && new Engine(module);
        if (evaluation)
            send({kind: "crossing", crossings: perRate((rate) => evaluation.crossing(runs[rate]))});
    },
    search: ({rules, made}) =>
        module && send({kind: "search", next: new Engine(module).search(rules, made)}),
};

onmessage = async ({data}: MessageEvent<ToWorker>): Promise<void> => {
    try {
        await (handlers[data.kind] as (message: ToWorker) => unknown)(data);
    } catch (error) {
        reject(error);
    }
};
