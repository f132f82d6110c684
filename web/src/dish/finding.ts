// The direction in which a cluster rotates, as far as it is known.
import type {Cause, Rotation} from "../engine/engine";
import {intervalOf, liveEstimate} from "../engine/estimates";
import {signed, withError} from "../elements/page";
import {fill, texts} from "../texts/texts";

export type Direction = "with" | "against";
export interface Finding {
    /** ϖ/Ω, from periods after the warm-up if there are any; null without any data. */
    mean: number | null;
    /** The 95 % interval is mean ± 1.96 errors; null if it is not known yet. */
    error: number | null;
    direction: Direction | undefined;
    /** The interval excludes zero. */
    isFirm: boolean;
}

/** `turns` in the `periods` so far count while there is no complete period. */
export function findingOf(rotation: Rotation | undefined, turns: number, periods: number): Finding {
    const of = (mean: number | null, error: number | null = null): Finding => ({
        mean,
        error,
        direction: mean ? (mean > 0 ? "with" : "against") : undefined,
        isFirm: mean !== null && error !== null && Math.abs(mean) > intervalOf(error),
    });
    if (rotation) {
        const {mean, error} = liveEstimate(rotation);
        if (mean !== null && rotation.mean_by_time.blocks > 0) return of(mean, error);
        // In the warm-up the later half of the periods is closer to the steady state.
        const early = rotation.blocks.filter((each) => each !== null);
        const late = early.slice(Math.floor(early.length / 2));
        if (late.length > 0) return of(late.reduce((sum, each) => sum + each, 0) / late.length);
    }
    const counted = periods - (rotation && periods > rotation.warmup ? rotation.warmup : 0); // turns begin again with the averages
    return of(counted > 0.25 ? turns / counted : null);
}

/** ϖ/Ω with its error, as far as it is known. */
export function rotationText({mean, error}: Finding): string {
    return mean !== null && error === null ? signed(mean, 2) : withError(mean, error, texts.notYet);
}

/** The text below a container: its rotation, and with `cause` how well the cluster grips the wall.
 *  */
export const captionOf = (name: string, finding: Finding, cause?: Cause): string =>
    (finding.mean === null
        ? name
        : fill(texts.comparedResult, {
              name,
              rotation: rotationText(finding).replaceAll(" ", "\xa0"),
          })) +
    (cause && cause.slip !== null ? `\n${fill(texts.slip, {slip: signed(cause.slip, 2)})}` : "");
