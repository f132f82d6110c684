// How fast the engine is as WebAssembly: node speed.mjs SWIRL, after ./swirl lab. Prints events per second in
// this Node.js, by turns with the program SWIRL: of the event loop alone, with vectors and without, beside
// `bench/run --width baseline`, and with the page's averages beside `swirl run`.
import {execFileSync} from "node:child_process";
import {readFileSync} from "node:fs";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";

const [program] = process.argv.slice(2);
const built = join(dirname(fileURLToPath(import.meta.url)), "..", "..", "build", "wasm");
execFileSync("cmake", ["--build", built, "--target", "swirl", "loop_alone", "loop_alone_scalar"], {stdio: "ignore"});
const median = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
const events = 300_000;

const compiled = (name) => WebAssembly.compile(readFileSync(join(built, `${name}.wasm`)));
const instance = (module) => {
    const {exports} = new WebAssembly.Instance(module, {
        wasi_snapshot_preview1: new Proxy({}, {get: () => () => 52}),
        page: {refuse: () => { throw new Error("refused"); }}});
    exports._initialize();
    return exports;
};
/** In millions of events per second. */
function rateOf(dish) {
    dish.run_events(events / 10);
    const begun = performance.now();
    dish.run_events(events);
    return events / (performance.now() - begun) / 1000;
}
function loopRate(module, discs) {
    const dish = instance(module);
    dish.begin(discs);
    return rateOf(dish);
}
function pageRate(module, discs) {
    const dish = instance(module);
    const lines = Buffer.from(`discs=${discs}\n`);
    const at = dish.room(lines.length);
    Buffer.from(dish.memory.buffer, at, lines.length).set(lines);
    dish.begin();
    return rateOf(dish);
}
const answerOf = (...call) => JSON.parse(execFileSync(program, [...call, "--json", "-", "--quiet"]));
const runRate = (discs) =>
    answerOf("run", "--discs", discs, "--events", events).events_per_second / 1e6;
const benchRates = () => answerOf("bench", "--width", "baseline", "--seconds", "0.3").rows;

const [page, loop, scalar] = await Promise.all(["swirl", "loop_alone", "loop_alone_scalar"].map(compiled));
const rows = new Map([48, 28, 5].map((discs) =>
    [discs, {native: [], loop: [], scalar: [], run: [], page: []}]));
for (let turn = 0; turn < 5; ++turn) {
    const bench = benchRates();
    for (const [discs, row] of rows) {
        row.native.push(bench.find((r) => r.scene.startsWith("container, mu = 1") && r.discs === discs).rate / 1e6);
        row.loop.push(loopRate(loop, discs));
        row.scalar.push(loopRate(scalar, discs));
        row.run.push(runRate(discs));
        row.page.push(pageRate(page, discs));
    }
}
for (const [discs, row] of rows) {
    const [native, vectors, plain, run, seen] =
        [row.native, row.loop, row.scalar, row.run, row.page].map(median);
    console.log(`N = ${discs}, million events/s: loop ${native.toFixed(2)}, ` +
        `as WebAssembly ${vectors.toFixed(2)} (${(vectors / native).toFixed(2)}), ` +
        `without vectors ${plain.toFixed(2)} (${(plain / native).toFixed(2)}); ` +
        `with averages ${run.toFixed(2)}, on the page ${seen.toFixed(2)} (${(seen / run).toFixed(2)})`);
}
