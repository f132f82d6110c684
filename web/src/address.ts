// The page's address: the parameters, and a number of events to run to.
import type {Laboratory} from "./laboratory";
import {addressOf} from "./share";
import {startParameters} from "./start";
import {texts} from "./texts";

const maxEvents = 1e7;

/** The parameters in the address, and the number of events to run to. Undefined after an error message. */
export function readAddress(lab: Laboratory): {given: Record<string, string>; events: number} | undefined {
    const given: Record<string, string> = {};
    let events = 0;
    for (const [name, value] of startParameters()) {
        if (name === "events") {
            events = Number(value);
            if (Number.isInteger(events) && events >= 0 && events <= maxEvents) continue;
            lab.fail(texts.invalidEvents(value));
            return undefined;
        }
        if (!lab.parameters.some((row) => row.name === name && row.settable)) {
            lab.fail(texts.unknownParameter(name));
            return undefined;
        }
        given[name] = value;
    }
    return {given, events};
}

/** Keeps the address up to date. */
export function followAddress(lab: Laboratory): void {
    lab.on("given", () => {
        try {
            window.history.replaceState(null, "", addressOf(lab.given));
        } catch {
            // In some browsers the address of a local file cannot be changed.
        }
    });
}
