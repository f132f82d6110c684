// The texts of the page in the language of its reader (start.ts). Each language has a file
// texts.*.json with the same keys; names in braces stand for values. A test compares the files.
import * as de from "./texts.de.json";
import * as en from "./texts.en.json";
import rules from "./texts.engine.de.json";
import {labelled} from "./symbols";
import {language} from "./start";

export {symbols} from "./symbols";
export {fill} from "./worker_texts";

const german = language === "de";

type Names = Record<string, string>;
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

const translatedLine = (line: string): string => {
    const [, hint, text] = /^(hint: )?(.*)$/.exec(line)!;
    for (const [pattern, translation] of rules) {
        const found = new RegExp(pattern!);
        if (found.test(text!)) return (hint ? "Tipp: " : "") + text!.replace(found, translation!);
    }
    return line;
};

/** The message in German. Options are written as the names of their fields. */
export const translated = (message: string, labels: Record<string, string>): string =>
    labelled(message.split("\n").map(translatedLine).join("\n"), labels, false).replace(
        /(\d)\.(?=\d)/g,
        "$1,",
    );

/** An error message of the engine in the language of the page. */
export const engineMessage = (message: string): string =>
    german ? translated(message, texts.labels) : labelled(message, texts.labels);

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
