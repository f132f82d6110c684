// A second dish beside the first: kept as it was asked for, swirled at the same pace.
import type {FromWorker, ToWorker} from "./messages";
import {button, dark, element, withError} from "./page";
import {draw, type Coloring} from "./scene";
import {texts} from "./texts";

export class Beside {
    readonly figure = element("figure", {id: "beside"});
    private readonly canvas = element("canvas");
    private readonly caption = element("figcaption");
    private readonly worker: Worker;
    private frame: Float64Array | undefined;
    private waiting = true;
    private room = 0;
    coloring: Coloring = "spin";

    /** `given` are its parameters, `name` what it is called. */
    constructor(worker: Worker, engine: Promise<ArrayBuffer>, private readonly given:
                Record<string, string>, private readonly name: string, ended: () => void) {
        this.worker = worker;
        this.canvas.setAttribute("role", "img");
        this.canvas.setAttribute("aria-label", name);
        this.caption.textContent = name;
        const end = button("×", () => {
            this.worker.terminate();
            ended();
        }, "beside-ends");
        end.setAttribute("aria-label", texts.besideEnds);
        this.figure.append(this.canvas, element("div", {className: "row-of-caption"}, this.caption, end));
        worker.onmessage = ({data}: MessageEvent<FromWorker>): void => this.hear(data);
        void engine.then((bytes) => this.tell({kind: "engine", bytes}));
    }

    tick(swirls: number): void {
        if (this.waiting) return;
        this.waiting = true;
        this.tell({kind: "tick", swirls});
    }

    redraw(): void {
        if (this.frame)
            draw(this.canvas, this.frame, {view: "lab", coloring: this.coloring, trails: [],
                                           event: undefined, next: undefined, omega: 0,
                                           dark: dark(), room: this.room, turned: 0, held: undefined});
    }

    private tell(message: ToWorker): void {
        this.worker.postMessage(message);
    }

    private hear(data: FromWorker): void {
        if (data.kind === "ready") this.tell({kind: "begin", given: this.given, events: 0});
        else if (data.kind === "begun") this.room = Number(data.configuration["amplitude"]);
        else if (data.kind === "refused") this.caption.textContent = data.sentence;
        if (data.kind !== "frame") return;
        this.waiting = false;
        this.frame = data.frame;
        this.redraw();
        const found = data.rotation?.by_time;
        if (found)
            this.caption.textContent =
                texts.besideHas(this.name, withError(found.mean, found.error, texts.notYet));
    }
}
