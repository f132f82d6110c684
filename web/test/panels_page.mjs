// Tests discovery, explorer, lesson, languages and opened files in a real browser: node
// panels_page.mjs FILE.html CHROMIUM FILES [FOLDER]. FILES has files of the command line
// (tests/cli/lab_test.py), downloads are stored in FOLDER. Exits with 1 and a message if a test
// fails.
import assert from "node:assert/strict";
import {readFileSync, writeFileSync} from "node:fs";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {launch, violationsOf} from "./browser.mjs";

const [file, executablePath, files, folder] = process.argv.slice(2);
const address = pathToFileURL(file).href;
const browser = await launch(executablePath);
const errors = [];
const newPage = async (options = {}) => {
    const page = await browser.newPage({
        viewport: {width: 1280, height: 900},
        locale: "en-GB",
        ...options,
    });
    page.on("pageerror", (error) => errors.push(error.message));
    page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
    return page;
};
let page = await newPage();
const text = (id) => page.textContent(`#${id}`);
const open = async (query) => {
    await page.goto("about:blank"); // another fragment alone would not load the page
    await page.goto(address + query);
    await page.waitForFunction(
        () =>
            document.getElementById("state-hash").textContent !== "" ||
            !document.getElementById("error").hidden,
    );
};
const requireAccessible = async (where) => assert.deepEqual(await violationsOf(page), [], where);
const downloaded = async (button, as) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
    const bytes = Buffer.concat(await (await download.createReadStream()).toArray());
    if (folder) writeFileSync(join(folder, as ?? download.suggestedFilename()), bytes);
    return [download.suggestedFilename(), bytes];
};
const rowsOf = (bytes) =>
    bytes
        .toString()
        .trim()
        .split("\n")
        .map((line) => line.split(","));
/** The number of different points that the plot describes. */
const pointsShown = async () =>
    Number(
        /with (\d+) points/.exec(
            await page.getAttribute("#discovery-plot [role=img]", "aria-label"),
        )[1],
    );

// Discovery: each number that is visited drops a point, and the points give the bracket of N_c.
await open("?discs=8");
await page.waitForFunction(() =>
    /with 1 points/.test(document.querySelector("#discovery-plot [role=img]").ariaLabel),
);
for (const [k, n] of ["20", "48"].entries()) {
    await page.fill("#parameter-discs", n);
    await page.waitForFunction(
        (wanted) =>
            document
                .querySelector("#discovery-plot [role=img]")
                .ariaLabel.includes(`with ${wanted} points`),
        k + 2,
    );
}
await page.waitForFunction(() =>
    /between N = 20 and N = 48/.test(document.getElementById("discovery-finding").textContent),
);
const [name, table] = await downloaded("#discovery-table");
assert.equal(name, "discovery.csv");
assert.deepEqual(rowsOf(table)[0], [
    "discs",
    "varpi",
    "varpi_error",
    "runs",
    "periods",
    "other_parameters",
]);
assert.deepEqual(
    rowsOf(table)
        .slice(1)
        .map(([discs]) => discs),
    ["8", "20", "48"],
);
for (const [discs, mean, error, runs, periods] of rowsOf(table).slice(1)) {
    assert.equal(Math.sign(mean), discs === "48" ? -1 : 1, `${discs}: ${mean}`);
    assert.ok(
        error > 0 && runs === "4" && [50, 200, 800].includes(Number(periods)),
        `${discs}: ${error}, ${runs} × ${periods}`,
    );
}
// Points of other parameters stay in the background, with a plot of their own.
await page.fill("#parameter-mu", "0.5");
await page.waitForFunction(
    () => document.querySelectorAll("#discovery-plot .legend span").length >= 2,
);
// A link contains the parameters and the points, and opens with both.
const link = await page.evaluate(async () => {
    let copied;
    Object.defineProperty(navigator, "clipboard", {
        value: {
            writeText: async (text) => {
                copied = text;
            },
        },
    });
    document.getElementById("discovery-link").click();
    await new Promise((resolve) => setTimeout(resolve));
    return copied;
});
assert.match(link, /\?discs=48&mu=0\.5/);
await open("?discs=48&mu=0.5&seed=2#points=8_0.3_0.02_800,48_-0.02_0.001_200,bad");
assert.equal(await pointsShown(), 2);
assert.match(await text("error"), /1 point that is damaged/);
// Its points give N_c on load, and survive other parameters and a reload.
await open(
    "?discs=30&mu=0.5&fbclid=1#points=42_0.01_0.0005_800,43_0.005_0.0005_800,44_-0.002_0.0005_800,45_-0.006_0.0005_800",
);
await page.waitForFunction(() =>
    /N_c = 43\.7/.test(document.getElementById("discovery-finding").textContent),
);
assert.equal(await page.isHidden("#error"), true);
await page.fill("#parameter-discs", "31");
await page.waitForFunction(
    () => /discs=31/.test(location.search) && /points=.*43_/.test(location.hash),
);
assert.doesNotMatch(page.url(), /fbclid/);
await page.reload();
await page.waitForFunction(() =>
    /N_c = 43\.7/.test(document.getElementById("discovery-finding").textContent),
);
await open("?discs=48&mu=0.5&seed=2#points=8_0.3_0.02_800,48_-0.02_0.001_200");
await page.click("#discovery-clear");
await page.waitForFunction(() =>
    /with [01] points/.test(document.querySelector("#discovery-plot [role=img]").ariaLabel),
);

// Explorer: ϖ against N for two curves (Figure 5b), its table, its picture, its command line.
await open("?discs=5&seed=3");
await page.click("#explorer summary");
const explore = async (fields, rows) => {
    for (const [field, value] of Object.entries(fields))
        await (/quantity|-x$|-curve$/.test(field)
            ? page.selectOption(`#${field}`, value)
            : page.fill(`#${field}`, value));
    await page.click("#explorer-start");
    await page.waitForFunction(
        (wanted) =>
            document.querySelectorAll("#explorer-findings tr").length === wanted &&
            document.getElementById("explorer-start").textContent === "Start",
        rows,
    );
};
await explore(
    {"explorer-values": "5, 8:2:10", "explorer-curves": "0, 1, 1:0", "explorer-periods": "20"},
    4,
);
assert.match(await text("explorer-status"), /^9 of 9 points/);
assert.match(
    await text("explorer-command"),
    /^\.\/swirl sweep --discs 5,8,10 --mu 0,1 --periods 40 --warmup 20 --seed 3 --replicates 4 --out study && /,
);
assert.match(
    await text("explorer-command"),
    /\n\.\/swirl sweep --discs 5,8,10 --mu-disc 1 --mu-wall 0 /,
);
await requireAccessible("the explorer");
const [tableName, bytes] = await downloaded("#explorer-table", "rotation_explored.csv");
assert.equal(tableName, "explorer.csv");
assert.equal(rowsOf(bytes).length, 10);
const [pictureName, picture] = await downloaded("#explorer-picture");
assert.equal(pictureName, "explorer.png");
assert.ok(picture.subarray(1, 4).toString() === "PNG" && picture.readUInt32BE(16) >= 300);

// N_c against a parameter.
await explore(
    {
        "explorer-quantity": "crossing",
        "explorer-x": "mu",
        "explorer-curve": "",
        "explorer-values": "0.5",
    },
    2,
);
const [, found] = await page.$$eval("#explorer-findings tr", (rows) =>
    rows.map((row) => [...row.cells].map((each) => each.textContent)),
);
assert.match(found[1], /^4\d\.\d+ ± 0\.\d+ \(95 %: 4\d\.\d to 4\d\.\d\)$/);
assert.match(await text("explorer-command"), /^\.\/swirl crossing --mu 0\.5 --seed 3 --to 48$/);
const [[...head], values] = rowsOf((await downloaded("#explorer-table"))[1]);
assert.deepEqual(
    [head.slice(0, 4), values.slice(0, 2)],
    [
        ["mu", "verdict", "N_c_mean_by_time", "N_c_mean_by_time_error"],
        ["0.5", "crosses"],
    ],
);
// Wrong input is an error message; so is a parameter that the engine rejects.
for (const [fields, said] of [
    [{"explorer-values": "x"}, /FROM:STEP:TO/],
    [{"explorer-values": "1:1:1000"}, /limit is 400/],
    [{"explorer-values": "-1"}, /^Friction is '-1', but/],
]) {
    for (const [field, value] of Object.entries(fields)) await page.fill(`#${field}`, value);
    await page.click("#explorer-start");
    await page.waitForFunction(
        (wanted) => new RegExp(wanted).test(document.getElementById("explorer-status").textContent),
        said.source,
    );
}
await page.selectOption("#explorer-quantity", "rotation");
await page.fill("#explorer-values", "1");
await page.fill("#explorer-periods", "5");
await page.click("#explorer-start");
assert.match(await text("explorer-status"), /from 10 to 100000/);

// Lesson: the next step opens when the result is there. The prediction hides the answer until then.
await open("");
await page.click("#lesson-open");
for (let step = 1; step <= 6; ++step) {
    await page.waitForFunction(
        (wanted) =>
            document.querySelector("#lesson h2")?.textContent.startsWith(`Step ${wanted} of 6`),
        step,
    );
    assert.equal(await page.isDisabled("#lesson-next"), true);
    assert.equal(await page.isVisible("#headline"), false);
    if (step === 1) await requireAccessible("the lesson");
    if (step === 2) {
        // the step is in the address and survives a reload
        await page.waitForFunction(() => /lesson=2/.test(location.search));
        await page.reload();
        await page.waitForFunction(() =>
            document.querySelector("#lesson h2")?.textContent.startsWith("Step 2 of 6"),
        );
    }
    await page.click(`#lesson input[value="${step % 3}"]`);
    await page.waitForFunction(() => !document.getElementById("lesson-next").disabled);
    const outcome = await text("lesson-outcome");
    const expected = [
        /with the swirl/,
        /against the swirl/,
        /N_c = 3\d\.\d+ ± 0/,
        /clockwise/,
        /with the swirl/,
        /hardly any rule/,
    ][step - 1];
    assert.match(outcome, expected);
    // The predictions: against, against it or never, and so on; only the second is right.
    assert.match(outcome, step === 2 ? /was different|was right/ : /was/);
    // The colours and the motion are those of the text.
    assert.equal(await page.inputValue("#choose-coloring"), step === 6 ? "contacts" : "sector");
    const marks = await page.evaluate(
        () =>
            new Promise((resolve) => {
                // of the wall in the M-frame
                const seen = new Set(),
                    {lineTo} = CanvasRenderingContext2D.prototype;
                CanvasRenderingContext2D.prototype.lineTo = function (x, y) {
                    if (Math.abs(Math.hypot(x, y) - 8.6) < 1)
                        seen.add(`${x.toFixed(1)} ${y.toFixed(1)}`);
                    return lineTo.call(this, x, y);
                };
                const end = (left) => {
                    if (left > 0) return requestAnimationFrame(() => end(left - 1));
                    CanvasRenderingContext2D.prototype.lineTo = lineTo;
                    resolve(seen.size);
                };
                end(30); // frames
            }),
    );
    if (step === 6) {
        // both have averages, and the slip that the explanation speaks of
        await page.waitForFunction(() =>
            /with it.*against it/.test(document.getElementById("headline").textContent),
        );
        const slips = await page.$$eval("#views figcaption", (all) =>
            all.map((each) => Number(/s = (\d\.\d+)/.exec(each.textContent)?.[1])),
        );
        assert.ok(Math.abs(slips[0] - 0.6) < 0.06 && Math.abs(slips[1] - 0.98) < 0.03, `${slips}`); // three errors of 50 periods
    }
    if (step === 4) assert.ok(marks > 24, `the wall moves: ${marks} positions of its marks`);
    if (step === 5) {
        // the next experiment is one click away, and the fields show both coefficients
        assert.equal(await page.getAttribute("#parameter-mu", "placeholder"), "1:0");
        await page.click("#lesson-try");
        await page.waitForFunction(
            () => document.getElementById("parameter-mu").placeholder === "0:1",
        );
    }
    await page.click("#lesson-next");
}
await page.waitForFunction(() => !/lesson/.test(location.search));
assert.equal(await page.$("#lesson h2"), null);
assert.equal(await page.isVisible("#headline"), true);
// The solutions have the right options, the measured values and the explanations.
await page.evaluate(() => {
    globalThis.print = () => {};
    document.getElementById("lesson-solutions").click();
});
const solved = await page.textContent("#worksheet");
assert.equal(solved.match(/☒/g).length, 6);
for (const shown of [
    "−0.0365 ± 0.0003",
    "38.49 ± 0.06",
    "☒ 35 to 44 discs",
    "Gears would have a spin correlation of −1",
    "0.184",
])
    assert.ok(solved.includes(shown), shown);
await page.evaluate(() => dispatchEvent(new Event("afterprint")));
assert.equal(await page.$("#worksheet"), null);

// The worksheet replaces the page in print, and disappears after it.
await page.click("#teaching summary");
await page.evaluate(() => {
    globalThis.print = () => {};
});
await page.click("#lesson-worksheet");
await page.emulateMedia({media: "print"});
assert.equal(await page.isVisible("main"), false);
assert.equal(await page.locator("#worksheet section").count(), 8);
assert.ok(await page.isVisible("#worksheet svg"));
if (folder) await page.pdf({path: join(folder, "worksheet.pdf"), preferCSSPageSize: true});
await page.emulateMedia({media: "screen"});
await page.evaluate(() => dispatchEvent(new Event("afterprint")));
assert.deepEqual([await page.$("#worksheet"), await page.isVisible("main")], [null, true]);

// Files of the command line: the page repeats the run of a result.
await open("");
await page.setInputFiles("#open-file", join(files, "run.json"));
await page.waitForFunction(() =>
    /bitwise identical/.test(document.getElementById("opened-status")?.textContent),
);
const wanted = JSON.parse(readFileSync(join(files, "run.json"), "utf-8"));
const cells = await page.$$eval("#comparison tr", (rows) =>
    rows.slice(1).map((row) => [...row.cells].slice(1).map((each) => each.textContent)),
);
for (const [inFile, onPage] of cells) assert.equal(inFile, onPage);
assert.equal(cells.at(-1)[0], wanted.state_hash);
await page.waitForFunction(() =>
    document.getElementById("command").textContent.includes("--discs 12 --mu 0.3"),
);
await requireAccessible("a result");
// A result with another state is reported.
const changed = JSON.stringify({...wanted, state_hash: "0123456789abcdef"});
await page.setInputFiles("#open-file", {
    name: "changed.json",
    mimeType: "application/json",
    buffer: Buffer.from(changed),
});
await page.waitForFunction(() =>
    /differs/.test(document.getElementById("opened-status")?.textContent),
);
// A dropped file is opened, too.
await page.evaluate(
    (text) => {
        const dataTransfer = new DataTransfer();
        dataTransfer.items.add(new File([text], "dropped.json"));
        for (const kind of ["dragover", "drop"])
            document.body.dispatchEvent(
                new DragEvent(kind, {dataTransfer, bubbles: true, cancelable: true}),
            );
    },
    readFileSync(join(files, "run.json"), "utf-8"),
);
await page.waitForFunction(() =>
    /dropped\.json/.test(document.querySelector("#opened h2")?.textContent),
);
for (const [buffer, said] of [
    ["no such thing", /'a\.txt' is not a result/],
    // At once, although it begins as a result does.
    [`{"config": "${"x".repeat(45e6)}"}`, /'a\.txt' is larger than 10 MB/],
    ['{"config": {', /'a\.txt' cannot be read/],
    ["\x89HDF\r\n\x1a\n1234", /'a\.txt' is not a result[^]*Notebooks read recordings/],
    ['{"config": {}, "events": {"total": "x"}}', /'a\.txt' is damaged: events\.total = "x"/],
]) {
    await page.setInputFiles("#open-file", {
        name: "a.txt",
        mimeType: "text/plain",
        buffer: Buffer.from(buffer, "latin1"),
    });
    await page.waitForFunction(
        (wanted) => new RegExp(wanted).test(document.getElementById("error").textContent),
        said.source,
    );
}

// German, by the address and by the browser; the address keeps its language.
await open("?lang=de&discs=8");
const german = async () => {
    assert.equal(await page.getAttribute("html", "lang"), "de");
    assert.match(await page.title(), /^Pancake Rotation: warum sich Murmeln/);
    assert.match(
        await page.getAttribute("meta[name=description]", "content"),
        /^Schwenke eine Schale/,
    );
    assert.match(await page.textContent("label[for=slider-discs]"), /^Anzahl der Scheiben/);
    await page.waitForFunction(() =>
        /^8 Scheiben/.test(document.getElementById("headline").textContent),
    );
    const shown = await page.evaluate(() => document.body.innerText);
    for (const english of [" the ", " discs", "Number of", "Save", "swirl\\."])
        assert.ok(!new RegExp(english).test(shown), english);
    const commands = await page.evaluate(() =>
        [...document.querySelectorAll("code, pre")].map((each) => each.innerText),
    );
    const numbers = commands.reduce((all, each) => all.replace(each, ""), shown).match(/\d\.\d+/g);
    assert.equal(numbers, null, `with a decimal point: ${numbers}`);
};
await german();
await page.fill("#parameter-discs", "9");
await page.waitForFunction(() => /discs=9/.test(location.search));
assert.match(page.url(), /lang=de/);
await page.fill("#parameter-mu", "0,35"); // decimal comma in and out
await page.waitForFunction(() => /mu=0\.35/.test(location.search));
assert.equal(await page.inputValue("#parameter-mu"), "0,35");
await page.locator("#slider-mu").fill("0.4");
assert.equal(await page.inputValue("#parameter-mu"), "0,4");
await page.fill("#parameter-mu", "-0,5");
await page.waitForFunction(() =>
    /^Reibung ist „-0,5“/.test(document.getElementById("error").textContent),
);
await page.fill("#parameter-mu", "");
await requireAccessible("the German page");
await open("?lang=de&discs=30000&radius=0.01");
assert.match(await text("error"), /^30000 Scheiben sind zu viele/);
page = await newPage({locale: "de-DE"});
await open("?discs=8");
await german();
// Without ?lang, another language gets English.
page = await newPage({locale: "fr-FR"});
await open("?discs=8");
assert.equal(await page.getAttribute("html", "lang"), "en");

// A file with parameters starts with them; in a frame without an address it runs as well, as in a
// notebook.
const page1 = readFileSync(file, "utf-8").replace(
    '<meta charset="utf-8">',
    '$&<meta name="swirl-start" content="discs=7&amp;mu=0.2&amp;lang=de">',
);
page = await newPage();
await page.setContent(
    `<iframe id="in" width="900" height="600" sandbox="allow-scripts allow-downloads allow-modals"></iframe>`,
);
await page.evaluate((html) => {
    document.getElementById("in").srcdoc = html;
}, page1);
const frame = page.frameLocator("#in");
await frame.locator('canvas[aria-label^="7 Scheiben"]').first().waitFor();
// The command is in the menu that saves and shares, which is closed.
await frame
    .locator("#command")
    .filter({hasText: "--discs 7 --mu 0.2"})
    .waitFor({state: "attached"});
await frame.locator("#parameter-discs").fill("6");
await frame.locator('canvas[aria-label^="6 Scheiben"]').first().waitFor();

// Embedded: the dish and the large sliders only.
await open("?embed=1");
assert.deepEqual(
    [
        await page.isVisible("#views canvas"),
        await page.isVisible("#parameter-discs"),
        await page.isVisible("#headline"),
    ],
    [true, true, true],
);
assert.deepEqual(
    [
        await page.isVisible("#panels"),
        await page.isVisible("footer"),
        await page.isVisible("#discovery"),
    ],
    [false, false, false],
);

assert.deepEqual(errors, []);
await browser.close();
