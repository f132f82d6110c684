// The lesson: in each step the reader predicts, observes, and reads the explanation. The next step
// opens when the result of the present one is known.
import {searchCrossing, controlling, usualSearch} from "../engine/crossing_search";
import type {Host, Values} from "../dish/host";
import {reference} from "./discovery";
import {button, element, localized, signed, withError} from "../elements/page";
import type {ChartPoint} from "../elements/chart";
import {Runs} from "../engine/runs";
import type {Coloring, View} from "../drawing/view";
import {pageEntry, setPageEntry} from "../texts/start";
import {documentIn} from "../texts/symbols";
import {fill, lessonSteps, symbols, team, texts, worksheet} from "../texts/texts";

/** How the result of a step is found: the direction of a run, N_c, or an answer that needs no run.
 *  */
type Kind = "direction" | "crossing" | number;

export interface Step {
    given: Values;
    view: View | "both";
    kind: Kind;
    /** The colours that its text speaks of; by sector if omitted. */
    coloring?: Coloring;
    /** The number of discs in a second container. */
    beside?: string;
    /** Shows the motion within a period. */
    isSlow?: boolean;
    /** For teachers: the right option, and what long runs of the page's engine give. */
    solution: [option: number, measured?: string];
    /** The experiment that its explanation proposes. */
    next?: Values;
}

export const steps: Step[] = [
    {given: {discs: "8"}, view: "lab", kind: "direction", solution: [0, "0.145 ± 0.005"]},
    {given: {discs: "48"}, view: "lab", kind: "direction", solution: [1, "−0.0365 ± 0.0003"]},
    {given: {discs: "28"}, view: "lab", kind: "crossing", solution: [2, "38.49 ± 0.06"]},
    {given: {discs: "48"}, view: "m", kind: 0, isSlow: true, solution: [0]}, // one image per period would show the wall at rest
    {
        given: {discs: "48", mu_disc: "1", mu_wall: "0"},
        view: "both",
        kind: "direction",
        solution: [0, "1.000 ± 0.002"],
        next: {discs: "48", mu_disc: "0", mu_wall: "1"},
    },
    {
        given: {discs: "48"},
        view: "lab",
        kind: 1,
        coloring: "contacts",
        beside: "8",
        isSlow: true,
        solution: [1],
    },
];

/** The options for N_c: first and last number of discs. */
export const ranges: [number, number][] = [
    [0, 19],
    [20, 34],
    [35, 44],
    [45, Infinity],
];
const rangeText = ([lower, upper]: [number, number]): string =>
    lower <= 0
        ? fill(texts.lesson.rangeBelow, {limit: upper + 1})
        : upper === Infinity
          ? fill(texts.lesson.rangeFrom, {lower})
          : fill(texts.lesson.range, {lower, upper});
const runPeriods = 50;
const watchTime = 4000; // milliseconds between the prediction and its result

/** The option of texts.lesson.directions that an estimate belongs to. */
export function directionOf(mean: number, error: number): number {
    return Math.abs(mean) < 2 * error ? 2 : mean > 0 ? 0 : 1;
}

/** The option for N_c, which is between whole numbers. */
export function rangeOf(crossing: number): number {
    return ranges.findIndex(([, last]) => crossing < last + 0.5);
}

interface Result {
    answer: number;
    text: string;
}

export class Lesson {
    /** Is called when there is another step. */
    changed: () => void = () => {};
    private step = -1; // closed
    private chosen: number | undefined;
    private result: Result | undefined;
    private runs: Runs | undefined;
    private readonly finished = new Map<number, {chosen: number; result: Result}>();

    /** The steps are shown in `place`, the button that begins in `start`, the rest in `panels`. */
    constructor(
        private readonly place: HTMLElement,
        start: HTMLElement,
        panels: HTMLElement,
        private readonly host: Host,
        private readonly fail: (message: string) => void,
    ) {
        start.replaceChildren(button(texts.lesson.start, () => this.go(0), "lesson-open"));
        panels.append(teachingPanel());
    }

    private optionsOf(step: number): string[] {
        const {kind} = steps[step]!;
        return kind === "direction"
            ? texts.lesson.directions
            : kind === "crossing"
              ? ranges.map(rangeText)
              : (lessonSteps[step]!.options ?? []);
    }

    /** Opens the step in the page's address. */
    open(): void {
        const text = pageEntry("lesson");
        if (text === null) return;
        const step = /^\d+$/.test(text) ? Number(text) : NaN;
        if (step >= 1 && step <= steps.length) return this.go(step - 1);
        setPageEntry("lesson", undefined);
        this.fail(fill(texts.invalidLesson, {text, steps: steps.length}));
    }

    private go(to: number): void {
        this.runs?.stop();
        this.runs = undefined;
        this.step = to < steps.length ? to : -1;
        setPageEntry("lesson", this.step < 0 ? undefined : String(this.step + 1));
        this.changed();
        const at = steps[this.step],
            before = this.finished.get(this.step);
        this.chosen = before?.chosen;
        this.result = before?.result;
        // The answer stays hidden until there is a prediction.
        const predicted = document.body.classList.contains("predicts");
        document.body.classList.toggle("predicts", at !== undefined && !before);
        this.host.setSlow(at?.isSlow ?? false);
        if (at) this.display(at, !before);
        else if (predicted) this.host.play();
        this.show();
        (
            this.place.querySelector<HTMLElement>("h2") ?? document.getElementById("lesson-open")
        )?.focus();
    }

    private display({given, view, coloring = "sector", beside}: Step, isPaused = false): void {
        this.host.show(this.host.withSeed(given), {view, coloring, isPaused, beside});
    }

    /** After the prediction: watch, measure, and show the result. */
    private async predict(option: number): Promise<void> {
        const step = this.step;
        this.chosen = option;
        document.body.classList.remove("predicts");
        this.display(steps[step]!);
        this.show();
        const [result] = await Promise.all([this.measure(step), this.watched()]);
        if (this.step !== step) return;
        this.result = result;
        this.finished.set(step, {chosen: this.chosen, result});
        this.show();
    }

    /** Time to see the motion before the result appears, if there is motion. */
    private async watched(): Promise<void> {
        if (this.host.playing()) await new Promise((resolve) => setTimeout(resolve, watchTime));
    }

    private async measure(step: number): Promise<Result> {
        const {kind, given} = steps[step]!;
        if (typeof kind === "number") return {answer: kind, text: this.optionsOf(step)[kind] ?? ""};
        this.runs ??= new Runs(() => this.host.newWorker());
        const runs = this.runs;
        if (kind === "direction") {
            const replicates = await runs.replicates(this.host.withSeed(given), runPeriods);
            const {mean = null, error = null} = replicates
                ? (await runs.estimates(replicates)).mean_by_time
                : {};
            const answer = directionOf(mean ?? 0, error ?? 1);
            return {
                answer,
                text: fill(texts.lesson.rotation, {
                    rotation: withError(mean, error, texts.notYet),
                    direction: texts.lesson.directions[answer]!,
                }),
            };
        }
        const {discs: _, ...others} = given;
        const {crossings} = await searchCrossing(usualSearch, {
            run: (n, seed, periods) =>
                runs.run({...others, discs: String(n), seed: String(seed)}, periods),
            search: (rules, made) => runs.search(rules, made),
            crossings: (all) => runs.crossings(all),
        });
        const {discs, error} = crossings[controlling];
        return discs === null
            ? {answer: -1, text: texts.lesson.noCrossing}
            : {
                  answer: rangeOf(discs),
                  text: fill(texts.lesson.crossing, {discs: withError(discs, error, "")}),
              };
    }

    private show(): void {
        const at = lessonSteps[this.step];
        if (!at) {
            this.place.replaceChildren();
            return;
        }
        const next = button(
            this.step + 1 < steps.length ? texts.lesson.next : texts.lesson.close,
            () => this.go(this.step + 1),
            "lesson-next",
        );
        next.className = "main";
        next.disabled = this.result === undefined;
        const back = button(texts.lesson.back, () => this.go(this.step - 1), "lesson-back");
        const heading = element("h2", {
            textContent: fill(texts.lesson.step, {
                step: this.step + 1,
                all: steps.length,
                title: at.title,
            }),
            tabIndex: -1,
        });
        this.place.replaceChildren(
            element(
                "div",
                {className: "lesson"},
                heading,
                element("p", {textContent: at.text}),
                this.question(at.question),
                this.outcome(at.explanation),
                element(
                    "div",
                    {className: "bar"},
                    back,
                    next,
                    ...(this.step + 1 < steps.length
                        ? [button(texts.lesson.close, () => this.go(-1), "lesson-close")]
                        : []),
                ),
            ),
        );
    }

    private question(text: string): HTMLElement {
        return element(
            "fieldset",
            {disabled: this.chosen !== undefined},
            element("legend", {textContent: text}),
            ...this.optionsOf(this.step).map((option, k) => {
                const radio = element("input", {
                    type: "radio",
                    name: "prediction",
                    value: String(k),
                    checked: this.chosen === k,
                });
                radio.addEventListener("change", () => void this.predict(k));
                return element("label", {}, radio, ` ${option}`);
            }),
        );
    }

    private outcome(explanation: string): HTMLElement {
        const place = element("div", {id: "lesson-outcome"});
        place.setAttribute("aria-live", "polite");
        if (this.result) {
            const right = this.result.answer === this.chosen;
            place.append(
                element("p", {
                    className: "result",
                    textContent: fill(texts.lesson.result, {text: this.result.text}),
                }),
                element(
                    "p",
                    {},
                    element("strong", {
                        textContent: right ? texts.lesson.right : texts.lesson.wrong,
                    }),
                    " ",
                    explanation,
                ),
            );
            const {next} = steps[this.step]!;
            if (next)
                place.append(
                    button(
                        texts.lesson.tryNext,
                        () => this.host.show(this.host.withSeed(next)),
                        "lesson-try",
                    ),
                );
        } else
            place.append(
                element("p", {
                    className: "quiet",
                    textContent:
                        this.chosen === undefined ? texts.lesson.predict : texts.lesson.watch,
                }),
            );
        return place;
    }
}

/** The worksheet, and the notes for tournament teams. */
function teachingPanel(): HTMLElement {
    const documentation = documentationOf();
    const pages = Object.entries(team.pages).map(([page, name]) =>
        element(
            "li",
            {},
            documentation
                ? element("a", {
                      href: `${documentation}${page}.html`,
                      textContent: name,
                      target: "_top",
                  })
                : element(
                      "span",
                      {},
                      `${name}: `,
                      element("code", {textContent: documentIn(page)}),
                  ),
        ),
    );
    const commands = element("pre", {textContent: team.commands.join("\n"), tabIndex: 0});
    commands.setAttribute("aria-label", texts.explorer.command);
    commands.setAttribute("role", "region");
    return element(
        "details",
        {id: "teaching"},
        element("summary", {textContent: texts.lesson.teaching}),
        element("p", {textContent: texts.lesson.worksheetHelp}),
        element(
            "div",
            {className: "bar"},
            button(texts.lesson.worksheet, () => printWorksheet(), "lesson-worksheet"),
            button(texts.lesson.solutions, () => printWorksheet(true), "lesson-solutions"),
        ),
        element("h3", {textContent: texts.lesson.team}),
        element("p", {textContent: team.intro}),
        element("ol", {}, ...team.points.map((each) => element("li", {textContent: each}))),
        commands,
        element("p", {textContent: team.more}),
        element("ul", {}, ...pages),
    );
}

/** The address of the documentation, which `swirl site` writes into the page; a single file has
 *  none. */
const documentationOf = (): string =>
    document.querySelector<HTMLMetaElement>('meta[name="swirl-documentation"]')?.content ?? "";

// --- worksheet ----------------------------------------------------------------------------------

const lines = (count: number): HTMLElement[] =>
    Array.from({length: count}, () => element("div", {className: "write"}));

/** Graph paper with axes: N from 0 to 50, ϖ/Ω from −0.1 to 0.3. */
function graph(): SVGSVGElement {
    const space = "http://www.w3.org/2000/svg",
        width = 500,
        height = 200;
    const svg = document.createElementNS(space, "svg");
    svg.setAttribute("viewBox", `-45 -10 ${width + 55} ${height + 45}`);
    const add = (name: string, attributes: Record<string, string | number>, text = ""): void => {
        const made = document.createElementNS(space, name);
        for (const [key, value] of Object.entries(attributes))
            made.setAttribute(key, String(value));
        made.textContent = text;
        svg.append(made);
    };
    const grid = (x1: number, y1: number, x2: number, y2: number, strong: boolean): void =>
        add("line", {
            x1,
            y1,
            x2,
            y2,
            stroke: strong ? "#000" : "#bbb",
            "stroke-width": strong ? 1.2 : 0.5,
        });
    for (let n = 0; n <= 50; n += 2) grid(n * 10, 0, n * 10, height, n === 0);
    for (let n = 0; n <= 50; n += 10)
        add(
            "text",
            {x: n * 10, y: height + 14, "text-anchor": "middle", "font-size": 11},
            String(n),
        );
    for (let k = 0; k <= 20; ++k) grid(0, k * 10, width, k * 10, k === 15);
    for (const [k, value] of [0.3, 0.2, 0.1, 0, -0.1].entries())
        add(
            "text",
            {x: -6, y: k * 50 + 4, "text-anchor": "end", "font-size": 11},
            signed(value, 1),
        );
    add(
        "text",
        {x: width / 2, y: height + 30, "text-anchor": "middle", "font-size": 12},
        texts.numberOfDiscs,
    );
    add(
        "text",
        {
            x: -34,
            y: height / 2,
            "text-anchor": "middle",
            "font-size": 12,
            transform: `rotate(-90 -34 ${height / 2})`,
        },
        symbols.rotation,
    );
    return svg;
}

function tableWith(head: string[], rows: number): HTMLTableElement {
    return element(
        "table",
        {},
        element("tr", {}, ...head.map((each) => element("th", {textContent: each, scope: "col"}))),
        ...Array.from({length: rows}, () =>
            element("tr", {}, ...head.map(() => element("td", {textContent: "\u00a0"}))),
        ),
    );
}

/** The worksheet as an element, empty or with solutions. */
export function worksheetPage(isSolved = false): HTMLElement {
    const blank = "________ ± ________";
    const question = (step: number): HTMLElement => {
        const {
                kind,
                solution: [right, measured = blank],
            } = steps[step]!,
            at = lessonSteps[step]!;
        const options =
            kind === "direction"
                ? texts.lesson.directions
                : kind === "crossing"
                  ? ranges.map(rangeText)
                  : (at.options ?? []);
        return element(
            "section",
            {},
            element("h2", {textContent: `${step + 1}. ${at.title}`}),
            element("p", {textContent: at.text}),
            element("p", {}, element("strong", {textContent: at.question})),
            element(
                "p",
                {},
                `${worksheet.prediction}: `,
                ...options.map((option, k) =>
                    element(
                        "span",
                        {className: "box"},
                        `${isSolved && k === right ? "☒" : "☐"} ${option}`,
                    ),
                ),
            ),
            ...(typeof kind === "number"
                ? []
                : [
                      element(
                          "p",
                          {className: "fill"},
                          `${worksheet.measured}: `,
                          kind === "crossing" ? symbols.crossing : symbols.rotation,
                          ` = ${isSolved ? localized(measured) : blank}`,
                      ),
                  ]),
            element("p", {textContent: `${worksheet.explanation}:`}),
            ...(isSolved ? [element("p", {textContent: at.explanation})] : lines(2)),
        );
    };
    return element(
        "section",
        {id: "worksheet"},
        element(
            "header",
            {},
            element("h1", {textContent: worksheet.title}),
            element("p", {
                textContent: `${worksheet.name}: ____________________  ${worksheet.date}: __________`,
            }),
        ),
        ...steps.slice(0, 3).map((_, k) => question(k)),
        element(
            "section",
            {},
            element("h2", {textContent: worksheet.table}),
            pointsTable(isSolved ? reference.filter(({x}) => x % 6 === 5) : []),
            element("p", {textContent: worksheet.graph}),
            graph(),
            element("p", {
                textContent: `${worksheet.crossing} ${isSolved ? localized(steps[2]!.solution[1]!) : blank}`,
            }),
        ),
        ...steps.slice(3).map((_, k) => question(k + 3)),
        element(
            "section",
            {},
            element("h2", {textContent: worksheet.experiment}),
            element("p", {textContent: worksheet.experimentText}),
            tableWith([worksheet.number, worksheet.turns, worksheet.direction], 5),
            element("p", {textContent: worksheet.question}),
            ...lines(2),
        ),
    );
}

/** Two rows: N, and ϖ/Ω with its error. */
function pointsTable(points: ChartPoint[]): HTMLTableElement {
    const row = (name: string, of: (point: ChartPoint) => string = () => ""): HTMLElement =>
        element(
            "tr",
            {},
            element("th", {textContent: name, scope: "row"}),
            ...Array.from({length: 9}, (_, k) =>
                element("td", {textContent: points[k] ? of(points[k]) : "\u00a0"}),
            ),
        );
    return element(
        "table",
        {className: "points"},
        row(symbols.discs, ({x}) => String(x)),
        row(symbols.rotation, ({y}) => signed(y, 3)),
        row("±"),
    );
}

/** Prints the worksheet instead of the page. */
export function printWorksheet(isSolved = false): void {
    document.getElementById("worksheet")?.remove();
    document.body.append(worksheetPage(isSolved));
    document.body.classList.add("prints-worksheet");
    addEventListener(
        "afterprint",
        () => {
            document.body.classList.remove("prints-worksheet");
            document.getElementById("worksheet")?.remove();
        },
        {once: true},
    );
    print();
}
