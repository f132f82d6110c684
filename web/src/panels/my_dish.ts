// My dish: its sizes and its speed become parameters, and counted turns become points of the plot.
// Results of a class are pooled into one curve.
import type {Discovery, Setting} from "./discovery";
import {settingFrom} from "./discovery";
import {settingOf} from "./settings";
import {perRate} from "../engine/engine";
import type {Host, Values} from "../dish/host";
import {measuredFrom} from "./measured";
import {button, element, localized, typedNumber} from "../elements/page";
import type {Estimates, EvaluatedRun} from "../engine/runs";
import {showCode} from "../dish/share";
import {optionOf} from "../texts/symbols";
import {fill, texts} from "../texts/texts";

/** Lengths in mm, and turns of the dish per second. */
export interface DishSizes {
    container: number;
    particle: number;
    amplitude: number;
    rate: number;
}

const gravity = 9810; // mm/s²

/** The parameters of rolling spheres in this dish. Lengths are in units of r; the speed of the
 *  dish, A Ω, is 1. */
export function givenFor({container, particle, amplitude, rate}: DishSizes): Values {
    const omega = 2 * Math.PI * rate,
        rounded = (x: number): string => String(Number(x.toPrecision(5)));
    return {
        preset: "experiment",
        container_radius: rounded(container / particle),
        amplitude: rounded(amplitude / particle),
        period: rounded((2 * Math.PI * amplitude) / particle),
        gravity: rounded((gravity * particle) / (amplitude * omega) ** 2),
    };
}

/** The results of a class: links or their points, one per line. Each seed counts once, and only
 *  points with the parameters `wanted`. Where several pupils have a point, its error is that
 *  between them. */
export async function pooled(
    text: string,
    wanted: string,
    isParameter: (name: string) => boolean,
    estimates: (runs: EvaluatedRun[]) => Promise<Estimates>,
): Promise<{points: Setting; pupils: number; omitted: number}> {
    const bySeed = new Map<string, Setting>();
    let omitted = 0;
    for (const [k, line] of text.split(/\s+/).filter(Boolean).entries()) {
        const [before, fragment = ""] = line.split("#"),
            given = new URLSearchParams(before!.split("?")[1] ?? "");
        const {setting} = settingFrom(new URLSearchParams(fragment).get("points") ?? "");
        const parameters = Object.fromEntries([...given].filter(([name]) => isParameter(name)));
        if (setting.size === 0 || settingOf(parameters) !== wanted) ++omitted;
        else bySeed.set(given.get("seed") ?? `line ${k}`, setting);
    }
    const all = new Map<number, EvaluatedRun[]>(),
        points: Setting = new Map();
    for (const setting of bySeed.values())
        for (const [discs, {mean, error, periods}] of setting) {
            const of = all.get(discs) ?? [];
            all.set(discs, [...of, {discs, periods, rotation: perRate(() => ({mean, error}))}]);
            points.set(discs, {mean, error, periods: periods + (points.get(discs)?.periods ?? 0)});
        }
    for (const [discs, each] of all)
        if (each.length > 1) {
            const {mean, error} = (await estimates(each)).mean_by_time;
            points.set(discs, {mean: mean!, error: error!, periods: points.get(discs)!.periods});
        }
    return {points, pupils: bySeed.size, omitted};
}

/** The reader of QR codes that some browsers have, such as Chrome on phones. */
interface CodeReader {
    detect(image: ImageBitmap): Promise<{rawValue: string}[]>;
}
const codeReader = (): CodeReader | undefined => {
    const {BarcodeDetector: Reader} = globalThis as {
        BarcodeDetector?: new (options: {formats: string[]}) => CodeReader;
    };
    return Reader && new Reader({formats: ["qr_code"]});
};

/** The two readings of the paper's experiment. */
const readings: [keyof typeof texts.myDish.readings, DishSizes][] = [
    ["text", {container: 25.5, particle: 3, amplitude: 11.5, rate: 1.88}],
    ["supplement", {container: 25.5, particle: 3, amplitude: 5.75, rate: 1.88}],
];

export class MyDish {
    readonly panel: HTMLElement;
    private readonly fields: Record<keyof DishSizes, HTMLInputElement>;
    private readonly lengths = choiceOf("my-lengths", {1: "mm", 10: "cm"});
    private readonly rates = choiceOf("my-rates", {60: "rpm", 1: "Hz"});
    private readonly found = element("p", {id: "my-found"});
    private readonly counted = element("textarea", {
        id: "my-points",
        rows: 4,
        placeholder: "8 4.4 20\n48 -0.7 20",
    });
    private readonly results = element("textarea", {id: "class-results", rows: 4});
    private readonly photo = element("input", {type: "file", id: "class-photo", accept: "image/*"});
    private readonly pooledText = element("p", {id: "class-found"});

    constructor(
        private readonly host: Host,
        private readonly discovery: Discovery,
        copy: (text: string, from: HTMLButtonElement) => void,
        private readonly fail: (message: string) => void,
        classAddress: () => string,
    ) {
        const {myDish} = texts,
            inputOf = (id: string): HTMLInputElement =>
                element("input", {type: "text", id: `my-${id}`, inputMode: "decimal"});
        this.fields = {
            container: inputOf("container"),
            particle: inputOf("particle"),
            amplitude: inputOf("amplitude"),
            rate: inputOf("rate"),
        };
        const labelled = (text: string, ...inputs: HTMLElement[]): HTMLElement =>
            element("label", {}, `${text} `, ...inputs);
        const photo = labelled(myDish.photo, this.photo);
        photo.hidden = !codeReader();
        this.photo.setAttribute("capture", "environment");
        const show = button(myDish.show, () => this.show(), "my-show"),
            classLink = button(
                myDish.classLink,
                () => copy(classAddress(), classLink),
                "class-link",
            );
        this.panel = element(
            "details",
            {id: "my-dish"},
            element("summary", {textContent: myDish.title}),
            element("p", {textContent: myDish.help}),
            element(
                "div",
                {className: "bar"},
                ...Object.entries(this.fields).map(([name, input]) =>
                    labelled(myDish.names[name as keyof DishSizes], input),
                ),
                labelled(myDish.lengths, this.lengths),
                labelled(myDish.rates, this.rates),
                show,
            ),
            element(
                "div",
                {className: "bar"},
                ...readings.map(([name, sizes]) =>
                    button(myDish.readings[name], () => this.fill(sizes), `my-${name}`),
                ),
            ),
            this.found,
            labelled(myDish.points, this.counted),
            element("p", {className: "quiet", textContent: myDish.pointsHelp}),
            element("h3", {textContent: myDish.class}),
            element("p", {textContent: myDish.classHelp}),
            element(
                "div",
                {className: "bar"},
                classLink,
                button(myDish.classCode, () => showCode(classAddress()), "class-code"),
            ),
            labelled(myDish.results, this.results),
            photo,
            this.pooledText,
        );
        this.counted.addEventListener("input", () => this.showPoints());
        this.results.addEventListener("input", () => void this.pool());
        this.photo.addEventListener("change", () => void this.readCodes());
        this.counted.value = localized(discovery.measured.map((row) => row.join(" ")).join("\n"));
    }

    /** Fills in sizes and shows them. */
    private fill(sizes: DishSizes): void {
        this.lengths.value = "1";
        this.rates.value = "60";
        for (const [name, value] of Object.entries(sizes))
            this.fields[name as keyof DishSizes].value = localized(
                String(Number((name === "rate" ? 60 * value : value).toPrecision(4))),
            );
        this.show();
    }

    private show(): void {
        const {names} = texts.myDish,
            sizes = {} as DishSizes;
        for (const name of ["container", "particle", "amplitude", "rate"] as const) {
            const text = this.fields[name].value,
                value = Number(typedNumber(text)),
                unit = name === "rate" ? 1 / Number(this.rates.value) : Number(this.lengths.value);
            const [least, most] = name === "rate" ? [0.05, 20] : [0.1, 1000];
            sizes[name] = value * unit;
            if (text.trim() !== "" && sizes[name] >= least && sizes[name] <= most) continue;
            this.found.textContent = fill(texts.myDish.invalid, {
                name: names[name],
                text,
                least: localized(String(least)),
                most: String(most),
                unit: name === "rate" ? "Hz" : "mm",
            });
            return;
        }
        if (sizes.particle >= sizes.container) {
            this.found.textContent = fill(texts.myDish.tooLarge, {
                particle: this.fields.particle.value,
                container: this.fields.container.value,
            });
            return;
        }
        const given = givenFor(sizes),
            {discs} = this.host.given();
        this.found.textContent = fill(texts.myDish.found, {
            options: Object.entries(given)
                .map(([name, value]) => `${optionOf(name)} ${value}`)
                .join(" "),
        });
        this.host.show(this.host.withSeed({...given, ...(discs ? {discs} : {})}));
    }

    private showPoints(): void {
        const {rows, wrong} = measuredFrom(typedNumber(this.counted.value));
        this.discovery.showMeasured(rows);
        if (wrong) this.fail(fill(texts.myDish.wrongPoint, {line: wrong}));
    }

    /** Adds the links in a photograph of QR codes. */
    private async readCodes(): Promise<void> {
        const file = this.photo.files?.[0],
            image = file && (await createImageBitmap(file).catch(() => undefined));
        const codes = image
            ? await codeReader()!
                  .detect(image)
                  .catch(() => [])
            : [];
        this.photo.value = ""; // the same name may follow
        if (codes.length === 0) return this.fail(texts.myDish.noCode);
        this.results.value = [this.results.value.trim(), ...codes.map(({rawValue}) => rawValue)]
            .filter(Boolean)
            .join("\n");
        void this.pool();
    }

    private async pool(): Promise<void> {
        const text = this.results.value;
        const {points, pupils, omitted} = await pooled(
            text,
            this.discovery.setting,
            (name) => this.host.isParameter(name),
            (runs) => this.discovery.runs.estimates(runs),
        );
        if (text !== this.results.value) return;
        this.discovery.showClass(points);
        this.pooledText.textContent = fill(texts.myDish.pooled, {
            pupils,
            points: points.size,
            omitted,
        });
    }
}

function choiceOf(id: string, options: Record<number, string>): HTMLSelectElement {
    return element(
        "select",
        {id},
        ...Object.entries(options).map(([value, textContent]) =>
            element("option", {value, textContent}),
        ),
    );
}
