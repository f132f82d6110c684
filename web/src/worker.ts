// The engine at work, beside the page so that the page never waits for it.
import {Engine, Refusal, perRate} from "./engine";
import type {Frame, FromWorker, ToWorker} from "./messages";
import {workerTexts} from "./texts";

/** A tick works for so long at most; what is left of it is not made up for. */
const patience = 12; // milliseconds
const eventsAtOnce = 500;
const betweenAverages = 200; // milliseconds
/** A swirl of so many takes seconds; of more there would be no motion to look at. */
const mostDiscs = 20_000;

let module: WebAssembly.Module | undefined;
let engine: Engine | undefined;
let now = 0; // the moment that is shown
let period = 1;
let lastAverages = 0;
let change: Record<string, string> | undefined; // waits for the end of the swirl

const say = (message: FromWorker): void => postMessage(message);

function refuse(error: unknown): void {
    engine = undefined;
    say({kind: "refused", sentence: error instanceof Refusal ? error.message :
        workerTexts.stopped(String(error))});
}

/** Nothing is shown of a dish that the command line would end with a sentence. */
function refuseTrouble(dish: Engine, atTheEnd: boolean): void {
    const sentence = dish.problem(atTheEnd);
    if (sentence) throw new Refusal(sentence);
}

function show(single = false): void {
    if (!engine) return;
    const frame: Frame = {kind: "frame", frame: engine.frame(now), events: engine.events,
                          hash: engine.stateHash, command: engine.command()};
    if (single) [frame.event, frame.next] = [engine.event(), engine.nextEvent()];
    if (single || performance.now() - lastAverages > betweenAverages) {
        frame.rotation = engine.rotation();
        lastAverages = performance.now();
    }
    postMessage(frame, {transfer: [frame.frame.buffer]});
}

/** A dish at rest; what cannot be is refused. */
function dishOf(module: WebAssembly.Module, given: Record<string, string>): Engine {
    const discs = given["discs"] ?? "";
    if (Number(discs) > mostDiscs) throw new Refusal(workerTexts.tooMany(discs, mostDiscs));
    const dish = new Engine(module);
    dish.begin(given);
    return dish;
}

/** So many events; says on the way how far it has come. */
function run(dish: Engine, events: number): void {
    let said = performance.now();
    for (let done = 0; done < events; done += eventsAtOnce) {
        dish.runEvents(Math.min(eventsAtOnce, events - done));
        refuseTrouble(dish, false);
        if (performance.now() - said < betweenAverages) continue;
        said = performance.now();
        say({kind: "progress", done: Math.min(done + eventsAtOnce, events), all: events});
    }
    refuseTrouble(dish, true);
}

function begin(given: Record<string, string>, events: number): void {
    if (!module) return;
    engine = dishOf(module, {...given, ...watched});
    now = 0;
    lastAverages = 0;
    change = undefined;
    const configuration = engine.configuration();
    period = Number(configuration["period"]);
    say({kind: "begun", configuration});
    run(engine, events);
    now = engine.time;
    show(events > 0);
}

/** The page's own measurements go along with every dish: they change no bit. */
const watched = {measure: "density,flow,profile"};

/** To a moment, or as far as patience goes; whether it has come there. */
function advance(dish: Engine, target: number): boolean {
    const deadline = performance.now() + patience;
    let arrived = false;
    do {
        arrived = dish.advanceTo(target, eventsAtOnce);
        refuseTrouble(dish, false);
    } while (!arrived && performance.now() < deadline);
    return arrived;
}

function tick(swirls: number): void {
    if (!engine) return;
    const swirlEnds = (Math.floor(now / period + 1e-9) + 1) * period;
    const target = change ? Math.min(now + swirls * period, swirlEnds) : now + swirls * period;
    const arrived = advance(engine, target);
    const reached = arrived ? target : Math.min(engine.time, target);
    now = Math.max(now, reached);
    if (change && now === swirlEnds) goOn(change);
    show();
}

/** The same discs wait for the end of the swirl; another dish waits for nothing. */
function ask(given: Record<string, string>): void {
    if (!engine) return;
    if (engine.keeps(given)) change = given;
    else say({kind: "changed", kept: false, configuration: engine.configuration()});
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
    const dish = dishOf(module, given), configuration = dish.configuration();
    const end = (swirls + dish.rotation().warmup) * Number(configuration["period"]);
    while (!dish.advanceTo(end, eventsAtOnce) && !dish.problem(false));
    const collapsed = dish.problem(true) !== "";
    say({kind: "point", rotation: dish.rotation(), collapsed});
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
                ask(data.given);
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
                if (module) {
                    const found = new Engine(module);
                    say({kind: "crossing", curve: data.curve,
                         crossings: perRate((rate) => found.crossing(data.curves[rate]))});
                }
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
