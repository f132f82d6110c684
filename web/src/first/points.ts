// The measured points of the row: for each number of discs several runs with different seeds, in a
// worker of its own. A run is a whole simulation, and the engine evaluates them as `swirl crossing`
// does.
import {perRate, type Crossing, type RunNumbers} from "../engine/engine";
import type {FromWorker, ToWorker} from "../engine/messages";
import type {Way} from "./words";

export type Values = Record<string, string>;

export const settled = 20; // periods, the warm-up of the page

/** Mean of ϖ/Ω over the runs, and its direction: "still" if its sign is not certain. */
export interface Point {
    mean: number;
    way: Way;
}

/** The points of one surface, and the two numbers between which the direction changes. */
export interface Points {
    points: ReadonlyMap<number, Point>;
    reversal: [number, number] | undefined;
}
const none: Points = {points: new Map(), reversal: undefined};

/** Periods of a run, before and in its average. At a wall without friction the discs follow the swirl
 *  from the fifth period on. They gain energy there, so each further period has more collisions. */
const lengthOf = (given: Values): {warmup: number; periods: number} =>
    Number(given["mu_wall"]) === 0 && given["mu_wall"] !== undefined
        ? {warmup: 5, periods: 10}
        : {warmup: settled, periods: 40};
const firstRuns = 4; // each number of discs has at least these
const mostRuns = 16; // if the sign is not certain after fewer

interface Job {
    surface: string;
    n: number;
    seed: number;
    given: Values;
}

export class Measured {
    /** Called when a point has changed. */
    changed: () => void = () => {};
    private readonly runs = new Map<string, Map<number, RunNumbers[]>>(); // keys: surface, number
    private readonly found = new Map<string, Points>();
    private queue: Job[] = [];
    private busy: Job | undefined;
    private evaluated: Job | undefined; // its surface is being evaluated
    private isReady = false;

    constructor(private readonly worker: Worker) {
        worker.onmessage = ({data}: MessageEvent<FromWorker>): void => this.hear(data);
    }

    /** The points of the discs with these frictions. */
    of(surface: string): Points {
        return this.found.get(surface) ?? none;
    }

    get surfaces(): string[] {
        return [...this.found.keys()];
    }

    /** Measures this number of discs before those that were asked for earlier. */
    want(surface: string, n: number, given: Values): void {
        if (this.runsOf(surface).has(n)) return;
        this.runsOf(surface).set(n, []);
        this.ask(surface, n, given);
    }

    private runsOf(surface: string): Map<number, RunNumbers[]> {
        const known = this.runs.get(surface) ?? new Map<number, RunNumbers[]>();
        this.runs.set(surface, known);
        return known;
    }

    private ask(surface: string, n: number, given: Values, isLast = false): void {
        const done = this.runsOf(surface).get(n)!.length;
        const jobs = Array.from({length: firstRuns}, (_, k) => ({
            surface,
            n,
            seed: done + k + 1,
            given,
        }));
        this.queue = isLast ? [...this.queue, ...jobs] : [...jobs, ...this.queue];
        this.next();
    }

    private next(): void {
        if (!this.isReady || this.busy || this.evaluated) return;
        this.busy = this.queue.shift();
        if (!this.busy) return;
        const {n, seed, given} = this.busy,
            {warmup, periods} = lengthOf(given);
        this.send({
            kind: "point",
            given: {...given, discs: String(n), seed: String(seed), warmup: String(warmup)},
            periods,
        });
    }

    private send(message: ToWorker): void {
        this.worker.postMessage(message);
    }

    private hear(data: FromWorker): void {
        const {busy, evaluated} = this;
        if (data.kind === "ready") this.isReady = true;
        else if (busy && (data.kind === "point" || data.kind === "rejected")) {
            this.busy = undefined;
            const mean = data.kind === "point" ? data.rotation.mean_by_time.mean : null;
            if (mean !== null) this.take(busy, mean);
        } else if (evaluated && data.kind === "crossing") {
            this.evaluated = undefined;
            this.judge(evaluated, data.crossings.mean_by_time);
        }
        this.next();
    }

    /** The runs of a number are evaluated four by four, with those of the other numbers. */
    private take(job: Job, mean: number): void {
        const {surface, n, given} = job,
            all = this.runsOf(surface);
        // A run has no error of its own: the engine compares the runs with each other.
        all.get(n)!.push([n, mean, NaN, lengthOf(given).periods, 0]);
        if (all.get(n)!.length % firstRuns !== 0) return;
        this.evaluated = job;
        const complete = [...all.values()].flatMap((runs) =>
            runs.slice(0, firstRuns * Math.floor(runs.length / firstRuns)),
        );
        this.send({kind: "crossing", runs: perRate(() => complete)});
    }

    private judge({surface, n, given}: Job, {points, undetermined, before, after}: Crossing): void {
        const found = new Map<number, Point>();
        for (const [number, mean] of points) {
            if (mean === null) continue;
            const way = undetermined.includes(number) ? "still" : mean > 0 ? "with" : "against";
            found.set(number, {mean, way});
        }
        const reversal: [number, number] | undefined =
            before !== null && after !== null ? [before, after] : undefined;
        this.found.set(surface, {points: found, reversal});
        const isOpen =
            found.get(n)?.way === "still" && this.runsOf(surface).get(n)!.length < mostRuns;
        if (isOpen) this.ask(surface, n, given, true);
        this.changed();
    }
}
