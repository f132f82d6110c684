// The texts of the page in the language of its reader (start.ts). Each language has a file
// texts.*.json with the same keys; names in braces stand for values. A test compares the files.
import * as de from "./texts.de.json";
import * as en from "./texts.en.json";
import sentencesOfEngine from "./texts.engine.de.json";
import type {Message, Sentence, SentenceValue} from "./message";
import {labelled} from "./symbols";
import {language} from "./start";
import {fill} from "./worker_texts";

export {symbols} from "./symbols";
export {fill} from "./worker_texts";

const german = language === "de";

type Names = Record<string, string>;
type Values = Record<string, string | number>;
/** One sentence for each code of src/swirl/run/sentences.hpp. */
const germanOf: Names = sentencesOfEngine;
/** Tables that are read by the names of parameters. */
type Tables = {labels: Names; symbolOf: Names; groups: Names; descriptions: Names};
export const texts: Omit<typeof en.texts, keyof Tables> & Tables = german ? de.texts : en.texts;
export const lessonSteps: {
    title: string;
    text: string;
    question: string;
    options?: string[];
    explanation: string;
}[] = german ? de.lessonSteps : en.lessonSteps;
export const worksheet: typeof en.worksheet = german ? de.worksheet : en.worksheet;
export const team: typeof en.team = german ? de.team : en.team;
export const examples: {name: string; help: string; given: Names}[] = (
    german ? de.examples : en.examples
) as {name: string; help: string; given: Names}[];

/** The names of parameters in English, where the language of the page has no other. */
export function nameParameters(rows: readonly {name: string; label: string}[]): void {
    for (const {name, label} of rows) texts.labels[name] ??= label;
}

/** "1 disc", "48 discs": with the singular and the plural. */
export const counted = (n: number, [one, several]: readonly string[]): string =>
    `${n} ${n === 1 ? one : several}`;

/** The value of a sentence in German. */
const valueInGerman = (value: SentenceValue): string | number => {
    if (typeof value === "number") return value;
    if (Array.isArray(value)) return sentencesInGerman(value);
    if (typeof value === "object")
        return value.words.replaceAll("\n", ", ").replace(/, (?=[^,]*$)/, " oder ");
    return /^-?\d+\.\d+$/.test(value) ? value.replace(".", ",") : value;
};
const sentencesInGerman = (sentences: readonly Sentence[]): string =>
    sentences
        .map(({code, values}) => {
            const shown = Object.entries(values).map(([name, value]) => [
                name,
                valueInGerman(value),
            ]);
            return fill(germanOf[code] ?? code, Object.fromEntries(shown) as Values, true);
        })
        .join("");

/** A message in German. Options are written as the names of their fields. */
export const inGerman = ({text, sentences}: Message, labels: Names): string =>
    labelled(sentences.length > 0 ? sentencesInGerman(sentences) : text, labels, false);

/** Without the middle of a long value, such as a list of sizes. */
const shortened = (text: string): string =>
    text.length < 1000 ? text : `${text.slice(0, 400)} … ${text.slice(-400)}`;

/** An error message of the engine in the language of the page. */
export const engineMessage = (message: Message): string =>
    shortened(german ? inGerman(message, texts.labels) : labelled(message.text, texts.labels));

/** Replaces the texts of index.html, which are built in as English ones. */
export function translatePage(): void {
    if (!german) return;
    document.documentElement.lang = de.page.language;
    document.title = de.page.title;
    const known = new Map(
        Object.entries(en.page).map(([name, text]) => [
            text,
            de.page[name as keyof typeof en.page],
        ]),
    );
    const nodes = document.createTreeWalker(
        document.documentElement,
        NodeFilter.SHOW_ELEMENT | NodeFilter.SHOW_TEXT,
    );
    for (let node = nodes.nextNode(); node; node = nodes.nextNode()) {
        if (node instanceof Element) {
            for (const {name, value} of [...node.attributes]) {
                const text = known.get(value);
                if (text && name !== "id" && name !== "class") node.setAttribute(name, text);
            }
            continue;
        }
        const shown = node.textContent ?? "",
            text = known.get(shown.trim());
        if (text) node.textContent = shown.replace(shown.trim(), () => text);
    }
}
