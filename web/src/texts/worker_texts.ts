// The texts of the engine's worker, separate so that the worker does not contain those of the page.
import {worker as de} from "./texts.de.json";
import {worker as en} from "./texts.en.json";
import {language} from "./start";

export const workerTexts: typeof en = language === "de" ? de : en;

/** A number of a message, with a decimal comma in German. */
const shown = (x: number, isGerman: boolean): string => {
    const text = Math.abs(x) < 1e15 ? String(x) : x.toExponential();
    return isGerman ? text.replace(".", ",") : text;
};

/** Replaces {name} by a value, and {name|one|several} by one of two texts, of which the first is
 *  for 1. */
export const fill = (
    text: string,
    values: Record<string, string | number>,
    isGerman = language === "de",
): string =>
    text
        .replace(
            /\{(\w+)\|((?:[^{}|]|\{\w+\})*)\|((?:[^{}]|\{\w+\})*)\}/g,
            (_, name: string, one: string, several: string) => (values[name] === 1 ? one : several),
        )
        .replace(/\{(\w+)\}/g, (_, name: string) => {
            const value = values[name] ?? `{${name}}`;
            return typeof value === "number" ? shown(value, isGerman) : String(value);
        });
