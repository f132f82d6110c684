// Why the cluster reverses, in three parts: a pancake that rolls on the wall, the contacts of this
// run, and gears that jam. Only the second part is the simulation; the others are pictures of the
// minimal model.
import type {Laboratory} from "../engine/laboratory";
import {button, dark, element, localized, signed, withError} from "../elements/page";
import {paletteOf, sectorColors} from "../drawing/palette";
import {fill, texts} from "../texts/texts";

/** γ = |ϖ_M|/Ω of a rigid disc that rolls on the wall with the slip parameter `slip`; ϖ/Ω = 1 − γ.
 *  */
export const pancakeGamma = (slip: number, size: number): number => slip / size;

const pace = 0.4; // periods per second of the pictures
const amplitude = 0.22; // unit: the container's radius, as in the paper

type Context = CanvasRenderingContext2D;

/** A canvas with y upwards, whose unit is half its width. */
function contextOf(canvas: HTMLCanvasElement): Context | null {
    const size = Math.round(canvas.clientWidth * (window.devicePixelRatio || 1)),
        context = canvas.getContext("2d");
    if (canvas.width !== size) canvas.width = canvas.height = size;
    context?.setTransform(size / 2, 0, 0, -size / 2, size / 2, size / 2);
    context?.clearRect(-1, -1, 2, 2);
    return context;
}

/** A disc in the colours of sectors that has turned by `angle`. */
function drawPancake(
    context: Context,
    x: number,
    y: number,
    r: number,
    angle: number,
    ink: string,
): void {
    for (const [k, color] of sectorColors.entries()) {
        const from = angle + (k * Math.PI) / 3;
        context.fillStyle = color;
        context.beginPath();
        context.moveTo(x, y);
        context.arc(x, y, r, from, from + Math.PI / 3 + 0.01);
        context.fill();
    }
    context.strokeStyle = ink;
    context.lineWidth = 0.012;
    context.beginPath();
    context.arc(x, y, r, 0, 2 * Math.PI);
    context.stroke();
}

/** A gear with a mark that has turned by `angle`. */
function drawGear(
    context: Context,
    [x, y]: [number, number],
    r: number,
    angle: number,
    color: string,
): void {
    const teeth = 12;
    context.fillStyle = color;
    context.beginPath();
    for (let k = 0; k < 4 * teeth; ++k) {
        const a = angle + (k * Math.PI) / (2 * teeth),
            at = r * (k % 4 < 2 ? 1.08 : 0.92);
        context.lineTo(x + at * Math.cos(a), y + at * Math.sin(a));
    }
    context.fill();
    context.fillStyle = "#fff";
    context.beginPath();
    context.arc(
        x + 0.6 * r * Math.cos(angle),
        y + 0.6 * r * Math.sin(angle),
        0.14 * r,
        0,
        2 * Math.PI,
    );
    context.fill();
}

export class CausePanel {
    readonly panel: HTMLDetailsElement;
    private readonly pancake = element("canvas", {id: "pancake"});
    private readonly gears = element("canvas", {id: "gears"});
    private readonly slip = element("input", {
        type: "range",
        id: "pancake-slip",
        min: "0",
        max: "1",
        step: "0.01",
        value: "1",
    });
    private readonly size = element("input", {
        type: "range",
        id: "pancake-size",
        min: "0.4",
        max: "0.98",
        step: "0.01",
        value: "0.8",
    });
    private readonly finding = element("p", {id: "pancake-finding", className: "finding"});
    private readonly measured = element("p", {id: "cause-measured", className: "finding"});

    /** `showContacts` shows few and many discs with their contacts in the containers above. */
    constructor(
        private readonly lab: Laboratory,
        private readonly isStill: boolean,
        showContacts: () => void,
    ) {
        const {cause} = texts,
            slider = (label: string, input: HTMLElement): HTMLElement =>
                element("label", {}, label, " ", input);
        const part = (title: string, ...children: (Node | string)[]): HTMLElement =>
            element("section", {}, element("h3", {textContent: title}), ...children);
        for (const [canvas, label] of [
            [this.pancake, cause.pancakePicture],
            [this.gears, cause.gearsPicture],
        ] as const) {
            canvas.setAttribute("role", "img");
            canvas.setAttribute("aria-label", label);
        }
        this.panel = element(
            "details",
            {id: "cause"},
            element("summary", {textContent: cause.title}),
            element(
                "div",
                {className: "causes"},
                part(
                    cause.pancake,
                    this.pancake,
                    slider(cause.slipSlider, this.slip),
                    slider(cause.sizeSlider, this.size),
                    this.finding,
                    element("p", {textContent: cause.pancakeText}),
                ),
                part(
                    cause.contacts,
                    element("p", {textContent: cause.contactsText}),
                    button(cause.showContacts, showContacts, "show-contacts"),
                    this.measured,
                ),
                part(
                    cause.gears,
                    this.gears,
                    element("p", {className: "quiet", textContent: cause.gearsPicture}),
                    element("p", {textContent: cause.gearsText}),
                ),
            ),
        );
        for (const input of [this.slip, this.size])
            input.addEventListener("input", () => this.show());
        this.panel.addEventListener("toggle", () => {
            if (this.panel.open) this.animate(performance.now());
        });
        lab.on("averages", () => this.showMeasured());
        this.show();
        this.showMeasured();
    }

    private get gamma(): number {
        return pancakeGamma(Number(this.slip.value), Number(this.size.value));
    }

    private show(): void {
        for (const input of [this.slip, this.size]) {
            input.setAttribute("aria-valuetext", signed(Number(input.value), 2));
            input.style.setProperty(
                "--share",
                `${(100 * (Number(input.value) - Number(input.min))) / (Number(input.max) - Number(input.min))}%`,
            );
        }
        const rotation = 1 - this.gamma,
            way = Math.abs(rotation) < 0.005 ? "still" : rotation > 0 ? "with" : "against";
        this.finding.textContent = fill(texts.cause.pancakeFinding, {
            slip: signed(Number(this.slip.value), 2),
            size: signed(Number(this.size.value), 2),
            gamma: signed(this.gamma, 2),
            rotation: signed(rotation, 2),
            way: texts.cause.pancakeWays[way],
        });
        this.finding.className = `finding ${way}`;
        if (this.isStill) this.draw(0);
    }

    private showMeasured(): void {
        const {cause} = this.lab,
            share = (x: number | null | undefined): string =>
                x === null || x === undefined
                    ? texts.notYet
                    : localized(`${Math.round(100 * x)} %`);
        this.measured.textContent = fill(texts.cause.measured, {
            particles: this.lab.counted(this.lab.last?.frame[10] ?? 0),
            slip: cause?.slip == null ? texts.notYet : signed(cause.slip, 2),
            wall: share(cause?.wallSticking),
            disc: share(cause?.discSticking),
            correlation: withError(
                cause?.spinCorrelation ?? null,
                cause?.spinCorrelationError ?? null,
                texts.notYet,
            ),
        });
    }

    private animate(now: number): void {
        if (!this.panel.open) return;
        this.draw((now / 1000) * pace);
        if (!this.isStill) requestAnimationFrame((time) => this.animate(time));
    }

    /** The pictures after this many periods. */
    private draw(periods: number): void {
        const palette = paletteOf(dark());
        this.drawDish(periods, palette.ink, palette.floor);
        this.drawGears(periods, [palette.with, palette.against], palette.ink);
    }

    private drawDish(periods: number, ink: string, floor: string): void {
        const context = contextOf(this.pancake),
            R = 0.97 / (1 + amplitude),
            angle = 2 * Math.PI * periods,
            r = R * Number(this.size.value);
        if (!context) return;
        const [c, s] = [Math.cos(angle), Math.sin(angle)],
            [x, y] = [amplitude * R * c, amplitude * R * s];
        context.fillStyle = floor;
        context.strokeStyle = ink;
        context.lineWidth = 0.025;
        context.beginPath();
        context.arc(x, y, R, 0, 2 * Math.PI);
        context.fill();
        context.stroke();
        // The pancake lies at M, the point of the wall farthest from the centre of the path.
        drawPancake(context, x + (R - r) * c, y + (R - r) * s, r, angle * (1 - this.gamma), ink);
    }

    /** Two gears turn in opposite directions; a third that touches both jams them. */
    private drawGears(periods: number, [one, other]: [string, string], ink: string): void {
        const context = contextOf(this.gears),
            r = 0.24,
            angle = 2 * Math.PI * periods;
        if (!context) return;
        drawGear(context, [-0.68, 0.5], r, angle, one);
        drawGear(context, [-0.68 + 2 * r, 0.5], r, Math.PI / 12 - angle, other);
        const shake = 0.03 * Math.sin(9 * angle),
            low = -0.62,
            x = 0.28;
        drawGear(context, [x - r, low], r, shake, one);
        drawGear(context, [x + r, low], r, Math.PI / 12 - shake, other);
        drawGear(context, [x, low + Math.sqrt(3) * r], r, shake, ink);
    }
}
