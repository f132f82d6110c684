// Time on the page: playing, and the fast run to the averages.
import type {Dish} from "./dish";
import {minPeriods} from "../engine/estimates";
import type {Laboratory} from "../engine/laboratory";
import type {ToWorker} from "../engine/messages";

const usualPace = 1, // periods per second
    slowPace = 1 / 3;
/** In the time-lapse, one image per period. Next to another container it is slower, because a few
 *  discs turn fast. */
const lapsePace = 16,
    comparedPace = 10;
const unseen = 10; // periods not shown, so that the first image of two containers shows their directions
const averagedInLapse = minPeriods; // periods after the warm-up, so that the average has an error
/** A period of more discs takes too long for a time-lapse. */
const lapseDiscs = 300;
/** Time for which a change of parameters is shown at the usual pace, before the time-lapse to its
 *  averages. */
const watched = 3000; // milliseconds

export class Player {
    isPlaying: boolean;
    /** The motion within a period is visible: at a third of the pace. Instead of a time-lapse, the
     *  periods to the averages are skipped. */
    isSlow = false;
    /** Period at which the time-lapse ends; 0: there is none. */
    private lapseEnd = 0;
    private skips = false; // the warm-up
    private lapseBegin: ReturnType<typeof setTimeout> | undefined;
    private playsAfterError = false;
    private lastTick = 0;
    private isStarted = false;
    private isAsked = false; // an animation frame is asked for
    private readonly listeners: (() => void)[] = [];

    constructor(
        private readonly lab: Laboratory,
        private readonly dish: Dish,
        readonly reducedMotion: boolean,
    ) {
        this.isPlaying = !reducedMotion;
        lab.on("frame", () => {
            if (this.skips) dish.repaint();
            this.skips = false;
            if (this.lapseEnd > 0 && this.period >= this.lapseEnd - 1e-6) this.endLapse();
        });
        lab.on("begin", () => {
            clearTimeout(this.lapseBegin);
            this.endLapse();
            if (this.playsAfterError) this.setPlaying(true);
            this.playsAfterError = false;
        });
        lab.on("changed", (byParameters) => {
            clearTimeout(this.lapseBegin);
            this.endLapse();
            if (byParameters && this.isPlaying)
                this.lapseBegin = setTimeout(() => {
                    if (this.isPlaying) this.lapse();
                }, watched);
        });
        lab.on("error", () => {
            this.playsAfterError ||= this.isPlaying;
            this.setPlaying(false);
        });
    }

    /** Starts the frames. */
    start(): void {
        this.isStarted = true;
        this.lab.on("frame", () => this.askForFrame());
        document.addEventListener("visibilitychange", () => this.askForFrame());
        this.askForFrame();
    }

    /** Asks for an animation frame while time passes and the page is visible. */
    private askForFrame(): void {
        if (!this.isStarted || this.isAsked || !this.isPlaying || document.hidden) return;
        this.isAsked = true;
        requestAnimationFrame((now) => {
            this.isAsked = false;
            this.animate(now);
            this.askForFrame();
        });
    }

    onChange(listener: () => void): void {
        this.listeners.push(listener);
    }

    setPlaying(on: boolean): void {
        this.isPlaying = on;
        this.lastTick = 0;
        if (!on) this.endLapse();
        this.report();
    }

    private get period(): number {
        const {last} = this.lab;
        return last ? last.frame[1]! + last.frame[2]! / this.lab.value("period") : 0;
    }

    /** At the beginning and after a change of parameters: runs until there are averages. After the
     *  warm-up it draws one image per period, or none with reduced motion or in slow motion. */
    lapse(): void {
        const {lab, dish} = this;
        if (!this.isPlaying && !this.reducedMotion) return;
        if (!lab.last || lab.isByHand || this.lapseEnd > 0 || lab.last.frame[10]! > lapseDiscs)
            return;
        const now = Math.floor(this.period + 1e-6),
            warmup = Number(lab.averages?.warmup ?? 0);
        const end = Math.max(now, warmup) + averagedInLapse;
        const skipsAll = this.reducedMotion || this.isSlow,
            skipped = skipsAll ? end - now : warmup - now + (dish.compared?.follows ? unseen : 0);
        if ((skipsAll || now < warmup) && lab.request({kind: "skip", periods: skipped})) {
            this.skips = true;
            if (dish.compared?.follows) dish.compared.skip(skipped);
        }
        if (skipsAll) return;
        this.lapseEnd = end;
        this.isPlaying = true;
        dish.isLapse = true;
        this.report();
    }

    private endLapse(): void {
        if (this.lapseEnd === 0) return;
        this.lapseEnd = 0;
        this.lastTick = 0;
        this.dish.isLapse = false;
        this.report();
    }

    private report(): void {
        for (const listener of this.listeners) listener();
        this.askForFrame();
    }

    private animate(now: number): void {
        const {lab, dish} = this;
        if (dish.holdsTime) this.lastTick = 0;
        if (!this.isPlaying || lab.isWaiting || !lab.last || dish.holdsTime) return;
        // After a pause, or a while in the background, time continues from here.
        const elapsed = this.lastTick > 0 ? Math.min(now - this.lastTick, 100) : 0;
        this.lastTick = now;
        const pace =
            this.lapseEnd === 0
                ? this.isSlow || dish.coloring === "contacts"
                    ? slowPace
                    : usualPace
                : dish.compared
                  ? comparedPace
                  : lapsePace;
        const periods = (elapsed / 1000) * pace,
            {compared} = dish;
        const next = (frame: Float64Array, more = periods): ToWorker =>
            lab.isByHand && dish.pointer
                ? this.steerTo(dish.pointer, frame, periods)
                : {kind: "tick", periods: more, strobe: dish.strobe || dish.isLapse};
        lab.request(next(lab.last.frame));
        if (!compared?.last) return;
        // Both are at the same point of their paths.
        const behind = (lab.last.frame[2]! - compared.last[2]!) / lab.value("period");
        compared.request(next(compared.last, Math.max(0, periods + behind - Math.round(behind))));
    }

    /** Moves the container straight to the pointer, at most four times as fast as on its path, and
     *  not out of the image. */
    private steerTo([x, y]: [number, number], frame: Float64Array, periods: number): ToWorker {
        const {lab} = this,
            amplitude = lab.value("amplitude");
        const period = lab.value("period"),
            duration = Math.max(periods, 1e-4) * period;
        const [fromX, fromY] = [frame[3]!, frame[4]!];
        const outside = Math.max(1, Math.hypot(x, y) / lab.maxDistance());
        const [dx, dy] = [x / outside - fromX, y / outside - fromY];
        const usual = (2 * Math.PI * (amplitude || 0.2 * lab.value("container_radius"))) / period;
        const share = Math.min(1, (4 * usual * duration) / (Math.hypot(dx, dy) || 1));
        return {kind: "steer", x: fromX + share * dx, y: fromY + share * dy, duration};
    }
}
