// The page's address: the parameters, a number of events to run to, and the points of the plot. It
// is all that the page stores, so that two tabs have nothing in common, and nothing can be full or
// blocked.
import type {Laboratory} from "./engine/laboratory";
import {addressOf} from "./dish/share";
import {isEmbedded, pageEntry, setPageEntry, startParameters} from "./texts/start";
import {fill, texts} from "./texts/texts";

const maxEvents = 1e7,
    maxBeside = 300;

/** The number of discs of the container next to the first: the one in the address, or for a new
 *  visitor a few. Undefined if there is none. */
export function readBeside(lab: Laboratory, isNew: boolean): string | undefined {
    const text = pageEntry("beside") ?? (isNew && !isEmbedded() ? "8" : undefined);
    if (text === undefined) return undefined;
    const isValid = /^\d+$/.test(text) && Number(text) >= 1 && Number(text) <= maxBeside;
    setPageEntry("beside", isValid ? text : undefined);
    if (!isValid)
        lab.warn(fill(texts.invalidNumber, {name: "beside", text, from: 1, to: maxBeside}));
    return isValid ? text : undefined;
}

/** The parameters in the address, and the number of events to run to. Undefined after an error
 *  message. */
export function readAddress(
    lab: Laboratory,
): {given: Record<string, string>; events: number} | undefined {
    const given: Record<string, string> = {};
    let events = 0;
    for (const [name, value] of startParameters(lab.isParameter)) {
        if (name === "events") {
            events = value.trim() === "" ? NaN : Number(value);
            if (Number.isInteger(events) && events >= 0 && events <= maxEvents) continue;
            lab.fail(fill(texts.invalidEvents, {text: value}));
            return undefined;
        }
        given[name] = value;
    }
    return {given, events};
}

/** A random seed of four digits. */
export const newSeed = (): string =>
    String(1000 + (crypto.getRandomValues(new Uint32Array(1))[0]! % 9000));

const settling = 250; // milliseconds; browsers allow about three changes per second

/** Keeps the address up to date. `fragment` is its part after #. Returns a function to call when
 *  that has changed. */
export function followAddress(lab: Laboratory, fragment: () => string): () => void {
    let later: ReturnType<typeof setTimeout> | undefined;
    const write = (): void => {
        clearTimeout(later);
        later = undefined;
        try {
            const hash = fragment();
            window.history.replaceState(null, "", addressOf(lab.given) + (hash && `#${hash}`));
        } catch {
            // In some browsers the address of a local file cannot be changed.
        }
    };
    const follow = (): void => {
        later ??= setTimeout(write, settling);
    };
    lab.on("given", follow);
    addEventListener("pagehide", () => {
        if (later !== undefined) write();
    });
    return follow;
}
