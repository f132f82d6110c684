// The simulation of the first page: one dish whose discs stay the same when their number, the
// friction or their spins change.
import type {Frame, FromWorker, ToWorker} from "../engine/messages";
import {SectorPaint} from "../drawing/paint";
import {settled, type Values} from "./points";

export class DishRun {
    last: Frame | undefined;
    period = 1;
    amplitude = 1.892;
    readonly paint = new SectorPaint();
    isByHand = false;
    /** The names of the parameters that the engine has. */
    isKnown: (name: string) => boolean = () => false;
    /** Called when the engine is loaded, a frame has arrived, and when values are rejected. */
    ready: () => void = () => {};
    framed: () => void = () => {};
    failed: (message: string) => void = () => {};
    private isWaiting = true;
    private skipped = 0; // periods before the first image
    private run = 0;
    private given: Values = {};
    private before = 0; // turns since the last change, before the averages began

    constructor(private readonly worker: Worker) {
        worker.onmessage = ({data}: MessageEvent<FromWorker>): void => this.hear(data);
    }

    /** Turns of the cluster since the last change. */
    get turns(): number {
        return this.last ? this.before + this.last.turns[0] : 0;
    }

    /** Starts a new simulation, which is shown after this many periods. */
    begin(given: Values, skipped = 0): void {
        this.given = given;
        this.isByHand = false;
        this.isWaiting = true;
        this.skipped = skipped;
        this.send({kind: "begin", given, events: 0, run: ++this.run});
        if (skipped > 0) this.send({kind: "skip", periods: skipped});
    }

    /** The same discs go on with other values. */
    change(given: Values): void {
        this.given = given;
        if (!this.last || this.isByHand) return this.begin(given);
        this.send({kind: "change", given});
    }

    /** Time goes on by this many periods. */
    tick(periods: number): void {
        this.request({kind: "tick", periods});
    }

    /** Skips periods without showing them. */
    skip(periods: number): void {
        this.request({kind: "skip", periods});
    }

    /** Moves the container by hand, towards a point in the lab frame. */
    steer([x, y]: [number, number], seconds: number, reach: number): void {
        if (!this.last) return;
        if (!this.isByHand) this.restart();
        this.isByHand = true;
        const f = this.last.frame,
            duration = Math.max(1e-3, seconds * this.period),
            fastest = (4 * 2 * Math.PI * this.amplitude * duration) / this.period,
            outside = Math.max(1, Math.hypot(x, y) / reach);
        const [dx, dy] = [x / outside - f[3]!, y / outside - f[4]!],
            share = Math.min(1, fastest / (Math.hypot(dx, dy) || 1));
        this.request({kind: "steer", x: f[3]! + share * dx, y: f[4]! + share * dy, duration});
    }

    showContacts(shown: boolean): void {
        this.send({kind: "measure", maps: false, contacts: shown});
    }

    private restart(): void {
        this.before = 0;
        if (this.last) this.paint.apply(this.last.frame);
    }

    private send(message: ToWorker): void {
        this.worker.postMessage(message);
    }

    private request(message: ToWorker): void {
        if (this.isWaiting) return;
        this.isWaiting = true;
        this.send(message);
    }

    private hear(data: FromWorker): void {
        if ("run" in data && data.run !== this.run) return;
        switch (data.kind) {
            case "ready":
                this.isKnown = (name) => data.parameters.some((row) => row.name === name);
                return this.ready();
            case "started":
                this.period = Number(data.configuration["period"]);
                this.amplitude = Number(data.configuration["amplitude"]);
                this.last = undefined;
                this.before = 0;
                return;
            case "changed":
                if (!data.kept) return this.begin(this.given);
                return this.restart();
            case "rejected":
                this.isWaiting = false;
                return this.failed(data.message.text);
            case "unsupported":
                return this.failed("");
            case "frame":
                return this.take(data);
        }
    }

    private take(data: Frame): void {
        this.isWaiting = false;
        const isFirst = this.last === undefined,
            f = data.frame;
        if (f[1]! + f[2]! / this.period < this.skipped - 1e-6) {
            this.isWaiting = true; // the frame before the skip
            return;
        }
        this.skipped = 0;
        // The engine's count begins again with its averages.
        if (this.last && !this.isByHand && this.last.frame[1]! < settled && f[1]! >= settled)
            this.before += this.last.turns[0];
        this.last = data;
        if (isFirst) this.paint.apply(f);
        else if (this.paint.sectors.length !== f[10]) this.paint.extend(f);
        this.framed();
    }
}
