// N_c of one setting with few runs: the method of `swirl crossing` (src/swirl/study/crossing_search.hpp) with
// shorter runs, so that it takes seconds. The engine evaluates the runs, as for the command line.
//
// 1. Coarse scan: short runs at eight numbers of discs in the range.
// 2. Narrowing: runs within the bracket until every number in it has one.
// 3. Tolerance: the numbers of the bracket, and those outside it with an undetermined sign, get further runs,
//    each twice as long as the ones before, until the error of N_c is below the tolerance.
//
// All numbers of a bracket get further runs together. If each got runs until its sign is certain, it would
// stop where chance moves it away from zero, and the interval of N_c would be too narrow.
import {rates, type Crossing, type Rate} from "./engine";
import type {Crossings, EvaluatedRun, FinishedRun} from "./runs";

export interface SearchSettings {
    from: number;
    to: number;
    /** Length of the first runs after the warm-up, in periods. */
    periods: number;
    /** Target standard error of N_c. */
    tolerance: number;
    /** Further runs at one number of discs, at most. */
    rounds: number;
    seed: number;
}
export const usualSearch: SearchSettings = {from: 5, to: 48, periods: 66, tolerance: 0.25, rounds: 4, seed: 1};

/** What the search needs: a run, and the evaluation of all runs. */
export interface SearchTools {
    run(discs: number, seed: number, periods: number): Promise<FinishedRun>;
    crossings(runs: EvaluatedRun[]): Promise<Crossings>;
}

export interface SearchResult {
    crossings: Crossings;
    runs: number;
    collapsed: number;
    withinTolerance: boolean;
}

/** The rate that controls the search. */
export const controlling: Rate = "by_time";
const coarsePoints = 8;
const maxSignRounds = 2; // of further runs outside the bracket
const gapAtOnce = 3; // missing numbers in a bracket that are run together

class Searcher {
    private readonly finished: EvaluatedRun[] = [];
    private readonly rounds = new Map<number, number>(); // of further runs, by number of discs
    private readonly attempted = new Map<number, number>();
    private runs = 0;

    constructor(private readonly settings: SearchSettings, private readonly tools: SearchTools,
                private readonly progress: (runs: number) => void) {}

    async search(): Promise<SearchResult> {
        const {from, to} = this.settings;
        await this.makeRuns([...new Set(Array.from({length: coarsePoints}, (_, k) =>
            Math.round(from + (to - from) * k / (coarsePoints - 1))))]);
        for (;;) {
            const crossings = await this.tools.crossings(this.finished), found = crossings[controlling];
            // The brackets of all four rates are narrowed from the same runs.
            const missing = [...new Set(rates.flatMap((rate) => this.missingIn(crossings[rate])))];
            const more = missing.length > 0 ? missing : this.numbersForMoreRuns(found);
            if (more.length === 0)
                return {crossings, runs: this.runs, collapsed: this.runs - this.finished.length,
                        withinTolerance: this.isWithinTolerance(found)};
            if (missing.length === 0) for (const n of more) this.rounds.set(n, this.roundsAt(n) + 1);
            await this.makeRuns(more);
        }
    }

    private roundsAt(n: number): number { return this.rounds.get(n) ?? 0; }

    /** One run at each number; those with many discs take longest, so they come first. */
    private async makeRuns(numbers: number[]): Promise<void> {
        await Promise.all([...numbers].sort((a, b) => b - a).map(async (discs) => {
            const attempt = this.attempted.get(discs) ?? 0;
            this.attempted.set(discs, attempt + 1);
            const periods = this.settings.periods * 2 ** this.roundsAt(discs);
            const {rotation} = await this.tools.run(discs, this.settings.seed + attempt, periods);
            if (rotation) this.finished.push({discs, periods, rotation});
            this.progress(++this.runs);
        }));
        // The evaluation must not depend on the order in which the workers finish.
        this.finished.sort((a, b) => a.discs - b.discs || a.periods - b.periods);
    }

    /** Numbers in the bracket without a run: all if they are few, else the middle one. */
    private missingIn({before, after, discs}: Crossing): number[] {
        if (before === null || after === null || discs !== null) return [];
        const inside = Array.from({length: after - before - 1}, (_, k) => before + 1 + k)
            .filter((n) => !this.attempted.has(n));
        return inside.length <= gapAtOnce ? inside : [inside[inside.length >> 1]!];
    }

    private numbersForMoreRuns(found: Crossing): number[] {
        const {before, after, discs} = found;
        const open = (n: number): boolean => this.roundsAt(n) < this.settings.rounds;
        const inside = (n: number): boolean =>
            before !== null && after !== null && before <= n && n <= after;
        const outside = found.undetermined.filter(
            (n) => !inside(n) && open(n) && this.roundsAt(n) < maxSignRounds);
        if (discs === null || this.isWithinTolerance(found)) return outside;
        return [...outside, ...found.points.map(([n]) => n).filter((n) => inside(n) && open(n))];
    }

    private isWithinTolerance({verdict, error}: Crossing): boolean {
        if (verdict === "crosses") return error !== null && error <= this.settings.tolerance;
        return verdict !== "undecided";
    }
}

export function searchCrossing(settings: SearchSettings, tools: SearchTools,
                               progress: (runs: number) => void = () => {}): Promise<SearchResult> {
    return new Searcher(settings, tools, progress).search();
}
