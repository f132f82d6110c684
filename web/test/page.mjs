// The one file in a real browser: node page.mjs FILE.html CHROMIUM HASH PICTURE.svg [FOLDER], where the
// picture is `swirl image --bare` of the dish that has this hash, and FOLDER gets what is downloaded. Ends with 1 and a sentence for whatever is not as it should be.
import assert from "node:assert/strict";
import {readFileSync, writeFileSync} from "node:fs";
import {createRequire} from "node:module";
import {pathToFileURL} from "node:url";
import {chromium} from "playwright-core";

const [file, executablePath, wantedHash, picture, folder] = process.argv.slice(2);
const address = pathToFileURL(file).href;
const args = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
              "--disable-background-networking", "--disable-component-update", "--disable-sync"];
const browser = await chromium.launch({executablePath, args});
const page = await browser.newPage({viewport: {width: 1200, height: 800}});
const complaints = [], requests = [];
page.on("pageerror", (error) => complaints.push(error.message));
page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) requests.push(request.url());
});
// Where the page draws circles, in pixels of the canvas.
await page.addInitScript(() => {
    globalThis.drawnCircles = [];
    const arc = CanvasRenderingContext2D.prototype.arc;
    CanvasRenderingContext2D.prototype.arc = function (x, y, r, ...angles) {
        const {a, d, e, f} = this.getTransform();
        globalThis.drawnCircles.push([a * x + e, d * y + f, a * r]);
        return arc.call(this, x, y, r, ...angles);
    };
});
/** Nothing that keeps anybody from using it: axe-core's rules of WCAG 2.1, levels A and AA. */
const barriers = async (where) => {
    await page.addScriptTag({path: createRequire(import.meta.url).resolve("axe-core/axe.min.js")});
    const {violations, passes} = await page.evaluate(() => globalThis.axe.run(
        {runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "best-practice"]}));
    assert.ok(passes.length > 15, `${where}: only ${passes.length} rules were tried`);
    assert.deepEqual(violations.map(({id, nodes}) => `${id}: ${nodes[0].html}`), [], where);
};
const text = (id) => page.textContent(`#${id}`);
/** The name and the bytes of what a button saves. */
const downloaded = async (button) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
    const chunks = await (await download.createReadStream()).toArray();
    return [download.suggestedFilename(), Buffer.concat(chunks)];
};
/** A study of 20 swirls a run, until all its findings are told. */
const study = async (discs, mu, findings) => {
    await page.fill("#study-discs", discs);
    await page.fill("#study-mu", mu);
    await page.fill("#study-swirls", "20");
    await page.click("#study-start");
    await page.waitForFunction(
        (wanted) => document.querySelectorAll("#study-findings li").length === wanted, findings,
        {timeout: 60_000});
};
const open = async (query) => {
    await page.goto(address + query);
    await page.waitForFunction(() => document.getElementById("state-hash").textContent !== "" ||
        !document.getElementById("refusal").hidden, null, {timeout: 60_000});
};

// The address holds the dish, and runs to exactly that event.
await open("?discs=28&mu=0.5&seed=3&events=20000");
assert.equal(await text("state-hash"), wantedHash);
assert.equal(await text("event-count"), "20000");
// Averages of the command line leave out what the page leaves out, as soon as there are any.
assert.equal(await text("command"), "./swirl run --discs 28 --mu 0.5 --warmup 20 --seed 3 --events 20000");

// It draws every disc where `swirl image` draws it, to half a pixel: places in radii of a disc from
// the middle of the dish, which has the widest circle.
const circlesOf = (list, radiusOf) => {
    const [cx, cy, widest] = list.reduce((a, b) => (b[2] > a[2] ? b : a));
    const small = list.filter(([, , r]) => r > 0.08 * widest && r < 0.2 * widest);
    const radius = radiusOf(widest, small.map(([, , r]) => r));
    return {radius, discs: small.filter(([, , r]) => Math.abs(r - radius) < 0.1)
        .map(([x, y]) => [(x - cx) / radius, (y - cy) / radius])};
};
const ofPage = circlesOf(await page.evaluate(() => { // of the last time that it drew
    const circles = globalThis.drawnCircles;
    return circles.slice(circles.findLastIndex(([, , r]) => r === Math.max(...circles.map((c) => c[2]))));
}), (dish) => dish / 8.6); // the picture's widest circle is the wall's outer edge
const ofPicture = circlesOf([...readFileSync(picture, "utf-8").matchAll(/ d="M ([^"]*)"/g)]
    .map(([, path]) => path.split(/[^-\d.]+/).filter(Boolean).map(Number))
    .filter((numbers) => numbers.length >= 26) // round: four curves
    .map((numbers) => {
        const xs = numbers.filter((_, k) => k % 2 === 0), ys = numbers.filter((_, k) => k % 2 === 1);
        return [0.5 * (Math.min(...xs) + Math.max(...xs)), 0.5 * (Math.min(...ys) + Math.max(...ys)),
                0.5 * (Math.max(...xs) - Math.min(...xs))];
    }), (_, discs) => Math.max(...discs));
assert.equal(new Set(ofPage.discs.map(String)).size, 28);
for (const [x, y] of ofPage.discs) {
    const nearest = Math.min(...ofPicture.discs.map(([u, v]) => Math.hypot(u - x, v - y)));
    assert.ok(nearest * ofPage.radius < 0.5, `a disc is drawn ${nearest * ofPage.radius} pixels off`);
}

// One event more, drawn with its impulse.
await page.click("#step");
await page.waitForFunction(() => document.getElementById("event-count").textContent === "20001");

// A thousand more, one by one, with the next one looked up each time.
await page.evaluate(() => { for (let k = 0; k < 1000; ++k) document.getElementById("step").click(); });
await page.waitForFunction(() => document.getElementById("event-count").textContent === "21001");
assert.equal(await page.isHidden("#refusal"), true);
await barriers("a dish");
await page.emulateMedia({colorScheme: "dark"});
await barriers("a dish in the dark");
await page.emulateMedia({colorScheme: "light"});
assert.equal(await text("caution"), "");

for (const [query, options] of [["?discs=48&events=2000", "--discs 48"], // has not come so far
                                ["?discs=5&warmup=2&events=3000", "--discs 5 --warmup 2"]]) {
    await open(query);
    assert.equal(await text("command"), `./swirl run ${options} --events ${query.split("events=")[1]}`);
}

// It moves, and time goes on.
await open("?discs=48");
const before = Number(await text("event-count"));
await page.waitForFunction((n) => Number(document.getElementById("event-count").textContent) > n,
                           before + 1000, {timeout: 60_000});
const painted = await page.evaluate(() => {
    const canvas = document.querySelector("canvas");
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return new Set(Array.from({length: data.length / 400}, (_, k) => data[400 * k])).size;
});
assert.ok(painted > 5, `the canvas shows ${painted} shades`);

// Every number has a slider, and what the slider says stands in the field.
const withoutSlider = await page.$$eval("#parameters .row", (all) => all
    .filter((row) => !row.querySelector("input[type=range]"))
    .map((row) => row.querySelector("input[type=text], select").id.replace("parameter-", "")));
assert.deepEqual(withoutSlider, ["preset", "body", "mixture", "floor", "path"]);
const ofMuWall = page.locator(".row:has(#parameter-mu_wall) input[type=range]");
assert.deepEqual([await ofMuWall.getAttribute("max"), await ofMuWall.getAttribute("step")], ["2", "0.05"]);
await ofMuWall.fill("0.35");
assert.equal(await page.inputValue("#parameter-mu_wall"), "0.35");
await page.fill("#parameter-mu_wall", "");

// A slider and a field make another dish; the address follows where the page has one.
await page.fill("#parameter-discs", "5");
await page.waitForFunction(
    () => document.getElementById("command").textContent.includes("--discs 5 "));
await page.selectOption("#choose-preset", {label: "48 discs, μ = 0.1"});
await page.waitForFunction(
    () => document.getElementById("command").textContent.includes("--mu 0.1"));
await page.selectOption("#choose-View", "both");
assert.equal(await page.locator("canvas:visible").count() >= 2, true);

// Words are chosen; what a preset brings stands where nothing is given.
await page.selectOption("#parameter-preset", "experiment");
await page.waitForSelector('canvas[aria-label^="48 spheres"]');
await page.waitForFunction(() => document.getElementById("parameter-body").value === "sphere");
assert.equal(await page.inputValue("#parameter-restitution"), "");
assert.equal(await page.getAttribute("#parameter-restitution", "placeholder"), "0.9");
await page.selectOption("#parameter-body", "disc");
await page.waitForSelector('canvas[aria-label^="48 coins"]');
await page.selectOption("#parameter-preset", "");
await page.selectOption("#parameter-body", "sphere");
await page.waitForSelector('canvas[aria-label^="48 spheres"]');

// What cannot be is said in a sentence, and mended.
await page.fill("#parameter-discs", "1000");
await page.waitForFunction(() => !document.getElementById("refusal").hidden);
assert.match(await text("refusal"), /1000 spheres do not fit/);
assert.deepEqual([await text("command"), await page.isDisabled("#copy")], ["", true]);
await page.fill("#parameter-discs", "12");
await page.waitForFunction(() => document.getElementById("refusal").hidden &&
    document.getElementById("command").textContent.includes("--discs 12 "));
// What is copied is what is shown.
const [copied, shown] = await page.evaluate(() => {
    let copied;
    Object.defineProperty(navigator, "clipboard", {value: {writeText: async (text) => { copied = text; }}});
    document.getElementById("copy").click();
    return [copied, document.getElementById("command").textContent];
});
assert.equal(copied, shown);
// A value of more than one line, or with characters that are not shown, is another command than it seems.
for (const [query, code] of [["?discs=5%0Atouch%20x%20%23", "000A"], ["?discs=5%0Aseed=7", "000A"],
                             ["?seed=1&mu=0.5%0D", "000D"], ["?discs=5%00", "0000"], ["?seed=3%1B[2J", "001B"],
                             ["?path=circle%E2%80%AE", "202E"], ["?discs=5%E2%80%A8", "2028"]]) {
    await open(query);
    assert.match(await text("refusal"), new RegExp(`control character U\\+${code},`), query);
    assert.deepEqual([await text("command"), await page.isDisabled("#copy"), await text("event-count")],
                     ["", true, ""], query);
}
await open("?disks=5");
assert.match(await text("refusal"), /'disks'/);
await open("?discs=5&events=-1");
assert.match(await text("refusal"), /events=-1/);
await open("?discs=30000&radius=0.01");
assert.match(await text("refusal"), /30000 discs are too many for a page.* \.\/swirl run --discs 30000\.$/);

// A container that is a dot beside its path is drawn, with its discs and marks.
await open("?discs=5&amplitude=1e6&events=100");
assert.ok(await page.evaluate(() => {
    globalThis.drawnCircles = [];
    document.getElementById("trails").click();
    return globalThis.drawnCircles.length;
}) >= 10);
assert.deepEqual(complaints, []);

// A collapse is no state: neither on the way to an event nor while one looks on.
for (const events of ["&events=300000", ""]) {
    await page.goto(`${address}?discs=48&restitution=0.5&contact_duration=0${events}`);
    await page.waitForFunction(() => !document.getElementById("refusal").hidden, null, {timeout: 60_000});
    assert.match(await text("refusal"), /\(inelastic collapse\)/);
    if (events) assert.equal(await text("state-hash"), "");
}

// What takes a while says how far it is.
await page.goto(`${address}?discs=48&events=1000000`);
await page.waitForFunction(
    () => /^\d+ of 1000000 events done\.$/.test(document.getElementById("headline").textContent));
await page.waitForFunction(() => document.getElementById("event-count").textContent === "1000000", null,
                           {timeout: 60_000});
await page.evaluate(() => {
    globalThis.headlines = [];
    const headline = document.getElementById("headline");
    new MutationObserver(() => globalThis.headlines.push(headline.textContent))
        .observe(headline, {childList: true});
});
await page.selectOption("#choose-preset", {label: "2000 small discs"});
await page.waitForSelector('canvas[aria-label^="2000 discs"]');
assert.ok((await page.evaluate(() => globalThis.headlines)).includes("Placing 2000 discs…"));

// Changed on the way: the same discs go on, and no command line makes them.
await open("?discs=8");
await page.check("#keep");
await page.evaluate(() => { // ten swirls a second
    const speed = document.getElementById("speed");
    speed.value = "1";
    speed.dispatchEvent(new Event("input"));
});
await page.fill("#parameter-mu", "0.2");
await page.waitForFunction(() => document.getElementById("command").textContent.startsWith("none"));
await page.fill("#parameter-discs", "9"); // that is another dish
await page.waitForFunction(
    () => document.getElementById("command").textContent.includes("--discs 9 --mu 0.2"));
await page.click("#play"); // and does not wait for the end of a swirl, which may never come
await page.fill("#parameter-discs", "7");
await page.waitForSelector('canvas[aria-label^="7 discs"]');
await page.fill("#parameter-discs", "900"); // nor does a sentence
await page.waitForFunction(() => /do not fit/.test(document.getElementById("refusal").textContent));
await page.fill("#parameter-discs", "9");
await page.waitForSelector('canvas[aria-label^="9 discs"]');
assert.equal(await page.isHidden("#refusal"), true);
await page.click("#play");
await page.uncheck("#keep");

// Maps fill up.
await page.click("#maps summary");
await page.waitForFunction(() => {
    const canvas = document.getElementById("density-map");
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width || 1, canvas.height || 1);
    return new Set(Array.from({length: data.length / 40}, (_, k) => data[40 * k])).size > 10;
}, null, {timeout: 60_000});
await page.waitForSelector("#profile canvas");
await page.click("#maps summary");

// By hand: the dish goes where the pointer goes, and ends where one says.
await page.click("#by-hand");
const dish = await page.locator("#views canvas").boundingBox();
for (let k = 0; k < 40; ++k) {
    await page.mouse.move(dish.x + dish.width * (0.5 + 0.1 * Math.cos(k / 3)),
                          dish.y + dish.height * (0.5 + 0.1 * Math.sin(k / 3)));
    await page.waitForTimeout(20);
}
assert.match(await text("headline"), /^Move the dish/);
await page.click("#by-hand");
await page.waitForFunction(() => /^9 discs/.test(document.getElementById("headline").textContent));

// Time backwards: only where nothing is lost.
await open("?discs=8");
assert.equal(await page.isDisabled("#backwards"), true);
await open("?discs=8&mu=0");
assert.match(await text("caution"), /^Without friction the energy grows without bound on the polygon; /);
await open("?discs=8&mu=0&body=sphere&floor=sliding"); // the floor takes it
assert.equal(await text("caution"), "");
await open("?discs=8&mu=0");
await page.click("#backwards");
await page.waitForFunction(() => document.getElementById("backwards").textContent === "Time forwards");
assert.match(await text("command"), /^none/);
await page.click("#backwards");
await page.waitForFunction(() => document.getElementById("backwards").textContent === "Time backwards");

// A disc that is dragged goes where the pointer goes.
await open("?discs=1&events=20");
const table1 = await page.locator("#views canvas").boundingBox();
const centroid = (of = page) => of.evaluate(() => { // of what is drawn in the disc's colour
    const canvas = document.querySelector("#views canvas");
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let n = 0, x = 0, y = 0;
    for (let k = 0; k < data.length / 4; ++k) {
        if (data[4 * k] !== 0 || data[4 * k + 1] !== 114 || data[4 * k + 2] !== 178) continue;
        n += 1;
        x += k % canvas.width;
        y += Math.floor(k / canvas.width);
    }
    return [(x / n + 0.5) / canvas.width, (y / n + 0.5) / canvas.height];
});
await page.selectOption("#choose-Colour", "id");
const held = await centroid();
await page.mouse.move(table1.x + held[0] * table1.width, table1.y + held[1] * table1.height);
await page.mouse.down();
await page.mouse.move(table1.x + 0.5 * table1.width, table1.y + 0.45 * table1.height, {steps: 10});
await page.waitForTimeout(300);
await page.mouse.move(table1.x + 0.5 * table1.width, table1.y + 0.45 * table1.height);
await page.waitForTimeout(300);
const put = await centroid();
await page.mouse.up();
// The hand of the disc and its rim are not of its colour: to a hundredth of the picture.
assert.ok(Math.hypot(put[0] - 0.5, put[1] - 0.45) < 0.01, `dragged to ${put}`);

// And by keys: taken, moved, let go; time stands still while it is held.
const lab = page.locator("#views canvas").first();
await lab.focus();
await page.keyboard.press("]");
assert.match(await text("headline"), /^Disc 1 is held/);
const lifted = await centroid();
for (let k = 0; k < 4; ++k) {
    await page.keyboard.press("ArrowLeft");
    await page.waitForTimeout(150);
}
const pushed = await centroid();
// Four quarters of its radius, in widths of the picture: that shows R + A, and a margin.
const radius = 1 / (2 * 1.06 * (8.6 + 1.892));
assert.ok(Math.hypot(lifted[0] - pushed[0] - radius, pushed[1] - lifted[1]) < 0.1 * radius,
    `moved from ${lifted} to ${pushed}`);
await page.keyboard.press("Escape");
await page.selectOption("#choose-Colour", "spin");

// A finger takes a disc up and down, which elsewhere would scroll the page.
const phone = await browser.newPage({viewport: {width: 360, height: 740}, hasTouch: true,
                                     reducedMotion: "reduce"});
await phone.goto(`${address}?discs=1&events=20`);
await phone.waitForFunction(() => document.getElementById("state-hash").textContent !== "");
await phone.selectOption("#choose-Colour", "id");
await phone.locator("#views canvas").scrollIntoViewIfNeeded();
const small = await phone.locator("#views canvas").boundingBox();
const touched = await centroid(phone);
const fingers = await phone.context().newCDPSession(phone);
const touch = (type, y) => fingers.send("Input.dispatchTouchEvent", {type, touchPoints: y === undefined ? [] :
    [{x: small.x + touched[0] * small.width, y: small.y + y * small.height}]});
const way = touched[1] > 0.5 ? -0.2 : 0.2;
await touch("touchStart", touched[1]);
for (let k = 1; k <= 20; ++k) {
    await touch("touchMove", touched[1] + way * k / 20);
    await phone.waitForTimeout(30);
}
const led = await centroid(phone);
await touch("touchEnd");
assert.ok(Math.hypot(led[0] - touched[0], led[1] - touched[1] - way) < 0.02, `a finger led it to ${led}`);

// Who asked for less motion has none from the lesson either.
await phone.click("#lesson-start");
await phone.waitForSelector('canvas[aria-label^="8 discs"]');
assert.equal(await phone.textContent("#play"), "Play");
await phone.close();

// A second dish, which stays as it was asked for.
await open("?discs=12");
await page.click("#keep-beside");
await page.fill("#parameter-discs", "20");
await page.waitForFunction(() => /^12 discs: ϖ/.test(
    document.querySelector("#beside figcaption")?.textContent ?? ""), null, {timeout: 60_000});
await page.waitForFunction(() => document.getElementById("command").textContent.includes("--discs 20 "));
await barriers("two dishes");
await page.click("#beside-ends");
assert.equal(await page.locator("#beside").count(), 0);

// The paper's figure by oneself, in small; the warm-up that is looked for is the page's own here.
await open("?discs=12&warmup=auto");
await page.click("#study summary");
for (const [discs, mu, said] of [["5:x", "1", /must be numbers or ranges/], ["", "1", /must be numbers/],
                                 ["5", "1:x", /pairs DISC:WALL/], ["5", "1:", /pairs DISC:WALL/],
                                 ["5:6", "1", /must be numbers/]]) {
    await page.fill("#study-discs", discs);
    await page.fill("#study-mu", mu);
    await page.click("#study-start");
    assert.match(await text("study-said"), said);
}
await study("5, 8:2:10", "0, 1, 1:0", 3);
assert.match(await text("study-said"), /^9 of 9 runs/);
assert.deepEqual((await page.$$eval("#study-findings li", (all) => all.map((each) => each.textContent)))
    .map((each) => each.split(": ")[0]).sort(), ["μ = 0", "μ = 1", "μ_d = 1, μ_w = 0"]);
for (const each of await page.$$eval("#study-findings li", (all) => all.map((one) => one.textContent)))
    assert.match(each, /Mean over the discs: .+ by time, .+ by event\. Rigid body: .+ by time, .+ by event\.$/);
await barriers("the study");
const table = (await downloaded("#study-table"))[1].toString().trim().split("\n");
assert.equal(table.length, 10);
assert.equal(table[0], "mu_disc,mu_wall,discs,varpi,varpi_error,collapsed,varpi_rigid,varpi_rigid_error");
assert.deepEqual(table.filter((row) => row.startsWith("1,0,")).map((row) => row.split(",")[2]).sort(),
                 ["10", "5", "8"]);
if (folder) writeFileSync(`${folder}/study.csv`, table.join("\n"));
assert.ok(table.slice(1).every((row) => row.split(",").every((x) => Number.isFinite(Number(x)))));
await page.fill("#study-discs", "1000");
await page.click("#study-start");
await page.waitForFunction(
    () => /do not fit/.test(document.getElementById("study-said").textContent));
await page.click("#study summary");

// A run of it that collapses is told, and has no average.
await page.goto(`${address}?discs=5&restitution=0.5&contact_duration=0`);
await page.click("#study summary");
await study("48", "1", 1);
assert.match(await text("study-said"), /^1 of 1 runs done\. Collapsed, and left out.*: N = 48 at μ = 1\.$/);
assert.match((await downloaded("#study-table"))[1].toString(), /\n1,1,48,,,1,,\n$/);
await page.click("#study summary");

// The lesson goes through its six steps by keyboard alone.
await open("");
await page.focus("#lesson-start");
await page.keyboard.press("Enter");
for (let step = 1; step <= 6; ++step) {
    if (step === 3) await barriers("the lesson");
    assert.match(await text("lesson"), new RegExp(`^${step}\\. `));
    await page.locator("#lesson button").last().focus();
    await page.keyboard.press("Enter");
}
assert.equal(await page.locator("#lesson-start").count(), 1);

// A recording is a film and the positions.
await page.waitForSelector('canvas[aria-label^="28 discs"]');
await page.click("#record");
await page.waitForTimeout(1500);
await page.click("#record");
await page.waitForSelector("#save-film", {timeout: 90_000}); // a busy machine is slow to end a film

// Downloads.
const saved = {}, canvasSize = await page.$eval("#views canvas", ({width, height}) => [width, height]);
for (const [button, name, begins] of [["#save-picture", "swirl.png", "\x89PNG"],
                                      ["#save-table", "rotation.csv", "swirl,varpi_rigid\n"],
                                      ["#save-film", "swirl.webm", "\x1a\x45\xdf\xa3"],
                                      ["#save-positions", "swirl.xyz", "28\nProperties=species"],
                                      ["#save-result", "result.json", "{\n"]]) {
    const [called, bytes] = await downloaded(button);
    assert.equal(called, name);
    saved[name] = bytes;
    assert.ok(saved[name].toString("latin1").startsWith(begins), name);
}

// The picture has the canvas's size; tests/cli/lab_test.py decodes it.
assert.deepEqual([16, 20].map((at) => saved["swirl.png"].readUInt32BE(at)), canvasSize);
assert.ok(canvasSize[0] >= 300, `${canvasSize}`);

// Positions are extended XYZ, frame for frame: later and later, everybody in the dish, nobody in another.
const lines = saved["swirl.xyz"].toString().trimEnd().split("\n"), frames = [];
for (let at = 0; at < lines.length; at += 30) {
    assert.equal(lines[at], "28");
    const [, columns, time] = lines[at + 1].match(/^Properties=(\S+) Time=(\S+) pbc="F F F"$/);
    const width = columns.split(":").reduce((sum, word, k) => sum + (k % 3 === 2 ? Number(word) : 0), 0);
    const rows = lines.slice(at + 2, at + 30).map((each) => each.split(" "));
    assert.ok(rows.every((row) => row.length === width && row[0] === "D1" &&
        row.slice(1).every((word) => word !== "" && Number.isFinite(Number(word)))), lines[at + 1]);
    frames.push({time: Number(time), rows: rows.map((row) => row.slice(1).map(Number))});
}
assert.ok(frames.length > 5, `${frames.length} frames`);
for (const [k, {time, rows}] of frames.entries()) {
    if (k > 0) assert.ok(time >= frames[k - 1].time);
    for (const [i, [x, y, z, , , vz, , radius, id]] of rows.entries()) {
        assert.deepEqual([z, vz, radius, id], [0, 0, 1, i + 1]);
        assert.ok(Math.hypot(x, y) < 8.6 + 1.892 - 1 + 1e-9);
        for (const [u, v] of rows.slice(i + 1)) assert.ok(Math.hypot(u - x, v - y) > 2 - 1e-9);
    }
}
if (folder) for (const [name, bytes] of Object.entries(saved)) writeFileSync(`${folder}/${name}`, bytes);

// A narrow screen has nothing that sticks out.
await page.setViewportSize({width: 360, height: 740});
const wide = await page.evaluate(() => document.documentElement.scrollWidth);
assert.ok(wide <= 360, `at a width of 360 the page is ${wide} wide`);

assert.deepEqual(complaints, []);
assert.deepEqual(requests, []);

// Without JavaScript there is a sentence.
const plain = await browser.newPage({javaScriptEnabled: false});
await plain.goto(address);
assert.match(await plain.innerText("body"), /JavaScript, which is turned off here/);
await browser.close();

// And without vectors in WebAssembly, which Chromium leaves out where the processor has none.
const old = await chromium.launch({executablePath, args: [
    ...args, "--js-flags=--no-enable-sse4-1 --no-enable-ssse3 --no-enable-sse3"]});
const without = await old.newPage();
await without.goto(address);
await without.waitForFunction(() => document.getElementById("state-hash").textContent !== "" ||
    !document.getElementById("refusal").hidden, null, {timeout: 60_000});
assert.match(await without.textContent("#refusal"), /^This browser has no WebAssembly with vectors \(SIMD\)/);
await old.close();
