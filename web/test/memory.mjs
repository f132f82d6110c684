// Whether the page's memory stays where it is: node memory.mjs FILE.html CHROMIUM [MINUTES [MB [QUERY]]].
// The dish of the query (48 discs) runs at ten swirls a second with maps that fill up, and every half
// minute it is looked up, after a collection of garbage, what is alive: in the page, in its workers, in
// the engine's memory, and what the system has given to the tab. From the second minute on (all that
// is built once has been built then) no line through any of them may climb by more than MB in the time
// that is left; what the system gives comes in larger pieces, and may climb by four times as much. Ends
// with 1 and a sentence for what grows.
import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import {pathToFileURL} from "node:url";
import {chromium} from "playwright-core";

const [file, executablePath, minutes = "10", allowed = "16", query = "?discs=48"] =
    process.argv.slice(2);
const between = 30_000; // milliseconds
const settled = 120_000;

const browser = await chromium.launch({executablePath, args: [
    "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync"]});
const page = await browser.newPage({viewport: {width: 800, height: 600}});
const complaints = [];
page.on("pageerror", (error) => complaints.push(error.message));
// A worker of the page, which comes from a blob, keeps the engine to itself: what it makes is noted
// before it begins. Weakly, so that nothing lives longer for it.
await page.addInitScript(() => {
    const note = `globalThis.engines = [];
        WebAssembly.Instance = class extends WebAssembly.Instance {
            constructor(...given) {
                super(...given);
                globalThis.engines.push(new WeakRef(this.exports.memory));
            }
        };`;
    globalThis.Blob = class extends Blob {
        constructor(parts, options) {
            super(/javascript/.test(options?.type ?? "") ? [note, ...parts] : parts, options);
        }
    };
});
await page.goto(pathToFileURL(file).href + query);
await page.waitForFunction(() => Number(document.getElementById("event-count").textContent) > 0);
await page.evaluate(() => {
    const speed = document.getElementById("speed");
    speed.value = speed.max;
    speed.dispatchEvent(new Event("input"));
});
await page.click("#maps summary");

const session = await page.context().newCDPSession(page);
const whole = await browser.newBrowserCDPSession();
await session.send("HeapProfiler.enable");
/** Of the tab, which is the process that has used most of the processor; in MB. */
async function resident() {
    const {processInfo} = await whole.send("SystemInfo.getProcessInfo");
    const tabs = processInfo.filter(({type}) => type === "renderer")
        .sort((a, b) => b.cpuTime - a.cpuTime);
    const [, kB] = readFileSync(`/proc/${tabs[0].id}/status`, "utf-8").match(/VmRSS:\s+(\d+)/);
    return Number(kB) / 1000;
}
/** Alive in the workers, in MB, and of how many engines: the garbage of a worker is collected where
 *  Chromium lets a page ask for that. */
async function engines() {
    const all = await Promise.all(page.workers().map((worker) => worker.evaluate(
        () => (globalThis.engines ?? []).map((each) => each.deref()?.buffer.byteLength).filter(Boolean))));
    const sizes = all.flat();
    return {engines: sizes.length, engine: sizes.reduce((a, b) => a + b, 0) / 1e6};
}
async function look(begun) {
    const garbage = (await session.send("Runtime.getHeapUsage")).usedSize / 1e6;
    await session.send("HeapProfiler.collectGarbage");
    const {usedSize, backingStorageSize = 0} = await session.send("Runtime.getHeapUsage");
    const {nodes, jsEventListeners: listeners, documents} = await session.send("Memory.getDOMCounters");
    const events = Number(await page.textContent("#event-count"));
    return {seconds: (performance.now() - begun) / 1000, events,
            swirls: Number(await page.textContent("#estimates dd:nth-of-type(3)")),
            heap: usedSize / 1e6, uncollected: garbage, buffers: backingStorageSize / 1e6,
            ...await engines(), resident: await resident(), nodes, listeners, documents};
}
/** By least squares, per second. */
function slope(series, name) {
    const mean = (of) => series.reduce((sum, each) => sum + of(each), 0) / series.length;
    const t = mean((each) => each.seconds), y = mean((each) => each[name]);
    return mean((each) => (each.seconds - t) * (each[name] - y)) / mean((each) => (each.seconds - t) ** 2);
}

const series = [], begun = performance.now();
const shown = ["seconds", "events", "swirls", "heap", "uncollected", "buffers", "engines", "engine",
               "resident", "nodes", "listeners"];
console.log(shown.join("\t"));
for (let k = 0; k <= Number(minutes) * 60_000 / between; ++k) {
    await page.waitForTimeout(Math.max(0, begun + k * between - performance.now()));
    const seen = await look(begun);
    series.push(seen);
    console.log(shown.map((name) => Number(seen[name].toFixed(2))).join("\t"));
}
const late = series.filter(({seconds}) => seconds * 1000 >= settled);
assert.ok(late.length >= 4, "MINUTES must be at least 4, to see whether anything grows.");
const left = late.at(-1).seconds - late[0].seconds;
for (const [name, most] of [["heap", allowed], ["buffers", allowed], ["engine", 4],
                            ["resident", 4 * allowed], ["nodes", 200], ["listeners", 50]]) {
    const growth = slope(late, name) * left;
    console.log(`${name}: ${growth < 0 ? "" : "+"}${growth.toFixed(2)} in ${left.toFixed(0)} s`);
    assert.ok(growth <= Number(most), `${name} grows by ${growth.toFixed(2)} in ${left.toFixed(0)} s`);
}
assert.deepEqual(complaints, []);
await browser.close();
