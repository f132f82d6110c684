// What the page works out by itself: node units.mjs. Ends with 1 and a sentence for whatever is wrong.
import assert from "node:assert/strict";
import {mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {dirname, join} from "node:path";
import {fileURLToPath, pathToFileURL} from "node:url";
import {build} from "esbuild";

const sources = join(dirname(fileURLToPath(import.meta.url)), "..", "src");
const folder = mkdtempSync(join(tmpdir(), "swirl-units-"));
const load = async (name) => {
    const outfile = join(folder, `${name}.mjs`);
    await build({entryPoints: [join(sources, `${name}.ts`)], bundle: true, format: "esm", outfile,
                 logLevel: "error"});
    return import(pathToFileURL(outfile).href);
};
const frame = (discs, {time = 0, centre = [0, 0], radius = 8.6} = {}) => new Float64Array(
    [time, 0, 0, ...centre, 0, 0, radius, 1, 0, discs.length,
     ...discs.flatMap(([x, y, r = 1]) => [x, y, 0.25, -0.5, 1, 2, r, 0])]);

try {
    const {turnBetween, discAt} = await load("scene");
    const turned = (discs, by) => discs.map(([x, y]) => [
        3 + x * Math.cos(by) - y * Math.sin(by), 4 + x * Math.sin(by) + y * Math.cos(by)]);
    const pack = [[0, 0], [2, 0], [1, 3], [-4, 2]];
    for (const by of [0, 0.3, -0.3, 3, -3]) { // moved elsewhere as well: that is no turning
        const turns = turnBetween(frame(pack), frame(turned(pack, by)));
        assert.ok(Math.abs(turns - by / (2 * Math.PI)) < 1e-12, `${turns} turns for ${by}`);
    }
    assert.equal(turnBetween(frame(pack), frame(pack.slice(1))), 0); // another dish
    assert.equal(discAt(frame(pack), 2.5, 0.5), 1);
    assert.equal(discAt(frame(pack), 2.9, 0.9), undefined);

    const {xyz} = await load("recording");
    const lines = xyz(frame([[1, 2], [3, 4, 0.5]], {time: 7.5})).split("\n");
    assert.equal(lines[0], "2");
    assert.match(lines[1], /^Properties=species:S:1:pos:R:3:velo:R:3:omega:R:1:radius:R:1:id:I:1 Time=7.5 /);
    assert.equal(lines[2], "D1 1 2 0 1 2 0 -0.5 1 1");
    assert.equal(lines[3], "D2 3 4 0 1 2 0 -0.5 0.5 2");
    assert.deepEqual(lines.slice(4), [""]);

    const {withError} = await load("page");
    assert.equal(withError(-0.0412, 0.0013, "?"), "−0.0412 ± 0.0013");
    assert.equal(withError(0.5, 0.04, "?"), "0.500 ± 0.040");
    assert.equal(withError(12.34, 3, "?"), "12.3 ± 3.0");
    assert.equal(withError(null, null, "?"), "?");
    assert.equal(withError(0.25, null, "?"), "0.250");

    const {numbersIn} = await load("study");
    assert.deepEqual(numbersIn("5, 8:2:12"), [5, 8, 10, 12]);
    assert.deepEqual(numbersIn("0:0.1:0.3").map((x) => x.toFixed(6)),
                     ["0.000000", "0.100000", "0.200000", "0.300000"]);
    for (const wrong of ["", "5:x", "1:0:5", "1:2"]) assert.equal(numbersIn(wrong), undefined, wrong);
} finally {
    rmSync(folder, {recursive: true});
}
