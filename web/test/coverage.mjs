// Measures how often the page's 95 % intervals contain the true rotation rate: node coverage.mjs
// SWIRL.wasm [POINTS]. At 28 and 48 discs it makes the points of the discovery plot from their
// first runs, 60 by default, and the live average of each run. Exits with 1 if a share of the
// points is not 93 to 97 %, or one of the averages not 95 % within chance.
import assert from "node:assert/strict";
import {mkdtempSync, readFileSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {runsOf} from "./background.mjs";
import {loader} from "./sources.mjs";

const [wasm, points = "60"] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "swirl-coverage-"));
const load = loader(folder);
/** ϖ/Ω by time of long runs: eight seeds of 1500 periods after 100 of warm-up; errors 0.0003 and
 *  0.0002. */
const truth = {28: 0.0327, 48: -0.0365};
const periods = 50,
    warmup = 20;
try {
    const {Engine, perRate} = await load("engine"),
        {Runs, seedsPerPoint} = await load("runs"),
        {liveEstimate} = await load("estimates");
    const module = await WebAssembly.compile(readFileSync(wasm));
    const background = runsOf(Runs, new Engine(module), perRate);
    /** The rotation after `periods`, and after one more, which completes the last of them on
     *  display. */
    const run = (discs, seed) => {
        const engine = new Engine(module);
        engine.begin({discs: String(discs), seed: String(seed)});
        const period = Number(engine.configuration().period);
        return [0, 1].map((more) => {
            while (!engine.advanceTo((warmup + periods + more) * period, 500));
            return engine.rotation();
        });
    };
    for (const discs of [28, 48]) {
        const holds = ({mean, error}) => Math.abs(mean - truth[discs]) <= 1.96 * error;
        const all = seedsPerPoint * points;
        let ofPoints = 0,
            ofRuns = 0,
            halves = 0;
        for (let point = 0; point < points; ++point) {
            const runs = Array.from({length: seedsPerPoint}, (_, k) =>
                run(discs, 1 + seedsPerPoint * point + k),
            );
            const {mean_by_time} = await background.estimates(
                runs.map(([rotation]) => ({discs, periods, rotation})),
            );
            ofPoints += holds(mean_by_time);
            halves += (1.96 * mean_by_time.error) / points;
            for (const [, late] of runs) ofRuns += holds(liveEstimate(late));
        }
        console.log(
            `N = ${discs}: the points contain the true value in ${((100 * ofPoints) / points).toFixed(1)} %, half width ` +
                `${halves.toFixed(4)}; the run on display in ${((100 * ofRuns) / all).toFixed(1)} %`,
        );
        // Of 60 intervals of exactly 95 %, 93 to 97 % are 56 to 58. The seeds are fixed, so this is
        // no matter of chance.
        assert.ok(
            ofPoints >= 0.93 * points && ofPoints <= 0.97 * points,
            `${ofPoints} of ${points} points at N = ${discs}`,
        );
        // Twice the standard deviation of a binomial share of 95 %: 2.8 % for 240 runs.
        assert.ok(
            Math.abs(ofRuns / all - 0.95) <= 2 * Math.sqrt((0.95 * 0.05) / all),
            `${ofRuns} of ${all} runs at N = ${discs}`,
        );
    }
} finally {
    rmSync(folder, {recursive: true});
}
