// A second container to the left of the first. It keeps its parameters and moves at the same pace,
// also by hand.
import type {Laboratory} from "../engine/laboratory";
import type {FromWorker, ToWorker} from "../engine/messages";
import {button, dark, element, signed} from "../elements/page";
import {SectorPaint} from "../drawing/paint";
import {draw, extentOf} from "../drawing/scene";
import type {Coloring} from "../drawing/view";
import {isWholePeriod} from "../drawing/strobe";
import {Contacts} from "../drawing/contacts";
import {fill, engineMessage, texts} from "../texts/texts";
import {captionOf, findingOf, type Finding} from "./finding";

/** How the first container is shown, and the extent of both images, which have one scale. */
interface Look {
    extent: number;
    coloring: Coloring;
    strobe: boolean;
    isLapse: boolean;
    isByHand: boolean;
}

export class ComparedContainer {
    readonly canvas = element("canvas");
    readonly figure: HTMLElement;
    particles = 0;
    finding: Finding = findingOf(undefined, 0, 0);
    hasAverages = false;
    last: Float64Array | undefined;
    private readonly worker: Worker;
    private readonly caption = element("figcaption");
    private shown: {frame: Float64Array; turns: number} | undefined;
    private readonly paint = new SectorPaint();
    private readonly contacts = new Contacts();
    private waiting = true;
    private isNew = true; // its colours are those of the next frame
    private skipped = 0; // periods to skip after the first frame
    private room = 0;
    /** The room that its image needs. */
    get extent(): number {
        return this.shown ? extentOf(this.shown.frame, this.room) : 0;
    }
    private period = 1;
    private look: Look = {
        extent: 0,
        coloring: "sector",
        strobe: false,
        isLapse: false,
        isByHand: false,
    };

    /** `given` are its parameters, `follows` whether it begins again together with the first
     *  container. */
    constructor(
        lab: Laboratory,
        readonly given: Record<string, string>,
        private readonly name: string,
        readonly follows: boolean,
        ended: () => void,
    ) {
        this.canvas.setAttribute("role", "img");
        this.canvas.setAttribute("aria-label", name);
        this.caption.textContent = name;
        const end = button("×", ended, "close-compared");
        end.setAttribute("aria-label", texts.closeCompared);
        this.figure = element("figure", {id: "compared"}, this.canvas, this.caption, end);
        this.worker = lab.newWorker();
        this.worker.onmessage = ({data}: MessageEvent<FromWorker>): void => this.hear(data);
    }

    end(): void {
        this.worker.terminate();
    }

    begin(): void {
        this.isNew = true;
        this.send({kind: "begin", given: this.given, events: 0, run: 0});
    }

    /** Sends a message unless the answer to an earlier one is missing. */
    request(message: ToWorker): void {
        if (!this.waiting) this.send(message);
    }

    /** Runs the periods before the averages without showing them, as soon as it has begun. */
    skip(periods: number): void {
        this.skipped = this.last ? 0 : periods;
        if (this.last) this.send({kind: "skip", periods});
    }

    redraw(look = this.look): void {
        if (look.coloring !== this.look.coloring) {
            this.send(
                {kind: "measure", maps: false, contacts: look.coloring === "contacts"},
                false,
            );
            if (look.coloring === "sector" && this.last) this.paint.apply(this.last);
        }
        this.look = {...look};
        const {shown} = this;
        if (shown)
            draw(this.canvas, shown.frame, {
                view: "lab",
                coloring: this.look.coloring,
                sectors: this.paint.sectors,
                omega: 0,
                dark: dark(),
                extent: this.look.extent,
                turns: shown.turns,
                held: undefined,
                contacts: this.contacts.recent,
            });
    }

    private send(message: ToWorker, isAnswered = true): void {
        this.waiting ||= isAnswered;
        this.worker.postMessage(message);
    }

    private hear(data: FromWorker): void {
        if (data.kind === "ready") this.begin();
        else if (data.kind === "started") {
            this.room = Number(data.configuration["amplitude"]);
            this.period = Number(data.configuration["period"]);
        } else if (data.kind === "rejected") this.caption.textContent = engineMessage(data.message);
        if (data.kind !== "frame") return;
        const {
                frame,
                rotation,
                turns: [turns],
            } = data,
            {look} = this;
        this.waiting = false;
        this.contacts.add(data, this.period);
        if (this.isNew || this.last?.length !== frame.length || frame[1]! > this.last[1]! + 1) {
            // it skipped periods
            this.paint.apply(frame);
            this.shown = undefined;
        }
        this.isNew = false;
        this.last = frame;
        if (this.skipped > 0) this.skip(this.skipped);
        this.particles = frame[10]!;
        const stops = (look.strobe || look.isLapse) && !look.isByHand;
        if (!stops || isWholePeriod(frame, this.period)) {
            if (!look.isLapse && this.paint.isMixed(frame)) this.paint.apply(frame);
            this.shown = {frame, turns};
        }
        this.redraw();
        if (look.isByHand)
            this.caption.textContent = `${this.name}: ${fill(texts.turns, {turns: signed(turns, 2)})}`;
        else if (rotation) {
            this.hasAverages = rotation.mean_by_time.blocks > 0;
            this.finding = findingOf(rotation, turns, frame[1]! + frame[2]! / this.period);
            this.caption.textContent = captionOf(
                this.name,
                this.finding,
                look.coloring === "contacts" ? data.cause : undefined,
            );
        }
    }
}
