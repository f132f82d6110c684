// Draws the dish of the first page. What is drawn is a state of the engine, at one scale; only the
// camera moves by itself. When it rides with the swirl, the dish is at rest and its rim runs past.
import {frameDisc, frameHead} from "../engine/engine";
import {sectorColors, toned, type Palette} from "../drawing/palette";
import {drawSwirl, drawTurns, drawWallMark} from "../drawing/turns";
import {head, type Frame} from "../drawing/view";
import {sized} from "./canvas";

export interface Scene {
    frame: Float64Array;
    sectors: readonly number[];
    /** Turns of the cluster since the last change. */
    turns: number;
    amplitude: number;
    oilsRim: boolean;
    oilsDiscs: boolean;
    holdsSpins: boolean;
    isByHand: boolean;
    isPaused: boolean;
    palette: Palette;
}

const hair = 0.075; // unit of the lines, in radii of a disc
const around = 18.5 * hair; // room for the arc and its head
const rim = 0.42; // thickness of the wall
const oil = "#d8a72c";
const easing = 0.09; // share of the way to the other camera, per image

/** Collisions of pairs, which fade within about half a period. A disc that hits the wall is paired
 *  with itself. */
export class Pressed {
    private readonly pairs = new Map<string, {i: number; j: number; weight: number}>();

    add(contacts: Float64Array | undefined, discs: number): void {
        for (const [key, pair] of this.pairs) {
            pair.weight *= 0.93;
            if (pair.weight < 0.2 || Math.max(pair.i, pair.j) >= discs) this.pairs.delete(key);
        }
        for (let k = 0; contacts && k < contacts.length; k += 4) {
            const [i, j] = [contacts[k + 1]!, contacts[k + 2]!].sort((a, b) => a - b) as [
                number,
                number,
            ];
            if (j >= discs) continue;
            const key = `${i} ${j}`,
                pair = this.pairs.get(key);
            if (pair) pair.weight += 1;
            else this.pairs.set(key, {i, j, weight: 1});
        }
    }

    get all(): Iterable<{i: number; j: number; weight: number}> {
        return this.pairs.values();
    }
}

export class Stage {
    /** Whether the camera rides with the swirl, and how much of the way there it is. */
    rides = false;
    readonly pressed = new Pressed();
    private ride = 0;
    private angle = 0; // the camera has turned by it
    private phase: number | undefined; // the container's, in the last image
    private scale = 1;
    private middle: [number, number] = [0, 0];
    private readonly sprites = new Map<string, HTMLCanvasElement>();

    constructor(
        private readonly canvas: HTMLCanvasElement,
        private readonly movesCamera: boolean,
    ) {}

    /** Whether the camera is on its way. */
    get isMoving(): boolean {
        return this.ride !== Number(this.rides) || (!this.rides && this.angle !== 0);
    }

    /** A point of the page in the lab frame. */
    pointAt(event: {clientX: number; clientY: number}): [number, number] {
        const {left, top} = this.canvas.getBoundingClientRect();
        return [
            (event.clientX - left - this.middle[0]) / this.scale,
            (this.middle[1] - event.clientY + top) / this.scale,
        ];
    }

    draw(scene: Scene): void {
        const {context, width, height, ratio} = sized(this.canvas),
            frame = head(scene.frame);
        this.moveCamera(frame);
        const {ride} = this,
            room = frame.radius + (1 - ride) * scene.amplitude + around;
        this.scale = Math.min(width, height) / 2 / room;
        this.middle = [width / 2, height / 2];
        context.translate(...this.middle);
        context.scale(this.scale, -this.scale);
        context.save();
        context.rotate(-this.angle);
        context.translate(-ride * frame.centre[0], -ride * frame.centre[1]);
        this.drawDish(context, frame, scene);
        this.drawDiscs(context, frame, scene, ratio);
        if (ride > 0.5) this.drawPressed(context, frame, scene);
        context.restore();
        const [cx, cy] = frame.centre.map((x) => (1 - ride) * x) as [number, number];
        drawTurns(
            context,
            {...frame, centre: [cx, cy]},
            scene.turns,
            scene.palette,
            hair,
            rim + 0.5 * hair,
        );
        if (!scene.isByHand) this.drawPath(context, frame, scene, room);
        context.setTransform(ratio, 0, 0, ratio, 0, 0);
        if (scene.isPaused) drawPaused(context, width, height, scene.palette);
    }

    /** In the lower left corner: the direction of the swirl, as in movies, and where the dish is on
     *  its way. A camera that rides along does not see it. */
    private drawPath(
        context: CanvasRenderingContext2D,
        {centre}: Frame,
        {palette}: Scene,
        room: number,
    ): void {
        const radius = 0.085 * room,
            corner = 1.7 * radius - room;
        context.save();
        context.translate(corner, corner);
        context.globalAlpha = 1 - this.ride;
        drawSwirl(context, radius, palette, hair, 0, 1.6 * Math.PI);
        const phase = Math.atan2(centre[1], centre[0]);
        context.fillStyle = palette.ink;
        context.beginPath();
        context.arc(
            radius * Math.cos(phase),
            radius * Math.sin(phase),
            0.26 * radius,
            0,
            2 * Math.PI,
        );
        context.fill();
        context.restore();
    }

    private moveCamera({centre}: Frame): void {
        const phase = Math.atan2(centre[1], centre[0]);
        const more = this.phase === undefined ? 0 : phase - this.phase;
        this.phase = phase;
        const to = Number(this.rides);
        this.ride += (this.movesCamera ? easing : 1) * (to - this.ride);
        if (Math.abs(this.ride - to) < 0.004) this.ride = to;
        this.angle += this.ride * Math.atan2(Math.sin(more), Math.cos(more));
        if (this.rides) return;
        this.angle = Math.atan2(Math.sin(this.angle), Math.cos(this.angle));
        this.angle *= this.movesCamera ? 1 - easing : 0;
        if (Math.abs(this.angle) < 0.004) this.angle = 0;
    }

    /** The table, so that the dish is seen to move, and the dish with marks on its rim. */
    private drawDish(context: CanvasRenderingContext2D, frame: Frame, scene: Scene): void {
        const {palette, oilsRim} = scene,
            [cx, cy] = frame.centre,
            {radius} = frame;
        const disc = (r: number, color: string, dx = 0, dy = 0): void => {
            context.fillStyle = color;
            context.beginPath();
            context.arc(cx + dx, cy + dy, r, 0, 2 * Math.PI);
            context.fill();
        };
        context.globalAlpha = 0.35;
        const spacing = 3;
        for (let x = -10; x <= 10; ++x)
            for (let y = -10; y <= 10; ++y) {
                context.fillStyle = palette.quiet;
                context.fillRect(spacing * x - 0.06, spacing * y - 0.06, 0.12, 0.12);
            }
        context.globalAlpha = 1;
        disc(radius + rim, "rgb(0 0 0 / 0.14)", 0.18, -0.28);
        disc(radius + rim, oilsRim ? oil : palette.ink);
        disc(radius, palette.floor);
        if (oilsRim) return drawShine(context, cx, cy, radius);
        context.strokeStyle = palette.floor;
        context.lineWidth = 0.14;
        for (let k = 0; k < 36; ++k) {
            const to = radius + (k % 9 ? 0.24 : 0.4);
            drawWallMark(context, frame.centre, (k * Math.PI) / 18, radius + 0.06, to);
        }
    }

    private drawDiscs(
        context: CanvasRenderingContext2D,
        frame: Frame,
        scene: Scene,
        ratio: number,
    ): void {
        const f = scene.frame;
        for (let i = 0; i < frame.discs; ++i) {
            const k = frameHead + frameDisc * i,
                r = f[k + 6]!,
                color = sectorColors[scene.sectors[i] ?? 0]!;
            const size = Math.max(8, Math.ceil(2 * r * this.scale * ratio));
            context.save();
            context.translate(f[k]!, f[k + 1]!);
            context.rotate(this.angle); // the light stays where it is
            context.scale(1, -1);
            context.drawImage(this.sprite(color, size, scene.oilsDiscs), -r, -r, 2 * r, 2 * r);
            context.restore();
            context.save();
            context.translate(f[k]!, f[k + 1]!);
            context.rotate(f[k + 2]!);
            context.scale(r, r);
            drawEye(context, scene.holdsSpins);
            context.restore();
        }
    }

    /** A thick line between discs that collide often. */
    private drawPressed(context: CanvasRenderingContext2D, frame: Frame, scene: Scene): void {
        const f = scene.frame;
        context.strokeStyle = scene.palette.ink;
        context.lineCap = "round";
        context.globalAlpha = 0.75;
        for (const {i, j, weight} of this.pressed.all) {
            const a = frameHead + frameDisc * i,
                b = frameHead + frameDisc * j;
            const [x, y] = [f[a]!, f[a + 1]!],
                [dx, dy] = [x - frame.centre[0], y - frame.centre[1]],
                out = frame.radius / Math.hypot(dx, dy);
            const end: [number, number] =
                i === j
                    ? [frame.centre[0] + out * dx, frame.centre[1] + out * dy]
                    : [f[b]!, f[b + 1]!];
            if (Math.hypot(end[0] - x, end[1] - y) > 2.6) continue; // they have separated
            context.lineWidth = Math.min(0.5, 0.07 * weight);
            context.beginPath();
            context.moveTo(x, y);
            context.lineTo(...end);
            context.stroke();
        }
        context.globalAlpha = 1;
    }

    /** A disc, lit from the upper left; with oil it shines. */
    private sprite(color: string, size: number, isOiled: boolean): HTMLCanvasElement {
        const name = `${color} ${size} ${isOiled}`,
            known = this.sprites.get(name);
        if (known) return known;
        if (this.sprites.size > 60) this.sprites.clear(); // they belong to other sizes of the window
        const made = document.createElement("canvas"),
            context = made.getContext("2d")!,
            r = size / 2;
        made.width = made.height = size;
        const shade = context.createRadialGradient(0.62 * r, 0.55 * r, 0.1 * r, r, r, r);
        shade.addColorStop(0, toned(color, "white", isOiled ? 0.92 : 0.38));
        shade.addColorStop(isOiled ? 0.3 : 0.5, color);
        shade.addColorStop(1, toned(color, "black", 0.26));
        context.fillStyle = shade;
        context.beginPath();
        context.arc(r, r, r, 0, 2 * Math.PI);
        context.fill();
        this.sprites.set(name, made);
        return made;
    }
}

/** A cat's eye shows the orientation. A disc that cannot spin has a pin in its centre. */
function drawEye(context: CanvasRenderingContext2D, isHeld: boolean): void {
    context.fillStyle = "rgb(255 255 255 / 0.9)";
    context.beginPath();
    context.ellipse(0, 0, 0.64, 0.17, 0, 0, 2 * Math.PI);
    context.fill();
    context.fillStyle = "rgb(20 24 28 / 0.85)";
    context.beginPath();
    context.arc(0.42, 0, 0.13, 0, 2 * Math.PI);
    context.fill();
    if (!isHeld) return;
    context.beginPath();
    context.arc(0, 0, 0.3, 0, 2 * Math.PI);
    context.fill();
    context.fillStyle = "rgb(255 255 255 / 0.9)";
    context.beginPath();
    context.arc(0, 0, 0.12, 0, 2 * Math.PI);
    context.fill();
}

/** A smooth rim has no marks, and shines. */
function drawShine(context: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
    context.strokeStyle = "rgb(255 255 255 / 0.65)";
    context.lineWidth = 0.12;
    for (const from of [0.55, 1.55]) {
        context.beginPath();
        context.arc(x, y, radius + 0.24, from * Math.PI, (from + 0.4) * Math.PI);
        context.stroke();
    }
}

/** The sign for "play": time stands still. */
function drawPaused(
    context: CanvasRenderingContext2D,
    width: number,
    height: number,
    palette: Palette,
): void {
    const size = 22;
    context.fillStyle = palette.ink;
    context.beginPath();
    context.moveTo(width / 2 - 0.6 * size, height / 2 - size);
    context.lineTo(width / 2 + size, height / 2);
    context.lineTo(width / 2 - 0.6 * size, height / 2 + size);
    context.closePath();
    context.strokeStyle = palette.paper;
    context.lineWidth = 5;
    context.stroke();
    context.fill();
}
