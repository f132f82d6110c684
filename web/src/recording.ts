// What the canvas shows, as a movie, and the states behind it, as positions that OVITO, VMD and ASE
// read: extended XYZ, in the columns of `swirl export`.
import {frameDisc, frameHead} from "./engine";
import {button, element, save} from "./page";
import {texts} from "./texts";

const mostNumbers = 2e7; // in memory, eight bytes each

/** A frame as extended XYZ. */
export function xyz(f: Float64Array): string {
    const discs = f[10]!;
    const lines = [String(discs), "Properties=species:S:1:pos:R:3:velo:R:3:omega:R:1:radius:R:1:" +
        `id:I:1 Time=${f[0]} pbc="F F F"`];
    const sizes = new Map<number, number>();
    for (let i = 0; i < discs; ++i) {
        const [x, y, , spin, vx, vy, radius] =
            f.subarray(frameHead + frameDisc * i, frameHead + frameDisc * (i + 1));
        if (!sizes.has(radius!)) sizes.set(radius!, sizes.size + 1);
        lines.push(`D${sizes.get(radius!)} ${x} ${y} 0 ${vx} ${vy} 0 ${spin} ${radius} ${i + 1}`);
    }
    return lines.join("\n") + "\n";
}

/** Frame by frame: one string of them all might be longer than a browser allows. */
export function positionsOf(frames: Float64Array[]): Blob {
    return new Blob(frames.map(xyz), {type: "chemical/x-xyz"});
}

/** The frames of a recording, as far as memory is meant for them. */
export class Frames {
    readonly all: Float64Array[] = [];
    private numbers = 0;

    /** False when there is no room for another one. */
    add(frame: Float64Array): boolean {
        this.all.push(frame);
        this.numbers += frame.length;
        return this.numbers + frame.length <= mostNumbers;
    }
}

export class Recording {
    readonly panel = element("span", {id: "recording"});
    private frames: Frames | undefined; // while it goes on
    private done: Float64Array[] = [];
    private movie: MediaRecorder | undefined;
    private film: Blob | undefined;
    private readonly start: HTMLButtonElement;

    /** `canvas` is what is filmed. */
    constructor(private readonly canvas: () => HTMLCanvasElement | undefined) {
        this.start = button(texts.record, () => (this.frames ? this.stop() : this.begin()), "record");
        this.layOut();
    }

    add(frame: Float64Array): void {
        if (this.frames && !this.frames.add(frame)) this.stop();
    }

    /** Another canvas, or another dish: the film ends. */
    stop(): void {
        if (!this.frames) return;
        this.done = this.frames.all;
        this.frames = undefined;
        if (this.movie) this.movie.stop(); // and then it hands over the film
        else this.layOut();
    }

    private begin(): void {
        this.frames = new Frames();
        this.done = []; // its memory is the new one's
        this.film = undefined;
        const canvas = this.canvas();
        const type = ["video/webm;codecs=vp8", "video/webm"].find(
            (each) => globalThis.MediaRecorder?.isTypeSupported(each));
        if (canvas && type) {
            const parts: Blob[] = [];
            this.movie = new MediaRecorder(canvas.captureStream(), {mimeType: type,
                                                                    videoBitsPerSecond: 6e6});
            this.movie.ondataavailable = ({data}): void => { parts.push(data); };
            this.movie.onstop = (): void => {
                this.movie = undefined;
                this.film = new Blob(parts, {type: "video/webm"});
                this.layOut();
            };
            this.movie.start();
        }
        this.layOut();
    }

    private layOut(): void {
        this.start.textContent = this.frames ? texts.recordEnds : texts.record;
        this.start.setAttribute("aria-pressed", String(this.frames !== undefined));
        const kept: HTMLElement[] = [];
        if (this.film && !this.frames) {
            const film = this.film;
            kept.push(button(texts.film, () => save("swirl.webm", {bytes: film}), "save-film"));
        }
        if (this.done.length > 0 && !this.frames)
            kept.push(button(texts.positions, () => save("swirl.xyz", {bytes: positionsOf(this.done)}),
                             "save-positions"));
        this.panel.replaceChildren(this.start, ...kept);
    }
}
