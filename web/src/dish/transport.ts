// The bar below the container for time, and the panel for view and colours.
import type {Dish, Views} from "./dish";
import {icon, type Icon} from "../elements/icons";
import type {Laboratory} from "../engine/laboratory";
import {byId, element} from "../elements/page";
import type {Player} from "./player";
import type {Coloring} from "../drawing/view";
import {pageEntry, setPageEntry} from "../texts/start";
import {fill, texts} from "../texts/texts";

function iconButton(id: string, name: Icon, label: string, act: () => void): HTMLButtonElement {
    const made = element(
        "button",
        {type: "button", id, className: "icon", title: label},
        icon(name),
    );
    made.setAttribute("aria-label", label);
    made.addEventListener("click", act);
    return made;
}

/** A button that is on or off. */
function toggle(
    id: string,
    label: string,
    title: string,
    act: (on: boolean) => void,
): HTMLButtonElement {
    const made = element("button", {
        type: "button",
        id,
        className: "toggle",
        textContent: label,
        title,
    });
    made.setAttribute("aria-pressed", "false");
    made.addEventListener("click", () => {
        const on = made.getAttribute("aria-pressed") !== "true";
        made.setAttribute("aria-pressed", String(on));
        act(on);
    });
    return made;
}

export function choice<Value extends string>(
    id: string,
    label: string,
    options: Record<Value, string>,
    value: Value,
    set: (value: Value) => void,
): HTMLSelectElement {
    const select = element(
        "select",
        {id},
        ...Object.entries<string>(options).map(([each, text]) =>
            element("option", {value: each, textContent: text}),
        ),
    );
    select.value = value;
    select.addEventListener("change", () => set(select.value as Value));
    select.setAttribute("aria-label", label);
    select.title = label;
    return select;
}

export class Transport {
    /** Called when the way in which the page shows the container has changed. */
    changed: () => void = () => {};
    private readonly play: HTMLButtonElement;
    private readonly view: HTMLSelectElement;
    private readonly coloring: HTMLSelectElement;

    constructor(
        private readonly lab: Laboratory,
        private readonly dish: Dish,
        private readonly player: Player,
    ) {
        this.play = iconButton("play", "play", texts.play, () =>
            player.setPlaying(!player.isPlaying),
        );
        const strobe = toggle("strobe", texts.strobe, texts.strobeHelp, (on) => {
            dish.strobe = on;
            this.keep("strobe", Number(on), 0);
        });
        this.view = choice<Views>("choose-view", texts.view, texts.views, dish.view, (value) =>
            this.setView(value),
        );
        this.coloring = choice<Coloring>(
            "choose-coloring",
            texts.color,
            texts.colors,
            dish.coloring,
            (value) => this.setColoring(value),
        );
        byId("transport").replaceChildren(
            element(
                "div",
                {className: "buttons"},
                this.play,
                iconButton("restart", "restart", texts.restart, () => lab.begin()),
            ),
        );
        byId("viewing").replaceChildren(
            element(
                "details",
                {},
                element("summary", {textContent: texts.options}),
                element("div", {className: "bar", id: "options"}, this.view, this.coloring, strobe),
            ),
        );
        player.onChange(() => this.show());
        this.show();
    }

    /** What the address has, as far as it is known; call it when the dish is laid out. */
    readAddress(): void {
        const choose = <Word extends string>(
            name: string,
            words: Record<Word, string>,
            set: (word: Word) => void,
        ): void => {
            const text = pageEntry(name);
            if (text !== null && Object.hasOwn(words, text)) set(text as Word);
            else if (text !== null)
                this.reject(
                    name,
                    fill(texts.invalidWord, {name, text, words: Object.keys(words).join(", ")}),
                );
        };
        choose("view", texts.views, (view) => this.setView(view));
        choose("color", texts.colors, (color) => this.setColoring(color));
        choose("strobe", {0: "", 1: ""}, (on) => {
            if (on === "1") byId("strobe").click();
        });
    }

    /** A value of the address that is not valid is reported and forgotten. */
    private reject(name: string, message: string): void {
        this.lab.warn(message);
        setPageEntry(name, undefined);
    }

    /** Keeps a value for later addresses, unless it is the usual one. */
    private keep(name: string, value: string | number, usual: string | number): void {
        setPageEntry(name, value === usual ? undefined : String(value));
        this.changed();
    }

    setView(view: Views): void {
        this.keep("view", view, "lab");
        this.view.value = view;
        this.dish.setView(view);
    }

    setColoring(coloring: Coloring): void {
        this.keep("color", coloring, "sector");
        this.coloring.value = coloring;
        this.dish.coloring = coloring;
        if (coloring === "sector") this.dish.repaint();
        this.dish.redraw();
    }

    nextView(): void {
        this.choose(this.view);
    }
    nextColoring(): void {
        this.choose(this.coloring);
    }

    private choose(select: HTMLSelectElement): void {
        select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
        select.dispatchEvent(new Event("change"));
    }

    private show(): void {
        const {play, player} = this,
            label = player.isPlaying ? texts.pause : texts.play;
        play.replaceChildren(icon(player.isPlaying ? "pause" : "play"));
        play.title = label;
        play.setAttribute("aria-label", label);
    }
}
