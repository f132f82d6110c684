// The direction in which the cluster rotates: as a sentence, on a signed gauge and as numbers.
import type {ComparedContainer} from "../dish/compared";
import {intervalOf} from "../engine/estimates";
import {findingOf, rotationText, type Direction, type Finding} from "../dish/finding";
import type {Laboratory} from "../engine/laboratory";
import {byId, element, signed, withElements} from "../elements/page";
import {settingOf} from "./settings";
import {fill, symbols, texts} from "../texts/texts";

const gaugeFrom = -0.4,
    gaugeTo = 1.1; // ϖ/Ω; clusters without wall friction rotate at 1
/** Square roots: counterrotation of some hundredths is visible, too. */
const root = (x: number): number => Math.sign(x) * Math.sqrt(Math.abs(x));
const position = (x: number): number =>
    100 * Math.max(0, Math.min(1, (root(x) - root(gaugeFrom)) / (root(gaugeTo) - root(gaugeFrom))));
const percent = (x: number): string => `${x.toFixed(2)}%`;

export class Verdict {
    private readonly band = element("div", {className: "band"});
    private readonly needle = element("div", {className: "needle"});
    private readonly rate = element("span", {id: "rotation"});
    private readonly gauge = byId("gauge");
    private said = "";
    /** The container next to the first. */
    other: () => ComparedContainer | undefined = () => undefined;

    constructor(private readonly lab: Laboratory) {
        const side = (direction: Direction): HTMLElement =>
            element("span", {className: `side ${direction}`, textContent: texts.sides[direction]});
        this.gauge.replaceChildren(
            element("div", {className: "sides"}, side("against"), side("with")),
            element("div", {className: "track"}, this.band, this.needle),
            element("div", {className: "reading"}, `${symbols.rotation} = `, this.rate),
        );
        this.gauge.style.setProperty("--zero", percent(position(0)));
        this.gauge.title = texts.rotationHelp;
        this.gauge.setAttribute("role", "meter");
        this.gauge.setAttribute("aria-label", symbols.rotation);
        this.gauge.setAttribute("aria-valuemin", String(gaugeFrom));
        this.gauge.setAttribute("aria-valuemax", String(gaugeTo));
        lab.on("begin", () => this.clear());
        lab.on("changed", () => this.clear());
        lab.on("averages", () => this.show());
        lab.on("error", () => this.say(texts.noSimulation));
        lab.on("progress", (unit, done, all) => this.say(fill(texts.running[unit], {done, all})));
    }

    /** Shows a text instead of the verdict until the next verdict. */
    say(text: string): void {
        if (text === this.said) return;
        this.said = text;
        byId("headline").textContent = text;
    }

    get finding(): Finding {
        const {lab} = this,
            {last} = lab;
        const periods = last ? last.frame[1]! + last.frame[2]! / lab.value("period") : 0;
        return findingOf(lab.averages, last?.turns[0] ?? 0, periods);
    }

    private clear(): void {
        this.drawGauge({mean: null, error: null, direction: undefined, isFirm: false});
        byId("numbers").replaceChildren();
        const discs = Number(this.lab.given["discs"]);
        // Many discs, or discs close to the densest packing, take seconds.
        this.say(
            !this.lab.last && discs > 0
                ? fill(texts.placing, {particles: this.lab.counted(discs, this.lab.given)})
                : "…",
        );
    }

    private show(): void {
        const {lab, finding} = this,
            n = lab.last?.frame[10] ?? 0,
            particles = lab.counted(n);
        this.drawGauge(finding);
        this.showNumbers();
        if (lab.isByHand)
            return this.say(
                fill(texts.byHandHeadline, {turns: signed(lab.last?.turns[0] ?? 0, 2)}),
            );
        const {direction, isFirm, error} = finding;
        if (!direction) return this.say(fill(texts.undecided, {particles}));
        const strong = (words: Record<Direction, string>, way: Direction): HTMLElement =>
            element("strong", {textContent: words[way], className: way});
        const other = this.other(),
            beside = other?.finding.direction;
        // Both in one sentence, if only their numbers differ, and not from the warm-up.
        if (
            other?.hasAverages &&
            beside &&
            (lab.averages?.mean_by_time.blocks ?? 0) > 0 &&
            settingOf(other.given) === settingOf(lab.given)
        ) {
            return this.write(fill(texts.both, {few: lab.counted(other.particles), many: n}), {
                one: strong(texts.ways, beside),
                other: strong(texts.ways, direction),
            });
        }
        const words = isFirm
            ? fill(texts.verdict, {n, particles})
            : error !== null
              ? fill(texts.nearZero, {particles})
              : fill(texts.soFar, {particles});
        this.write(words, {direction: strong(texts.sides, direction)});
        byId("verdict").classList.toggle("firm", isFirm);
    }

    /** Shows a text with elements in place of the names in braces. */
    private write(words: string, elements: Record<string, HTMLElement>): void {
        const text = words.replace(/\{(\w+)\}/g, (_, name: string) => elements[name]!.textContent!);
        if (text === this.said) return;
        this.said = text;
        byId("headline").replaceChildren(...withElements(words, elements));
    }

    private drawGauge({mean, error, direction}: Finding): void {
        this.gauge.dataset["direction"] = direction ?? "";
        this.needle.hidden = this.band.hidden = mean === null;
        this.rate.textContent = rotationText(this.finding);
        this.gauge.setAttribute("aria-valuetext", this.rate.textContent);
        this.gauge.setAttribute("aria-valuenow", String(mean ?? 0));
        if (mean === null) return;
        this.gauge.style.setProperty("--at", percent(position(mean)));
        const [from, to] = [-1, 1].map((side) =>
            position(mean + side * intervalOf(error ?? 0)),
        ) as [number, number];
        this.band.style.left = percent(from);
        this.band.style.width = percent(to - from);
        this.band.classList.toggle("unknown", error === null);
    }

    private showNumbers(): void {
        const {lab} = this,
            {last, averages} = lab;
        if (!last) return;
        const [turns, rigid] = last.turns,
            time = last.frame[0]!;
        const differ = Math.abs(turns - rigid) > Math.max(0.1, 0.15 * Math.abs(turns));
        const pairs: [string, string, string, string][] = [
            [
                texts.turned,
                fill(texts.turns, {turns: signed(turns, 2)}),
                texts.turnedHelp,
                "turned",
            ],
            [
                texts.periods,
                signed(time / lab.value("period"), 1),
                texts.periodsHelp,
                "period-count",
            ],
        ];
        if (lab.isByHand) pairs.pop(); // there is no period
        const warmup =
            averages && averages.mean_by_time.blocks === 0 && !lab.isByHand
                ? fill(texts.warmup, {periods: averages.warmup})
                : "";
        byId("numbers").replaceChildren(
            element(
                "dl",
                {id: "estimates"},
                ...pairs.map(([name, value, title, id]) =>
                    element(
                        "div",
                        {title},
                        element("dt", {textContent: name}),
                        element("dd", {id, textContent: value}),
                    ),
                ),
            ),
            element("p", {
                id: "note",
                textContent:
                    warmup || (differ ? fill(texts.differ, {rigid: signed(rigid, 2)}) : ""),
            }),
            element("p", {id: "caution", textContent: this.caution()}),
        );
    }

    /** A warning about the averages; empty if there is none. */
    private caution(): string {
        const {lab} = this,
            energyGrows =
                lab.conservesEnergy() &&
                lab.value("amplitude") > 0 &&
                lab.configuration["path"] !== "circle";
        return energyGrows && !lab.isByHand ? texts.grows : "";
    }
}
