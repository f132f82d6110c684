// The measured points of the row: for each number of discs several runs with different seeds, in a
// worker of its own. A run is a whole simulation, so a point is a true average.
import type {FromWorker, ToWorker} from "../engine/messages";
import type {Way} from "./words";

export type Values = Record<string, string>;

/** Mean of ϖ/Ω over the runs, and half of its 99 % interval. */
export interface Point {
    mean: number;
    error: number;
    runs: number;
    way: Way;
}

/** Periods of a run, before and in its average. At a wall without friction the discs follow the swirl
 *  from the fifth period on, and gain energy: each further period has more collisions. */
const lengthOf = (given: Values): {warmup: number; periods: number} =>
    Number(given["mu_wall"]) === 0 && given["mu_wall"] !== undefined
        ? {warmup: 5, periods: 10}
        : {warmup: 20, periods: 40};
const firstRuns = 4; // each number of discs has at least these
const mostRuns = 16; // if the sign is not certain after fewer
/** Student's t of 99 % for 3, 7, 11 and 15 degrees of freedom: a wrong sign would move the reversal,
 *  and each number of discs is judged up to four times. */
const student = new Map([
    [4, 5.841],
    [8, 3.499],
    [12, 3.106],
    [16, 2.947],
]);

/** The point of these means; undefined while there are too few. Runs are added by four. */
export function pointOf(means: readonly number[]): Point | undefined {
    const runs = firstRuns * Math.floor(means.length / firstRuns),
        t = student.get(runs);
    if (t === undefined) return undefined;
    const used = means.slice(0, runs),
        mean = used.reduce((sum, each) => sum + each, 0) / runs;
    const square = used.reduce((sum, each) => sum + (each - mean) ** 2, 0) / (runs - 1);
    const error = t * Math.sqrt(square / runs);
    return {
        mean,
        error,
        runs,
        way: Math.abs(mean) <= error ? "still" : mean > 0 ? "with" : "against",
    };
}

/** The last number whose cluster turns with the swirl, and the next one that turns against it;
 *  undefined if there are no such neighbours, or their order is the other one. */
export function reversalOf(points: ReadonlyMap<number, Point>): [number, number] | undefined {
    const of = (way: Way): number[] =>
        [...points].filter(([, point]) => point.way === way).map(([n]) => n);
    const [plus, minus] = [of("with"), of("against")];
    if (plus.length === 0 || minus.length === 0) return undefined;
    const [last, next] = [Math.max(...plus), Math.min(...minus)];
    return last < next ? [last, next] : undefined;
}

interface Job {
    surface: string;
    n: number;
    seed: number;
    given: Values;
}

export class Points {
    /** Called when a point has changed. */
    changed: () => void = () => {};
    private readonly means = new Map<string, Map<number, number[]>>(); // keys: surface, number
    private queue: Job[] = [];
    private busy: Job | undefined;
    private isReady = false;

    constructor(private readonly worker: Worker) {
        worker.onmessage = ({data}: MessageEvent<FromWorker>): void => this.hear(data);
    }

    /** The points of the discs with these frictions. */
    of(surface: string): ReadonlyMap<number, Point> {
        const found = new Map<number, Point>();
        for (const [n, means] of this.means.get(surface) ?? []) {
            const point = pointOf(means);
            if (point) found.set(n, point);
        }
        return found;
    }

    get surfaces(): string[] {
        return [...this.means.keys()];
    }

    /** Measures this number of discs before those that were asked for earlier. */
    want(surface: string, n: number, given: Values): void {
        const means = this.meansOf(surface, n);
        if (means.length > 0 || this.queue.some((job) => job.surface === surface && job.n === n))
            return;
        this.ask(surface, n, given);
    }

    private meansOf(surface: string, n: number): number[] {
        const all = this.means.get(surface) ?? new Map<number, number[]>();
        this.means.set(surface, all);
        const means = all.get(n) ?? [];
        all.set(n, means);
        return means;
    }

    private ask(surface: string, n: number, given: Values, isLast = false): void {
        const done = this.meansOf(surface, n).length;
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
        if (!this.isReady || this.busy) return;
        this.busy = this.queue.shift();
        if (!this.busy) return;
        const {n, seed, given} = this.busy,
            {warmup, periods} = lengthOf(given);
        this.worker.postMessage({
            kind: "point",
            given: {...given, discs: String(n), seed: String(seed), warmup: String(warmup)},
            periods,
        } satisfies ToWorker);
    }

    private hear(data: FromWorker): void {
        if (data.kind === "ready") this.isReady = true;
        const job = this.busy;
        if (job && (data.kind === "point" || data.kind === "rejected")) {
            this.busy = undefined;
            const mean = data.kind === "point" ? data.rotation.mean_by_time.mean : null;
            if (mean !== null) this.take(job, mean);
        }
        this.next();
    }

    private take({surface, n, given}: Job, mean: number): void {
        const means = this.meansOf(surface, n);
        means.push(mean);
        const point = means.length % firstRuns === 0 ? pointOf(means) : undefined;
        if (point?.way === "still" && means.length < mostRuns) this.ask(surface, n, given, true);
        this.changed();
    }
}
