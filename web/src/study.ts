// The paper's Figure 5b by oneself: ϖ(N) for frictions of one's choice, a run for every point, on
// all cores, and where the curves cross zero.
import uPlot from "uplot";
import {perRate, type Crossing, type Estimate, type Rate} from "./engine";
import type {FromWorker, ToWorker} from "./messages";
import {button, element, ink, line, save, withError} from "./page";
import {symbols, texts} from "./texts";

/** Between discs, and with the wall. */
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

/** The rate that is drawn. */
const drawn: Rate = "by_time";

const colors = ["#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00"];
const most = 400; // points
const nameOf = ({disc, wall}: Friction): string => texts.friction(disc, wall);

/** Not a number where there is nothing. */
const numberIn = (text: string): number => (text.trim() === "" ? NaN : Number(text));

/** "5, 10, 20:5:40": numbers, and ranges FROM:STEP:TO. Nothing if it is neither. */
export function numbersIn(text: string): number[] | undefined {
    const all: number[] = [];
    for (const part of text.split(",").map((each) => each.trim()).filter(Boolean)) {
        const [from, by, to, more] = part.split(":").map(numberIn) as [number, number?, number?, number?];
        if (!Number.isFinite(from) || more !== undefined) return undefined;
        if (by === undefined) all.push(from);
        else if (to === undefined || !(by > 0) || !(to >= from)) return undefined;
        else for (let k = 0; from + k * by <= to * (1 + 1e-12) && all.length <= most; ++k)
            all.push(from + k * by);
    }
    return all.length > 0 && all.length <= most ? all : undefined;
}

/** As numbersIn, for discs and wall alike, and DISC:WALL for a pair: "0.1, 0:0.5:1, 1:0"; each once.
 *  Nothing if it is none of these. */
export function frictionsIn(text: string): Friction[] | undefined {
    const all = new Map<string, Friction>();
    for (const part of text.split(",").filter((each) => each.trim())) {
        const pair = part.split(":").map(numberIn);
        const these = pair.length === 2 ? [{disc: pair[0]!, wall: pair[1]!}]
            : (numbersIn(part) ?? [NaN]).map((mu) => ({disc: mu, wall: mu}));
        for (const friction of these) {
            if (!Number.isFinite(friction.disc) || !Number.isFinite(friction.wall)) return undefined;
            all.set(nameOf(friction), friction);
        }
    }
    return all.size > 0 ? [...all.values()] : undefined;
}

/** What a run has found; nothing of one that collapsed, whose averages end where it did. */
function found({rotation, collapsed}: Extract<FromWorker, {kind: "point"}>): Partial<Point> {
    if (collapsed) return {done: true, collapsed};
    return {done: true, rotation};
}

export class Study {
    readonly panel: HTMLDetailsElement;
    private readonly discs = element("input", {type: "text", id: "study-discs", value: "5:6:53"});
    private readonly frictions = element("input", {type: "text", id: "study-mu", value: "0.1, 1"});
    private readonly swirls = element("input", {type: "text", id: "study-swirls", value: "200"});
    private readonly said = element("p", {id: "study-said"});
    private readonly findings = element("ul", {id: "study-findings"});
    private readonly place = element("div", {id: "study-plot"});
    private readonly start = button(texts.start, () => this.toggle(), "study-start");
    private plot: uPlot | undefined;
    private points: Point[] = [];
    private curves: Friction[] = [];
    private waiting: Point[] = [];
    private workers: Worker[] = [];

    /** `begin` makes a worker that has the engine; `given` says what else holds of every dish. */
    constructor(private readonly begin: () => Worker,
                private readonly given: () => Record<string, string>) {
        const field = (label: string, input: HTMLInputElement): HTMLElement =>
            element("label", {}, `${label} `, input);
        this.panel = element("details", {id: "study"},
            element("summary", {textContent: texts.study}),
            element("p", {textContent: texts.studyHow}),
            element("div", {className: "bar"}, field(symbols.discs, this.discs), field(symbols.friction, this.frictions),
                    field(texts.swirls, this.swirls), this.start,
                    button(texts.studyTable, () => this.saveTable(), "study-table")),
            this.said, this.place, this.findings);
    }

    private toggle(): void {
        if (this.workers.length > 0) {
            this.stop();
            this.said.textContent = texts.stopped;
            return;
        }
        const discs = numbersIn(this.discs.value), frictions = frictionsIn(this.frictions.value);
        const swirls = Number(this.swirls.value);
        if (!discs || !frictions || discs.length * frictions.length > most) {
            this.said.textContent = texts.studyWrong(most);
            return;
        }
        if (!(Number.isInteger(swirls) && swirls >= 10 && swirls <= 100000)) {
            this.said.textContent = texts.swirlsWrong(this.swirls.value);
            return;
        }
        this.curves = frictions;
        // Dense dishes take longest, so they come first.
        const numbers = [...new Set(discs)].sort((a, b) => b - a);
        this.points = numbers.flatMap((n) => this.curves.map((friction) => ({friction, discs: n})));
        this.waiting = [...this.points];
        this.findings.replaceChildren();
        this.draw();
        this.start.textContent = texts.stop;
        const cores = Math.min(navigator.hardwareConcurrency || 1, this.points.length, 16);
        this.workers = Array.from({length: cores}, () => this.begin());
        for (const worker of this.workers) this.employ(worker, swirls);
    }

    private stop(): void {
        for (const worker of this.workers) worker.terminate();
        this.workers = [];
        this.start.textContent = texts.start;
    }

    private employ(worker: Worker, swirls: number): void {
        let at: Point | undefined;
        const tell = (message: ToWorker): void => worker.postMessage(message);
        const next = (): void => {
            at = this.waiting.shift();
            if (at) tell({kind: "point", swirls, given: {
                ...this.given(), discs: String(at.discs), mu_disc: String(at.friction.disc),
                mu_wall: String(at.friction.wall)}});
            else if (this.points.every((each) => each.done)) this.askCrossings(tell);
        };
        worker.onmessage = ({data}: MessageEvent<FromWorker>): void => {
            if (data.kind === "ready") next();
            if (data.kind === "point" && at) {
                Object.assign(at, found(data));
                this.report();
                next();
            }
            if (data.kind === "crossing") this.showCrossing(this.curves[data.curve]!, data.crossings);
            if (data.kind === "refused") {
                this.stop();
                this.said.textContent = data.sentence;
            }
        };
    }

    private report(): void {
        const done = this.points.filter((each) => each.done).length;
        const lost = this.points.filter((each) => each.collapsed);
        const runs = lost.map((each) => texts.runOf(each.discs, nameOf(each.friction))).join(", ");
        this.said.textContent = texts.studyProgress(done, this.points.length) +
            (lost.length > 0 ? ` ${texts.collapsed(runs)}` : "");
        this.draw();
    }

    private askCrossings(tell: (message: ToWorker) => void): void {
        for (const [curve, friction] of this.curves.entries())
            tell({kind: "crossing", curve, curves: perRate((rate) => this.points
                .filter((each) => each.friction === friction)
                .flatMap(({discs, rotation}) => [discs, rotation?.[rate].mean ?? NaN, rotation?.[rate].error ?? NaN]))});
    }

    /** N_c depends on the rotation rate, so each has its own. */
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

    /** One standard error up and down, and the line ϖ = 0. */
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
