// Measures how soon the page shows something, and its frame rate: node frames.mjs FILE.html
// CHROMIUM. The targets on an idle machine are 1 s to the first motion and to the provisional
// verdict, 5 s to the firm one, and 60 frames/s, or 30 with 2000 discs. Exits with 1 if a page does
// not move.
import {pathToFileURL} from "node:url";
import {launch} from "./browser.mjs";

const [file, executablePath] = process.argv.slice(2);
const watched = 100; // frames

const browser = await launch(executablePath);
const page = await browser.newPage({viewport: {width: 1200, height: 800}});
// Notes when each of these is first true, in milliseconds after the request.
await page.addInitScript(() => {
    globalThis.times = {};
    const signs = {
        motion: () => Number(document.getElementById("event-count")?.textContent) > 0,
        provisional: () => document.querySelector("#headline strong") !== null,
        firm: () => document.getElementById("verdict").classList.contains("firm"),
    };
    const look = () => {
        for (const [name, holds] of Object.entries(signs))
            if (!(name in globalThis.times) && document.getElementById("verdict") && holds())
                globalThis.times[name] = performance.now();
        requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
});
for (const [query, name] of [
    ["?discs=48", "N = 48"],
    ["?discs=2000&radius=0.14&inertia=solid", "N = 2000"],
]) {
    await page.goto(pathToFileURL(file).href + query);
    const isLarge = name === "N = 2000"; // its warm-up takes a minute
    await page.waitForFunction((wanted) => wanted in globalThis.times, isLarge ? "motion" : "firm");
    await page.waitForTimeout(2500); // until the time-lapse has ended
    const times = await page.evaluate(() => globalThis.times);
    // Each frame changes the number of events.
    const perSecond = await page.evaluate(
        (wanted) =>
            new Promise((resolve) => {
                let frames = 0;
                const begun = performance.now();
                const watch = new MutationObserver(() => {
                    frames += 1;
                    if (frames < wanted) return;
                    watch.disconnect();
                    resolve((frames / (performance.now() - begun)) * 1000);
                });
                watch.observe(document.getElementById("event-count"), {childList: true});
            }),
        watched,
    );
    const said = Object.entries(times)
        .map(([sign, at]) => `${sign} after ${at.toFixed(0)} ms`)
        .join(", ");
    console.log(`${name}: ${said}; ${perSecond.toFixed(0)} frames/s`);
}
await browser.close();
