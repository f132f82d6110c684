// The controls of the parameters: large sliders for the most important ones, and the others in
// groups.
import type {Parameter} from "../engine/engine";
import type {Laboratory} from "../engine/laboratory";
import {byId, element, localized, typedNumber} from "../elements/page";
import {optionOf} from "../texts/symbols";
import {fill, texts} from "../texts/texts";

/** The inputs of a parameter: a text or a choice of words, and an optional slider. */
interface Field {
    parameter: Parameter;
    row: HTMLElement;
    text: HTMLInputElement | HTMLSelectElement;
    slider?: HTMLInputElement;
}

/** Whether a parameter has an effect with these values in effect. */
function applies(
    {applies_to}: Parameter,
    {body, floor, restitution, path}: Record<string, string>,
): boolean {
    const sphere = body === "sphere",
        onFloor = floor !== undefined && floor !== "none";
    switch (applies_to) {
        case "every_run":
            return true;
        case "dissipation":
            return Number(restitution) < 1;
        case "floor":
            return onFloor;
        case "rolling_spheres":
            return onFloor && sphere;
        case "spheres":
            return sphere;
        case "polygons":
            return path !== "circle";
    }
}

/** At most four significant digits. */
const shortened = (value: string): string =>
    /^\d*\.\d{4,}$/.test(value) ? String(Number(Number(value).toPrecision(4))) : value;

/** The words among the values of a parameter, from its form: "none|sliding", "NUMBER|paper|solid".
 *  */
const wordsOf = ({form}: Parameter): string[] =>
    form.split("|").filter((word) => /^[a-z-]+$/.test(word));

/** A list of choices if all values are words; a text field with suggestions if numbers are allowed,
 *  too. */
function textField(row: Parameter, id: string): [Field["text"], ...HTMLElement[]] {
    const words = wordsOf(row);
    if (words.length > 0 && words.length === row.form.split("|").length)
        return [
            element(
                "select",
                {id},
                ...(words.includes(row.default) ? words : ["", ...words]).map((word) =>
                    element("option", {value: word, textContent: word}),
                ),
            ),
        ];
    const text = element("input", {
        type: "text",
        id,
        spellcheck: false,
        autocomplete: "off",
        inputMode: words.length === 0 && row.slider ? "decimal" : "text",
    });
    if (words.length === 0) return [text];
    text.setAttribute("list", `${id}-words`);
    return [
        text,
        element(
            "datalist",
            {id: `${id}-words`},
            ...words.map((word) => element("option", {value: word})),
        ),
    ];
}

/** A value that is no number, such as a word or two coefficients, leaves the slider without a
 *  thumb. */
function showOn(slider: HTMLInputElement, value: string): void {
    const isNumber = value !== "" && Number.isFinite(Number(value));
    if (isNumber) slider.value = value;
    slider.setAttribute("aria-valuetext", localized(value));
    slider.classList.toggle("unset", !isNumber);
    const share = isNumber
        ? (Number(slider.value) - Number(slider.min)) / (Number(slider.max) - Number(slider.min))
        : 0;
    slider.style.setProperty("--share", `${100 * share}%`);
}

export class Parameters {
    private readonly fields: Record<string, Field> = {};
    private readonly groups: HTMLElement[] = [];
    private readonly spheres = element("input", {type: "checkbox", id: "rolling-spheres"});

    constructor(private readonly lab: Laboratory) {
        lab.on("ready", () => this.build());
        lab.on("given", () => this.show());
        lab.on("started", () => this.show());
        lab.on("changed", () => this.show());
    }

    private build(): void {
        const inGroup = (group: string): Parameter[] =>
            this.lab.parameters.filter((row) => row.page_group === group);
        this.spheres.addEventListener("change", () =>
            this.lab.set(
                {preset: this.spheres.checked ? "experiment" : "", body: "", floor: ""},
                {restart: true},
            ),
        );
        byId("main-controls").replaceChildren(
            ...inGroup("main").map((row, k) =>
                this.control(row, k < 2 ? "control large" : "control"),
            ),
            element(
                "label",
                {className: "control check", title: texts.spheresHelp},
                this.spheres,
                ` ${texts.spheres}`,
            ),
        );
        this.groups.splice(
            0,
            Infinity,
            ...Object.entries(texts.groups).map(([group, textContent]) =>
                element(
                    "fieldset",
                    {},
                    element("legend", {textContent}),
                    ...inGroup(group).map((row) => this.control(row, "control")),
                ),
            ),
        );
        byId("more").replaceChildren(
            element(
                "details",
                {id: "parameters"},
                element("summary", {textContent: texts.more}),
                element("div", {className: "groups"}, ...this.groups),
            ),
        );
        this.show();
    }

    private control(row: Parameter, className: string): HTMLElement {
        const id = `parameter-${row.name}`;
        const [text, ...proposed] = textField(row, id),
            [symbol, index] = row.symbol.split("_");
        const title =
            `${texts.descriptions[row.name] ?? row.description}${row.unit ? ` (${row.unit})` : ""}\n` +
            optionOf(row.name);
        const name = texts.labels[row.name] ?? row.name;
        const label = element(
            "label",
            {htmlFor: row.slider ? `slider-${row.name}` : id, title},
            name,
            ...(symbol
                ? [
                      " ",
                      element(
                          "i",
                          {},
                          symbol,
                          ...(index ? [element("sub", {textContent: index})] : []),
                      ),
                  ]
                : []),
        );
        const isNumber = row.slider !== null || row.name === "mixture";
        text.addEventListener("input", () =>
            this.change(row.name, isNumber ? typedNumber(text.value.trim()) : text.value.trim()),
        );
        const made = element("div", {className}, label, text, ...proposed);
        this.fields[row.name] = {parameter: row, row: made, text};
        if (!row.slider) return made;
        text.setAttribute("aria-label", fill(texts.exactly, {name}));
        const [min, max, step] = row.slider.map(String) as [string, string, string];
        const slider = element("input", {
            type: "range",
            id: `slider-${row.name}`,
            min,
            max,
            step,
        });
        slider.addEventListener("input", () => this.change(row.name, slider.value));
        made.append(slider);
        this.fields[row.name]!.slider = slider;
        return made;
    }

    /** The visible row of a parameter. */
    rowOf(name = ""): HTMLElement | undefined {
        const row = this.fields[name]?.row;
        return row?.offsetParent ? row : undefined;
    }

    private change(name: string, value: string): void {
        // A preset with another unit of length or time needs a gravity; here the one in effect
        // stays.
        const {given} = this.lab;
        const changesUnit =
            ["radius", "period", "speed"].includes(name) && given["preset"] && !given["gravity"];
        const gravity: Record<string, string> = changesUnit
            ? {gravity: this.lab.effectiveValue("gravity")}
            : {};
        // One friction coefficient replaces the two others.
        this.lab.set({
            ...(name === "mu" ? {mu_disc: "", mu_wall: ""} : {}),
            ...gravity,
            [name]: value,
        });
    }

    private show(): void {
        const {lab, fields} = this;
        for (const [name, {parameter, row, text, slider}] of Object.entries(fields)) {
            const value = lab.given[name] ?? "",
                holds = lab.effectiveValue(name),
                shown = shortened(holds.split(",")[0]!);
            const isChoice = text instanceof HTMLSelectElement;
            if (text instanceof HTMLInputElement) text.placeholder = localized(shown);
            const wanted = isChoice ? value || holds : value;
            if (typedNumber(text.value.trim()) !== typedNumber(wanted))
                text.value = isChoice ? wanted : localized(wanted); // unless it is being typed
            if (slider) showOn(slider, value || shown);
            row.hidden =
                parameter.page_group !== "main" &&
                value === "" &&
                !applies(parameter, lab.configuration);
        }
        for (const group of this.groups)
            group.hidden = [...group.querySelectorAll<HTMLElement>(".control")].every(
                (row) => row.hidden,
            );
        this.spheres.checked =
            (lab.given["preset"] ?? lab.configuration["preset"]) === "experiment" &&
            (lab.given["body"] ?? "sphere") === "sphere";
    }
}
