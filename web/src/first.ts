// The first page: one dish, the row of beads, and four touches. Everything else is in the
// Laboratory, the second page.
import "./first.css";
import engineUrl from "../generated/dish.wasm.gz?url";
import EngineWorker from "./engine/worker?worker&inline";
import {byId, dark, localized} from "./elements/page";
import {paletteOf} from "./drawing/palette";
import {DishRun} from "./first/dish";
import {Measured, settled, type Values} from "./first/points";
import {drawRow, fewest, most, numberAt, placeOf} from "./first/row";
import {Stage} from "./first/stage";
import {words, type Way} from "./first/words";
import {isEmbedded, language, startParameters} from "./texts/start";
import {fill} from "./texts/worker_texts";

const pace = 2; // periods per second
const ridePace = 0.7; // slow enough to see who spins
const shown = 5000; // milliseconds between the numbers of a page that nobody has touched
const settling = 80; // milliseconds between the last input and its effect
const reach = 2.4; // largest distance by hand, in radii of a disc
const tap = 6; // pixels; a longer way of the pointer stirs
const stillTurns = 30; // periods that a page without motion shows

/** The parameters that this page can set: index.html has the list, for swirl.lab() and for links. */
const ofThisPage = document
    .querySelector<HTMLMetaElement>("[name=swirl-parameters]")!
    .content.split(" ");
const touches = ["rim", "discs", "hold", "ride"] as const;
type Touch = (typeof touches)[number];

const moves = !matchMedia("(prefers-reduced-motion: reduce)").matches;
const unpacked = fetch(engineUrl).then((answer) =>
    new Response(answer.body!.pipeThrough(new DecompressionStream("gzip"))).arrayBuffer(),
);
function newWorker(): Worker {
    const made = new EngineWorker({name: language});
    void unpacked.then((bytes) => made.postMessage({kind: "engine", bytes}));
    return made;
}

const [canvas, row] = [byId("dish"), byId("row")] as HTMLCanvasElement[] as [
    HTMLCanvasElement,
    HTMLCanvasElement,
];
const dish = new DishRun(newWorker()),
    measured = new Measured(newWorker()),
    stage = new Stage(canvas, moves);
const on = new Set<Touch>();
let n = 8;
let given: Values = {}; // the address has them
let isPlaying = moves;
let isTouched = false;
let pointer: [number, number] | undefined; // the dish is moved there by hand
let later: ReturnType<typeof setTimeout> | undefined;

/** The parameters of the dish on the page. */
function values(): Values {
    const {mu, ...others} = given,
        made: Values = {...others, discs: String(n)};
    const of = (name: "mu_disc" | "mu_wall", index: number): string =>
        given[name] ?? mu?.split(":").at(index) ?? "";
    for (const [name, touch, index] of [
        ["mu_disc", "discs", 0],
        ["mu_wall", "rim", -1],
    ] as const) {
        const value = on.has(touch) ? "0" : of(name, index);
        if (value) made[name] = value;
        else delete made[name];
    }
    if (on.has("hold")) made["cannot_spin"] = "1";
    else delete made["cannot_spin"];
    return made;
}
const surface = (): string =>
    [...on]
        .filter((touch) => touch !== "ride")
        .sort()
        .join();

/** The direction of the present number of discs, as far as it is measured. */
const way = (): Way | undefined => measured.of(surface()).points.get(n)?.way;

const mark = "\n"; // the place of the coloured words
/** Writes a sentence in which the direction is in its colour. */
function say(): void {
    const found = way();
    let text = fill(words.discs, {n});
    if (dish.isByHand) {
        const {turns} = dish,
            sign = turns < 0 ? "−" : "+";
        text = fill(words.byHand, {turns: localized(sign + Math.abs(turns).toFixed(1))});
    } else if (found === "still") text = fill(words.still, {n});
    else if (found) text = fill(words.turn, {n, way: mark});
    const [before, after] = text.split(mark) as [string, string?];
    const sentence = byId("sentence"),
        key = text + (found ?? "");
    if (sentence.dataset["said"] === key) return;
    sentence.dataset["said"] = key;
    sentence.replaceChildren(before);
    if (after === undefined || !found || found === "still") return;
    const colored = document.createElement("b");
    colored.className = found;
    colored.textContent = words.ways[found];
    sentence.append(colored, after);
}

function describe(): void {
    const found = way();
    row.setAttribute("aria-valuenow", String(n));
    row.setAttribute(
        "aria-valuetext",
        fill(words.discs, {n}) + (found ? `, ${words.ways[found]}` : ""),
    );
    const {reversal} = measured.of(surface());
    byId("reversal").textContent = reversal
        ? fill(words.reversal, {from: reversal[0], to: reversal[1]})
        : "";
    if (reversal)
        placeBelowRow(byId("reversal"), (placeAt(reversal[0]) + placeAt(reversal[1])) / 2);
}
/** The place of a number on the page. */
const placeAt = (number: number): number => row.offsetLeft + placeOf(number, row.clientWidth);
/** Centres a text at a place, as far as the window is wide enough. */
function placeBelowRow(text: HTMLElement, middle: number): void {
    const most = document.documentElement.clientWidth - text.offsetWidth - 8;
    text.style.marginLeft = `${Math.max(8, Math.min(most, middle - text.offsetWidth / 2))}px`;
}

function draw(): void {
    const palette = paletteOf(dark()),
        {last} = dish;
    if (last) {
        byId("first")?.setAttribute("hidden", "");
        stage.draw({
            frame: last.frame,
            sectors: dish.paint.sectors,
            turns: dish.turns,
            amplitude: dish.amplitude,
            oilsRim: on.has("rim"),
            oilsDiscs: on.has("discs"),
            holdsSpins: on.has("hold"),
            isByHand: dish.isByHand,
            isPaused: !isPlaying && !dish.isByHand,
            palette,
        });
    }
    const here = surface();
    drawRow(row, {
        n,
        measured: measured.of(here),
        others: measured.surfaces.filter((each) => each !== here).map((each) => measured.of(each)),
        palette,
    });
    say();
    describe();
}

let isAsked = false; // an animation frame is asked for
let lastTick = 0;
/** Draws now and as long as something moves; a hidden or paused page asks for no images. */
function animate(): void {
    if (isAsked || document.hidden) return;
    isAsked = true;
    requestAnimationFrame((now) => {
        isAsked = false;
        const elapsed = Math.min(60, now - (lastTick || now)) / 1000;
        lastTick = now;
        if (dish.isByHand || pointer) {
            if (pointer) dish.steer(pointer, elapsed, reach);
        } else if (isPlaying) dish.tick(elapsed * (on.has("ride") ? ridePace : pace));
        draw();
        if (isPlaying || pointer || stage.isMoving) animate();
        else lastTick = 0;
    });
}

/** The address of this state, with which it can be shared. */
function address(): string {
    const query = new URLSearchParams(location.search);
    for (const name of ofThisPage) query.delete(name);
    for (const [name, value] of Object.entries(values())) query.set(name, value);
    return `?${query}`;
}

function follow(): void {
    for (const touch of touches) byId(touch).setAttribute("aria-pressed", String(on.has(touch)));
    const laboratory = byId("laboratory") as HTMLAnchorElement;
    laboratory.href = laboratory.pathname.replace(/^.*\//, "") + (isTouched ? address() : "");
    try {
        if (isTouched) history.replaceState(null, "", address());
    } catch {
        // In some browsers the address of a local file cannot be changed.
    }
}

/** The same discs continue with the values on the page, which are measured, too. */
function change(): void {
    follow();
    describe();
    animate();
    clearTimeout(later);
    later = setTimeout(() => {
        dish.change(values());
        measured.want(surface(), n, values());
        if (!moves) dish.skip(stillTurns);
    }, settling);
}

function setNumber(wanted: number): void {
    const next = Math.max(fewest, Math.min(most, wanted));
    if (next === n) return;
    n = next;
    change();
}

function setPlaying(plays: boolean): void {
    isPlaying = plays;
    animate();
}

// The row of beads is a slider.
const pressedAt = (event: PointerEvent): void => {
    isTouched = true;
    const {left, width} = row.getBoundingClientRect();
    setNumber(numberAt(event.clientX - left, width));
};
row.addEventListener("pointerdown", (event) => {
    row.setPointerCapture(event.pointerId);
    pressedAt(event);
});
row.addEventListener("pointermove", (event) => {
    if (event.buttons > 0) pressedAt(event);
});
const steps: Record<string, number> = {
    ArrowLeft: -1,
    ArrowDown: -1,
    ArrowRight: 1,
    ArrowUp: 1,
    PageDown: -5,
    PageUp: 5,
    Home: -most,
    End: most,
};
row.addEventListener("keydown", (event) => {
    const step = steps[event.key];
    if (step === undefined) return;
    event.preventDefault();
    isTouched = true;
    setNumber(n + step);
});

for (const touch of touches)
    byId(touch).addEventListener("click", () => {
        isTouched = true;
        if (!on.delete(touch)) on.add(touch);
        if (touch !== "ride") return change();
        followRide();
        animate();
    });
/** The camera rides if that is chosen. */
function followRide(): void {
    stage.rides = on.has("ride");
    dish.showContacts(stage.rides);
    follow();
}

// Dragging the dish stirs it; a tap stops time, or lets it go on.
let pressed: {x: number; y: number} | undefined;
const endRide = (): void => {
    if (on.delete("ride")) followRide();
};
canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pressed = {x: event.clientX, y: event.clientY};
});
canvas.addEventListener("pointermove", (event) => {
    if (!pressed || event.buttons === 0) return;
    if (!pointer && Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) < tap) return;
    if (!pointer) endRide();
    isTouched = true;
    pointer = stage.pointAt(event);
    animate();
});
const release = (): void => {
    pressed = undefined;
    if (!pointer) return;
    pointer = undefined;
    dish.begin(values());
    setPlaying(moves);
};
canvas.addEventListener("pointerup", () => {
    if (!pointer && pressed) setPlaying(!isPlaying);
    release();
});
canvas.addEventListener("pointercancel", release);
const directions: Record<string, [number, number]> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, 1],
    ArrowDown: [0, -1],
};
canvas.addEventListener("keydown", (event) => {
    const to = directions[event.key];
    if (event.key === " ") {
        event.preventDefault();
        setPlaying(!isPlaying);
    } else if (event.key === "Escape") release();
    else if (to) {
        event.preventDefault();
        if (!pointer) endRide();
        isTouched = true;
        pointer = [reach * to[0], reach * to[1]];
        animate();
    }
});
canvas.addEventListener("blur", release);

dish.framed = (): void => {
    if (stage.rides && dish.last) stage.pressed.add(dish.last.contacts, dish.last.frame[10]!);
    animate();
};
measured.changed = animate;
dish.failed = (message): void => {
    byId("sentence").textContent = message || words.noEngine;
};
dish.ready = (): void => {
    const entries = startParameters(dish.isKnown);
    given = Object.fromEntries(entries.filter(([name]) => ofThisPage.includes(name)));
    isTouched = entries.length > 0;
    const asked = Number(given["discs"]);
    if (Number.isInteger(asked) && asked >= fewest && asked <= most) n = asked;
    if (Number(given["mu_wall"] || 1) === 0) on.add("rim");
    if (Number(given["mu_disc"] || 1) === 0) on.add("discs");
    if (Number(given["cannot_spin"]) === 1) on.add("hold");
    for (const name of ["mu_wall", "mu_disc"]) if (Number(given[name]) === 0) delete given[name];
    given["seed"] ??= String(1 + Math.floor(1e6 * Math.random()));
    follow();
    dish.begin(values(), moves ? settled : settled + stillTurns);
    measured.want(surface(), n, values());
    if (isTouched) return;
    for (const each of untouched) measured.want("", each, {...values(), discs: String(each)});
    setInterval(() => {
        if (isTouched || !isPlaying || document.hidden) return;
        setNumber(untouched[(untouched.indexOf(n) + 1) % untouched.length]!);
    }, shown);
};
const untouched = [8, 48]; // numbers that the page shows by itself

for (const touch of touches) byId(touch).querySelector("span")!.textContent = words.touches[touch];
byId("laboratory").textContent = words.laboratory;
row.setAttribute("aria-label", words.number);
row.setAttribute("aria-valuemin", String(fewest));
row.setAttribute("aria-valuemax", String(most));
canvas.setAttribute("aria-label", words.dish);
byId("touches").setAttribute("aria-label", words.touchesLabel);
document.documentElement.lang = language;
document.title = words.title;
document.body.classList.toggle("embedded", isEmbedded());
if (location.protocol === "about:") byId("laboratory").hidden = true; // a frame in a notebook
new ResizeObserver(animate).observe(canvas);
document.addEventListener("visibilitychange", animate);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", animate);
say();
animate();
