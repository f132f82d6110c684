// Records the canvas as a movie, and the discs as extended XYZ with the columns of `swirl export`,
// which OVITO, VMD and ASE can read.
import {frameDisc, frameHead} from "../engine/engine";
import {button, element, save} from "../elements/page";
import {fill, texts} from "../texts/texts";

/** In order of preference. Safari before 18.4 records MP4 only. */
const movieTypes = ["video/webm;codecs=vp8", "video/webm", "video/mp4"];
const movieNames: Record<string, string> = {webm: "WebM", mp4: "MP4"};
const maxNumbers = 2e7; // limit of a recording, eight bytes each

/** A frame as extended XYZ. */
export function xyz(f: Float64Array): string {
    const discs = f[10]!;
    const lines = [
        String(discs),
        "Properties=species:S:1:pos:R:3:velo:R:3:omega:R:1:radius:R:1:" +
            `id:I:1 Time=${f[0]} pbc="F F F"`,
    ];
    const sizes = new Map<number, number>();
    for (let i = 0; i < discs; ++i) {
        const [x, y, , spin, vx, vy, radius] = f.subarray(
            frameHead + frameDisc * i,
            frameHead + frameDisc * (i + 1),
        );
        if (!sizes.has(radius!)) sizes.set(radius!, sizes.size + 1);
        lines.push(`D${sizes.get(radius!)} ${x} ${y} 0 ${vx} ${vy} 0 ${spin} ${radius} ${i + 1}`);
    }
    return lines.join("\n") + "\n";
}

/** One part per frame: a single string could exceed the browser's limit. */
export function positionsOf(frames: Float64Array[]): Blob {
    return new Blob(frames.map(xyz), {type: "chemical/x-xyz"});
}

/** The frames of a recording, up to a limit of memory. */
export class Frames {
    readonly all: Float64Array[] = [];
    private numbers = 0;

    /** False if another frame would not fit. */
    add(frame: Float64Array): boolean {
        this.all.push(frame);
        this.numbers += frame.length;
        return this.numbers + frame.length <= maxNumbers;
    }
}

export class Recording {
    readonly panel = element("span", {id: "recording"});
    private frames: Frames | undefined; // while recording
    private done: Float64Array[] = [];
    private recorder: MediaRecorder | undefined;
    private movie: Blob | undefined;
    private readonly start: HTMLButtonElement;

    /** `canvas` returns the canvas to record. */
    constructor(private readonly canvas: () => HTMLCanvasElement | undefined) {
        this.start = button(
            texts.record,
            () => (this.frames ? this.stop() : this.begin()),
            "record",
        );
        this.layOut();
    }

    add(frame: Float64Array): void {
        if (this.frames && !this.frames.add(frame)) this.stop();
    }

    /** Ends the recording, e.g. when the canvas or the simulation changes. */
    stop(): void {
        if (!this.frames) return;
        this.done = this.frames.all;
        this.frames = undefined;
        if (this.recorder)
            this.recorder.stop(); // its onstop stores the movie
        else this.layOut();
    }

    private begin(): void {
        this.frames = new Frames();
        this.done = []; // frees memory for the new recording
        this.movie = undefined;
        const canvas = this.canvas();
        const type = movieTypes.find((each) => globalThis.MediaRecorder?.isTypeSupported(each));
        if (canvas && type) {
            const parts: Blob[] = [];
            this.recorder = new MediaRecorder(canvas.captureStream(), {
                mimeType: type,
                videoBitsPerSecond: 6e6,
            });
            this.recorder.ondataavailable = ({data}): void => {
                parts.push(data);
            };
            this.recorder.onstop = (): void => {
                this.recorder = undefined;
                this.movie = new Blob(parts, {type: type.split(";")[0]!});
                this.layOut();
            };
            this.recorder.start();
        }
        this.layOut();
    }

    private layOut(): void {
        this.start.textContent = this.frames ? texts.recordStop : texts.record;
        this.start.setAttribute("aria-pressed", String(this.frames !== undefined));
        const buttons: HTMLElement[] = [];
        if (this.movie && !this.frames) {
            const movie = this.movie,
                form = movie.type.split("/")[1]!;
            buttons.push(
                button(
                    fill(texts.movie, {form: movieNames[form]!}),
                    () => save(`swirl.${form}`, {bytes: movie}),
                    "save-movie",
                ),
            );
        }
        if (this.done.length > 0 && !this.frames)
            buttons.push(
                button(
                    texts.positions,
                    () => save("swirl.xyz", {bytes: positionsOf(this.done)}),
                    "save-positions",
                ),
            );
        this.panel.replaceChildren(this.start, ...buttons);
    }
}
