// Results of the command line on the page: a result sets the parameters, and the page repeats the run
// and compares.
import {rates, type Estimate} from "../engine/engine";
import type {Host, Values} from "../dish/host";
import {button, element, withError} from "../elements/page";
import {Runs} from "../engine/runs";
import {fill, symbols, texts} from "../texts/texts";

/** A result of `swirl run --json`, as far as the page reads it. */
interface Result {
    config: Record<string, unknown>;
    events: {total: number};
    warmup?: {periods: number};
    rotation?: Record<string, Estimate>;
    state_hash?: string;
}

/** A result, and the parameters of its run. */
export interface Opened {
    given: Values;
    result: Result;
}

/** Thrown for a file that the page cannot read; `problem` is a key of texts.opened, `what` its
 *  wrong value. */
export class NotReadable extends Error {
    constructor(
        readonly problem: "unknown" | "damaged" | "wrongValue",
        readonly what = "",
    ) {
        super(problem);
    }
}

/** The largest result has a list of sizes. A longer text would stop the page while it is read. */
export const maxBytes = 10e6;
/** Characters of a value: lists of sizes and points of a path have up to 100,000 entries. */
const longestValue = 1000,
    longestList = 5e6;
const lists = ["sizes", "path"];
const maxRepeated = 2e7; // events

/** The parameters of a run, as the page takes them, from the JSON of the command line. Values that
 *  follow from others, and the length of the run, are omitted. */
export function givenFrom(
    config: Record<string, unknown>,
    known: readonly {name: string; settable: boolean; default: string}[],
): Values {
    const given: Values = {},
        fixed = ["events", "periods", "speed"];
    for (const {name, settable, default: standard} of known) {
        const value = config[name];
        if (!settable || fixed.includes(name) || value === null || value === undefined) continue;
        const text = isObject(value) ? mixtureText(value) : String(value);
        if (text.length > (lists.includes(name) ? longestList : longestValue))
            throw new NotReadable("wrongValue", `${name} = ${text.slice(0, 60)} …`);
        // Numbers are compared as numbers: "1.0" is the default "1".
        const isDefault =
            text === standard || (standard !== "" && Number(text) === Number(standard));
        if (!isDefault) given[name] = text;
    }
    // The default is the name of a value: that of the paper's discs.
    const {mu_disc, mu_wall, inertia, mass, radius, body = "disc"} = config;
    if (body === "disc" && inertia === 10 && mass === 1 && radius === 1) delete given["inertia"];
    if (mu_disc === mu_wall && mu_disc !== undefined) {
        delete given["mu_disc"];
        delete given["mu_wall"];
        if (Number(mu_disc) !== 1) given["mu"] = String(mu_disc);
    }
    return given;
}

const mixtureText = ({count, radius, mass}: Record<string, unknown>): string =>
    [count, radius, mass].filter((each) => each !== undefined && each !== null).join(":");

const isObject = (value: unknown): value is Record<string, unknown> =>
    typeof value === "object" && value !== null && !Array.isArray(value);

function parsed(text: string): unknown {
    try {
        return JSON.parse(text);
    } catch {
        return undefined;
    }
}

type Known = Parameters<typeof givenFrom>[1];

/** Throws NotReadable if a file that begins in this way is no result. */
function requireResult(begin: Uint8Array): void {
    const text = new TextDecoder("latin1").decode(begin.subarray(0, 40));
    if (!/^\s*\{/.test(text)) throw new NotReadable("unknown");
}

/** Throws NotReadable. */
export function readFile(bytes: ArrayBuffer, known: Known): Opened {
    const all = new Uint8Array(bytes);
    requireResult(all);
    const result = parsed(new TextDecoder().decode(all));
    if (!isObject(result)) throw new NotReadable("damaged");
    const {config, events} = result;
    if (!isObject(config) || !isObject(events)) throw new NotReadable("unknown");
    requireValues(result);
    const warmup = isObject(result["warmup"]) ? Number(result["warmup"]["periods"]) : NaN;
    const given = givenFrom(config, known);
    if (Number.isInteger(warmup) && warmup !== 20) given["warmup"] = String(warmup);
    else delete given["warmup"];
    return {given, result: result as unknown as Result};
}

const isNumber = (value: unknown): boolean => typeof value === "number" && Number.isFinite(value);
const isMissing = (value: unknown): boolean => value === null || value === undefined;

/** Throws NotReadable for a value of a result that the page would use and that is not of its kind.
 *  */
function requireValues(result: Record<string, unknown>): void {
    const require = (name: string, value: unknown, holds: boolean): void => {
        if (!holds)
            throw new NotReadable(
                "wrongValue",
                `${name} = ${String(JSON.stringify(value)).slice(0, 60)}`,
            );
    };
    const inside = (value: unknown): Record<string, unknown> => (isObject(value) ? value : {});
    const {total} = inside(result["events"]),
        {periods} = inside(result["warmup"]);
    require("events.total", total, Number.isSafeInteger(total) && (total as number) >= 0);
    require("warmup.periods", periods, isMissing(periods) || isNumber(periods));
    const {state_hash: hash} = result;
    require("state_hash", hash, isMissing(hash) || typeof hash === "string");
    for (const rate of rates)
        for (const key of ["mean", "error"]) {
            const value = inside(inside(result["rotation"])[rate])[key];
            require(`rotation.${rate}.${key}`, value, isMissing(value) || isNumber(value));
        }
}

export class OpenedFile {
    private readonly place = element("section", {id: "opened", hidden: true});
    private readonly choose = element("input", {
        type: "file",
        id: "open-file",
        accept: ".json",
    });
    private runs: Runs | undefined;

    /** The section with the file goes to `place`, the button to `buttons`. */
    constructor(
        place: HTMLElement,
        buttons: HTMLElement,
        private readonly host: Host,
        private readonly fail: (message: string) => void,
    ) {
        place.prepend(this.place);
        this.choose.hidden = true;
        this.choose.addEventListener("change", () => {
            const file = this.choose.files?.[0];
            if (file) void this.open(file);
            this.choose.value = "";
        });
        const open = button(texts.opened.choose, () => this.choose.click(), "open");
        open.title = texts.opened.help;
        buttons.append(open, this.choose);
        this.acceptDrops();
    }

    private acceptDrops(): void {
        const hasFiles = (event: DragEvent): boolean =>
            event.dataTransfer?.types.includes("Files") ?? false;
        const mark = (on: boolean): void => {
            document.body.classList.toggle("drops", on);
            document.body.dataset["drop"] = texts.opened.drop;
        };
        document.addEventListener("dragover", (event) => {
            if (!hasFiles(event)) return;
            event.preventDefault();
            mark(true);
        });
        document.addEventListener("dragleave", (event) => {
            if (!event.relatedTarget) mark(false);
        });
        document.addEventListener("drop", (event) => {
            if (!hasFiles(event)) return;
            event.preventDefault();
            mark(false);
            const file = event.dataTransfer?.files[0];
            if (file) void this.open(file);
        });
    }

    async open(file: File): Promise<void> {
        this.close();
        if (file.size > maxBytes)
            return this.fail(fill(texts.opened.tooLarge, {name: file.name, most: maxBytes / 1e6}));
        try {
            // Another file is not read to its end.
            requireResult(new Uint8Array(await file.slice(0, 40).arrayBuffer()));
            this.show(readFile(await file.arrayBuffer(), this.host.parameters()), file.name);
        } catch (error) {
            if (error instanceof NotReadable)
                return this.fail(
                    fill(texts.opened[error.problem], {name: file.name, what: error.what}),
                );
            throw error;
        }
    }

    private close(): void {
        this.runs?.stop();
        this.runs = undefined;
        this.place.hidden = true;
        this.place.replaceChildren();
    }

    private show({given, result}: Opened, name: string): void {
        this.host.show(given);
        const end = button("×", () => this.close(), "close-opened");
        end.setAttribute("aria-label", texts.opened.close);
        end.title = texts.opened.close;
        const status = element("p", {id: "opened-status", textContent: texts.opened.parametersSet});
        status.setAttribute("role", "status");
        this.place.hidden = false;
        this.place.replaceChildren(
            element(
                "div",
                {},
                element("h2", {textContent: fill(texts.opened.result, {name})}),
                end,
            ),
            status,
        );
        void this.compare(given, result, status);
    }

    /** Repeats the run to its last event and shows both results. */
    private async compare(given: Values, result: Result, status: HTMLElement): Promise<void> {
        const events = result.events.total;
        if (events > maxRepeated) {
            status.textContent = fill(texts.opened.tooLong, {events, most: maxRepeated});
            this.place.append(comparison(result, undefined));
            return;
        }
        status.textContent = texts.opened.comparing;
        const runs = (this.runs = new Runs(() => this.host.newWorker(), 1));
        let page: Result;
        try {
            page = JSON.parse(await runs.result(given, events)) as Result;
        } catch (error) {
            status.textContent = error instanceof Error ? error.message : String(error);
            return;
        }
        if (this.runs !== runs) return;
        runs.stop();
        this.runs = undefined;
        status.textContent = !result.state_hash
            ? texts.opened.parametersSet
            : result.state_hash === page.state_hash
              ? texts.opened.sameHash
              : texts.opened.otherHash;
        this.place.append(comparison(result, page));
    }
}

/** A table of the rotation rates, the events and the hash; the page's column is optional. */
function comparison(file: Result, page: Result | undefined): HTMLElement {
    const estimate = (result: Result, rate: string): string => {
        const {mean = null, error = null} = result.rotation?.[rate] ?? {};
        return withError(mean, error, texts.notYet);
    };
    const names: Record<string, string> = texts.rateNames;
    const rows: [string, (result: Result) => string][] = [
        ...rates.map((rate): [string, (result: Result) => string] => [
            `${symbols.rotation} ${names[rate]}`,
            (result) => estimate(result, rate),
        ]),
        [texts.opened.events, ({events}) => String(events.total)],
        [texts.opened.hash, ({state_hash}) => state_hash ?? texts.notYet],
    ];
    const cells = (of: (result: Result) => string): string[] => [
        of(file),
        ...(page ? [of(page)] : []),
    ];
    const head = [
        texts.opened.quantity,
        texts.opened.inFile,
        ...(page ? [texts.opened.onPage] : []),
    ];
    return element(
        "table",
        {id: "comparison"},
        element("tr", {}, ...head.map((each) => element("th", {textContent: each, scope: "col"}))),
        ...rows.map(([name, of]) =>
            element(
                "tr",
                {},
                element("th", {textContent: name, scope: "row"}),
                ...cells(of).map((each) => element("td", {textContent: each})),
            ),
        ),
    );
}
