// Examples as small live containers: a click sets their parameters.
import type {FromWorker, ToWorker} from "../engine/messages";
import type {Laboratory} from "../engine/laboratory";
import {byId, dark, element} from "../elements/page";
import {SectorPaint} from "../drawing/paint";
import {draw, extentOf} from "../drawing/scene";
import {examples} from "../texts/texts";

/** The thumbnails show this period. */
const shownPeriod = 8;

/** Draws the examples one after the other. */
export function buildGallery(
    lab: Laboratory,
    chosen: (given: Record<string, string>) => void,
): void {
    const pictures = examples.map(({name, help, given}) => {
        const canvas = element("canvas");
        canvas.setAttribute("aria-hidden", "true");
        const made = element(
            "button",
            {type: "button", className: "example", title: help},
            canvas,
            element("span", {textContent: name}),
        );
        made.addEventListener("click", () => chosen(given));
        return {
            made,
            canvas,
            given,
            frame: undefined as Float64Array | undefined,
            paint: new SectorPaint(),
            room: 0,
        };
    });
    const redraw = (): void => {
        for (const {canvas, frame, paint, room} of pictures)
            if (frame)
                draw(canvas, frame, {
                    view: "lab",
                    coloring: "sector",
                    sectors: paint.sectors,
                    omega: 0,
                    dark: dark(),
                    extent: extentOf(frame, room),
                    turns: 0,
                    held: undefined,
                    isSmall: true,
                });
    };
    const show = (): void => {
        for (const {made, given} of pictures)
            made.setAttribute("aria-pressed", String(sameGiven(given, lab.given)));
    };
    byId("gallery").replaceChildren(...pictures.map(({made}) => made));
    lab.on("given", show);
    addEventListener("resize", redraw);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);

    const worker = lab.newWorker(),
        send = (message: ToWorker): void => worker.postMessage(message);
    let at = 0;
    const begin = (): void => send({kind: "begin", given: pictures[at]!.given, events: 0, run: at});
    worker.onmessage = ({data}: MessageEvent<FromWorker>): void => {
        const picture = pictures[at]!;
        if (data.kind === "ready") begin();
        if (data.kind === "started") picture.room = Number(data.configuration["amplitude"]);
        if (data.kind !== "frame") return;
        if (data.frame[1]! < shownPeriod) return send({kind: "skip", periods: shownPeriod});
        picture.frame = data.frame;
        picture.paint.apply(data.frame);
        redraw();
        at += 1;
        if (at < pictures.length) begin();
        else worker.terminate();
    };
    show();
}

/** The same parameters, whatever their seed. */
function sameGiven(a: Record<string, string>, b: Record<string, string>): boolean {
    const [one, other] = [a, b].map((given) =>
        JSON.stringify(
            Object.entries(given)
                .filter(([name]) => name !== "seed")
                .sort(),
        ),
    );
    return one === other;
}
