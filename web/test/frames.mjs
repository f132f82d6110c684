// Measures when the page first moves and its frame rate: node frames.mjs FILE.html CHROMIUM. The targets
// on an idle machine are 1 s and 60 frames/s, or 30 with 2000 discs. Exits with 1 if a page stops moving.
import {pathToFileURL} from "node:url";
import {chromium} from "playwright-core";

const [file, executablePath] = process.argv.slice(2);
const watched = 3000; // milliseconds

const browser = await chromium.launch({executablePath, args: ["--no-sandbox", "--disable-gpu"]});
const page = await browser.newPage({viewport: {width: 1200, height: 800}});
let stopped = false;
for (const [query, name] of [["?discs=48", "N = 48"],
                             ["?discs=2000&radius=0.14&inertia=solid", "N = 2000"]]) {
    await page.goto(pathToFileURL(file).href + query);
    const first = await page.evaluate(() => new Promise((resolve) => {
        const look = () => (Number(document.getElementById("event-count").textContent) > 0
            ? resolve(performance.now()) : requestAnimationFrame(look));
        look();
    }));
    await page.waitForTimeout(1000);
    // Each frame changes the number of events.
    const perSecond = await page.evaluate((time) => new Promise((resolve) => {
        let frames = 0;
        const begun = performance.now();
        const watch = new MutationObserver(() => { frames += 1; });
        watch.observe(document.getElementById("event-count"), {childList: true});
        setTimeout(() => {
            watch.disconnect();
            resolve(frames / (performance.now() - begun) * 1000);
        }, time);
    }), watched);
    console.log(`${name}: first motion ${first.toFixed(0)} ms after the request, ` +
        `${perSecond.toFixed(0)} frames/s`);
    stopped ||= perSecond === 0;
}
await browser.close();
process.exitCode = stopped ? 1 : 0;
