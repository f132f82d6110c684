// Compares the speed of the WebAssembly engine with the program: node speed.mjs SWIRL, after
// `./swirl lab` and a build of bench/run. The runs alternate. Prints events per second in Node.js:
// the bare event loop with and without SIMD next to `bench/run --width sse2`, and with the page's
// averages next to `SWIRL run`, also with vectors of 128 bits.
import {execFileSync} from "node:child_process";
import {readFileSync} from "node:fs";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";

const [program] = process.argv.slice(2);
const built = join(dirname(fileURLToPath(import.meta.url)), "..", "..", "build", "wasm");
execFileSync("cmake", ["--build", built, "--target", "swirl", "event_loop", "event_loop_scalar"], {
    stdio: "ignore",
});
const bench = join(built, "..", "..", "bench", "run");
const median = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
const events = 300_000;

const compiled = (name) => WebAssembly.compile(readFileSync(join(built, `${name}.wasm`)));
const instance = (module) => {
    const {exports} = new WebAssembly.Instance(module, {
        wasi_snapshot_preview1: new Proxy({}, {get: () => () => 52}),
        page: {
            reject: () => {
                throw new Error("rejected");
            },
        },
    });
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
    const at = dish.buffer_for(lines.length);
    Buffer.from(dish.memory.buffer, at, lines.length).set(lines);
    dish.begin();
    return rateOf(dish);
}
const scene = "container, mu = 1";
const answerOf = (command, ...options) =>
    JSON.parse(
        execFileSync(command, [...options, "--json", "-", "--quiet"], {
            env: {...process.env, SWIRL_SIMD: "sse2"},
        }),
    );
const runRate = (discs) =>
    answerOf(program, "run", "--discs", discs, "--events", events).events_per_second / 1e6;
const benchRates = () =>
    answerOf(bench, "--only", scene, "--width", "sse2", "--seconds", "0.3").rows;

const [page, loop, scalar] = await Promise.all(
    ["swirl", "event_loop", "event_loop_scalar"].map(compiled),
);
const rows = new Map(
    [48, 28, 5].map((discs) => [discs, {native: [], loop: [], scalar: [], run: [], page: []}]),
);
for (let turn = 0; turn < 5; ++turn) {
    const bench = benchRates();
    for (const [discs, row] of rows) {
        row.native.push(
            bench.find((r) => r.scene.startsWith(scene) && r.discs === discs).rate / 1e6,
        );
        row.loop.push(loopRate(loop, discs));
        row.scalar.push(loopRate(scalar, discs));
        row.run.push(runRate(discs));
        row.page.push(pageRate(page, discs));
    }
}
for (const [discs, row] of rows) {
    const [native, simd, scalar, run, page] = [
        row.native,
        row.loop,
        row.scalar,
        row.run,
        row.page,
    ].map(median);
    console.log(
        `N = ${discs}, million events/s: loop ${native.toFixed(2)}, ` +
            `WebAssembly ${simd.toFixed(2)} (${(simd / native).toFixed(2)}), ` +
            `without SIMD ${scalar.toFixed(2)} (${(scalar / native).toFixed(2)}); ` +
            `with averages ${run.toFixed(2)}, page ${page.toFixed(2)} (${(page / run).toFixed(2)})`,
    );
}
