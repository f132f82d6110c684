// Errors of the page. The mean ± 1.96 errors is the 95 % interval, as in src/swirl/statistics/replicates.hpp, however
// few values there are.
//
// The blocks of a single run do not give its error: at N = 48 the discs remember their arrangement for tens of periods,
// and intervals from single periods contain the true value in 75 to 87 of 100 cases. The error of a point is therefore
// that between runs with different seeds, and the error of the run on display that between its quarters, which are the
// longest blocks that it has. web/test/coverage.mjs measures how often these intervals contain the true value.
import type {Rotation} from "./engine";

export interface MeanWithError {
    mean: number | null;
    error: number | null;
}

/** Student's t for 95 % (Abramowitz and Stegun 26.7.5), within 1 % from three degrees of freedom on. */
export function student95(freedom: number): number {
    const z = 1.959964, z2 = z * z;
    return z * (1 + (z2 + 1) / (4 * freedom) + ((5 * z2 + 16) * z2 + 3) / (96 * freedom ** 2) +
        (((3 * z2 + 19) * z2 + 17) * z2 - 15) / (384 * freedom ** 3));
}

const meanOf = (values: readonly number[]): number => values.reduce((sum, each) => sum + each, 0) / values.length;

/** The mean of independent values, at least four, with the error from their scatter. */
export function estimateOf(values: readonly number[]): {mean: number; error: number} {
    const mean = meanOf(values), n = values.length;
    const variance = values.reduce((sum, each) => sum + (each - mean) ** 2, 0) / (n - 1);
    return {mean, error: student95(n - 1) / 1.96 * Math.sqrt(variance / n)};
}

/** Half of the 95 % interval. */
export const intervalOf = (error: number): number => 1.96 * error;

const quarters = 4;
/** The quarters of a run are not independent. At 28 and 48 discs, and for 50 and 100 periods, the scatter between 180 runs
 *  is 1.06 to 1.22 times that from their quarters (web/test/coverage.mjs). */
const memory = 1.15;
/** A shorter run has no error: its quarters would be shorter than its memory. */
export const minPeriods = 50;

/** ϖ/Ω of a run that is still growing, by time. Periods at the beginning that fill no quarter count for the mean only. */
export function liveEstimate(rotation: Rotation): MeanWithError {
    const {blocks, warmup_blocks: early, periods_per_block: [, periods], mean_by_time: {mean}} = rotation;
    const late = blocks.slice(early).filter((each) => each !== null);
    if (mean === null || late.length * periods < minPeriods || late.length < quarters) return {mean, error: null};
    const size = Math.floor(late.length / quarters), begin = late.length - quarters * size;
    const means = Array.from({length: quarters}, (_, k) => meanOf(late.slice(begin + k * size, begin + (k + 1) * size)));
    return {mean, error: memory * estimateOf(means).error};
}
