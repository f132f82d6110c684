// Tests that the page's memory does not grow: node memory.mjs FILE.html CHROMIUM [MINUTES [MB
// [QUERY]]]. The simulation of QUERY (48 discs) runs at ten periods per second with open maps. Each
// half minute, after a garbage collection, the script records the live memory of the page, its
// workers and the engine, and the resident memory of the tab. The first two minutes are ignored,
// since one-time allocations happen there. After that a linear fit may grow by at most MB in the
// remaining time, and the resident memory by four times as much, since the system hands it out in
// larger pieces. Exits with 1 and a message if something grows.
import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import {pathToFileURL} from "node:url";
import {launch} from "./browser.mjs";

const [file, executablePath, minutes = "10", allowed = "16", query = "?discs=48"] =
    process.argv.slice(2);
const between = 30_000; // milliseconds
const settled = 120_000;

const browser = await launch(executablePath);
const page = await browser.newPage({viewport: {width: 800, height: 600}});
const errors = [];
page.on("pageerror", (error) => errors.push(error.message));
// The page's workers are blobs, and the engine is not visible from outside. This code is added to
// each worker and records its engines in weak references, which do not extend their lifetime.
await page.addInitScript(() => {
    // Two periods per second are ten by a clock that is five times as fast.
    const ask = globalThis.requestAnimationFrame;
    globalThis.requestAnimationFrame = (draw) => ask((now) => draw(5 * now));
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
await page.click("#profile-panel summary");

const session = await page.context().newCDPSession(page);
const whole = await browser.newBrowserCDPSession();
await session.send("HeapProfiler.enable");
/** Resident memory in MB of the tab, which is the process with the most processor time. */
async function resident() {
    const {processInfo} = await whole.send("SystemInfo.getProcessInfo");
    const tabs = processInfo
        .filter(({type}) => type === "renderer")
        .sort((a, b) => b.cpuTime - a.cpuTime);
    const [, kB] = readFileSync(`/proc/${tabs[0].id}/status`, "utf-8").match(/VmRSS:\s+(\d+)/);
    return Number(kB) / 1000;
}
/** The number of live engines in the workers and their memory in MB. Chromium collects the garbage
 *  of workers on its own. */
async function engines() {
    const all = await Promise.all(
        page
            .workers()
            .map((worker) =>
                worker.evaluate(() =>
                    (globalThis.engines ?? [])
                        .map((each) => each.deref()?.buffer.byteLength)
                        .filter(Boolean),
                ),
            ),
    );
    const sizes = all.flat();
    return {engines: sizes.length, engine: sizes.reduce((a, b) => a + b, 0) / 1e6};
}
async function sample(begun) {
    const garbage = (await session.send("Runtime.getHeapUsage")).usedSize / 1e6;
    await session.send("HeapProfiler.collectGarbage");
    const {usedSize, backingStorageSize = 0} = await session.send("Runtime.getHeapUsage");
    const {
        nodes,
        jsEventListeners: listeners,
        documents,
    } = await session.send("Memory.getDOMCounters");
    const events = Number(await page.textContent("#event-count"));
    return {
        seconds: (performance.now() - begun) / 1000,
        events,
        periods: Number(await page.textContent("#period-count")),
        heap: usedSize / 1e6,
        uncollected: garbage,
        buffers: backingStorageSize / 1e6,
        ...(await engines()),
        resident: await resident(),
        nodes,
        listeners,
        documents,
    };
}
/** Growth per second by least squares. */
function slope(series, name) {
    const mean = (of) => series.reduce((sum, each) => sum + of(each), 0) / series.length;
    const t = mean((each) => each.seconds),
        y = mean((each) => each[name]);
    return (
        mean((each) => (each.seconds - t) * (each[name] - y)) /
        mean((each) => (each.seconds - t) ** 2)
    );
}

const series = [],
    begun = performance.now();
const shown = [
    "seconds",
    "events",
    "periods",
    "heap",
    "uncollected",
    "buffers",
    "engines",
    "engine",
    "resident",
    "nodes",
    "listeners",
];
console.log(shown.join("\t"));
for (let k = 0; k <= (Number(minutes) * 60_000) / between; ++k) {
    await page.waitForTimeout(Math.max(0, begun + k * between - performance.now()));
    const seen = await sample(begun);
    series.push(seen);
    console.log(shown.map((name) => Number(seen[name].toFixed(2))).join("\t"));
}
const late = series.filter(({seconds}) => seconds * 1000 >= settled);
assert.ok(late.length >= 4, "MINUTES must be at least 4 to detect growth.");
const left = late.at(-1).seconds - late[0].seconds;
for (const [name, most] of [
    ["heap", allowed],
    ["buffers", allowed],
    ["engine", 4],
    ["resident", 4 * allowed],
    ["nodes", 200],
    ["listeners", 50],
]) {
    const growth = slope(late, name) * left;
    console.log(`${name}: ${growth < 0 ? "" : "+"}${growth.toFixed(2)} in ${left.toFixed(0)} s`);
    assert.ok(
        growth <= Number(most),
        `${name} grows by ${growth.toFixed(2)} in ${left.toFixed(0)} s`,
    );
}
assert.deepEqual(errors, []);
await browser.close();
