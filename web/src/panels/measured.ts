// Turns that were counted at a real dish: points with the error of counting.
import type {ChartPoint} from "../elements/chart";

/** Number of particles, turns of the cluster (negative: against the swirl), and circles of the
 *  dish. */
export type Measured = [number, number, number];

/** A mark is read at the beginning and at the end, each to about a twelfth of a turn, like the hour
 *  on a clock. */
const readingError = Math.SQRT2 / 12; // turns
const most = 60; // points in a link

function rowOf(words: string[]): Measured | undefined {
    const [n, turns, circles, ...more] = words.map(Number) as [number, number, number, ...number[]];
    const isValid =
        words.length === 3 &&
        more.length === 0 &&
        Number.isInteger(n) &&
        n >= 1 &&
        n <= 20_000 &&
        Math.abs(turns) <= 1e4 &&
        circles >= 1 &&
        circles <= 1e5 &&
        Math.abs(turns) <= 3 * circles + 1;
    return isValid ? [n, turns, circles] : undefined;
}

/** Lines "N turns circles", and the first line that is none. */
export function measuredFrom(
    text: string,
    between: string | RegExp = "\n",
    within: string | RegExp = /[\s;]+/,
): {rows: Measured[]; wrong: string | undefined} {
    const lines = text
        .split(between)
        .map((line) => line.trim())
        .filter(Boolean)
        .slice(0, most);
    const rows = lines.map((line) => rowOf(line.replaceAll("−", "-").split(within)));
    return {
        rows: rows.filter((row) => row !== undefined),
        wrong: lines.find((_, k) => rows[k] === undefined),
    };
}

/** As text for a link: "8_4.4_20,…". */
export const measuredText = (rows: readonly Measured[]): string =>
    rows.map((row) => row.join("_")).join(",");
export const measuredFromLink = (text: string): ReturnType<typeof measuredFrom> =>
    measuredFrom(text, ",", "_");

/** ϖ/Ω of a row and its standard error. */
export const rateOf = ([, turns, circles]: Measured): [number, number] => [
    turns / circles,
    readingError / circles,
];

export function measuredPoints(rows: readonly Measured[]): ChartPoint[] {
    return rows
        .map((row) => {
            const [y, error] = rateOf(row);
            return {x: row[0], y, lower: y - 1.96 * error, upper: y + 1.96 * error};
        })
        .sort((a, b) => a.x - b.x);
}
