// The error of the run on display. The mean ± 1.96 errors is the 95 % interval, as in src/swirl/statistics/replicates.hpp.
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

/** Half of the 95 % interval. */
export const intervalOf = (error: number): number => 1.96 * error;

const quarters = 4;
/** Student's t for 95 % and three degrees of freedom, relative to 1.96
 *  (src/swirl/statistics/student.hpp). */
const student = 3.182446 / 1.959964;
/** The quarters of a run are not independent. At 28 and 48 discs, and for 50 and 100 periods, the
 *  scatter between 180 runs is 1.06 to 1.22 times that from their quarters (web/test/coverage.mjs).
 *  */
const memory = 1.15;
/** A shorter run has no error: its quarters would be shorter than its memory. */
export const minPeriods = 50;

const meanOf = (values: readonly number[]): number =>
    values.reduce((sum, each) => sum + each, 0) / values.length;

/** ϖ/Ω of a run that is still growing, by time. Periods at the beginning that fill no quarter count
 *  for the mean only. */
export function liveEstimate(rotation: Rotation): MeanWithError {
    const {
        blocks,
        warmup_blocks: early,
        periods_per_block: [, periods],
        mean_by_time: {mean},
    } = rotation;
    const late = blocks.slice(early).filter((each) => each !== null);
    if (mean === null || late.length * periods < minPeriods || late.length < quarters)
        return {mean, error: null};
    const size = Math.floor(late.length / quarters),
        begin = late.length - quarters * size;
    const means = Array.from({length: quarters}, (_, k) =>
        meanOf(late.slice(begin + k * size, begin + (k + 1) * size)),
    );
    const middle = meanOf(means),
        square = meanOf(means.map((each) => (each - middle) ** 2));
    return {mean, error: memory * student * Math.sqrt(square / (quarters - 1))};
}
