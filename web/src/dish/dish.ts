// The container on the page: its canvases, and what the pointer, fingers and keys do on them.
import {ComparedContainer} from "./compared";
import {Contacts} from "../drawing/contacts";
import type {Laboratory} from "../engine/laboratory";
import {layerOf, type MapKind} from "../drawing/maps";
import type {Frame, Maps} from "../engine/messages";
import {byId, dark, element, signed} from "../elements/page";
import {SectorPaint} from "../drawing/paint";
import {discAt, discOf, draw, extentOf, pointedAt} from "../drawing/scene";
import type {Coloring, View} from "../drawing/view";
import {isWholePeriod} from "../drawing/strobe";
import {fill, texts} from "../texts/texts";
import {captionOf, findingOf} from "./finding";

export type Views = View | "both" | MapKind;
const mapKinds: readonly string[] = ["density", "flow", "spin"];
const isMap = (view: Views): view is MapKind => mapKinds.includes(view);

const mapInterval = 700; // milliseconds

export class Dish {
    view: Views = "lab";
    coloring: Coloring = "sector";
    forces = false;
    private strobes = false;
    private readonly contacts = new Contacts();
    /** The same, while time runs fast to the averages. */
    isLapse = false;
    /** Whether another part of the page shows averages of the M-frame. */
    needsMaps: () => boolean = () => false;
    compared: ComparedContainer | undefined;
    /** The container's target when it is moved by hand. */
    pointer: [number, number] | undefined;
    /** Called when the way in which the page shows the containers has changed. */
    changed: () => void = () => {};
    /** Called when there is another compared container, or none. */
    comparedChanged: () => void = () => {};
    /** Called when canvases are replaced. */
    laidOut: () => void = () => {};

    private readonly canvases: Partial<Record<View, HTMLCanvasElement>> = {};
    private readonly paint = new SectorPaint();
    private maps: Maps | undefined;
    private lastMaps = 0;
    private measures = ""; // what the worker was told
    private shown: Frame | undefined; // the last image of the stroboscope
    private dragged: number | undefined; // the disc under the pointer
    private held: number | undefined; // the disc selected by keys

    constructor(
        private readonly lab: Laboratory,
        private readonly say: (text: string) => void,
    ) {
        lab.on("begin", () => this.forget());
        lab.on("changed", () => {
            this.maps = undefined;
        });
        lab.on("maps", (maps) => {
            this.maps = maps;
        });
        lab.on("frame", (frame) => this.receive(frame));
        addEventListener("resize", () => this.redraw());
        matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.redraw());
    }

    /** Shows a container with these parameters next to the first, or none. */
    compare(given?: Record<string, string>, name = "", follows = false): void {
        this.compared?.end();
        this.compared =
            given && new ComparedContainer(this.lab, given, name, follows, () => this.compare());
        document.body.classList.toggle("compares", given !== undefined);
        this.layOut();
        this.comparedChanged();
    }

    /** Time is paused while a disc is dragged or selected. */
    get holdsTime(): boolean {
        return this.dragged !== undefined || this.held !== undefined;
    }
    /** The canvas that is saved and recorded. */
    get canvas(): HTMLCanvasElement | undefined {
        return this.canvases.lab ?? this.canvases.m;
    }

    /** One image per period. */
    get strobe(): boolean {
        return this.strobes;
    }
    set strobe(on: boolean) {
        this.strobes = on;
        this.redraw();
    }

    layOut(): void {
        const views: View[] =
            this.view === "both" ? ["lab", "m"] : [isMap(this.view) ? "m" : this.view];
        byId("views").replaceChildren(
            ...views.map((each) => {
                const canvas = element("canvas");
                canvas.setAttribute("role", "img");
                this.canvases[each] = canvas;
                if (each === "lab") {
                    this.addPointerControl(canvas);
                    this.addTouchControl(canvas);
                    this.addKeyControl(canvas);
                }
                return element(
                    "figure",
                    {},
                    canvas,
                    element("figcaption", {textContent: texts.views[each]}),
                );
            }),
        );
        for (const each of ["lab", "m"] as const)
            if (!views.includes(each)) delete this.canvases[each];
        if (this.compared) {
            byId("views").prepend(this.compared.figure);
            this.addPointerControl(this.compared.canvas);
        }
        this.laidOut();
        this.redraw();
    }

    setView(view: Views): void {
        this.view = view;
        this.layOut();
    }

    /** Colours the discs by sector, as they are now. */
    repaint(): void {
        if (this.shown) this.paint.apply(this.shown.frame);
        this.redraw();
    }

    private forget(): void {
        this.measures = ""; // there may be another worker
        if (this.compared?.follows && this.compared.last) this.compared.begin();
        this.shown = this.maps = undefined;
        this.paint.sectors.length = 0;
    }

    private receive(frame: Frame): void {
        this.requestMaps();
        this.show(frame);
    }

    private show(frame: Frame): void {
        const before = this.shown?.frame;
        const stops = (this.strobe || this.isLapse) && !this.lab.isByHand;
        this.contacts.add(frame, this.lab.value("period"));
        if (stops && before && !isWholePeriod(frame.frame, this.lab.value("period"))) return;
        if (before?.length !== frame.frame.length) this.paint.extend(frame.frame);
        if (!this.isLapse && before?.[1] !== frame.frame[1] && this.paint.isMixed(frame.frame))
            this.paint.apply(frame.frame);
        this.shown = frame;
        this.redraw();
    }

    private requestMaps(): void {
        const maps = isMap(this.view) || this.needsMaps(),
            contacts = this.coloring === "contacts";
        const measures = {maps: maps || this.coloring === "pinned", contacts},
            said = JSON.stringify(measures);
        if (said !== this.measures) this.lab.send({kind: "measure", ...measures});
        this.measures = said;
        if (this.lab.isByHand || !maps || performance.now() - this.lastMaps < mapInterval) return;
        this.lastMaps = performance.now();
        this.lab.send({kind: "maps"});
    }

    private get note(): string {
        return this.isLapse
            ? texts.lapseNote
            : this.strobe && !this.lab.isByHand
              ? texts.strobeNote
              : "";
    }

    /** The distance from S to which the images reach: both have one scale. */
    private get extent(): number {
        const {lab} = this,
            {frame} = (this.shown ?? lab.last)!;
        return Math.max(extentOf(frame, lab.maxDistance()), this.compared?.extent ?? 0);
    }

    redraw(): void {
        const {lab, shown} = this;
        if (!shown) return;
        const period = lab.value("period"),
            {extent} = this;
        for (const [each, canvas] of Object.entries(this.canvases) as [View, HTMLCanvasElement][]) {
            draw(canvas, shown.frame, {
                view: each,
                coloring: this.coloring,
                sectors: this.paint.sectors,
                dark: dark(),
                omega: this.forces && !lab.isByHand ? (2 * Math.PI) / period : 0,
                extent,
                turns: shown.turns[0],
                held: this.held,
                contacts: this.contacts.recent,
                map: isMap(this.view) ? layerOf(this.view, this.maps) : undefined,
                note: this.note,
            });
            const label = fill(texts.container, {
                particles: lab.counted(shown.frame[10] ?? 0),
                view: texts.views[each],
            });
            if (canvas.getAttribute("aria-label") !== label)
                canvas.setAttribute("aria-label", label);
        }
        this.compared?.redraw({
            coloring: this.coloring,
            strobe: this.strobe,
            extent,
            isLapse: this.isLapse,
            isByHand: lab.isByHand,
        });
        this.showCaption();
    }

    /** Next to another container the caption of the first has its result. */
    private showCaption(): void {
        const {lab, shown} = this,
            caption = this.canvases.lab?.parentElement?.querySelector("figcaption"),
            name = lab.counted(shown!.frame[10]!);
        if (!caption) return;
        const text = !this.compared
            ? texts.views.lab
            : lab.isByHand
              ? `${name}: ${fill(texts.turns, {turns: signed(shown!.turns[0], 2)})}`
              : captionOf(
                    name,
                    findingOf(lab.averages, shown!.turns[0], shown!.frame[1]!),
                    this.coloring === "contacts" ? lab.cause : undefined,
                );
        if (caption.textContent !== text) caption.textContent = text;
    }

    /** Time is paused while a disc is selected. */
    private select(disc: number | undefined): void {
        if (disc === this.held) return;
        this.held = disc;
        if (disc !== undefined) this.say(fill(texts.selected, {disc: disc + 1}));
        this.redraw();
    }

    /** Moves a disc, unless the answer to an earlier message is missing. */
    private moveDisc(disc: number, x: number, y: number): void {
        if (this.lab.request({kind: "drag", disc, x, y})) this.lab.resetAverages();
    }

    /** The pointer moves the container in the mode "by hand", otherwise the disc under it. */
    private addPointerControl(canvas: HTMLCanvasElement): void {
        const {lab} = this;
        canvas.title = texts.dragHelp;
        const point = (event: PointerEvent): [number, number] =>
            pointedAt(canvas, this.extent, event.clientX, event.clientY);
        canvas.addEventListener("pointerdown", (event) => {
            if (!lab.last) return;
            if (lab.isByHand) this.pointer = point(event);
            else if (canvas === this.canvases.lab)
                this.dragged = discAt(lab.last.frame, ...point(event));
            if (this.dragged !== undefined) canvas.setPointerCapture(event.pointerId);
        });
        canvas.addEventListener("pointermove", (event) => {
            if (!lab.last) return;
            if (lab.isByHand) this.pointer = point(event);
            if (this.dragged !== undefined) this.moveDisc(this.dragged, ...point(event));
        });
        for (const end of ["pointerup", "pointercancel"] as const)
            canvas.addEventListener(end, () => {
                this.dragged = undefined;
            });
    }

    /** A vertical touch move scrolls the page and cancels the pointer. If the touch starts on a
     *  disc, this prevents the scrolling. */
    private addTouchControl(canvas: HTMLCanvasElement): void {
        canvas.addEventListener(
            "touchstart",
            (event) => {
                const finger = event.touches[0],
                    {lab} = this;
                if (!lab.last || lab.isByHand || !finger || event.touches.length > 1) return;
                const at = pointedAt(canvas, this.extent, finger.clientX, finger.clientY);
                if (discAt(lab.last.frame, ...at) !== undefined) event.preventDefault();
            },
            {passive: false},
        );
    }

    /** The keys do what the pointer does: [ and ] select a disc, arrows move it, Escape deselects
     *  it. In the mode "by hand" the arrows move the container. */
    private addKeyControl(canvas: HTMLCanvasElement): void {
        const ways: Record<string, [number, number]> = {
            ArrowLeft: [-1, 0],
            ArrowRight: [1, 0],
            ArrowUp: [0, 1],
            ArrowDown: [0, -1],
        };
        canvas.tabIndex = 0;
        canvas.setAttribute("role", "application");
        canvas.setAttribute(
            "aria-keyshortcuts",
            "[ ] ArrowLeft ArrowRight ArrowUp ArrowDown Escape",
        );
        canvas.addEventListener("keydown", (event) => {
            const {lab} = this,
                way = ways[event.key];
            if (!lab.last) return;
            const frame = lab.last.frame,
                discs = frame[10] ?? 0;
            if (way) {
                event.preventDefault();
                if (lab.isByHand) {
                    const [x, y] = this.pointer ?? [frame[3]!, frame[4]!];
                    const step = 0.1 * lab.maxDistance();
                    this.pointer = [x + step * way[0], y + step * way[1]];
                } else if (this.held !== undefined && this.held < discs) {
                    const {x, y, radius} = discOf(frame, this.held);
                    const step = (event.shiftKey ? 0.05 : 0.25) * radius;
                    this.moveDisc(this.held, x + step * way[0], y + step * way[1]);
                }
            } else if ((event.key === "[" || event.key === "]") && !lab.isByHand && discs > 0) {
                const next =
                    this.held === undefined ? 0 : this.held + (event.key === "]" ? 1 : discs - 1);
                this.select(next % discs);
            } else if (event.key === "Escape") {
                this.select(undefined);
            }
        });
        canvas.addEventListener("blur", () => this.select(undefined));
    }
}
