// The engine at work, beside the page so that the page never waits for it.
import {Engine, Refusal} from "./engine";
import type {Frame, FromWorker, ToWorker} from "./messages";
import {texts} from "./texts";

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
    if (single) frame.event = engine.event();
    if (single || performance.now() - lastAverages > betweenAverages) {
        frame.rotation = engine.rotation();
        lastAverages = performance.now();
    }
    postMessage(frame, {transfer: [frame.frame.buffer]});
}

function begin(given: Record<string, string>, events: number): void {
    if (!module) return;
    engine = new Engine(module);
    engine.begin(given);
    now = 0;
    lastAverages = 0;
    stuckSince = undefined;
    const configuration = engine.configuration();
    period = Number(configuration["period"]);
    say({kind: "begun", configuration});
    if (events > 0) engine.runEvents(events);
    now = engine.time;
    show(events > 0);
}

function tick(swirls: number): void {
    if (!engine) return;
    const target = now + swirls * period;
    const deadline = performance.now() + patience;
    let arrived = engine.advanceTo(target, eventsAtOnce);
    while (!arrived && performance.now() < deadline)
        arrived = engine.advanceTo(target, eventsAtOnce);
    const reached = arrived ? target : Math.min(engine.time, target);
    if (arrived || reached > now + 1e-9 * period) stuckSince = undefined;
    else if (performance.now() - (stuckSince ??= performance.now()) > collapse)
        throw new Refusal("Time all but stands still: discs that lie pressed together collide ever " +
            "faster, and the model has no state after that (a collapse). Another seed may not " +
            "meet it; with a restitution below 1 a longer contact_duration keeps them apart.");
    now = Math.max(now, reached);
    show();
}

onmessage = async ({data}: MessageEvent<ToWorker>): Promise<void> => {
    try {
        switch (data.kind) {
            case "engine":
                module = await Engine.compile(data.bytes).catch(() => {
                    throw new Refusal(texts.noWebAssembly);
                });
                say({kind: "ready", parameters: new Engine(module).parameters()});
                break;
            case "begin":
                begin(data.given, data.events);
                break;
            case "tick":
                tick(data.swirls);
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
