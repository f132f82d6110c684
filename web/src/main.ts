// The page: controls and views. The simulation itself runs in the worker.
import "./style.css";
import "uplot/dist/uPlot.min.css";
import uPlot from "uplot";
import engineUrl from "../generated/swirl.wasm.gz?url";
import EngineWorker from "./worker?worker&inline";
import type {Parameter, Rotation} from "./engine";
import type {Frame, FromWorker, ToWorker} from "./messages";
import {ComparedContainer} from "./compared";
import {MapsPanel} from "./maps";
import {accent, byId, button, dark, element, ink, line, quiet, save, withError} from "./page";
import {Recording} from "./recording";
import {meansOf, periodsOf, tableOf} from "./series";
import {discAt, discOf, draw, pointedAt, recent, clusterTurnsBetween, type Coloring, type View} from "./scene";
import {Study} from "./study";
import {lesson, presets, symbols, texts} from "./texts";

const trailLength = 45; // frames, at most
const trailPeriods = 0.3; // at most, as in `swirl movie`
const settling = 350; // milliseconds between the last input and its effect

// --- state ------------------------------------------------------------------------------------

let rows: Parameter[] = [];
let given: Record<string, string> = {};
let configuration: Record<string, string> = {};
let runTo = 0; // number of events, from the page's address
const reducedMotion = matchMedia("(prefers-reduced-motion: reduce)");
let playing = !reducedMotion.matches;
let view: "lab" | "m" | "both" = "lab";
let coloring: Coloring = "spin";
let trails = false;
let forces = false;
let periodsPerSecond = 1;
let step = -1; // of the lesson; -1: closed
let last: Frame | undefined;
let history: Float64Array[] = [];
let waiting = false; // for the frame that answers a message
let lastTick = 0;
let keepDiscs = false; // when a parameter changes
let hasHistory = false; // the simulation was changed, so no command line reproduces it
let byHand = false;
let pointer: [number, number] | undefined; // the container's target when it is moved by hand
let clusterTurns = 0; // rotation of the cluster, in turns
let dragged: number | undefined; // the disc under the pointer
let held: number | undefined; // the disc selected by keys
let backwards = false;
let compared: ComparedContainer | undefined;

const worker = new EngineWorker();
const send = (message: ToWorker): void => worker.postMessage(message);

// --- views ------------------------------------------------------------------------------------

const canvases: Partial<Record<View, HTMLCanvasElement>> = {};

function layOutViews(): void {
    const views: View[] = view === "both" ? ["lab", "m"] : [view];
    byId("views").replaceChildren(...views.map((each) => {
        const canvas = element("canvas");
        canvas.setAttribute("role", "img");
        canvases[each] = canvas;
        if (each === "lab") {
            addPointerControl(canvas);
            addTouchControl(canvas);
            addKeyControl(canvas);
        }
        return element("figure", {}, canvas, element("figcaption", {textContent: texts.views[each]}));
    }));
    for (const each of ["lab", "m"] as const) if (!views.includes(each)) delete canvases[each];
    if (compared) byId("views").append(compared.figure);
    recording.stop();
    redraw();
}

/** The pointer moves the container in the mode "by hand", otherwise the disc under it. */
function addPointerControl(canvas: HTMLCanvasElement): void {
    canvas.title = texts.dragHelp;
    const point = (event: PointerEvent): [number, number] =>
        pointedAt(canvas, last!.frame, maxDistance(), event.clientX, event.clientY);
    canvas.addEventListener("pointerdown", (event) => {
        if (!last) return;
        if (byHand) pointer = point(event);
        else dragged = discAt(last.frame, ...point(event));
        if (dragged !== undefined) canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
        if (!last) return;
        if (byHand) pointer = point(event);
        if (dragged !== undefined) moveDisc(dragged, ...point(event));
    });
    for (const end of ["pointerup", "pointercancel"] as const)
        canvas.addEventListener(end, () => { dragged = undefined; });
}

/** A vertical touch move scrolls the page and cancels the pointer. If the touch starts on a disc,
 *  this prevents the scrolling. */
function addTouchControl(canvas: HTMLCanvasElement): void {
    canvas.addEventListener("touchstart", (event) => {
        const finger = event.touches[0];
        if (!last || byHand || !finger || event.touches.length > 1) return;
        const at = pointedAt(canvas, last.frame, maxDistance(), finger.clientX, finger.clientY);
        if (discAt(last.frame, ...at) !== undefined) event.preventDefault();
    }, {passive: false});
}

/** Moves a disc, unless the answer to an earlier message is still missing. */
function moveDisc(disc: number, x: number, y: number): void {
    if (waiting) return;
    waiting = true;
    resetAverages();
    send({kind: "drag", disc, x, y});
}

/** The keys do what the pointer does: [ and ] select a disc, arrows move it, Escape deselects it. In
 *  the mode "by hand" the arrows move the container. */
function addKeyControl(canvas: HTMLCanvasElement): void {
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
                const step = 0.1 * maxDistance();
                pointer = [x + step * way[0], y + step * way[1]];
            } else if (held !== undefined && held < discs) {
                const {x, y, radius} = discOf(last.frame, held);
                const step = (event.shiftKey ? 0.05 : 0.25) * radius;
                moveDisc(held, x + step * way[0], y + step * way[1]);
            }
        } else if ((event.key === "[" || event.key === "]") && !byHand && discs > 0) {
            const next = held === undefined ? 0 : held + (event.key === "]" ? 1 : discs - 1);
            select(next % discs);
        } else if (event.key === "Escape") {
            select(undefined);
        }
    });
    canvas.addEventListener("blur", () => select(undefined));
}

/** Time is paused while a disc is selected. */
function select(disc: number | undefined): void {
    if (disc === held) return;
    held = disc;
    if (disc !== undefined) byId("headline").textContent = texts.selected(disc + 1);
    redraw();
}

/** The discs continue, but no command line reproduces them from here on. */
function resetAverages(): void {
    hasHistory = true;
    history = [];
    clearAverages();
    clusterTurns = 0;
}

/** The largest distance of the container's centre from S; by hand, twice the amplitude. */
function maxDistance(): number {
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
                                  room: maxDistance(), clusterTurns, held});
        compared?.redraw();
        const label = texts.container(counted(last.frame[10] ?? 0), texts.views[each]);
        if (canvas.getAttribute("aria-label") !== label) canvas.setAttribute("aria-label", label);
    }
}

// --- numbers and plot -------------------------------------------------------------------------

const plot = new uPlot({
    width: 400, height: 190,
    scales: {x: {time: false}},
    axes: [{label: texts.periods, stroke: ink, grid: {stroke: line}},
           {label: symbols.rigidRotation, stroke: ink, grid: {stroke: line}}],
    series: [{label: texts.periods}, {label: symbols.rigidRotation, stroke: quiet, width: 1},
             {label: texts.mean, stroke: accent, width: 2}],
    legend: {show: false},
}, [[], [], []], byId("plot"));

/** "48 discs", "1 sphere": the number with the particles of this configuration. */
function counted(n: number, {preset, body} = configuration): string {
    const sphere = body === "sphere" || (preset === "experiment" && !body);
    return texts.counted(n, texts.bodies[sphere ? "sphere" : "disc"]);
}

/** Which way the cluster rotates. */
function headlineOf(rotation: Rotation): string {
    if (byHand) return texts.byHandHeadline(clusterTurns.toFixed(2).replace("-", "−"));
    const discs = Number(configuration["discs"]);
    const {mean, error} = rotation.by_time;
    if (mean === null || error === null || Math.abs(mean) < 2 * error) return texts.undecided(counted(discs));
    return (mean > 0 ? texts.rotates : texts.counterrotates)(discs, counted(discs));
}

let averages: Rotation | undefined; // as last shown
const blocksShown = (): number => averages?.blocks.length ?? 0;

function clearAverages(): void {
    averages = undefined;
    plot.setData([[], [], []]);
}

/** No contact and no floor dissipates energy. */
function conservesEnergy(): boolean {
    const {mu_disc, mu_wall, restitution, floor} = configuration;
    return Number(mu_disc) === 0 && Number(mu_wall) === 0 && Number(restitution) === 1 &&
        (floor ?? "none") === "none";
}

/** A warning about the averages; empty if there is none. */
function caution(): string {
    const {amplitude, path} = configuration;
    const energyGrows = conservesEnergy() && Number(amplitude) > 0 && path !== "circle";
    return energyGrows && !byHand ? texts.grows : "";
}

function showRotation(rotation: Rotation): void {
    const time = last?.frame[0] ?? 0;
    const pairs: [string, string][] = [
        [texts.byTime, withError(rotation.by_time.mean, rotation.by_time.error, texts.notYet)],
        [texts.byEvent, withError(rotation.by_event.mean, rotation.by_event.error, texts.notYet)],
        [texts.periods, (time / Number(configuration["period"])).toFixed(1)],
        [texts.clusterRotation, texts.turns(clusterTurns.toFixed(2).replace("-", "−"))],
    ];
    if (byHand) pairs.splice(0, 3); // no period, so no averages
    const early = rotation.by_time.blocks === 0 && !byHand ? texts.warmup(rotation.warmup) : "";
    byId("numbers").replaceChildren(element("dl", {id: "estimates"}, ...pairs.flatMap(
        ([name, value]) => [element("dt", {textContent: name}), element("dd", {textContent: value})])),
        element("p", {textContent: early}), element("p", {id: "caution", textContent: caution()}));
    const headline = headlineOf(rotation);
    if (byId("headline").textContent !== headline) byId("headline").textContent = headline;
    const before = blocksShown();
    averages = rotation;
    if (blocksShown() === before) return;
    if (byId("plot").hidden !== blocksShown() < 2) resize();
    plot.setData([periodsOf(rotation), rotation.blocks, meansOf(rotation)]);
}

// --- starting a simulation --------------------------------------------------------------------

const copyButton = byId("copy") as HTMLButtonElement;

/** Without a running simulation there is no command. */
function offerCommand(command = ""): void {
    byId("command").textContent = hasHistory ? texts.noCommand : command;
    copyButton.disabled = hasHistory || command === "";
}

function address(): string {
    const query = new URLSearchParams(Object.entries(given).filter(([, value]) => value !== ""));
    const text = query.toString();
    return text ? `?${text}` : location.pathname;
}

const manyDiscs = 1000; // placing more discs takes a noticeable time

function begin(events = 0): void {
    history = [];
    clearAverages();
    last = undefined;
    waiting = true;
    hasHistory = false;
    setByHand(false);
    setBackwards(false);
    recording.stop();
    clusterTurns = 0;
    const discs = Number(given["discs"]);
    byId("headline").textContent = discs >= manyDiscs ? texts.placing(counted(discs, givenValues())) : "…";
    byId("error").hidden = true;
    for (const ofState of ["event-count", "state-hash"]) byId(ofState).textContent = "";
    offerCommand();
    send({kind: "begin", given: givenValues(), events});
}

function givenValues(): Record<string, string> {
    return Object.fromEntries(Object.entries(given).filter(([, value]) => value !== ""));
}

let later: ReturnType<typeof setTimeout> | undefined;
function changed(): void {
    clearTimeout(later);
    later = setTimeout(() => {
        try {
            window.history.replaceState(null, "", address());
        } catch {
            // In some browsers the address of a local file cannot be changed.
        }
        // After an error there is no simulation to continue.
        if (keepDiscs && last && !byHand && byId("error").hidden)
            send({kind: "change", given: givenValues()});
        else begin();
    }, settling);
}

function showError(text: string): void {
    byId("error").textContent = text;
    byId("error").hidden = false;
    offerCommand();
    setPlaying(false);
}

// --- controls ---------------------------------------------------------------------------------

/** The inputs of a parameter: a text or a choice of words, and an optional slider. */
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
    const value = given[name] ?? "", holds = effectiveValue(name);
    const isChoice = field.text instanceof HTMLSelectElement;
    if (field.text instanceof HTMLInputElement) field.text.placeholder = holds;
    const text = isChoice ? value || holds : value;
    if (field.text.value.trim() !== text) field.text.value = text; // unless it is being typed
    if (field.slider) field.slider.value = value || holds || field.slider.value;
}

/** The value in effect if none is given: the preset's, or the default. */
function effectiveValue(name: string): string {
    const {mu_disc, mu_wall, [name]: configured} = configuration;
    const both = name === "mu" && mu_disc === mu_wall ? mu_disc : undefined;
    return configured ?? both ?? rows.find((row) => row.name === name)?.default ?? "";
}

function showFields(): void {
    for (const [name, field] of Object.entries(fields)) showField(name, field);
}

const describe = ({name, description}: Parameter): string => texts.descriptions[name] ?? description;

/** The words among the values of a parameter, from its form: "none|sliding", "NUMBER|paper|solid". */
const wordsOf = ({form}: Parameter): string[] => form.split("|").filter((word) => /^[a-z]+$/.test(word));

/** A list of choices if all values are words; a text field with suggestions if numbers are allowed, too. */
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
        if (fields[row.name]?.slider) fields[row.name]!.slider!.value = text.value || effectiveValue(row.name);
        changed();
    });
    fields[row.name] = {text};
    if (!row.slider) {
        text.className = "wide";
        return element("div", {className: "row"}, label, text, ...proposed);
    }
    const [min, max, step] = row.slider.map(String) as [string, string, string];
    const slider = element("input", {type: "range", min, max, step});
    slider.setAttribute("aria-label", describe(row));
    slider.addEventListener("input", () => {
        given[row.name] = text.value = slider.value;
        changed();
    });
    fields[row.name]!.slider = slider;
    return element("div", {className: "row"}, label, slider, text);
}

/** The length of a run has no meaning on the page. */
const lengthParameters = ["events", "periods"];

function buildParameters(): void {
    const shown = rows.filter((row) => row.settable && !lengthParameters.includes(row.name));
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

const byHandButton = button(texts.hand, () => {
    if (byHand) return begin();
    if (!last) return;
    view = "lab";
    (byId(`choose-${texts.view}`) as HTMLSelectElement).value = view;
    hasHistory = true;
    clusterTurns = 0;
    pointer = [last.frame[3]!, last.frame[4]!];
    setByHand(true);
    layOutViews();
    setPlaying(true);
}, "by-hand");
function setByHand(on: boolean): void {
    byHand = on;
    byHandButton.textContent = on ? texts.byHandStop : texts.hand;
    byHandButton.setAttribute("aria-pressed", String(on));
    document.body.classList.toggle("by-hand", on);
}

const backwardsButton = button(texts.backwards, () => send({kind: "reverse"}), "backwards");
backwardsButton.title = texts.backwardsHelp;
function setBackwards(on: boolean): void {
    backwards = on;
    backwardsButton.textContent = on ? texts.forwards : texts.backwards;
    backwardsButton.setAttribute("aria-pressed", String(on));
}
function allowBackwards(): void {
    backwardsButton.disabled = !conservesEnergy();
}

const recording = new Recording(() => canvases.lab ?? canvases.m);

const compareButton = button(texts.compare, () => {
    const given = givenValues();
    const name = [counted(Number(configuration["discs"])),
                  ...Object.entries(given).filter(([key]) => key !== "discs")
                      .map(([key, value]) => `${key} ${value}`)].join(", ");
    compared = new ComparedContainer(new EngineWorker(), engine, given, name, () => {
        compared = undefined;
        compareButton.disabled = false;
        layOutViews();
    });
    compareButton.disabled = true;
    layOutViews();
}, "compare");
compareButton.title = texts.compareHelp;

function choice<Value extends string>(name: string, options: Record<Value, string>, value: Value,
                                      set: (value: Value) => void): HTMLElement {
    const select = element("select", {id: `choose-${name}`}, ...Object.entries<string>(options).map(
        ([each, text]) => element("option", {value: each, textContent: text})));
    select.value = value;
    select.addEventListener("change", () => set(select.value as Value));
    return element("label", {}, `${name} `, select);
}

function showColorKey(): void {
    byId("colors").textContent = texts.colorKey[coloring];
}

function buildBar(): void {
    showColorKey();
    playButton.addEventListener("click", () => setPlaying(!playing));
    const speed = element("input", {type: "range", min: "-3", max: "1", step: "0.1",
                                    value: String(Math.log10(periodsPerSecond)), id: "speed"});
    speed.addEventListener("input", () => { periodsPerSecond = 10 ** Number(speed.value); });
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
        button(texts.step, () => { setPlaying(false); send({kind: "step"}); }, "step"),
        button(texts.restart, () => begin(), "restart"),
        element("label", {}, `${texts.presets} `, preset),
        choice(texts.view, texts.views, view, (value) => { view = value; layOutViews(); }),
        choice(texts.color, texts.colors, coloring, (value) => { coloring = value; showColorKey(); redraw(); }),
        element("label", {}, trailBox, ` ${texts.trails}`),
        element("label", {title: texts.forcesHelp}, forcesBox, ` ${texts.forces}`),
        element("label", {title: texts.keepHelp}, keepBox, ` ${texts.keep}`),
        byHandButton, backwardsButton, compareButton,
        element("label", {}, `${texts.speed} `, speed),
        recording.panel,
        button(texts.image, () => {
            const canvas = canvases.lab ?? canvases.m;
            if (canvas) save("swirl.png", {href: canvas.toDataURL("image/png")});
        }, "save-image"),
        button(texts.table, () => {
            save("rotation.csv", {text: tableOf(averages), type: "text/csv"});
        }, "save-table"),
        button(texts.result, () => send({kind: "result"}), "save-result"));
    setPlaying(playing);
}

function buildLesson(): void {
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
            if (!reducedMotion.matches) setPlaying(true);
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
        send({kind: "step"});
    }
});

// --- from the worker --------------------------------------------------------------------------

function received(frame: Frame): void {
    waiting = false;
    if (last && last.frame.length === frame.frame.length) {
        clusterTurns += clusterTurnsBetween(last.frame, frame.frame);
        history.push(last.frame);
        if (history.length > trailLength) history.shift();
    }
    const ranToEvent = last === undefined && runTo > 0;
    last = frame;
    redraw();
    recording.add(frame.frame);
    if (frame.rotation) showRotation(frame.rotation);
    byId("event-count").textContent = String(frame.events);
    byId("state-hash").textContent = frame.hash;
    offerCommand(frame.command);
    if (maps.open && performance.now() - lastMaps > mapsInterval) requestMaps();
    if (ranToEvent) {
        runTo = 0;
        setPlaying(false);
    }
}

/** Applies the page's address; false if it is not valid. */
function readAddress(): boolean {
    const query = new URLSearchParams(location.search);
    const wanted: Record<string, string> = {};
    for (const [key, value] of query) {
        const name = key.replaceAll("-", "_");
        if (name === "events") {
            runTo = Number(value);
            if (Number.isInteger(runTo) && runTo >= 0 && runTo <= 1e7) continue;
            runTo = 0;
            showError(texts.invalidEvents(value));
            return false;
        }
        if (!rows.some((row) => row.name === name && row.settable)) {
            showError(texts.unknownParameter(key));
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
            buildParameters();
            buildBar();
            buildLesson();
            layOutViews();
            if (readAddress()) begin(runTo);
            requestAnimationFrame(animate);
            break;
        case "started":
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
            resetAverages();
            allowBackwards();
            break;
        case "reversed":
            if (!data.done) break;
            resetAverages();
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
            showError(texts.noWebAssembly);
            break;
        case "rejected":
            waiting = false;
            runTo = 0;
            showError(data.message);
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
    // After a pause, or a while in the background, time continues from here.
    const elapsed = lastTick > 0 ? Math.min(now - lastTick, 100) : 0;
    lastTick = now;
    const periods = elapsed / 1000 * periodsPerSecond;
    waiting = true;
    if (compared) {
        compared.coloring = coloring;
        compared.tick(periods);
    }
    if (byHand && pointer) steerTo(pointer, last.frame, periods);
    else send({kind: "tick", periods});
}

/** Moves the container straight to the pointer, at most four times as fast as on its path, and not
 *  out of the image. */
function steerTo([x, y]: [number, number], frame: Float64Array, periods: number): void {
    const period = Number(configuration["period"]), amplitude = Number(configuration["amplitude"]);
    const duration = Math.max(periods, 1e-4) * period;
    const [fromX, fromY] = [frame[3]!, frame[4]!];
    const outside = Math.max(1, Math.hypot(x, y) / maxDistance());
    const [dx, dy] = [x / outside - fromX, y / outside - fromY];
    const usual = 2 * Math.PI * (amplitude || 0.2 * Number(configuration["container_radius"])) / period;
    const share = Math.min(1, 4 * usual * duration / (Math.hypot(dx, dy) || 1));
    send({kind: "steer", x: fromX + share * dx, y: fromY + share * dy, duration});
}

function resize(): void {
    byId("plot").hidden = blocksShown() < 2;
    plot.setSize({width: byId("plot").clientWidth || 400, height: 190});
    redraw();
}
addEventListener("resize", resize);
resize();

/** The engine is embedded in the page, compressed to a third of its size. */
async function unpacked(url: string): Promise<ArrayBuffer> {
    const packed = (await fetch(url)).body;
    if (!packed) throw new Error("empty");
    return new Response(packed.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}
const engine = unpacked(engineUrl);
engine.then((bytes) => send({kind: "engine", bytes}), () => showError(texts.noWebAssembly));

// --- maps and study ---------------------------------------------------------------------------

const mapsInterval = 1000; // milliseconds
let lastMaps = 0;
function requestMaps(): void {
    if (byHand) return;
    lastMaps = performance.now();
    send({kind: "maps"});
}
const maps = new MapsPanel(requestMaps);
const study = new Study(() => {
    const created = new EngineWorker();
    void engine.then((bytes) => created.postMessage({kind: "engine", bytes} satisfies ToWorker));
    return created;
}, () => {
    const {discs: _, mu: __, mu_disc: ___, mu_wall: ____, ...others} = givenValues();
    return others;
});
byId("panels").replaceChildren(maps.panel, study.panel);
