// Whole runs in the background, on all cores. Each worker makes one run at a time.
import {
    UsageError,
    perRate,
    rates,
    type Crossing,
    type Estimate,
    type NextRuns,
    type Rate,
    type Rotation,
    type RunNumbers,
    type SearchedNumbers,
    type SearchRules,
} from "./engine";
import type {MeanWithError} from "./estimates";
import type {FromWorker, ToWorker} from "./messages";
import {engineMessage} from "../texts/texts";

/** A collapsed run has no rotation rate, since its averages end at the collapse. */
export interface FinishedRun {
    rotation: Rotation | undefined;
}

/** A run for the evaluation of a point or of N_c. */
export interface EvaluatedRun {
    discs: number;
    periods: number;
    rotation: Record<Rate, MeanWithError & Partial<Estimate>>;
    seed?: string;
}
/** A run of a search; a collapsed one has no rotation. */
export type SearchedRun = Pick<EvaluatedRun, "discs" | "periods"> & FinishedRun;
export type Crossings = Record<Rate, Crossing>;
export type Estimates = Record<Rate, MeanWithError>;

/** Number of seeds of a point. A single run underestimates its error where the discs remember their
 *  arrangement for longer than a block of it; the scatter between seeds does not. */
export const seedsPerPoint = 4;
const maxSeeds = 12;

/** The seeds of a point. A text that is no number stays, and the engine rejects it. */
export function seedsFrom(first = "1", count = seedsPerPoint): string[] {
    const whole = /^\d+$/.test(first || "1") ? BigInt(first || "1") : undefined;
    return Array.from({length: count}, (_, k) =>
        whole === undefined ? first : String(BigInt.asUintN(64, whole + BigInt(k))),
    );
}

/** Runs without a mean or an error are omitted. */
function numbersOf(
    discs: number,
    periods: number,
    {mean, error, effective_samples}: EvaluatedRun["rotation"][Rate],
): RunNumbers[] {
    return mean === null || error === null
        ? []
        : [[discs, mean, error, periods, effective_samples ?? 0]];
}

export const searchedNumbers = (made: SearchedRun[]): SearchedNumbers[] =>
    made.map(({discs, periods, rotation}) => [
        discs,
        periods,
        ...rates.flatMap((rate) => {
            const {
                mean,
                error,
                effective_samples: samples,
            }: Partial<EvaluatedRun["rotation"][Rate]> = rotation?.[rate] ?? {};
            return [mean ?? NaN, error ?? NaN, samples ?? 0];
        }),
    ]);

interface Task {
    message: ToWorker;
    resolve: (answer: FromWorker) => void;
    reject: (error: Error) => void;
}

const maxWorkers = 16;

export class Runs {
    private readonly queue: Task[] = [];
    private readonly idle: Worker[] = [];
    private readonly workers = new Map<Worker, Task | undefined>();
    private readonly size: number;

    /** `begin` creates a worker that gets the engine. */
    constructor(
        private readonly begin: () => Worker,
        cores = navigator.hardwareConcurrency || 1,
    ) {
        this.size = Math.max(1, Math.min(cores, maxWorkers));
    }

    /** A run with this many periods after the warm-up. Rejects with UsageError. */
    async run(given: Record<string, string>, periods: number): Promise<FinishedRun> {
        const answer = await this.ask({kind: "point", given, periods});
        if (answer.kind !== "point") throw new Error(answer.kind);
        return {rotation: answer.collapsed ? undefined : answer.rotation};
    }

    /** Runs that differ in their seeds only, in parallel or one after the other. A collapsed run is
     *  replaced by one with the next seed. Undefined if too many collapse, or `isWanted` has become
     *  false. Rejects with UsageError. */
    async replicates(
        given: Record<string, string>,
        periods: number,
        isWanted?: () => boolean,
    ): Promise<EvaluatedRun[] | undefined> {
        const discs = Number(given["discs"]),
            all: EvaluatedRun[] = [],
            seeds = seedsFrom(given["seed"], maxSeeds);
        while (all.length < seedsPerPoint && seeds.length > 0) {
            if (isWanted && !isWanted()) return undefined;
            const next = seeds.splice(0, isWanted ? 1 : seedsPerPoint - all.length);
            const finished = await Promise.all(
                next.map((seed) => this.run({...given, seed}, periods)),
            );
            for (const [k, {rotation}] of finished.entries())
                if (rotation) all.push({discs, periods, rotation, seed: next[k]!});
        }
        return all.length === seedsPerPoint ? all : undefined;
    }

    /** N_c by each rotation rate. */
    crossings(runs: EvaluatedRun[]): Promise<Crossings> {
        return this.evaluated(
            perRate((rate) =>
                runs.flatMap(({discs, periods, rotation}) =>
                    numbersOf(discs, periods, rotation[rate]),
                ),
            ),
        );
    }

    /** The means of runs with the same number of discs, and the errors between them, by the
     *  estimator of all programs: the runs give no errors of their own. */
    async estimates(runs: EvaluatedRun[]): Promise<Estimates> {
        const found = await this.evaluated(
            perRate((rate) =>
                runs.map(({discs, periods, rotation}) => [
                    discs,
                    rotation[rate].mean ?? NaN,
                    NaN,
                    periods,
                    0,
                ]),
            ),
        );
        return perRate((rate) => {
            const [, mean, error] = found[rate].points[0]!;
            return {mean, error};
        });
    }

    private async evaluated(runs: Record<Rate, RunNumbers[]>): Promise<Crossings> {
        const answer = await this.ask({kind: "crossing", runs});
        if (answer.kind !== "crossing") throw new Error(answer.kind);
        return answer.crossings;
    }

    /** The next runs of a search for N_c. */
    async search(rules: SearchRules, made: SearchedRun[]): Promise<NextRuns> {
        const answer = await this.ask({kind: "search", rules, made: searchedNumbers(made)});
        if (answer.kind !== "search") throw new Error(answer.kind);
        return answer.next;
    }

    /** The result of a run to exactly this event, as JSON. Rejects with UsageError. */
    async result(given: Record<string, string>, events: number): Promise<string> {
        const answer = await this.ask({kind: "repeat", given, events});
        if (answer.kind !== "result") throw new Error(answer.kind);
        return answer.text;
    }

    get busy(): boolean {
        return this.queue.length > 0 || [...this.workers.values()].some(Boolean);
    }

    /** Ends all workers; the promises of unfinished runs stay pending. */
    stop(): void {
        for (const worker of this.workers.keys()) worker.terminate();
        this.workers.clear();
        this.idle.length = this.queue.length = 0;
    }

    /** The message waits for a free worker. */
    private ask(message: ToWorker): Promise<FromWorker> {
        return new Promise((resolve, reject) => {
            this.queue.push({message, resolve, reject});
            if (this.idle.length === 0 && this.workers.size < this.size) this.add();
            this.next();
        });
    }

    private add(): void {
        const worker = this.begin();
        this.workers.set(worker, undefined);
        worker.onmessage = ({data}: MessageEvent<FromWorker>): void => {
            const task = this.workers.get(worker);
            if (data.kind === "progress" || data.kind === "started") return;
            this.workers.set(worker, undefined);
            this.idle.push(worker);
            if (data.kind === "rejected") task?.reject(new UsageError(engineMessage(data.message)));
            else task?.resolve(data); // "ready" answers no task
            this.next();
        };
    }

    private next(): void {
        while (this.queue.length > 0 && this.idle.length > 0) {
            const worker = this.idle.pop()!,
                task = this.queue.shift()!;
            this.workers.set(worker, task);
            worker.postMessage(task.message);
        }
    }
}
