// The bar below the container: time, view and colours.
import type {Dish, Views} from "./dish";
import {icon, type Icon} from "./icons";
import type {Laboratory} from "./laboratory";
import {byId, element} from "./page";
import type {Player} from "./player";
import type {Coloring} from "./scene";
import {texts} from "./texts";

function iconButton(id: string, name: Icon, label: string, act: () => void): HTMLButtonElement {
    const made = element("button", {type: "button", id, className: "icon", title: label}, icon(name));
    made.setAttribute("aria-label", label);
    made.addEventListener("click", act);
    return made;
}

/** A button that is on or off. */
function toggle(id: string, label: string, title: string, act: (on: boolean) => void): HTMLButtonElement {
    const made = element("button", {type: "button", id, className: "toggle", textContent: label, title});
    made.setAttribute("aria-pressed", "false");
    made.addEventListener("click", () => {
        const on = made.getAttribute("aria-pressed") !== "true";
        made.setAttribute("aria-pressed", String(on));
        act(on);
    });
    return made;
}

export function choice<Value extends string>(id: string, label: string, options: Record<Value, string>, value: Value,
                                             set: (value: Value) => void): HTMLSelectElement {
    const select = element("select", {id}, ...Object.entries<string>(options).map(
        ([each, text]) => element("option", {value: each, textContent: text})));
    select.value = value;
    select.addEventListener("change", () => set(select.value as Value));
    select.setAttribute("aria-label", label);
    select.title = label;
    return select;
}

export class Transport {
    private readonly play: HTMLButtonElement;
    private readonly view: HTMLSelectElement;
    private readonly coloring: HTMLSelectElement;

    constructor(lab: Laboratory, private readonly dish: Dish, private readonly player: Player) {
        this.play = iconButton("play", "play", texts.play, () => player.setPlaying(!player.isPlaying));
        const speed = element("input", {type: "range", min: "-3", max: "1", step: "0.1",
                                        value: String(Math.log10(player.pace)), id: "speed"});
        speed.addEventListener("input", () => { player.pace = 10 ** Number(speed.value); });
        this.view = choice<Views>("choose-view", texts.view, texts.views, dish.view,
                                                (value) => dish.setView(value));
        this.coloring = choice<Coloring>("choose-coloring", texts.color, texts.colors, dish.coloring,
            (value) => this.setColoring(value));
        byId("transport").replaceChildren(
            element("div", {className: "buttons"}, this.play,
                iconButton("step", "step", texts.step, () => player.step()),
                iconButton("restart", "restart", texts.restart, () => lab.begin()),
                iconButton("lapse", "lapse", texts.lapse, () => player.lapse())),
            toggle("strobe", texts.strobe, texts.strobeHelp, (on) => { dish.strobe = on; }),
            toggle("trails", texts.trails, texts.trailsHelp, (on) => { dish.trails = on; dish.redraw(); }),
            element("details", {id: "view-options"},
                element("summary", {title: texts.options}, icon("more")),
                element("div", {className: "menu", id: "options"})),
            element("label", {id: "pace", className: "optional", title: texts.speedHelp}, element("span", {textContent: texts.speed}), speed),
            this.view, this.coloring);
        for (const each of [this.view, this.coloring, byId("step")]) each.classList.add("optional");
        byId("view-options").querySelector("summary")!.setAttribute("aria-label", texts.options);
        player.onChange(() => this.show());
        this.show();
    }

    setView(view: Views): void {
        this.view.value = view;
        this.dish.setView(view);
    }

    setColoring(coloring: Coloring): void {
        this.coloring.value = coloring;
        this.dish.coloring = coloring;
        if (coloring === "sector") this.dish.repaint();
        this.dish.redraw();
    }

    nextView(): void { this.choose(this.view); }
    nextColoring(): void { this.choose(this.coloring); }

    private choose(select: HTMLSelectElement): void {
        select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
        select.dispatchEvent(new Event("change"));
    }

    private show(): void {
        const {play, player} = this, label = player.isPlaying ? texts.pause : texts.play;
        play.replaceChildren(icon(player.isPlaying ? "pause" : "play"));
        play.title = label;
        play.setAttribute("aria-label", label);
    }
}
