// The discovery plot: each number of discs that is selected adds a point with its error, so that
// the paper's Figure 5b appears. A point is the mean of separate runs in the background, and its
// error is that between them. Short runs give the point at once, and longer ones make it more
// precise while its number of discs stays selected.
import {UsageError, perRate, type Crossing, type Rotation} from "../engine/engine";
import {intervalOf, liveEstimate} from "../engine/estimates";
import type {Host, Values} from "../dish/host";
import {measuredFromLink, measuredPoints, measuredText, rateOf, type Measured} from "./measured";
import {addressOf} from "../dish/share";
import {settingOf} from "./settings";
import {button, element, quiet, save, withError} from "../elements/page";
import {Chart, type ChartCurve, type ChartPoint} from "../elements/chart";
import {Runs, seedsPerPoint} from "../engine/runs";
import {startParameters} from "../texts/start";
import {fill, symbols, texts} from "../texts/texts";

/** A point of the plot. */
export interface Visited {
    mean: number;
    /** mean ± 1.96 errors is the 95 % interval. */
    error: number;
    /** Of each run, after the warm-up. */
    periods: number;
}

/** ϖ/Ω for the default parameters, from four runs of 400 periods each (`swirl run --discs N`, seeds
 *  1 to 4). */
export const reference: ChartPoint[] = [
    [5, 0.184],
    [8, 0.145],
    [11, 0.11],
    [14, 0.087],
    [17, 0.079],
    [20, 0.064],
    [23, 0.05],
    [26, 0.038],
    [29, 0.03],
    [32, 0.021],
    [35, 0.01],
    [38, 0.001],
    [41, -0.011],
    [44, -0.025],
    [47, -0.036],
    [50, -0.041],
    [53, -0.027],
].map(([x, y]) => ({x: x!, y: y!, lower: y!, upper: y!}));

/** The points of one setting, that is of all parameters except the number of discs. */
export type Setting = Map<number, Visited>;

const runLengths = [50, 200, 800]; // periods
const largestForLongRuns = 150; // discs
const maxInLink = 60; // points
const settling = 300; // milliseconds until a visited number counts

/** Points as text for a link: "48_-0.0372_0.0013_200,…". */
export function linkTextOf(setting: Setting): string {
    return [...setting]
        .sort(([a], [b]) => a - b)
        .slice(0, maxInLink)
        .map(
            ([n, {mean, error, periods}]) =>
                `${n}_${mean.toPrecision(4)}_${error.toPrecision(2)}_${periods}`,
        )
        .join(",");
}

/** The points in such a text, and how many parts of it are none. */
export function settingFrom(text: string): {setting: Setting; invalid: number} {
    const setting: Setting = new Map(),
        parts = text.split(","),
        isWhole = (x: number, most: number): boolean => Number.isInteger(x) && x > 0 && x <= most;
    let invalid = Math.max(0, parts.length - maxInLink);
    for (const part of parts.slice(0, maxInLink)) {
        const [n, mean, error, periods, more] = part
            .split("_")
            .map((each) => (each.trim() === "" ? NaN : Number(each))) as [
            number,
            number,
            number,
            number,
            number?,
        ];
        if (
            isWhole(n, 20_000) &&
            Math.abs(mean) <= 100 &&
            error > 0 &&
            error <= 100 &&
            isWhole(periods, 1e6) &&
            more === undefined
        )
            setting.set(n, {mean, error, periods});
        else ++invalid;
    }
    return {setting, invalid};
}

/** All points as CSV: those of the page, and those that were counted at a real dish. */
export function tableOf(
    settings: Map<string, Setting>,
    measured: readonly Measured[] = [],
): string {
    const rows = [...settings].flatMap(([name, points]) =>
        [...points]
            .sort(([a], [b]) => a - b)
            .map(
                ([n, {mean, error, periods}]) =>
                    `${n},${mean},${error},${seedsPerPoint},${periods},"${name.replaceAll('"', '""')}"\n`,
            ),
    );
    const counted = measured.map(
        (row) => `${row[0]},${rateOf(row).join(",")},1,${row[2]},"counted: ${row[1]} turns"\n`,
    );
    return `discs,varpi,varpi_error,runs,periods,other_parameters\n${rows.join("")}${counted.join("")}`;
}

const titled = (made: HTMLButtonElement, title: string): HTMLButtonElement =>
    Object.assign(made, {title});

const asPlotted = (x: number, {mean, error}: {mean: number; error: number}): ChartPoint => ({
    x,
    y: mean,
    lower: mean - intervalOf(error),
    upper: mean + intervalOf(error),
});

export class Discovery {
    /** Is called when there are other points. */
    changed: () => void = () => {};
    readonly settings = new Map<string, Setting>();
    measured: readonly Measured[] = [];
    private pooled: Setting = new Map();
    private readonly plot: Chart;
    private readonly finding = element("p", {id: "discovery-finding"});
    readonly runs: Runs;
    private present: {setting: string; discs: number; given: Values} | undefined;
    private live: ChartPoint | undefined;
    private readonly under = new Set<string>(); // names of points whose first run is under way
    private refining = false;
    private found: Crossing | undefined;
    private timer: ReturnType<typeof setTimeout> | undefined;

    constructor(
        place: HTMLElement,
        private readonly host: Host,
        private readonly fail: (message: string) => void,
    ) {
        this.runs = new Runs(() => host.newWorker(), 2); // one is free while the other refines a point
        const plotPlace = element("div", {id: "discovery-plot"});
        place.replaceChildren(
            element("h2", {textContent: texts.discovery.title}),
            plotPlace,
            this.finding,
            element(
                "div",
                {className: "bar"},
                titled(
                    button(texts.discovery.table, () => this.saveTable(), "discovery-table"),
                    texts.discovery.tableHelp,
                ),
                titled(
                    button(texts.discovery.link, () => void this.copyLink(), "discovery-link"),
                    texts.discovery.linkHelp,
                ),
                titled(
                    button(texts.discovery.clear, () => this.clear(), "discovery-clear"),
                    texts.discovery.clearHelp,
                ),
            ),
            element(
                "details",
                {className: "quiet"},
                element("summary", {textContent: texts.discovery.about}),
                element("p", {textContent: texts.discovery.help}),
            ),
        );
        // A frame without an address, as in a notebook, has no link.
        document.getElementById("discovery-link")!.hidden = location.protocol === "about:";
        // On a phone, and on a laptop at twice the size, the slider is below the plot.
        const isSmall = innerWidth < 480 || (innerWidth <= 768 && innerHeight <= 800);
        this.plot = new Chart(plotPlace, {height: isSmall ? 120 : 210});
        this.draw();
    }

    /** The page shows this simulation. Call it for each new one, also after a change. */
    visit(): void {
        const given = this.host.given(),
            discs = Number(this.host.configuration()["discs"]);
        const setting = settingOf(given);
        const isOther = this.present?.setting !== setting;
        this.present = {setting, discs, given};
        if (isOther) {
            this.found = undefined;
            void this.evaluate(setting); // the points of a link, or of a setting that was left
        }
        this.live = undefined;
        clearTimeout(this.timer);
        this.timer = setTimeout(() => {
            void this.drop(setting, discs, given);
        }, settling);
        this.draw();
    }

    /** Adds the point of another container on the page. */
    add({discs, ...given}: Values): void {
        void this.drop(settingOf(given), Number(discs), given);
    }

    /** The averages of the simulation on display. */
    follow(rotation: Rotation): void {
        const {mean, error} = liveEstimate(rotation);
        this.live =
            this.present && mean !== null && error !== null
                ? asPlotted(this.present.discs, {mean, error})
                : undefined;
        this.draw();
    }

    /** The first run of a point, and then longer ones of the point that the page shows. */
    private async drop(setting: string, discs: number, given: Values): Promise<void> {
        const name = `${discs} ${setting}`;
        if (!this.settings.get(setting)?.has(discs) && !this.under.has(name)) {
            this.under.add(name);
            await this.lengthen(setting, discs, given, runLengths[0]!, true);
            this.under.delete(name);
        }
        if (this.refining) return;
        this.refining = true;
        for (let more = this.next(); more; more = this.next())
            if (!(await this.lengthen(more.setting, more.discs, more.given, more.periods))) break;
        this.refining = false;
    }

    /** The next longer run of the present point. */
    private next(): {setting: string; discs: number; given: Values; periods: number} | undefined {
        const {present} = this,
            point = present && this.settings.get(present.setting)?.get(present.discs);
        const periods = point && runLengths.find((length) => length > point.periods);
        if (!present || !periods || present.discs > largestForLongRuns) return undefined;
        return {...present, periods};
    }

    /** Longer runs end when another point is shown; they leave a worker free for its first runs.
     *  False if there is no result: a run collapsed, or the engine rejects the parameters, which
     *  the page itself reports. */
    private async lengthen(
        setting: string,
        discs: number,
        given: Values,
        periods: number,
        isFirst = false,
    ): Promise<boolean> {
        const isWanted = (): boolean =>
            this.present?.setting === setting && this.present.discs === discs;
        try {
            const all = {...given, discs: String(discs)};
            const runs = await this.runs.replicates(all, periods, isFirst ? undefined : isWanted);
            if (!runs) return !isWanted();
            const {mean, error} = (await this.runs.estimates(runs)).mean_by_time;
            if (mean === null || error === null || !(error > 0)) return false;
            this.keep(setting, discs, {mean, error, periods});
            return true;
        } catch (error) {
            if (error instanceof UsageError) return false;
            throw error;
        }
    }

    private keep(setting: string, discs: number, visited: Visited): void {
        const points = this.settings.get(setting) ?? new Map<number, Visited>();
        this.settings.set(setting, points.set(discs, visited));
        this.draw();
        this.changed();
        void this.evaluate(setting);
    }

    /** N_c from the points of the present setting. */
    private async evaluate(setting: string): Promise<void> {
        const points = this.settings.get(setting);
        if (!points || points.size < 2) return;
        const {mean_by_time} = await this.runs.crossings(
            [...points].map(([discs, {mean, error, periods}]) => ({
                discs,
                periods,
                rotation: perRate(() => ({mean, error})),
            })),
        );
        if (this.present?.setting !== setting) return;
        this.found = mean_by_time;
        this.draw();
    }

    private draw(): void {
        const present = this.present?.setting ?? "";
        const curves: ChartCurve[] = [...this.settings]
            .filter(([name]) => name !== present)
            .map(([name, points]) => ({
                name: this.nameOf(name),
                points: this.plotted(points),
                isFaint: true,
                isRotation: true,
            }));
        curves.unshift({
            name: this.nameOf(present),
            points: this.plotted(this.settings.get(present) ?? new Map()),
            isRotation: true,
        });
        if (present === "") curves[0]!.name = texts.discovery.yours;
        if (present === "")
            curves.push({
                name: texts.discovery.reference,
                points: reference,
                isFaint: true,
                line: {width: 3, color: quiet},
            });
        if (this.pooled.size > 0)
            curves.push({
                name: texts.discovery.ofClass,
                points: this.plotted(this.pooled),
                isRotation: true,
            });
        if (this.measured.length > 0)
            curves.push({
                name: texts.discovery.counted,
                points: measuredPoints(this.measured),
                isRotation: true,
            });
        const text = this.findingText();
        this.finding.textContent = text;
        const band =
            this.found &&
            this.found.discs !== null &&
            this.found.lower !== null &&
            this.found.upper !== null
                ? ([this.found.lower, this.found.upper] as [number, number])
                : undefined;
        this.plot.show(
            [texts.numberOfDiscs, symbols.rotation],
            curves,
            {at: this.present?.discs, live: this.live, band},
            fill(texts.discovery.description, {
                points: this.settings.get(present)?.size ?? 0,
                finding: text,
            }),
        );
    }

    private plotted(points: Setting): ChartPoint[] {
        return [...points].sort(([a], [b]) => a - b).map(([n, point]) => asPlotted(n, point));
    }

    private nameOf(setting: string): string {
        return (
            [...new URLSearchParams(setting)]
                .map(([name, value]) => `${name} ${value}`)
                .join(", ") || texts.discovery.defaults
        );
    }

    private findingText(): string {
        const found = this.found;
        if (!found || found.verdict !== "crosses") return texts.discovery.noCrossing;
        if (found.discs === null)
            return fill(texts.discovery.bracket, {lower: found.lower!, upper: found.upper!});
        return fill(texts.discovery.crossing, {discs: withError(found.discs, found.error, "")});
    }

    private saveTable(): void {
        save("discovery.csv", {text: tableOf(this.settings, this.measured), type: "text/csv"});
    }

    private clear(): void {
        this.settings.clear();
        this.measured = [];
        this.pooled = new Map();
        this.found = undefined;
        this.draw();
        this.changed();
    }

    /** The part of the address after # with the points of the parameters that are given. */
    fragment(): string {
        const points = this.settings.get(settingOf(this.host.given()));
        return [
            points?.size ? `points=${linkTextOf(points)}` : "",
            this.measured.length > 0 ? `counted=${measuredText(this.measured)}` : "",
        ]
            .filter(Boolean)
            .join("&");
    }

    /** The parameters of the present points. */
    get setting(): string {
        return settingOf(this.host.given());
    }

    /** Shows points that were counted at a real dish. */
    showMeasured(rows: readonly Measured[]): void {
        this.measured = rows;
        this.draw();
        this.changed();
    }

    /** Shows the points of a class. */
    showClass(points: Setting): void {
        this.pooled = points;
        this.draw();
    }

    /** An address with the present parameters and the points of this setting. */
    private link(): string {
        const address = new URL(addressOf(this.host.given()), location.href);
        address.hash = this.fragment();
        return address.href;
    }

    private async copyLink(): Promise<void> {
        const link = this.link();
        try {
            await navigator.clipboard.writeText(link);
            this.finding.textContent = texts.discovery.linkCopied;
        } catch {
            this.finding.replaceChildren(
                texts.discovery.linkIs,
                element("code", {textContent: link}),
            );
        }
    }

    /** Reads the points in the page's address, which belong to the parameters in it. */
    readLink(): void {
        const fragment = new URLSearchParams(location.hash.slice(1)),
            points = fragment.get("points");
        const {rows, wrong} = measuredFromLink(fragment.get("counted") ?? "");
        this.measured = rows;
        if (wrong) this.fail(fill(texts.myDish.wrongPoint, {line: wrong}));
        this.draw();
        if (points === null) return;
        const {setting, invalid} = settingFrom(points);
        this.settings.set(
            settingOf(Object.fromEntries(startParameters((name) => this.host.isParameter(name)))),
            setting,
        );
        if (invalid > 0) this.fail(fill(texts.discovery.invalid, {points: invalid}));
    }
}
