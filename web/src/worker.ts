// The engine at work, beside the page so that the page never waits for it.
import {Engine, Refusal} from "./engine";
import type {Frame, FromWorker, ToWorker} from "./messages";

/** A tick works for so long at most; what is left of it is not made up for. */
const patience = 12; // milliseconds
const eventsAtOnce = 500;
const betweenAverages = 200; // milliseconds
/** So long without progress, and time stands still: a collapse. */
const collapse = 4000; // milliseconds

let module: WebAssembly.Module | undefined;
let engine: Engine | undefined;
let now = 0; // the moment that is shown
let period = 1;
let lastAverages = 0;
let stuckSince: number | undefined;
let change: Record<string, string> | undefined; // waits for the end of the swirl

const say = (message: FromWorker): void => postMessage(message);

function refuse(error: unknown): void {
    engine = undefined;
    say({kind: "refused", sentence: error instanceof Refusal ? error.message :
        `The engine stopped: ${String(error)}. Reload the page.`});
}

function show(single = false): void {
    if (!engine) return;
    const frame: Frame = {kind: "frame", frame: engine.frame(now), events: engine.events,
                          hash: engine.stateHash};
    if (single) [frame.event, frame.next] = [engine.event(), engine.nextEvent()];
    if (single || performance.now() - lastAverages > betweenAverages) {
        frame.rotation = engine.rotation();
        lastAverages = performance.now();
    }
    postMessage(frame, {transfer: [frame.frame.buffer]});
}

function begin(given: Record<string, string>, events: number): void {
    if (!module) return;
    engine = new Engine(module);
    engine.begin({...given, ...watched});
    now = 0;
    lastAverages = 0;
    stuckSince = undefined;
    change = undefined;
    const configuration = engine.configuration();
    period = Number(configuration["period"]);
    say({kind: "begun", configuration});
    if (events > 0) engine.runEvents(events);
    now = engine.time;
    show(events > 0);
}

/** The page's own measurements go along with every dish: they change no bit. */
const watched = {measure: "density,flow,profile"};

/** To a moment, or as far as patience goes; whether it has come there. */
function advance(dish: Engine, target: number): boolean {
    const deadline = performance.now() + patience;
    let arrived = dish.advanceTo(target, eventsAtOnce);
    while (!arrived && performance.now() < deadline)
        arrived = dish.advanceTo(target, eventsAtOnce);
    return arrived;
}

function tick(swirls: number): void {
    if (!engine) return;
    const swirlEnds = (Math.floor(now / period + 1e-9) + 1) * period;
    const target = change ? Math.min(now + swirls * period, swirlEnds) : now + swirls * period;
    const arrived = advance(engine, target);
    const reached = arrived ? target : Math.min(engine.time, target);
    if (arrived || reached > now + 1e-9 * period) stuckSince = undefined;
    else if (performance.now() - (stuckSince ??= performance.now()) > collapse)
        throw new Refusal("Time all but stands still: discs that lie pressed together collide ever " +
            "faster, and the model has no state after that (a collapse). Another seed may not " +
            "meet it; with a restitution below 1 a longer contact_duration keeps them apart.");
    now = Math.max(now, reached);
    if (change && now === swirlEnds) goOn(change);
    show();
}

function goOn(given: Record<string, string>): void {
    if (!engine) return;
    change = undefined;
    const kept = engine.change(now, {...given, ...watched});
    const configuration = engine.configuration();
    if (kept) {
        now = 0;
        period = Number(configuration["period"]);
    }
    say({kind: "changed", kept, configuration});
}

function steer(x: number, y: number, duration: number): void {
    if (!engine) return;
    engine.steer(now, x, y, duration);
    period = Number.POSITIVE_INFINITY;
    now = advance(engine, duration) ? duration : engine.time;
    show();
}

function reverse(): void {
    if (!engine) return;
    const done = engine.reverse(now);
    if (done) now = 0;
    say({kind: "reversed", done});
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
    say({kind: "maps", density: of("density//by_time"),
         flow: {x: of("flow//x"), y: of("flow//y"), ux: of("flow//u_x"), uy: of("flow//u_y")},
         profile: {theta: of("profile//theta"), varpi: of("profile//varpi_m"),
                   wall: of("profile//wall")}});
}

/** A run of one's own study. Whoever asks for it asks nothing else of this worker meanwhile. */
function point(given: Record<string, string>, swirls: number): void {
    if (!module) return;
    engine = new Engine(module);
    engine.begin(given);
    const {period: length, warmup} = engine.configuration();
    const end = (swirls + Number(warmup || engine.rotation().warmup)) * Number(length);
    const begun = performance.now();
    let before = engine.time;
    let progress = begun;
    while (!engine.advanceTo(end, eventsAtOnce)) {
        if (engine.time > before) [before, progress] = [engine.time, performance.now()];
        else if (performance.now() - progress > collapse) break;
    }
    say({kind: "point", rotation: engine.rotation().by_time});
    engine = undefined;
}

onmessage = async ({data}: MessageEvent<ToWorker>): Promise<void> => {
    try {
        switch (data.kind) {
            case "engine":
                module = await Engine.compile(data.bytes).catch(() => undefined);
                say(module ? {kind: "ready", parameters: new Engine(module).parameters()}
                           : {kind: "unsupported"});
                break;
            case "begin":
                begin(data.given, data.events);
                break;
            case "tick":
                tick(data.swirls);
                break;
            case "change":
                change = data.given;
                break;
            case "steer":
                steer(data.x, data.y, data.duration);
                break;
            case "reverse":
                reverse();
                break;
            case "drag":
                drag(data.disc, data.x, data.y);
                break;
            case "result":
                if (engine) say({kind: "result", text: engine.result()});
                break;
            case "maps":
                maps();
                break;
            case "point":
                point(data.given, data.swirls);
                break;
            case "crossing":
                if (module) say({kind: "crossing", curve: data.curve,
                                 crossing: new Engine(module).crossing(data.points)});
                break;
            case "step":
                if (!engine) break;
                engine.runEvents(1);
                now = engine.time;
                show(true);
                break;
        }
    } catch (error) {
        refuse(error);
    }
};
