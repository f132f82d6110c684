// Further actions on the container: move it by hand, compare it.
import type {Dish} from "../dish/dish";
import type {Laboratory} from "../engine/laboratory";
import {button, byId, element, localized} from "../elements/page";
import type {Player} from "../dish/player";
import type {Transport} from "../dish/transport";
import {texts} from "../texts/texts";

export function experiments(
    lab: Laboratory,
    dish: Dish,
    player: Player,
    transport: Transport,
): HTMLElement[] {
    const hand = button(
        texts.hand,
        () => {
            if (lab.isByHand || !lab.last) return lab.setByHand(false);
            transport.setView("lab");
            dish.pointer = [lab.last.frame[3]!, lab.last.frame[4]!];
            lab.setByHand(true);
            player.setPlaying(true);
        },
        "by-hand",
    );
    const compare = button(
        texts.compare,
        () => {
            const given = {...lab.given},
                name = [
                    lab.counted(lab.value("discs")),
                    ...Object.entries(given)
                        .filter(([key]) => key !== "discs")
                        .map(([key, value]) => localized(`${key} ${value}`)),
                ].join(", ");
            dish.compare(given, name);
        },
        "compare",
    );
    compare.title = texts.compareHelp;
    const forces = element("input", {type: "checkbox", id: "forces"});
    forces.addEventListener("change", () => {
        dish.forces = forces.checked;
        dish.redraw();
    });
    const keep = element("input", {type: "checkbox", id: "keep", checked: lab.keepsDiscs});
    keep.addEventListener("change", () => {
        lab.keepsDiscs = keep.checked;
    });
    const paint = button(texts.paint, () => transport.setColoring("sector"), "paint");
    paint.title = texts.paintHelp;
    const show = (): void => {
        hand.textContent = lab.isByHand ? texts.byHandStop : texts.hand;
        hand.setAttribute("aria-pressed", String(lab.isByHand));
        document.body.classList.toggle("by-hand", lab.isByHand);
    };
    for (const kind of ["begin", "started", "changed"] as const) lab.on(kind, show);
    byId("transport").querySelector(".buttons")!.after(hand);
    return [
        compare,
        paint,
        element("label", {title: texts.forcesHelp}, forces, ` ${texts.forces}`),
        element("label", {title: texts.keepHelp}, keep, ` ${texts.keep}`),
    ];
}
