// The fonts and the widths of phones in which the page is tested. A browser may forbid the page's
// font, and then takes one of the system: those of Debian differ in width by a quarter.
import assert from "node:assert/strict";

const ofTheSystem = ["DejaVu Sans", "Liberation Sans"]; // packages fonts-dejavu-core and fonts-liberation
const widths = [320, 360, 412],
    height = 640;

/** Calls look(where, width, height) in each font and width, and returns its answers by `where`. */
export async function inEachFont(page, look) {
    const fonts = ["", ...ofTheSystem];
    const before = page.viewportSize(),
        seen = {},
        samples = new Map();
    for (const width of widths)
        for (const font of fonts) {
            if (font === fonts[0]) await page.setViewportSize({width, height}); // this takes the longest
            samples.set(
                font,
                await page.evaluate(async (name) => {
                    document.documentElement.style.fontFamily = name && `"${name}"`;
                    await document.fonts.ready;
                    const sample = document.createElement("span");
                    sample.textContent = "Scheiben drehen sich gegensinnig";
                    document.body.append(sample);
                    const {width} = sample.getBoundingClientRect();
                    sample.remove();
                    return width;
                }, font),
            );
            const where = `${font || "Inter"}, ${width} pixels wide`;
            seen[where] = await look(where, width, height);
        }
    assert.equal(
        new Set(samples.values()).size,
        fonts.length,
        `a font is missing: ${[...samples]}`,
    );
    await page.evaluate(() => {
        document.documentElement.style.fontFamily = "";
    });
    await page.setViewportSize(before);
    return seen;
}
