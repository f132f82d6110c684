// The legend of the colours, in a lower corner of the image. It is part of the canvas, so saved
// images and movies contain it.
import {mapColor} from "./maps";
import {canvasFont} from "../elements/page";
import {diverging, sequential, slidingColor, type Palette} from "./palette";
import {texts} from "../texts/texts";
import type {DrawOptions} from "./view";

const margin = 10,
    barWidth = 110,
    barHeight = 7,
    row = 17,
    narrow = 450; // pixels of the page

/** `size` is the width of the image in pixels of the page. */
export function drawLegend(
    context: CanvasRenderingContext2D,
    size: number,
    look: DrawOptions,
    palette: Palette,
): void {
    if (size < 220 || (size < 320 && look.coloring === "contacts")) return; // its rows would hide discs
    context.font = canvasFont(500, 13);
    context.textBaseline = "alphabetic";
    context.textAlign = "left";
    let y = size - margin;
    const say = (text: string, x = margin): void => {
        context.fillStyle = palette.ink;
        context.fillText(text, x, y);
    };
    /** A bar with a text at each end. */
    const bar = (shade: (t: number) => string, low: string, high: string): void => {
        const width = Math.max(
            barWidth,
            context.measureText(low).width + context.measureText(high).width + 12,
        );
        say(low);
        context.textAlign = "right";
        say(high, margin + width);
        context.textAlign = "left";
        const gradient = context.createLinearGradient(margin, 0, margin + width, 0);
        for (let k = 0; k <= 8; ++k) gradient.addColorStop(k / 8, shade(k / 8));
        context.fillStyle = gradient;
        context.fillRect(margin, y - row - 1, width, barHeight);
        y -= 2 * row;
    };
    const chip = (color: string, text: string, ring = false): void => {
        context.fillStyle = context.strokeStyle = color;
        context.lineWidth = 2;
        context.beginPath();
        context.arc(margin + 5, y - 4, ring ? 4 : 5, 0, 2 * Math.PI);
        if (ring) context.stroke();
        else context.fill();
        say(text, margin + 15);
        y -= row;
    };
    const ofSpin = (t: number): string => `rgb(${diverging(2 * t - 1).join(" ")})`;
    if (look.map) {
        const {kind} = look.map;
        // The corner is widest at the bottom, so long rows are there.
        if (kind === "flow") {
            say(texts.flowKey);
            y -= row;
        }
        chip(palette.pinned, texts.pinned, true);
        chip(palette.quiet, texts.loose, true);
        if (kind === "density")
            bar((t) => `rgb(${mapColor(t, look.dark).join(" ")})`, texts.sparse, texts.dense);
        else if (kind === "spin") bar(ofSpin, texts.spinAgainst, texts.spinWith);
        say(look.map.isEmpty ? texts.mapEmpty : texts.maps[kind]);
    } else if (look.coloring === "spin" || look.coloring === "contacts") {
        if (look.coloring === "contacts") {
            chip(slidingColor, texts.slides);
            chip(palette.ink, texts.sticks);
        }
        bar(ofSpin, texts.spinAgainst, texts.spinWith);
    } else if (look.coloring === "speed") {
        bar((t) => `rgb(${sequential(t).join(" ")})`, texts.atRest, texts.fast);
    } else if (look.coloring === "pinned") {
        chip(palette.loose, texts.loose);
        chip(palette.pinned, texts.pinned);
    }
    if (!look.note) return;
    context.textAlign = "right";
    context.fillStyle = palette.quiet;
    // In a small image M would be behind one long row.
    const rows = size < narrow ? look.note.split(/(?<=:) /) : [look.note];
    for (const [k, text] of rows.reverse().entries())
        context.fillText(text, size - margin, size - margin - k * row);
}
