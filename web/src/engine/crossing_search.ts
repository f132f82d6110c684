// N_c of one setting with few runs: the search of `swirl crossing`
// (src/swirl/statistics/crossing_search.hpp), which the engine steers, with shorter runs, so that
// it takes seconds.
import type {NextRuns, Rate, SearchRules} from "./engine";
import type {Crossings, EvaluatedRun, FinishedRun, SearchedRun} from "./runs";

export interface SearchSettings extends SearchRules {
    /** Length of the first runs after the warm-up, in periods. */
    periods: number;
    seed: number;
}
export const usualSearch: SearchSettings = {
    from: 5,
    to: 48,
    periods: 66,
    tolerance: 0.25,
    rounds: 4,
    seed: 1,
};

/** What the search needs: a run, the next runs after those made, and the evaluation of all runs. */
export interface SearchTools {
    run(discs: number, seed: number, periods: number): Promise<FinishedRun>;
    search(rules: SearchRules, made: SearchedRun[]): Promise<NextRuns>;
    crossings(runs: EvaluatedRun[]): Promise<Crossings>;
}

export interface SearchResult {
    crossings: Crossings;
    runs: number;
    collapsed: number;
    withinTolerance: boolean;
}

/** The rate that controls the search. */
export const controlling: Rate = "mean_by_time";

export async function searchCrossing(
    settings: SearchSettings,
    tools: SearchTools,
    progress: (runs: number) => void = () => {},
): Promise<SearchResult> {
    const made: SearchedRun[] = [],
        finished: EvaluatedRun[] = [];
    let count = 0;
    for (;;) {
        const {runs, within_tolerance: withinTolerance} = await tools.search(settings, made);
        if (runs.length === 0)
            return {
                crossings: await tools.crossings(finished),
                runs: count,
                collapsed: count - finished.length,
                withinTolerance,
            };
        const step = await Promise.all(
            runs.map(async ([discs, replicate, length]) => {
                const periods = settings.periods * length;
                const {rotation} = await tools.run(discs, settings.seed + replicate, periods);
                progress(++count);
                return {discs, periods, rotation};
            }),
        );
        made.push(...step);
        for (const {discs, periods, rotation} of step)
            if (rotation) finished.push({discs, periods, rotation});
    }
}
