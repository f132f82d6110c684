// The page: what is asked for, what is shown. The dish itself is with the worker.
import "./style.css";
import "uplot/dist/uPlot.min.css";
import uPlot from "uplot";
import engineUrl from "../generated/swirl.wasm.gz?url";
import EngineWorker from "./worker?worker&inline";
import type {Parameter, Rotation} from "./engine";
import type {Frame, FromWorker, ToWorker} from "./messages";
import {Beside} from "./beside";
import {MapsPanel} from "./maps";
import {accent, byId, button, dark, element, ink, line, quiet, save, withError} from "./page";
import {Recording} from "./recording";
import {meansOf, swirlsOf, tableOf} from "./series";
import {discAt, discOf, draw, pointedAt, recent, turnBetween, type Coloring, type View} from "./scene";
import {Study} from "./study";
import {lesson, presets, symbols, texts} from "./texts";

const trailLength = 45; // frames, at most
const trailPeriods = 0.3; // at most, as swirl movie has it
const settling = 350; // milliseconds after the last change before it is made

// --- state ------------------------------------------------------------------------------------

let rows: Parameter[] = [];
let given: Record<string, string> = {};
let configuration: Record<string, string> = {};
let runTo = 0; // events, from the address
const lessMotion = matchMedia("(prefers-reduced-motion: reduce)");
let playing = !lessMotion.matches;
let view: "lab" | "m" | "both" = "lab";
let coloring: Coloring = "spin";
let trails = false;
let forces = false;
let swirlsPerSecond = 1;
let step = -1; // of the lesson
let last: Frame | undefined;
let history: Float64Array[] = [];
let waiting = false; // for the answer to a tick
let lastTick = 0;
let keepDiscs = false; // where a parameter changes
let hasHistory = false; // no command line makes this dish
let byHand = false;
let pointer: [number, number] | undefined; // where the container is to go, by hand
let turned = 0; // of the pack, in turns
let dragged: number | undefined; // the disc that the pointer holds
let held: number | undefined; // the disc that the keys move
let backwards = false;
let beside: Beside | undefined;

const worker = new EngineWorker();
const tell = (message: ToWorker): void => worker.postMessage(message);

// --- the dish ---------------------------------------------------------------------------------

const canvases: Partial<Record<View, HTMLCanvasElement>> = {};

function layOutViews(): void {
    const views: View[] = view === "both" ? ["lab", "m"] : [view];
    byId("views").replaceChildren(...views.map((each) => {
        const canvas = element("canvas");
        canvas.setAttribute("role", "img");
        canvases[each] = canvas;
        if (each === "lab") {
            takePointer(canvas);
            takeTouch(canvas);
            takeKeys(canvas);
        }
        return element("figure", {}, canvas, element("figcaption", {textContent: texts.views[each]}));
    }));
    for (const each of ["lab", "m"] as const) if (!views.includes(each)) delete canvases[each];
    if (beside) byId("views").append(beside.figure);
    recording.stop();
    redraw();
}

/** By hand it leads the dish, else the disc that it is put on. */
function takePointer(canvas: HTMLCanvasElement): void {
    canvas.title = texts.dragHow;
    const point = (event: PointerEvent): [number, number] =>
        pointedAt(canvas, last!.frame, room(), event.clientX, event.clientY);
    canvas.addEventListener("pointerdown", (event) => {
        if (!last) return;
        if (byHand) pointer = point(event);
        else dragged = discAt(last.frame, ...point(event));
        if (dragged !== undefined) canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
        if (!last) return;
        if (byHand) pointer = point(event);
        if (dragged !== undefined) put(dragged, ...point(event));
    });
    for (const end of ["pointerup", "pointercancel"] as const)
        canvas.addEventListener(end, () => { dragged = undefined; });
}

/** A finger that moves up or down scrolls the page, and takes the disc from the pointer, unless the
 *  first touch says that it is for the disc. */
function takeTouch(canvas: HTMLCanvasElement): void {
    canvas.addEventListener("touchstart", (event) => {
        const finger = event.touches[0];
        if (!last || byHand || !finger || event.touches.length > 1) return;
        const at = pointedAt(canvas, last.frame, room(), finger.clientX, finger.clientY);
        if (discAt(last.frame, ...at) !== undefined) event.preventDefault();
    }, {passive: false});
}

/** Unless the last one is still under way. */
function put(disc: number, x: number, y: number): void {
    if (waiting) return;
    waiting = true;
    startAnew();
    tell({kind: "drag", disc, x, y});
}

/** What the pointer does, by keys: [ and ] take a disc, arrows move it, Escape lets it go; by hand
 *  arrows lead the dish. */
function takeKeys(canvas: HTMLCanvasElement): void {
    const ways: Record<string, [number, number]> = {
        ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1],
    };
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute("aria-keyshortcuts", "[ ] ArrowLeft ArrowRight ArrowUp ArrowDown Escape");
    canvas.addEventListener("keydown", (event) => {
        if (!last) return;
        const discs = last.frame[10] ?? 0, way = ways[event.key];
        if (way) {
            event.preventDefault();
            if (byHand) {
                const [x, y] = pointer ?? [last.frame[3]!, last.frame[4]!];
                const step = 0.1 * room();
                pointer = [x + step * way[0], y + step * way[1]];
            } else if (held !== undefined && held < discs) {
                const {x, y, radius} = discOf(last.frame, held);
                const step = (event.shiftKey ? 0.05 : 0.25) * radius;
                put(held, x + step * way[0], y + step * way[1]);
            }
        } else if ((event.key === "[" || event.key === "]") && !byHand && discs > 0) {
            const next = held === undefined ? 0 : held + (event.key === "]" ? 1 : discs - 1);
            hold(next % discs);
        } else if (event.key === "Escape") {
            hold(undefined);
        }
    });
    canvas.addEventListener("blur", () => hold(undefined));
}

/** Time stands still while a disc is held. */
function hold(disc: number | undefined): void {
    if (disc === held) return;
    held = disc;
    if (disc !== undefined) byId("headline").textContent = texts.holds(disc + 1);
    redraw();
}

/** The same discs, but no command line makes what they do from here on: averages begin anew. */
function startAnew(): void {
    hasHistory = true;
    history = [];
    forgetAverages();
    turned = 0;
}

/** How far from S the container may come; by hand, twice as far as it is swirled. */
function room(): number {
    const amplitude = Number(configuration["amplitude"] ?? 0);
    return byHand ? Math.max(2 * amplitude, 0.3 * Number(configuration["container_radius"]))
                  : amplitude;
}

function redraw(): void {
    if (!last) return;
    const past = trails ? recent(history, last.frame, trailPeriods * Number(configuration["period"])) : [];
    for (const [each, canvas] of Object.entries(canvases) as [View, HTMLCanvasElement][]) {
        draw(canvas, last.frame, {view: each, coloring, trails: past,
                                  event: last.event, next: last.next, dark: dark(),
                                  omega: forces && !byHand ? 2 * Math.PI / Number(configuration["period"]) : 0,
                                  room: room(), turned, held});
        beside?.redraw();
        const label = texts.dish(counted(last.frame[10] ?? 0), texts.views[each]);
        if (canvas.getAttribute("aria-label") !== label) canvas.setAttribute("aria-label", label);
    }
}

// --- numbers and plot -------------------------------------------------------------------------

const plot = new uPlot({
    width: 400, height: 190,
    scales: {x: {time: false}},
    axes: [{label: texts.swirls, stroke: ink, grid: {stroke: line}},
           {label: symbols.rigidRotation, stroke: ink, grid: {stroke: line}}],
    series: [{label: texts.swirls}, {label: symbols.rigidRotation, stroke: quiet, width: 1},
             {label: texts.mean, stroke: accent, width: 2}],
    legend: {show: false},
}, [[], [], []], byId("plot"));

/** So many of what is in a dish of these parameters. */
function counted(n: number, {preset, body, floor} = configuration): string {
    const sphere = body === "sphere" || (preset === "experiment" && !body);
    return texts.counted(n, texts.bodies[sphere ? "sphere" : floor === "sliding" ? "coin" : "disc"]);
}

function sentence(rotation: Rotation): string {
    if (byHand) return texts.handSays(turned.toFixed(2).replace("-", "−"));
    const discs = Number(configuration["discs"]);
    const {mean, error} = rotation.by_time;
    if (mean === null || error === null || Math.abs(mean) < 2 * error) return texts.undecided(counted(discs));
    return (mean > 0 ? texts.rotates : texts.counterrotates)(discs, counted(discs));
}

let averages: Rotation | undefined; // as they were shown last
const blocksShown = (): number => averages?.blocks.length ?? 0;

function forgetAverages(): void {
    averages = undefined;
    plot.setData([[], [], []]);
}

/** Nothing takes energy: no contact, nor a floor. */
function nothingRubs(): boolean {
    const {mu_disc, mu_wall, restitution, floor} = configuration;
    return Number(mu_disc) === 0 && Number(mu_wall) === 0 && Number(restitution) === 1 &&
        (floor ?? "none") === "none";
}

/** What a reader must know before believing the averages. */
function caution(): string {
    const {amplitude, path} = configuration;
    const keepsGrowing = nothingRubs() && Number(amplitude) > 0 && path !== "circle";
    return keepsGrowing && !byHand ? texts.grows : "";
}

function showRotation(rotation: Rotation): void {
    const time = last?.frame[0] ?? 0;
    const pairs: [string, string][] = [
        [texts.byTime, withError(rotation.by_time.mean, rotation.by_time.error, texts.notYet)],
        [texts.byEvent, withError(rotation.by_event.mean, rotation.by_event.error, texts.notYet)],
        [texts.swirls, (time / Number(configuration["period"])).toFixed(1)],
        [texts.turned, texts.turns(turned.toFixed(2).replace("-", "−"))],
    ];
    if (byHand) pairs.splice(0, 3); // no swirl to go by
    const early = rotation.by_time.blocks === 0 && !byHand ? texts.warmup(rotation.warmup) : "";
    byId("numbers").replaceChildren(element("dl", {id: "estimates"}, ...pairs.flatMap(
        ([name, value]) => [element("dt", {textContent: name}), element("dd", {textContent: value})])),
        element("p", {textContent: early}), element("p", {id: "caution", textContent: caution()}));
    const headline = sentence(rotation);
    if (byId("headline").textContent !== headline) byId("headline").textContent = headline;
    const before = blocksShown();
    averages = rotation;
    if (blocksShown() === before) return;
    if (byId("plot").hidden !== blocksShown() < 2) resize();
    plot.setData([swirlsOf(rotation), rotation.blocks, meansOf(rotation)]);
}

// --- asking for a dish ------------------------------------------------------------------------

const copyButton = byId("copy") as HTMLButtonElement;

/** A dish that is refused, or not there yet, has no command. */
function offerCommand(command = ""): void {
    byId("command").textContent = hasHistory ? texts.noCommand : command;
    copyButton.disabled = hasHistory || command === "";
}

function address(): string {
    const query = new URLSearchParams(Object.entries(given).filter(([, value]) => value !== ""));
    const text = query.toString();
    return text ? `?${text}` : location.pathname;
}

const manyDiscs = 1000; // so many take a moment to be placed

function begin(events = 0): void {
    history = [];
    forgetAverages();
    last = undefined;
    waiting = true;
    hasHistory = false;
    setByHand(false);
    setBackwards(false);
    recording.stop();
    turned = 0;
    const discs = Number(given["discs"]);
    byId("headline").textContent = discs >= manyDiscs ? texts.placing(counted(discs, asked())) : "…";
    byId("refusal").hidden = true;
    for (const ofState of ["event-count", "state-hash"]) byId(ofState).textContent = "";
    offerCommand();
    tell({kind: "begin", given: asked(), events});
}

function asked(): Record<string, string> {
    return Object.fromEntries(Object.entries(given).filter(([, value]) => value !== ""));
}

let later: ReturnType<typeof setTimeout> | undefined;
function changed(): void {
    clearTimeout(later);
    later = setTimeout(() => {
        try {
            window.history.replaceState(null, "", address());
        } catch {
            // A page from a memory stick has no address of its own in some browsers.
        }
        // What was refused has no dish to go on with.
        if (keepDiscs && last && !byHand && byId("refusal").hidden)
            tell({kind: "change", given: asked()});
        else begin();
    }, settling);
}

function refuse(text: string): void {
    byId("refusal").textContent = text;
    byId("refusal").hidden = false;
    offerCommand();
    setPlaying(false);
}

// --- controls ---------------------------------------------------------------------------------

/** What a parameter is given by: text or a choice of words, and a slider beside it. */
interface Field {
    text: HTMLInputElement | HTMLSelectElement;
    slider?: HTMLInputElement;
}
const fields: Record<string, Field> = {};

function setGiven(values: Record<string, string>): void {
    given = {...values};
    showFields();
}

function showField(name: string, field: Field): void {
    const value = given[name] ?? "", holds = holding(name);
    const isChoice = field.text instanceof HTMLSelectElement;
    if (field.text instanceof HTMLInputElement) field.text.placeholder = holds;
    const text = isChoice ? value || holds : value;
    if (field.text.value.trim() !== text) field.text.value = text; // not what is being typed
    if (field.slider) field.slider.value = value || holds || field.slider.value;
}

/** What holds where nothing is given: a preset has other values than the paper. */
function holding(name: string): string {
    const {mu_disc, mu_wall, [name]: configured} = configuration;
    const both = name === "mu" && mu_disc === mu_wall ? mu_disc : undefined;
    return configured ?? both ?? rows.find((row) => row.name === name)?.default ?? "";
}

function showFields(): void {
    for (const [name, field] of Object.entries(fields)) showField(name, field);
}

const describe = ({name, description}: Parameter): string => texts.descriptions[name] ?? description;

/** The words that a parameter can be, from how it is given: "none|sliding", "NUMBER|paper|solid". */
const wordsOf = ({form}: Parameter): string[] => form.split("|").filter((word) => /^[a-z]+$/.test(word));

/** Words alone are to choose from; words beside numbers are proposed. */
function textField(row: Parameter, id: string): [Field["text"], ...HTMLElement[]] {
    const words = wordsOf(row);
    if (words.length > 0 && words.length === row.form.split("|").length)
        return [element("select", {id}, ...(words.includes(row.default) ? words : ["", ...words])
            .map((word) => element("option", {value: word, textContent: word})))];
    const text = element("input", {type: "text", id, spellcheck: false});
    if (words.length === 0) return [text];
    text.setAttribute("list", `${id}-words`);
    return [text, element("datalist", {id: `${id}-words`},
                          ...words.map((word) => element("option", {value: word})))];
}

function parameterRow(row: Parameter): HTMLElement {
    const id = `parameter-${row.name}`;
    const [text, ...proposed] = textField(row, id), [symbol, index] = row.symbol.split("_");
    const label = element("label", {htmlFor: id, title: describe(row)}, row.name, " ",
                          element("i", {}, symbol ?? "", element("sub", {textContent: index ?? ""})));
    text.title = describe(row) + (row.unit ? ` (${row.unit})` : "");
    text.addEventListener("input", () => {
        given[row.name] = text.value.trim();
        if (fields[row.name]?.slider) fields[row.name]!.slider!.value = text.value || holding(row.name);
        changed();
    });
    fields[row.name] = {text};
    if (!row.usual) {
        text.className = "wide";
        return element("div", {className: "row"}, label, text, ...proposed);
    }
    const [min, max, step] = row.usual.map(String) as [string, string, string];
    const slider = element("input", {type: "range", min, max, step});
    slider.setAttribute("aria-label", describe(row));
    slider.addEventListener("input", () => {
        given[row.name] = text.value = slider.value;
        changed();
    });
    fields[row.name]!.slider = slider;
    return element("div", {className: "row"}, label, slider, text);
}

/** Those that say how long a run is have no sense where one looks on. */
const ofTheRun = ["events", "periods"];

function layOutParameters(): void {
    const shown = rows.filter((row) => row.given && !ofTheRun.includes(row.name));
    const groups = [...new Set(shown.map((row) => row.group))];
    byId("parameters").replaceChildren(...groups.map((group, k) => element(
        "details", {open: k === 0},
        element("summary", {textContent: texts.groups[group] ?? group}),
        ...shown.filter((row) => row.group === group).map(parameterRow))));
    showFields();
}

const playButton = element("button", {type: "button", className: "main", id: "play"});
function setPlaying(on: boolean): void {
    playing = on;
    playButton.textContent = on ? texts.pause : texts.play;
    lastTick = 0;
}

const handButton = button(texts.hand, () => {
    if (byHand) return begin();
    if (!last) return;
    view = "lab";
    (byId(`choose-${texts.view}`) as HTMLSelectElement).value = view;
    hasHistory = true;
    turned = 0;
    pointer = [last.frame[3]!, last.frame[4]!];
    setByHand(true);
    layOutViews();
    setPlaying(true);
}, "by-hand");
function setByHand(on: boolean): void {
    byHand = on;
    handButton.textContent = on ? texts.handEnds : texts.hand;
    handButton.setAttribute("aria-pressed", String(on));
    document.body.classList.toggle("by-hand", on);
}

const backwardsButton = button(texts.backwards, () => tell({kind: "reverse"}), "backwards");
backwardsButton.title = texts.backwardsHow;
function setBackwards(on: boolean): void {
    backwards = on;
    backwardsButton.textContent = on ? texts.forwards : texts.backwards;
    backwardsButton.setAttribute("aria-pressed", String(on));
}
function allowBackwards(): void {
    backwardsButton.disabled = !nothingRubs();
}

const recording = new Recording(() => canvases.lab ?? canvases.m);

const besideButton = button(texts.beside, () => {
    const given = asked();
    const name = [counted(Number(configuration["discs"])),
                  ...Object.entries(given).filter(([key]) => key !== "discs")
                      .map(([key, value]) => `${key} ${value}`)].join(", ");
    beside = new Beside(new EngineWorker(), engine, given, name, () => {
        beside = undefined;
        besideButton.disabled = false;
        layOutViews();
    });
    besideButton.disabled = true;
    layOutViews();
}, "keep-beside");

function choice<Value extends string>(name: string, options: Record<Value, string>, value: Value,
                                      set: (value: Value) => void): HTMLElement {
    const select = element("select", {id: `choose-${name}`}, ...Object.entries<string>(options).map(
        ([each, text]) => element("option", {value: each, textContent: text})));
    select.value = value;
    select.addEventListener("change", () => set(select.value as Value));
    return element("label", {}, `${name} `, select);
}

function sayColors(): void {
    byId("colors").textContent = texts.colorMeans[coloring];
}

function layOutBar(): void {
    sayColors();
    playButton.addEventListener("click", () => setPlaying(!playing));
    const speed = element("input", {type: "range", min: "-3", max: "1", step: "0.1",
                                    value: String(Math.log10(swirlsPerSecond)), id: "speed"});
    speed.addEventListener("input", () => { swirlsPerSecond = 10 ** Number(speed.value); });
    const trailBox = element("input", {type: "checkbox", id: "trails"});
    trailBox.addEventListener("change", () => { trails = trailBox.checked; redraw(); });
    const forcesBox = element("input", {type: "checkbox", id: "forces"});
    forcesBox.addEventListener("change", () => { forces = forcesBox.checked; redraw(); });
    const keepBox = element("input", {type: "checkbox", id: "keep"});
    keepBox.addEventListener("change", () => { keepDiscs = keepBox.checked; });
    const preset = element("select", {id: "choose-preset"}, element("option", {textContent: "…"}),
        ...presets.map(({name}) => element("option", {textContent: name})));
    preset.addEventListener("change", () => {
        const chosen = presets[preset.selectedIndex - 1];
        if (!chosen) return;
        setGiven(chosen.given);
        changed();
    });
    byId("bar").replaceChildren(
        playButton,
        button(texts.step, () => { setPlaying(false); tell({kind: "step"}); }, "step"),
        button(texts.restart, () => begin(), "restart"),
        element("label", {}, `${texts.presets} `, preset),
        choice(texts.view, texts.views, view, (value) => { view = value; layOutViews(); }),
        choice(texts.color, texts.colors, coloring, (value) => { coloring = value; sayColors(); redraw(); }),
        element("label", {}, trailBox, ` ${texts.trails}`),
        element("label", {title: texts.forcesHow}, forcesBox, ` ${texts.forces}`),
        element("label", {title: texts.keepHow}, keepBox, ` ${texts.keep}`),
        handButton, backwardsButton, besideButton,
        element("label", {}, `${texts.speed} `, speed),
        recording.panel,
        button(texts.picture, () => {
            const canvas = canvases.lab ?? canvases.m;
            if (canvas) save("swirl.png", {href: canvas.toDataURL("image/png")});
        }, "save-picture"),
        button(texts.table, () => {
            save("rotation.csv", {text: tableOf(averages), type: "text/csv"});
        }, "save-table"),
        button(texts.result, () => tell({kind: "result"}), "save-result"));
    setPlaying(playing);
}

function layOutLesson(): void {
    const show = (): void => {
        const at = lesson[step];
        if (!at) {
            const start = element("button", {type: "button", textContent: texts.lesson, id: "lesson-start"});
            start.addEventListener("click", () => go(0));
            byId("lesson").replaceChildren(start);
            return;
        }
        const move = (text: string, to: number): HTMLElement => {
            const made = element("button", {type: "button", textContent: text});
            made.addEventListener("click", () => go(to));
            return made;
        };
        byId("lesson").replaceChildren(element("div", {className: "lesson"},
            element("h2", {textContent: `${step + 1}. ${at.title}`}),
            element("p", {textContent: at.text}), move(texts.back, step - 1), " ",
            move(step + 1 < lesson.length ? texts.next : "×", step + 1)));
    };
    const go = (to: number): void => {
        step = to < lesson.length ? to : -1;
        const at = lesson[step];
        if (at) {
            setGiven(at.given);
            view = at.view;
            (byId(`choose-${texts.view}`) as HTMLSelectElement).value = view;
            layOutViews();
            changed();
            if (!lessMotion.matches) setPlaying(true);
        }
        show();
    };
    show();
}

copyButton.addEventListener("click", () => {
    void navigator.clipboard.writeText(byId("command").textContent ?? "").then(() => {
        copyButton.textContent = texts.copied;
    });
});
offerCommand();

document.addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    if (["INPUT", "SELECT", "BUTTON", "TEXTAREA"].includes(target.tagName)) return;
    if (event.key === " ") {
        event.preventDefault();
        setPlaying(!playing);
    } else if (event.key === ".") {
        setPlaying(false);
        tell({kind: "step"});
    }
});

// --- from the worker --------------------------------------------------------------------------

function received(frame: Frame): void {
    waiting = false;
    if (last && last.frame.length === frame.frame.length) {
        turned += turnBetween(last.frame, frame.frame);
        history.push(last.frame);
        if (history.length > trailLength) history.shift();
    }
    const hadRun = last === undefined && runTo > 0;
    last = frame;
    redraw();
    recording.add(frame.frame);
    if (frame.rotation) showRotation(frame.rotation);
    byId("event-count").textContent = String(frame.events);
    byId("state-hash").textContent = frame.hash;
    offerCommand(frame.command);
    if (maps.open && performance.now() - lastMaps > betweenMaps) askForMaps();
    if (hadRun) {
        runTo = 0;
        setPlaying(false);
    }
}

/** What the address asks for; false if it cannot be. */
function readAddress(): boolean {
    const query = new URLSearchParams(location.search);
    const wanted: Record<string, string> = {};
    for (const [key, value] of query) {
        const name = key.replaceAll("-", "_");
        if (name === "events") {
            runTo = Number(value);
            if (Number.isInteger(runTo) && runTo >= 0 && runTo <= 1e7) continue;
            runTo = 0;
            refuse(texts.badEvents(value));
            return false;
        }
        if (!rows.some((row) => row.name === name && row.given)) {
            refuse(texts.unknownName(key));
            return false;
        }
        wanted[name] = value;
    }
    setGiven(wanted);
    return true;
}

worker.onmessage = ({data}: MessageEvent<FromWorker>): void => {
    switch (data.kind) {
        case "ready":
            rows = data.parameters;
            layOutParameters();
            layOutBar();
            layOutLesson();
            layOutViews();
            if (readAddress()) begin(runTo);
            requestAnimationFrame(animate);
            break;
        case "begun":
            configuration = data.configuration;
            showFields();
            allowBackwards();
            break;
        case "changed":
            if (!data.kept) {
                begin();
                break;
            }
            configuration = data.configuration;
            showFields();
            startAnew();
            allowBackwards();
            break;
        case "reversed":
            if (!data.done) break;
            startAnew();
            setBackwards(!backwards);
            break;
        case "result":
            save("result.json", {text: JSON.stringify(JSON.parse(data.text), null, 2) + "\n",
                                 type: "application/json"});
            break;
        case "maps":
            maps.show(data);
            break;
        case "unsupported":
            refuse(texts.noWebAssembly);
            break;
        case "refused":
            waiting = false;
            runTo = 0;
            refuse(data.sentence);
            break;
        case "progress":
            byId("headline").textContent = texts.running(data.done, data.all);
            break;
        case "frame":
            received(data);
            break;
    }
};

function animate(now: number): void {
    requestAnimationFrame(animate);
    const still = dragged !== undefined || held !== undefined;
    if (still) lastTick = 0;
    if (!playing || waiting || !last || still) return;
    // After a pause, or a while in the background, time goes on from here.
    const elapsed = lastTick > 0 ? Math.min(now - lastTick, 100) : 0;
    lastTick = now;
    const swirls = elapsed / 1000 * swirlsPerSecond;
    waiting = true;
    if (beside) {
        beside.coloring = coloring;
        beside.tick(swirls);
    }
    if (byHand && pointer) steerTo(pointer, last.frame, swirls);
    else tell({kind: "tick", swirls});
}

/** Straight to where the pointer is, or as far as the hand may go: four times as fast as the dish is
 *  swirled, and not out of the picture. */
function steerTo([x, y]: [number, number], frame: Float64Array, swirls: number): void {
    const period = Number(configuration["period"]), amplitude = Number(configuration["amplitude"]);
    const duration = Math.max(swirls, 1e-4) * period;
    const [fromX, fromY] = [frame[3]!, frame[4]!];
    const outside = Math.max(1, Math.hypot(x, y) / room());
    const [dx, dy] = [x / outside - fromX, y / outside - fromY];
    const usual = 2 * Math.PI * (amplitude || 0.2 * Number(configuration["container_radius"])) / period;
    const share = Math.min(1, 4 * usual * duration / (Math.hypot(dx, dy) || 1));
    tell({kind: "steer", x: fromX + share * dx, y: fromY + share * dy, duration});
}

function resize(): void {
    byId("plot").hidden = blocksShown() < 2;
    plot.setSize({width: byId("plot").clientWidth || 400, height: 190});
    redraw();
}
addEventListener("resize", resize);
resize();

/** It stands in the page packed, a third of its size. */
async function unpacked(url: string): Promise<ArrayBuffer> {
    const packed = (await fetch(url)).body;
    if (!packed) throw new Error("empty");
    return new Response(packed.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}
const engine = unpacked(engineUrl);
engine.then((bytes) => tell({kind: "engine", bytes}), () => refuse(texts.noWebAssembly));

// --- maps, and the paper's figure by oneself --------------------------------------------------

const betweenMaps = 1000; // milliseconds
let lastMaps = 0;
function askForMaps(): void {
    if (byHand) return;
    lastMaps = performance.now();
    tell({kind: "maps"});
}
const maps = new MapsPanel(askForMaps);
const study = new Study(() => {
    const one = new EngineWorker();
    void engine.then((bytes) => one.postMessage({kind: "engine", bytes} satisfies ToWorker));
    return one;
}, () => {
    const {discs: _, mu: __, mu_disc: ___, mu_wall: ____, ...others} = asked();
    return others;
});
byId("panels").replaceChildren(maps.panel, study.panel);
