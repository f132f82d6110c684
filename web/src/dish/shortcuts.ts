// The keys of the page, and the list of them.
import type {Laboratory} from "../engine/laboratory";
import {button, byId, element} from "../elements/page";
import type {Player} from "./player";
import type {Transport} from "./transport";
import {texts} from "../texts/texts";

/** Opens or closes the list of details that contains this element, and goes there. */
function open(id: string, details: () => HTMLDetailsElement | null): void {
    const found = details();
    if (!found) return byId(id).querySelector("button")?.click();
    found.open = !found.open;
    if (!found.open) return;
    found.querySelector("summary")?.focus();
    found.scrollIntoView({block: "nearest"});
}
const detailsIn = (id: string) => (): HTMLDetailsElement | null =>
    byId(id).querySelector("details");

export function addShortcuts(lab: Laboratory, player: Player, transport: Transport): void {
    const change = (by: number): void =>
        lab.set({
            discs: String(
                Math.max(1, Number(lab.given["discs"] || lab.effectiveValue("discs")) + by),
            ),
        });
    const click = (id: string) => (): void => byId(id).click();
    const acts: Record<string, () => void> = {
        " ": () => player.setPlaying(!player.isPlaying),
        r: () => lab.begin(),
        s: click("strobe"),
        v: () => transport.nextView(),
        c: () => transport.nextColoring(),
        p: click("paint"),
        h: click("by-hand"),
        "+": () => change(1),
        "-": () => change(-1),
        o: () => open("viewing", detailsIn("viewing")),
        m: () => open("more", detailsIn("more")),
        l: () => open("lesson-start", () => null),
        e: () => open("explorer", detailsIn("explorer")),
        d: () => open("share", detailsIn("share")),
        "?": () => dialog.showModal(),
    };
    const isOn = element("input", {type: "checkbox", id: "keys-on", checked: true});
    const dialog = element(
        "dialog",
        {id: "keys"},
        element("h2", {textContent: texts.keys}),
        element(
            "dl",
            {},
            ...Object.entries(texts.keyNames).flatMap(([, [key, act]]) => [
                element("dt", {}, element("kbd", {textContent: key})),
                element("dd", {textContent: act}),
            ]),
        ),
        element("p", {textContent: texts.keysOfDish}),
        element("label", {}, isOn, ` ${texts.keysOn}`),
        button(texts.close, () => dialog.close()),
    );
    dialog.setAttribute("aria-label", texts.keys);
    dialog.addEventListener("click", (event) => {
        if (event.target === dialog) dialog.close();
    });
    document.body.append(dialog);
    const help = button("?", () => dialog.showModal(), "keys-open");
    help.title = texts.keys;
    help.setAttribute("aria-label", texts.keys);
    byId("top").append(help);
    document.addEventListener("keydown", (event) => {
        const target = event.target as HTMLElement,
            isTyped = target.matches("input:not([type=checkbox]), select, textarea");
        if (
            !isOn.checked ||
            dialog.open ||
            isTyped ||
            event.ctrlKey ||
            event.metaKey ||
            event.altKey
        )
            return;
        if (event.key === " " && target.matches("button, summary, input")) return;
        const act = acts[event.key.toLowerCase()];
        if (!act) return;
        event.preventDefault();
        act();
    });
}
