// How soon the laboratory moves, and how often it is drawn: node frames.mjs FILE.html CHROMIUM. Prints
// both (1 s, and 60 pictures a second, 30 with 2000 discs, are the aim on a machine that does nothing
// else), and ends with 1 if a page does not go on moving.
import {pathToFileURL} from "node:url";
import {chromium} from "playwright-core";

const [file, executablePath] = process.argv.slice(2);
const watched = 3000; // milliseconds

const browser = await chromium.launch({executablePath, args: ["--no-sandbox", "--disable-gpu"]});
const page = await browser.newPage({viewport: {width: 1200, height: 800}});
let stands = false;
for (const [query, name] of [["?discs=48", "N = 48"],
                             ["?discs=2000&radius=0.14&inertia=solid", "N = 2000"]]) {
    await page.goto(pathToFileURL(file).href + query);
    const first = await page.evaluate(() => new Promise((resolve) => {
        const look = () => (Number(document.getElementById("event-count").textContent) > 0
            ? resolve(performance.now()) : requestAnimationFrame(look));
        look();
    }));
    await page.waitForTimeout(1000);
    // A picture has come when the number of events has changed.
    const perSecond = await page.evaluate((time) => new Promise((resolve) => {
        let pictures = 0;
        const begun = performance.now();
        const watch = new MutationObserver(() => { pictures += 1; });
        watch.observe(document.getElementById("event-count"), {childList: true});
        setTimeout(() => {
            watch.disconnect();
            resolve(pictures / (performance.now() - begun) * 1000);
        }, time);
    }), watched);
    console.log(`${name}: first motion ${first.toFixed(0)} ms after the page was asked for, ` +
        `${perSecond.toFixed(0)} pictures/s`);
    stands ||= perSecond === 0;
}
await browser.close();
process.exitCode = stands ? 1 : 0;
