// Records the canvas as a movie. The positions of a run are in the recordings of the command line.
import {button, element, save} from "../elements/page";
import {fill, texts} from "../texts/texts";

/** In order of preference. Safari before 18.4 records MP4 only. */
const movieTypes = ["video/webm;codecs=vp8", "video/webm", "video/mp4"];
const movieNames: Record<string, string> = {webm: "WebM", mp4: "MP4"};

export class Recording {
    readonly panel = element("span", {id: "recording"});
    private recorder: MediaRecorder | undefined;
    private movie: Blob | undefined;
    private readonly start: HTMLButtonElement;

    /** `canvas` returns the canvas to record. */
    constructor(private readonly canvas: () => HTMLCanvasElement | undefined) {
        this.start = button(
            texts.record,
            () => (this.recorder ? this.stop() : this.begin()),
            "record",
        );
        this.layOut();
    }

    /** Ends the recording, e.g. when the canvas or the simulation changes; onstop stores the movie. */
    stop(): void {
        if (this.recorder?.state === "recording") this.recorder.stop();
    }

    private begin(): void {
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
        this.start.textContent = this.recorder ? texts.recordStop : texts.record;
        this.start.setAttribute("aria-pressed", String(this.recorder !== undefined));
        const buttons: HTMLElement[] = [];
        if (this.movie && !this.recorder) {
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
        this.panel.replaceChildren(this.start, ...buttons);
    }
}
