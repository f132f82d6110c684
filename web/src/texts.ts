// The texts of the page in the language of its reader (start.ts). Each language has its file.
import * as de from "./texts.de";
import * as en from "./texts.en";
import {labelled} from "./symbols";
import {translated} from "./texts.engine.de";
import {language} from "./start";

export {symbols} from "./symbols";
export type {StepTexts} from "./texts.en";

const german = language === "de";

export const texts: typeof en.texts = german ? de.texts : en.texts;
export const lessonSteps: en.StepTexts[] = german ? de.lessonSteps : en.lessonSteps;
export const worksheet: typeof en.worksheet = german ? de.worksheet : en.worksheet;
export const team: typeof en.team = german ? de.team : en.team;
export const examples: typeof en.examples = german ? de.examples : en.examples;
/** Separate, so that the worker does not contain the texts of the page. */
export const workerTexts: typeof en.workerTexts = german ? de.workerTexts : en.workerTexts;

/** An error message of the engine in the language of the page. */
export const engineMessage = (message: string): string => german ? translated(message, texts.labels) : labelled(message, texts.labels);

/** Replaces the texts of index.html, which are built in as English ones. */
export function translatePage(): void {
    if (!german) return;
    document.documentElement.lang = de.pageTexts.language;
    document.title = de.pageTexts.title;
    const known = new Map(Object.entries(en.pageTexts).map(
        ([name, text]) => [text, de.pageTexts[name as keyof typeof en.pageTexts]]));
    const nodes = document.createTreeWalker(document.documentElement, NodeFilter.SHOW_ELEMENT | NodeFilter.SHOW_TEXT);
    for (let node = nodes.nextNode(); node; node = nodes.nextNode()) {
        if (node instanceof Element) {
            for (const {name, value} of [...node.attributes]) {
                const text = known.get(value);
                if (text && name !== "id" && name !== "class") node.setAttribute(name, text);
            }
            continue;
        }
        const shown = node.textContent ?? "", text = known.get(shown.trim());
        if (text) node.textContent = shown.replace(shown.trim(), () => text);
    }
}
