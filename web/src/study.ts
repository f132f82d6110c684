// Reproduces the paper's Figure 5b: ϖ(N) for chosen friction coefficients, with one run per point on
// all cores, and N_c, where each curve crosses zero.
import uPlot from "uplot";
import {perRate, type Crossing, type Estimate, type Rate} from "./engine";
import type {FromWorker, ToWorker} from "./messages";
import {button, element, ink, line, save, withError} from "./page";
import {symbols, texts} from "./texts";

/** Friction coefficients between discs and at the wall. */
export interface Friction {
    disc: number;
    wall: number;
}

interface Point {
    friction: Friction;
    discs: number;
    done?: boolean;
    collapsed?: boolean;
    rotation?: Record<Rate, Estimate>;
}

/** The rotation rate in the plot. */
const drawn: Rate = "by_time";

const colors = ["#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00"];
const maxPoints = 400; // points
const nameOf = ({disc, wall}: Friction): string => texts.friction(disc, wall);

/** NaN for an empty text. */
const parseNumber = (text: string): number => (text.trim() === "" ? NaN : Number(text));

/** Parses numbers and ranges FROM:STEP:TO: "5, 10, 20:5:40". Undefined if the text is not valid. */
export function parseNumbers(text: string): number[] | undefined {
    const all: number[] = [];
    for (const part of text.split(",").map((each) => each.trim()).filter(Boolean)) {
        const [from, by, to, more] = part.split(":").map(parseNumber) as [number, number?, number?, number?];
        if (!Number.isFinite(from) || more !== undefined) return undefined;
        if (by === undefined) all.push(from);
        else if (to === undefined || !(by > 0) || !(to >= from)) return undefined;
        else for (let k = 0; from + k * by <= to * (1 + 1e-12) && all.length <= maxPoints; ++k)
            all.push(from + k * by);
    }
    return all.length > 0 && all.length <= maxPoints ? all : undefined;
}

/** Parses friction coefficients like parseNumbers; DISC:WALL sets the two separately: "0.1, 0:0.5:1,
 *  1:0". Duplicates are removed. Undefined if the text is not valid. */
export function parseCoefficients(text: string): Friction[] | undefined {
    const all = new Map<string, Friction>();
    for (const part of text.split(",").filter((each) => each.trim())) {
        const pair = part.split(":").map(parseNumber);
        const parsed = pair.length === 2 ? [{disc: pair[0]!, wall: pair[1]!}]
            : (parseNumbers(part) ?? [NaN]).map((mu) => ({disc: mu, wall: mu}));
        for (const friction of parsed) {
            if (!Number.isFinite(friction.disc) || !Number.isFinite(friction.wall)) return undefined;
            all.set(nameOf(friction), friction);
        }
    }
    return all.size > 0 ? [...all.values()] : undefined;
}

/** The result of a run. A collapsed run has no rotation rate, since its averages end at the collapse. */
function found({rotation, collapsed}: Extract<FromWorker, {kind: "point"}>): Partial<Point> {
    if (collapsed) return {done: true, collapsed};
    return {done: true, rotation};
}

export class Study {
    readonly panel: HTMLDetailsElement;
    private readonly discs = element("input", {type: "text", id: "study-discs", value: "5:6:53"});
    private readonly coefficients = element("input", {type: "text", id: "study-mu", value: "0.1, 1"});
    private readonly periods = element("input", {type: "text", id: "study-periods", value: "200"});
    private readonly status = element("p", {id: "study-status"});
    private readonly findings = element("ul", {id: "study-findings"});
    private readonly place = element("div", {id: "study-plot"});
    private readonly start = button(texts.start, () => this.toggle(), "study-start");
    private plot: uPlot | undefined;
    private points: Point[] = [];
    private curves: Friction[] = [];
    private waiting: Point[] = [];
    private workers: Worker[] = [];

    /** `begin` creates a worker with the engine; `given` returns the other parameters of all runs. */
    constructor(private readonly begin: () => Worker,
                private readonly given: () => Record<string, string>) {
        const field = (label: string, input: HTMLInputElement): HTMLElement =>
            element("label", {}, `${label} `, input);
        this.panel = element("details", {id: "study"},
            element("summary", {textContent: texts.study}),
            element("p", {textContent: texts.studyHelp}),
            element("div", {className: "bar"}, field(symbols.discs, this.discs), field(symbols.friction, this.coefficients),
                    field(texts.periods, this.periods), this.start,
                    button(texts.studyTable, () => this.saveTable(), "study-table")),
            this.status, this.place, this.findings);
    }

    private toggle(): void {
        if (this.workers.length > 0) {
            this.stop();
            this.status.textContent = texts.stopped;
            return;
        }
        const discs = parseNumbers(this.discs.value), coefficients = parseCoefficients(this.coefficients.value);
        const periods = Number(this.periods.value);
        if (!discs || !coefficients || discs.length * coefficients.length > maxPoints) {
            this.status.textContent = texts.invalidStudy(maxPoints);
            return;
        }
        if (!(Number.isInteger(periods) && periods >= 10 && periods <= 100000)) {
            this.status.textContent = texts.invalidPeriods(this.periods.value);
            return;
        }
        this.curves = coefficients;
        // Runs with many discs take longest, so they come first.
        const numbers = [...new Set(discs)].sort((a, b) => b - a);
        this.points = numbers.flatMap((n) => this.curves.map((friction) => ({friction, discs: n})));
        this.waiting = [...this.points];
        this.findings.replaceChildren();
        this.draw();
        this.start.textContent = texts.stop;
        const cores = Math.min(navigator.hardwareConcurrency || 1, this.points.length, 16);
        this.workers = Array.from({length: cores}, () => this.begin());
        for (const worker of this.workers) this.runPoints(worker, periods);
    }

    private stop(): void {
        for (const worker of this.workers) worker.terminate();
        this.workers = [];
        this.start.textContent = texts.start;
    }

    private runPoints(worker: Worker, periods: number): void {
        let at: Point | undefined;
        const send = (message: ToWorker): void => worker.postMessage(message);
        const next = (): void => {
            at = this.waiting.shift();
            if (at) send({kind: "point", periods, given: {
                ...this.given(), discs: String(at.discs), mu_disc: String(at.friction.disc),
                mu_wall: String(at.friction.wall)}});
            else if (this.points.every((each) => each.done)) this.requestCrossings(send);
        };
        worker.onmessage = ({data}: MessageEvent<FromWorker>): void => {
            if (data.kind === "ready") next();
            if (data.kind === "point" && at) {
                Object.assign(at, found(data));
                this.report();
                next();
            }
            if (data.kind === "crossing") this.showCrossing(this.curves[data.curve]!, data.crossings);
            if (data.kind === "rejected") {
                this.stop();
                this.status.textContent = data.message;
            }
        };
    }

    private report(): void {
        const done = this.points.filter((each) => each.done).length;
        const collapsed = this.points.filter((each) => each.collapsed);
        const runs = collapsed.map((each) => texts.runOf(each.discs, nameOf(each.friction))).join(", ");
        this.status.textContent = texts.studyProgress(done, this.points.length) +
            (collapsed.length > 0 ? ` ${texts.collapsed(runs)}` : "");
        this.draw();
    }

    private requestCrossings(send: (message: ToWorker) => void): void {
        for (const [curve, friction] of this.curves.entries())
            send({kind: "crossing", curve, curves: perRate((rate) => this.points
                .filter((each) => each.friction === friction)
                .flatMap(({discs, rotation}) => [discs, rotation?.[rate].mean ?? NaN, rotation?.[rate].error ?? NaN]))});
    }

    /** Each rotation rate has its own N_c. */
    private showCrossing(friction: Friction, crossings: Record<Rate, Crossing | null>): void {
        const found = perRate((rate) => {
            const crossing = crossings[rate];
            if (crossing === null) return texts.noCrossing;
            return crossing.discs === null ? texts.bracket(crossing.lower, crossing.upper)
                : texts.crossing(withError(crossing.discs, crossing.error, ""), crossing.lower, crossing.upper);
        });
        this.findings.append(element("li", {textContent: texts.crossings(nameOf(friction), found)}));
        if (this.findings.childElementCount === this.curves.length) this.stop();
    }

    private saveTable(): void {
        const rows = this.points.filter((each) => each.done).map((each) => [
            each.friction.disc, each.friction.wall, each.discs, each.rotation?.[drawn].mean ?? "",
            each.rotation?.[drawn].error ?? "", each.collapsed ? 1 : 0, each.rotation?.rigid_by_time.mean ?? "",
            each.rotation?.rigid_by_time.error ?? ""].join(",") + "\n");
        save("rotation_against_N.csv",
             {text: `mu_disc,mu_wall,discs,varpi,varpi_error,collapsed,varpi_rigid,varpi_rigid_error\n${rows.join("")}`, type: "text/csv"});
    }

    private draw(): void {
        const numbers = [...new Set(this.points.map((each) => each.discs))].sort((a, b) => a - b);
        const values = (friction: Friction): (number | null)[] => numbers.map((n) => this.points.find(
            (each) => each.friction === friction && each.discs === n)?.rotation?.[drawn].mean ?? null);
        this.plot?.destroy();
        this.plot = new uPlot({
            width: this.place.clientWidth || 400, height: 260,
            scales: {x: {time: false}},
            axes: [{label: texts.numberOfDiscs, stroke: ink, grid: {stroke: line}},
                   {label: symbols.rotation, stroke: ink, grid: {stroke: line}}],
            series: [{label: symbols.discs}, ...this.curves.map((friction, k) => (
                {label: nameOf(friction), stroke: colors[k % colors.length]!, width: 1.5,
                 spanGaps: true, points: {show: true, size: 5}}))],
            hooks: {draw: [(plot) => this.drawErrors(plot)]},
        }, [numbers, ...this.curves.map(values)], this.place);
    }

    /** Error bars of one standard error, and the line ϖ = 0. */
    private drawErrors(plot: uPlot): void {
        const context = plot.ctx;
        context.save();
        context.strokeStyle = ink();
        context.lineWidth = 1;
        const zero = plot.valToPos(0, "y", true);
        if (zero > plot.bbox.top && zero < plot.bbox.top + plot.bbox.height) {
            context.beginPath();
            context.moveTo(plot.bbox.left, zero);
            context.lineTo(plot.bbox.left + plot.bbox.width, zero);
            context.stroke();
        }
        for (const {friction, discs, rotation} of this.points) {
            const mean = rotation?.[drawn].mean ?? NaN, error = rotation?.[drawn].error ?? NaN;
            if (!Number.isFinite(mean + error)) continue;
            context.strokeStyle = colors[this.curves.indexOf(friction) % colors.length]!;
            const x = plot.valToPos(discs, "x", true);
            context.beginPath();
            context.moveTo(x, plot.valToPos(mean - error, "y", true));
            context.lineTo(x, plot.valToPos(mean + error, "y", true));
            context.stroke();
        }
        context.restore();
    }
}
