// A canvas as sharp as the screen, in pixels of the page.

export interface Sized {
    context: CanvasRenderingContext2D;
    width: number;
    height: number;
    /** Pixels of the canvas per pixel of the page. */
    ratio: number;
}

const sharpest = 2; // more costs frames and is not visible

/** Sets the size of the canvas, and clears it. */
export function sized(canvas: HTMLCanvasElement): Sized {
    const ratio = Math.min(devicePixelRatio || 1, sharpest),
        [width, height] = [canvas.clientWidth, canvas.clientHeight],
        context = canvas.getContext("2d")!;
    const [across, down] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== across || canvas.height !== down)
        [canvas.width, canvas.height] = [across, down];
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    return {context, width, height, ratio};
}
