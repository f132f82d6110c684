// A second container next to the first. It keeps its parameters and runs at the same speed.
import {liveEstimate} from "./estimates";
import type {FromWorker, ToWorker} from "./messages";
import {button, dark, element, withError} from "./page";
import {SectorPaint} from "./paint";
import {draw, type Coloring} from "./scene";
import {engineMessage, texts} from "./texts";

export class ComparedContainer {
    readonly figure = element("figure", {id: "compared"});
    private readonly canvas = element("canvas");
    private readonly caption = element("figcaption");
    private frame: Float64Array | undefined;
    private waiting = true;
    private room = 0;
    private turns = 0;
    coloring: Coloring = "sector";
    private readonly paint = new SectorPaint();

    /** `worker` has the engine, `given` are its parameters, `name` its caption. */
    constructor(private readonly worker: Worker, private readonly given: Record<string, string>,
                private readonly name: string, ended: () => void) {
        this.canvas.setAttribute("role", "img");
        this.canvas.setAttribute("aria-label", name);
        this.caption.textContent = name;
        const end = button("×", () => {
            this.worker.terminate();
            ended();
        }, "close-compared");
        end.setAttribute("aria-label", texts.closeCompared);
        this.figure.append(this.canvas, element("div", {className: "row-of-caption"}, this.caption, end));
        worker.onmessage = ({data}: MessageEvent<FromWorker>): void => this.hear(data);
    }

    tick(periods: number): void {
        if (this.waiting) return;
        this.waiting = true;
        this.send({kind: "tick", periods});
    }

    redraw(): void {
        if (this.frame)
            draw(this.canvas, this.frame, {view: "lab", coloring: this.coloring,
                                           sectors: this.paint.sectors, trails: [],
                                           event: undefined, next: undefined, omega: 0,
                                           dark: dark(), room: this.room, turns: this.turns, held: undefined});
    }

    private send(message: ToWorker): void {
        this.worker.postMessage(message);
    }

    private hear(data: FromWorker): void {
        if (data.kind === "ready") this.send({kind: "begin", given: this.given, events: 0, run: 0});
        else if (data.kind === "started") this.room = Number(data.configuration["amplitude"]);
        else if (data.kind === "rejected") this.caption.textContent = engineMessage(data.message);
        if (data.kind !== "frame") return;
        this.waiting = false;
        if (this.frame?.length !== data.frame.length) this.paint.apply(data.frame);
        this.frame = data.frame;
        this.turns = data.turns[0];
        this.redraw();
        const found = data.rotation && liveEstimate(data.rotation);
        if (found)
            this.caption.textContent =
                texts.comparedResult(this.name, withError(found.mean, found.error, texts.notYet));
    }
}
