// Measures the search for N_c of the explorer on one core: node crossing.mjs SWIRL.wasm
// [NAME=VALUE…]. Prints N_c, the runs, their events, the processor time, and the time on two idle
// cores: the page begins the runs of a round in this order, and the next round when all have ended.
import {mkdtempSync, readFileSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {loader} from "./sources.mjs";

const [wasm, ...words] = process.argv.slice(2),
    given = Object.fromEntries(words.map((word) => word.split("=")));
const folder = mkdtempSync(join(tmpdir(), "swirl-crossing-"));
const load = loader(folder);
try {
    const {Engine, perRate} = await load("engine"),
        {searchCrossing, usualSearch} = await load("crossing_search"),
        {searchedNumbers} = await load("runs");
    const module = await WebAssembly.compile(readFileSync(wasm)),
        begun = process.cpuUsage().user;
    const seconds = () => process.cpuUsage().user / 1e6;
    let events = 0,
        onTwoCores = 0,
        round = [0, 0];
    const {crossings, runs} = await searchCrossing(usualSearch, {
        run: async (discs, seed, periods) => {
            const run = new Engine(module),
                began = seconds();
            run.begin({...given, discs: String(discs), seed: String(seed)});
            const end = (periods + run.rotation().warmup) * Number(run.configuration()["period"]);
            while (!run.advanceTo(end, 500) && !run.problem(false));
            events += run.events;
            round[round[0] <= round[1] ? 0 : 1] += seconds() - began;
            return {rotation: run.problem(true) ? undefined : run.rotation()};
        },
        search: async (rules, made) => (
            (onTwoCores += Math.max(...round)),
            (round = [0, 0]),
            new Engine(module).search(rules, searchedNumbers(made))
        ),
        crossings: async (all) =>
            perRate((rate) =>
                new Engine(module).crossing(
                    all.map(({discs, periods, rotation}) => [
                        discs,
                        rotation[rate].mean,
                        rotation[rate].error,
                        periods,
                        rotation[rate].effective_samples ?? 0,
                    ]),
                ),
            ),
    });
    const {verdict, discs, error, lower, upper} = crossings.mean_by_time;
    console.log(
        `${verdict}: N_c = ${discs?.toFixed(2)} ± ${error?.toFixed(2)} (95 %: ${lower?.toFixed(1)} to ${upper?.toFixed(1)})`,
    );
    console.log(
        `${runs} runs, ${(events / 1e6).toFixed(1)} million events, ` +
            `${((process.cpuUsage().user - begun) / 1e6).toFixed(2)} s on one core, ${onTwoCores.toFixed(2)} s on two`,
    );
} finally {
    rmSync(folder, {recursive: true});
}
