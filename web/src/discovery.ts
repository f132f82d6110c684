// The discovery plot: each number of discs that is selected adds a point with its error, so that the paper's
// Figure 5b appears. A point is a separate run in the background. A short run gives the point at once, and
// longer runs make it more precise while its number of discs stays selected.
import {UsageError, perRate, type Crossing, type Rotation} from "./engine";
import type {Host, Values} from "./host";
import {addressOf} from "./share";
import {button, element, save, withError} from "./page";
import {PointsPlot, type Curve, type PlottedPoint} from "./points_plot";
import {Runs, type EvaluatedRun} from "./runs";
import {startParameters} from "./start";
import {symbols, texts} from "./texts";

/** A point of the plot. */
export interface Visited {
    mean: number;
    error: number;
    /** After the warm-up. */
    periods: number;
}

/** The points of one setting, that is of all parameters except the number of discs. */
export type Setting = Map<number, Visited>;

/** Parameters that do not distinguish settings. */
const ofNoSetting = ["discs", "events", "periods"];
const runLengths = [50, 200, 800]; // periods
const largestForLongRuns = 150; // discs
const maxInLink = 60; // points
const settling = 300; // milliseconds until a visited number counts

/** A name for the parameters except the number of discs, which is empty for the defaults. */
export function settingOf(given: Values): string {
    const named = Object.entries(given).filter(([name, value]) => value !== "" && !ofNoSetting.includes(name));
    return new URLSearchParams(named.sort(([a], [b]) => (a < b ? -1 : 1))).toString();
}

/** Points as text for a link: "48_-0.0372_0.0013_200,…". */
export function linkTextOf(setting: Setting): string {
    return [...setting].sort(([a], [b]) => a - b).slice(0, maxInLink)
        .map(([n, {mean, error, periods}]) => `${n}_${mean.toPrecision(4)}_${error.toPrecision(2)}_${periods}`).join(",");
}

/** The points in such a text; invalid ones are omitted. */
export function settingFrom(text: string): Setting {
    const setting: Setting = new Map();
    for (const part of text.split(",").slice(0, maxInLink)) {
        const [n, mean, error, periods] = part.split("_").map((each) => (each.trim() === "" ? NaN : Number(each)));
        if (Number.isInteger(n) && n! > 0 && Number.isFinite(mean) && error! > 0 && Number.isFinite(error) &&
            Number.isInteger(periods) && periods! > 0)
            setting.set(n!, {mean: mean!, error: error!, periods: periods!});
    }
    return setting;
}

/** All points as CSV. */
export function tableOf(settings: Map<string, Setting>): string {
    const rows = [...settings].flatMap(([name, points]) => [...points].sort(([a], [b]) => a - b).map(
        ([n, {mean, error, periods}]) => `${n},${mean},${error},${periods},"${name.replaceAll('"', '""')}"\n`));
    return `discs,varpi,varpi_error,periods,other_parameters\n${rows.join("")}`;
}

const titled = (made: HTMLButtonElement, title: string): HTMLButtonElement => Object.assign(made, {title});

const asPlotted = (x: number, {mean, error}: {mean: number; error: number}): PlottedPoint =>
    ({x, y: mean, lower: mean - 1.96 * error, upper: mean + 1.96 * error});

export class Discovery {
    readonly settings = new Map<string, Setting>();
    private readonly plot: PointsPlot;
    private readonly finding = element("p", {id: "discovery-finding"});
    private readonly runs: Runs;
    private present: {setting: string; discs: number; given: Values} | undefined;
    private live: PlottedPoint | undefined;
    private readonly under = new Set<string>(); // names of points whose first run is under way
    private refining = false;
    private found: Crossing | undefined;
    private timer: ReturnType<typeof setTimeout> | undefined;

    constructor(place: HTMLElement, private readonly host: Host) {
        this.runs = new Runs(() => host.newWorker(), 2); // one is free while the other refines a point
        const plotPlace = element("div", {id: "discovery-plot"});
        place.replaceChildren(
            element("h2", {textContent: texts.discovery.title}), plotPlace, this.finding,
            element("div", {className: "bar"},
                titled(button(texts.discovery.table, () => this.saveTable(), "discovery-table"), texts.discovery.tableHelp),
                titled(button(texts.discovery.link, () => void this.copyLink(), "discovery-link"), texts.discovery.linkHelp),
                titled(button(texts.discovery.clear, () => this.clear(), "discovery-clear"), texts.discovery.clearHelp)),
            element("details", {className: "quiet"}, element("summary", {textContent: texts.discovery.about}),
                    element("p", {textContent: texts.discovery.help})));
        // A frame without an address, as in a notebook, has no link.
        document.getElementById("discovery-link")!.hidden = location.protocol === "about:";
        this.plot = new PointsPlot(plotPlace, 210);
        this.readLink();
        this.draw();
    }

    /** The page shows this simulation. Call it for each new one, also after a change. */
    visit(): void {
        const given = this.host.given(), discs = Number(this.host.configuration()["discs"]);
        const setting = settingOf(given);
        if (this.present?.setting !== setting) this.found = undefined;
        this.present = {setting, discs, given};
        this.live = undefined;
        clearTimeout(this.timer);
        this.timer = setTimeout(() => {
            void this.drop(setting, discs, given);
        }, settling);
        this.draw();
    }

    /** The averages of the simulation on display. */
    follow(rotation: Rotation): void {
        const {mean, error, blocks} = rotation.by_time;
        this.live = this.present && mean !== null && error !== null && blocks > 4
            ? asPlotted(this.present.discs, {mean, error}) : undefined;
        this.draw();
    }

    /** The first run of a point, and then longer ones of the point that the page shows. */
    private async drop(setting: string, discs: number, given: Values): Promise<void> {
        const name = `${discs} ${setting}`;
        if (!this.settings.get(setting)?.has(discs) && !this.under.has(name)) {
            this.under.add(name);
            await this.lengthen(setting, discs, given, runLengths[0]!);
            this.under.delete(name);
        }
        if (this.refining) return;
        this.refining = true;
        for (let more = this.next(); more; more = this.next())
            if (!await this.lengthen(more.setting, more.discs, more.given, more.periods)) break;
        this.refining = false;
    }

    /** The next longer run of the present point. */
    private next(): {setting: string; discs: number; given: Values; periods: number} | undefined {
        const {present} = this, point = present && this.settings.get(present.setting)?.get(present.discs);
        const periods = point && runLengths.find((length) => length > point.periods);
        if (!present || !periods || present.discs > largestForLongRuns) return undefined;
        return {...present, periods};
    }

    private async lengthen(setting: string, discs: number, given: Values, periods: number): Promise<boolean> {
        const visited = await this.point({...given, discs: String(discs)}, periods);
        if (visited) this.add(setting, discs, visited);
        return visited !== undefined;
    }

    /** Undefined for a collapsed run or parameters that the engine rejects; the page itself reports that. */
    private async point(given: Values, periods: number): Promise<Visited | undefined> {
        try {
            const {rotation} = await this.runs.run(given, periods);
            const {mean, error} = rotation?.by_time ?? {};
            return mean != null && error != null && error > 0 ? {mean, error, periods} : undefined;
        } catch (error) {
            if (error instanceof UsageError) return undefined;
            throw error;
        }
    }

    private add(setting: string, discs: number, visited: Visited): void {
        const points = this.settings.get(setting) ?? new Map<number, Visited>();
        this.settings.set(setting, points.set(discs, visited));
        this.draw();
        this.storeInAddress();
        void this.evaluate(setting);
    }

    /** So that the points survive a reload. */
    private storeInAddress(): void {
        try {
            window.history.replaceState(null, "", this.link());
        } catch {
            // In some browsers the address of a local file cannot be changed.
        }
    }

    /** N_c from the points of the present setting. */
    private async evaluate(setting: string): Promise<void> {
        const points = this.settings.get(setting);
        if (!points || points.size < 2) return;
        const runs = [...points].map(([discs, {mean, error, periods}]): EvaluatedRun => (
            {discs, periods, rotation: perRate(() => ({mean, error, effective_samples: 0, blocks: 0}))}));
        const {by_time} = await this.runs.crossings(runs);
        if (this.present?.setting !== setting) return;
        this.found = by_time;
        this.draw();
    }

    private draw(): void {
        const present = this.present?.setting ?? "";
        const curves: Curve[] = [...this.settings].filter(([name]) => name !== present).map(([name, points]) =>
            ({name: this.nameOf(name), points: this.plotted(points), faint: true}));
        curves.unshift({name: this.nameOf(present), points: this.plotted(this.settings.get(present) ?? new Map())});
        const text = this.findingText();
        this.finding.textContent = text;
        const band = this.found && this.found.discs !== null && this.found.lower !== null && this.found.upper !== null
            ? [this.found.lower, this.found.upper] as [number, number] : undefined;
        this.plot.show([texts.numberOfDiscs, symbols.rotation], curves,
                       {at: this.present?.discs, live: this.live, band},
                       texts.discovery.description(this.settings.get(present)?.size ?? 0, text));
    }

    private plotted(points: Setting): PlottedPoint[] {
        return [...points].sort(([a], [b]) => a - b).map(([n, point]) => asPlotted(n, point));
    }

    private nameOf(setting: string): string {
        return [...new URLSearchParams(setting)].map(([name, value]) => `${name} ${value}`).join(", ") ||
            texts.discovery.defaults;
    }

    private findingText(): string {
        const found = this.found;
        if (!found || found.verdict !== "crosses") return texts.discovery.noCrossing;
        if (found.discs === null) return texts.discovery.bracket(found.lower!, found.upper!);
        return texts.discovery.crossing(withError(found.discs, found.error, ""));
    }

    private saveTable(): void {
        save("discovery.csv", {text: tableOf(this.settings), type: "text/csv"});
    }

    private clear(): void {
        this.settings.clear();
        this.found = undefined;
        this.draw();
    }

    /** An address with the present parameters and the points of this setting. */
    link(): string {
        const address = new URL(addressOf(this.host.given()), location.href);
        const points = this.settings.get(this.present?.setting ?? "");
        address.hash = points?.size ? `points=${linkTextOf(points)}` : "";
        return address.href;
    }

    private async copyLink(): Promise<void> {
        const link = this.link();
        try {
            await navigator.clipboard.writeText(link);
            this.finding.textContent = texts.discovery.linkCopied;
        } catch {
            this.finding.replaceChildren(texts.discovery.linkIs, element("code", {textContent: link}));
        }
    }

    /** The points in the page's address belong to the parameters in it. */
    private readLink(): void {
        const points = new URLSearchParams(location.hash.slice(1)).get("points");
        if (!points) return;
        this.settings.set(settingOf(Object.fromEntries(startParameters())), settingFrom(points));
    }
}
