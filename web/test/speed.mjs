// How fast the laboratory is: node speed.mjs FILE.html CHROMIUM SWIRL. SWIRL is the program to compare
// with. Prints events per second of the engine in this Node.js and of the program, by turns, and of the
// page in the browser frames per second, the time to the first motion, and the memory over a minute.
import {execFileSync} from "node:child_process";
import {readFileSync} from "node:fs";
import {dirname, join} from "node:path";
import {fileURLToPath, pathToFileURL} from "node:url";
import {chromium} from "playwright-core";

const [file, executablePath, program] = process.argv.slice(2);
const root = join(dirname(fileURLToPath(import.meta.url)), "..", "..");
const median = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
const events = 300_000;

const module = await WebAssembly.compile(readFileSync(join(root, "build/wasm/swirl.wasm")));
function engineRate(discs) {
    const {exports: out} = new WebAssembly.Instance(module, {
        wasi_snapshot_preview1: new Proxy({}, {get: () => () => 52}),
        page: {refuse: () => { throw new Error("refused"); }}});
    out._initialize();
    const lines = Buffer.from(`discs=${discs}\n`);
    const at = out.room(lines.length);
    Buffer.from(out.memory.buffer, at, lines.length).set(lines);
    out.begin();
    out.run_events(events / 10);
    const begun = performance.now();
    out.run_events(events);
    return events / (performance.now() - begun) / 1000;
}
/** Of the loop alone at the narrowest vectors, as everywhere: what WebAssembly could come to. */
const bench = JSON.parse(execFileSync(program, ["bench", "--width", "baseline", "--json", "-", "--quiet"]));
const loopRate = (discs) => bench.rows.find(
    (row) => row.scene.startsWith("dish") && row.discs === Number(discs)).rate / 1e6;
function programRate(discs) {
    const text = execFileSync(program, ["run", "--discs", discs, "--events", events, "--json", "-", "--quiet"]);
    return JSON.parse(text).events_per_second / 1e6;
}
for (const discs of ["48", "28", "5"]) {
    const [page, native] = [[], []];
    for (let k = 0; k < 5; ++k) {
        page.push(engineRate(discs));
        native.push(programRate(discs));
    }
    const [a, b, loop] = [median(page), median(native), loopRate(discs)];
    console.log(`N = ${discs}: ${a.toFixed(2)} million events/s in WebAssembly, ` +
        `${b.toFixed(2)} of the program, ratio ${(a / b).toFixed(2)}; ` +
        `${(a / loop).toFixed(2)} of its loop alone at baseline width`);
}

const browser = await chromium.launch({executablePath, args: ["--no-sandbox", "--disable-gpu"]});
const page = await browser.newPage({viewport: {width: 1200, height: 800}});
for (const [query, name] of [["?discs=48", "N = 48"],
                             ["?discs=2000&radius=0.14&inertia=solid", "N = 2000"]]) {
    await page.goto(pathToFileURL(file).href + query);
    const first = await page.evaluate(() => new Promise((resolve) => {
        const look = () => (Number(document.getElementById("event-count").textContent) > 0
            ? resolve(performance.now()) : requestAnimationFrame(look));
        look();
    }));
    await page.waitForTimeout(1000);
    // A frame has come when the number of events has changed.
    const perSecond = await page.evaluate(() => new Promise((resolve) => {
        let frames = 0;
        const begun = performance.now();
        const count = document.getElementById("event-count");
        new MutationObserver(() => {
            frames += 1;
            if (performance.now() - begun > 5000) resolve(frames / (performance.now() - begun) * 1000);
        }).observe(count, {childList: true});
    }));
    console.log(`${name}: first motion ${first.toFixed(0)} ms after the page was asked for, ` +
        `${perSecond.toFixed(0)} frames/s`);
}
const heap = () => page.evaluate(() => performance.memory.usedJSHeapSize / 1e6);
await page.goto(pathToFileURL(file).href + "?discs=48");
await page.waitForSelector("#speed");
await page.evaluate(() => {
    const speed = document.getElementById("speed");
    speed.value = "1";
    speed.dispatchEvent(new Event("input"));
});
await page.waitForTimeout(5000);
const before = await heap();
await page.waitForTimeout(60_000);
console.log(`memory of the page at ten swirls a second: ${before.toFixed(1)} MB, ` +
    `a minute later ${(await heap()).toFixed(1)} MB`);
await browser.close();
