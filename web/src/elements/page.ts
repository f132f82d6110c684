// Creates and finds elements of the page, and formats its numbers.
import {language} from "../texts/start";

export function element<Tag extends keyof HTMLElementTagNameMap>(
    tag: Tag,
    properties: Partial<HTMLElementTagNameMap[Tag]> = {},
    ...children: (Node | string)[]
): HTMLElementTagNameMap[Tag] {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...children);
    return made;
}

/** A text with elements in place of the names in braces. */
export const withElements = (
    text: string,
    elements: Record<string, HTMLElement>,
): (string | HTMLElement)[] =>
    text.split(/\{(\w+)\}/).map((each, k) => (k % 2 ? elements[each]! : each));

export function byId(id: string): HTMLElement {
    const found = document.getElementById(id);
    if (!found) throw new Error(`The page has no element '${id}'.`);
    return found;
}

export function button(text: string, act: () => void, id = ""): HTMLButtonElement {
    const made = element("button", {type: "button", textContent: text, id});
    made.addEventListener("click", act);
    return made;
}

const downloadStarts = 60_000; // milliseconds; there is no event for the end of a save dialog

/** Downloads a text, bytes, or the content at an address. */
export function save(
    name: string,
    content: {href: string} | {bytes: Blob} | {text: string; type: string},
): void {
    if ("href" in content) {
        element("a", {href: content.href, download: name}).click();
        return;
    }
    const href = URL.createObjectURL(
        "bytes" in content ? content.bytes : new Blob([content.text], {type: content.type}),
    );
    element("a", {href, download: name}).click();
    // The address keeps its content in memory until it is revoked.
    setTimeout(() => URL.revokeObjectURL(href), downloadStarts);
}

/** The font of the page for a canvas. */
export const canvasFont = (weight: number, pixels: number): string =>
    `${weight} ${pixels}px ${getComputedStyle(document.documentElement).fontFamily}`;

const style = (name: string): string =>
    getComputedStyle(document.documentElement).getPropertyValue(name);
export const ink = (): string => style("--ink");
export const line = (): string => style("--line");
export const quiet = (): string => style("--quiet");
export const paper = (): string => style("--paper");
export const accent = (): string => style("--accent");
/** The colour of a rotation rate, which is negative against the swirl. */
export const directionColor = (rate: number): string => style(rate < 0 ? "--against" : "--with");
export const dark = (): boolean => matchMedia("(prefers-color-scheme: dark)").matches;

/** Numbers with the decimal sign of the page's language. */
export const localized = (text: string): string =>
    language === "de" ? text.replace(/(\d)\.(?=\d)/g, "$1,") : text;
/** A number as it was typed, with a decimal point. */
export const typedNumber = (text: string): string =>
    language === "de" ? text.replaceAll(",", ".") : text;
/** A list as it was typed, separated by commas; where these are decimal signs, semicolons separate.
 *  */
export const typedList = (text: string): string =>
    language === "de" ? typedNumber(text).replaceAll(";", ",") : text;
export const shownList = (text: string): string =>
    language === "de" ? localized(text.replaceAll(",", ";")) : text;

/** With a minus sign. */
export const signed = (x: number, decimals: number): string =>
    localized(x.toFixed(decimals).replace("-", "−"));

export function withError(mean: number | null, error: number | null, unknown: string): string {
    if (mean === null) return unknown;
    if (error === null || !(error > 0)) return signed(mean, 3);
    const decimals = Math.min(6, Math.max(0, 1 - Math.floor(Math.log10(error))));
    return `${signed(mean, decimals)} ± ${signed(error, decimals)}`;
}
