// Tests the first page in Chromium: node first.mjs FOLDER CHROMIUM [--all], where FOLDER holds both
// pages. Exits with 1 and a message if a test fails.
import assert from "node:assert/strict";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {launch, violationsOf} from "./browser.mjs";
import {inEachFont} from "./fonts.mjs";

const [folder, executablePath] = process.argv.slice(2);
const all = process.argv.includes("--all");
const address = pathToFileURL(join(folder, "index.html")).href;
const browser = await launch(executablePath);
const controls = "button, input, select, summary, [role=slider]";

const said = (page) => page.textContent("#sentence");
const isSaid = (page, pattern) =>
    page.waitForFunction(
        (source) => new RegExp(source).test(document.getElementById("sentence").textContent),
        pattern,
    );
const open = async (query, options = {}) => {
    const page = await browser.newPage({viewport: {width: 360, height: 640}, ...options});
    page.on("pageerror", (error) => assert.fail(error.message));
    await page.goto(address + query);
    return page;
};
/** Taps the bead of this number. */
const choose = async (page, number) => {
    const {x, y, width, height} = await page.locator("#row").boundingBox();
    await page.mouse.click(x + 18 + ((number - 3) * (width - 36)) / 52, y + height / 2);
};
/** How many pixels of the arrow that shows the swirl are in the lower left corner of the dish. */
const arrowOf = (page) =>
    page.$eval("#dish", (canvas) => {
        const {width, height} = canvas,
            side = Math.min(width, height),
            corner = Math.floor(0.2 * side);
        const {data} = canvas
            .getContext("2d")
            .getImageData((width - side) / 2, (height + side) / 2 - corner, corner, corner);
        let count = 0;
        for (let k = 0; k < data.length; k += 4)
            count += data[k] === 107 && data[k + 1] === 115 && data[k + 2] === 122;
        return count;
    });
const hasNoViolation = async (page, where) => assert.deepEqual(await violationsOf(page), [], where);

// The layout: one dish on at least 40 % of the screen, at most five controls of at least 44 pixels,
// at most ten words in the sentence; nothing is cut off or covers the dish.
const every = [
    [360, 640],
    [768, 1024],
    [1440, 900],
].flatMap((size) =>
    ["light", "dark"].flatMap((scheme) => ["en", "de"].map((lang) => [...size, scheme, lang])),
);
const few = [
    [360, 640, "light", "de"],
    [768, 1024, "dark", "en"],
    [1440, 900, "light", "de"],
];
for (const [width, height, colorScheme, lang] of all ? every : few) {
    const where = `${width} × ${height}, ${colorScheme}, ${lang}`;
    const page = await open(`?lang=${lang}`, {viewport: {width, height}, colorScheme});
    await isSaid(page, "swirl|sinn");
    const places = () =>
        page.evaluate((wanted) => {
            const of = (each) => {
                const {left, top, right, bottom} = each.getBoundingClientRect();
                return {name: each.id, left, top, right, bottom};
            };
            const sentence = document.getElementById("sentence");
            return {
                stage: of(document.getElementById("stage")),
                link: of(document.getElementById("laboratory")),
                controls: [...document.querySelectorAll(wanted)].map(of),
                wide: document.documentElement.scrollWidth,
                high: document.documentElement.scrollHeight,
                isCut:
                    sentence.scrollWidth > sentence.clientWidth ||
                    sentence.scrollHeight > sentence.clientHeight ||
                    [...document.querySelectorAll("button")].some(
                        (each) => each.scrollWidth > each.clientWidth,
                    ),
                canvases: document.querySelectorAll("canvas").length,
            };
        }, controls);
    const {stage, ...others} = await places();
    const side = Math.min(stage.right - stage.left, stage.bottom - stage.top);
    assert.ok(side ** 2 >= 0.4 * width * height, `${where}: the dish has a side of ${side}`);
    assert.equal(others.controls.length, 5, where);
    assert.deepEqual([others.wide, others.high, others.isCut], [width, height, false], where);
    assert.equal(others.canvases, 2, `${where}: one dish and the row`);
    for (const {name, left, top, right, bottom} of [...others.controls, others.link]) {
        assert.ok(right - left >= 44 && bottom - top >= 44, `${where}: #${name} is small`);
        assert.ok(left >= 0 && top >= 0 && right <= width && bottom <= height, `${where}: ${name}`);
        // The corner of a control that is nearest to the middle of the dish is outside its circle.
        const [x, y] = [(stage.left + stage.right) / 2, (stage.top + stage.bottom) / 2];
        const dx = x - Math.max(left, Math.min(right, x)),
            dy = y - Math.max(top, Math.min(bottom, y));
        assert.ok(Math.hypot(dx, dy) >= 0.5 * side, `${where}: #${name} covers the dish`);
    }
    const sizes = await page.$$eval("#sentence, #reversal, button, a", (all) =>
        all.map((each) => parseFloat(getComputedStyle(each).fontSize)),
    );
    assert.ok(
        sizes.every((size) => [13, 16, 17, 24].includes(size)),
        `${where}: ${sizes}`,
    );
    const words = (await said(page)).trim().split(/\s+/);
    assert.ok(words.length <= 10, `${where}: ${words.join(" ")}`);
    await hasNoViolation(page, where);
    await page.emulateMedia({forcedColors: "active"});
    await page.click("#rim");
    await hasNoViolation(page, `${where}, forced colours`);
    const looks = await page.$$eval("#rim, #discs", (two) =>
        two.map((each) => getComputedStyle(each).backgroundColor),
    );
    assert.notEqual(looks[0], looks[1], `${where}: a pressed button looks like the others`);
    await page.emulateMedia({forcedColors: "none"});
    // Another font does not move the dish, and cuts no sentence off.
    if (width === 360)
        await inEachFont(page, async (font, ofPage, high) => {
            const now = await places();
            assert.ok(now.wide <= ofPage && now.high <= high, `${where}, ${font}: it scrolls`);
            assert.equal(now.isCut, false, `${where}, ${font}: the sentence is cut off`);
            assert.deepEqual(
                [now.stage.top, now.stage.bottom],
                [stage.top, stage.bottom],
                `${where}, ${font}: the dish has moved`,
            );
        });
    await page.close();
}

// A new visitor sees both directions without a touch. N_c is found in a few taps, and the true one
// is 38.5; each number that was tried has its bar.
{
    const page = await open("?lang=en");
    await isSaid(page, "^8 discs turn with the swirl$");
    await isSaid(page, "^48 discs turn against the swirl$");
    for (const number of [28, 43]) {
        await choose(page, number);
        await isSaid(page, `^${number} discs turn`);
    }
    assert.equal(await page.textContent("#reversal"), "reverses between 28 and 43");
    // The text is below its bracket.
    const [below, wanted] = await page.evaluate(() => {
        const [text, {left, width}] = ["reversal", "row"].map((id) =>
            document.getElementById(id).getBoundingClientRect(),
        );
        return [text.left + text.width / 2, left + 18 + ((35.5 - 3) * (width - 36)) / 52];
    });
    assert.ok(Math.abs(below - wanted) < 2, `the text is at ${below}, the bracket at ${wanted}`);
    assert.match(
        await page.getAttribute("#row", "aria-valuetext"),
        /^43 discs, against the swirl$/,
    );
    // The cause, on the same discs: without friction at the rim, or between the discs, 48 turn with
    // the swirl. If their spins are held, too, they turn against it again.
    await choose(page, 48);
    await isSaid(page, "^48 discs turn against the swirl$");
    await page.click("#rim");
    await isSaid(page, "^48 discs turn with the swirl$");
    await page.click("#rim");
    await page.click("#discs");
    await isSaid(page, "^48 discs turn with the swirl$");
    await page.click("#hold");
    await isSaid(page, "^48 discs turn against the swirl$");
    // An arrow shows which way the dish goes; a camera that rides along does not see it.
    assert.ok((await arrowOf(page)) > 50);
    await page.click("#ride");
    while ((await arrowOf(page)) > 0) await page.waitForTimeout(50);
    await page.click("#ride");
    // The address has this state.
    const copy = await open(new URL(page.url()).search);
    await isSaid(copy, "^48 discs turn against the swirl$");
    assert.deepEqual(
        await copy.$$eval("[aria-pressed=true]", (pressed) => pressed.map(({id}) => id)),
        ["discs", "hold"],
    );
    await copy.close();
    // The keys: the row is a slider, a focused dish is stirred by arrows and stopped by space.
    await page.focus("#row");
    for (const key of ["Home", "PageUp", "ArrowLeft", "ArrowUp"]) await page.keyboard.press(key);
    assert.equal(await page.getAttribute("#row", "aria-valuenow"), "8");
    await page.focus("#dish");
    await page.keyboard.press("ArrowLeft");
    await isSaid(page, "under your hand$");
    await page.keyboard.press("Escape");
    await isSaid(page, "^8 discs");
    // By hand: a drag stirs, and a tap stops time. A page at rest asks for no images.
    const {x, y, width, height} = await page.locator("#dish").boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + 30, y + height / 2, {steps: 4});
    await isSaid(page, "under your hand$");
    await page.mouse.up();
    await isSaid(page, "^8 discs");
    await page.mouse.click(x + width / 2, y + height / 2);
    await page.waitForTimeout(500); // measurements end, which draw their bar
    const asked = await page.evaluate(async () => {
        const ask = globalThis.requestAnimationFrame;
        let count = 0;
        globalThis.requestAnimationFrame = (act) => ((count += 1), ask(act));
        for (let k = 0; k < 20; ++k) await new Promise((drawn) => ask(drawn));
        globalThis.requestAnimationFrame = ask;
        return count;
    });
    assert.ok(asked <= 1, `a page at rest asked for ${asked} images`);
    await page.close();
}

// With less motion the dish is at rest, and the arc shows what it has turned.
{
    const page = await open("?lang=en&discs=48&seed=3", {reducedMotion: "reduce"});
    await isSaid(page, "^48 discs turn against the swirl$");
    const images = async () => {
        await page.waitForTimeout(400);
        return page.$eval("#dish", (canvas) => canvas.toDataURL());
    };
    assert.equal(await images(), await images());
    const arc = await page.$eval("#dish", (canvas) => {
        const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        let count = 0;
        for (let k = 0; k < data.length; k += 4)
            count += data[k] === 31 && data[k + 1] === 99 && data[k + 2] === 166;
        return count;
    });
    assert.ok(arc > 200, `the arc has ${arc} pixels`);
    await page.close();
}

// An address that asks for more opens the Laboratory, with the same entries; others stay.
for (const [query, place] of [
    ["?discs=20&mu=0.3&seed=4&utm_source=x", "index.html"],
    ["?discs=20&embed=1", "index.html"],
    ["?discs=20&view=m", "laboratory.html"],
    ["?amplitude=1.5", "laboratory.html"],
    ["?seed=1#points=8:0.1", "laboratory.html"],
]) {
    const page = await open(query);
    await page.waitForURL((url) => url.pathname.endsWith(place) && url.href.includes(query));
    await page.close();
}
{
    const page = await open("?lang=en&discs=20&mu=0.3&seed=4");
    await isSaid(page, "^20 discs turn");
    await page.click("#discs");
    await page.waitForURL((url) => url.search.includes("mu_disc=0&mu_wall=0.3"));
    await page.click("#laboratory");
    await page.waitForURL(/laboratory\.html\?.*mu_wall=0\.3/);
    await page.waitForFunction(() => document.getElementById("state-hash")?.textContent !== "");
    assert.equal(await page.isHidden("#error"), true);
    await page.click("#to-dish");
    await page.waitForURL(/index\.html/);
    await page.close();
}

// True motion: in the images of each dish (1000 with --all) no discs overlap by more than 1 % of a
// diameter. Time runs as fast as the engine allows, in steps of one image. The Laboratory begins
// with a film of 8 discs next to 48.
const watchOverlaps = () => {
    let now = 0;
    globalThis.requestAnimationFrame = (act) => setTimeout(() => act((now += 1000 / 60)));
    globalThis.overlaps = {images: 0, worst: 0, discs: new Set()};
    const drawn = new WeakMap();
    /** The drawing of an image begins: judges the one before. */
    const judge = (canvas) => {
        const discs = drawn.get(canvas) ?? [];
        drawn.set(canvas, []);
        if (discs.length === 0) return;
        for (const [k, [x, y, r]] of discs.entries())
            for (const [u, v, s] of discs.slice(k + 1)) {
                const overlap = (r + s - Math.hypot(x - u, y - v)) / (r + s);
                globalThis.overlaps.worst = Math.max(globalThis.overlaps.worst, overlap);
            }
        globalThis.overlaps.images += 1;
        globalThis.overlaps.discs.add(discs.length);
    };
    const {clearRect, drawImage, fillRect, arc} = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.clearRect = function (...place) {
        if (this.canvas.id === "dish") judge(this.canvas);
        return clearRect.apply(this, place);
    };
    CanvasRenderingContext2D.prototype.fillRect = function (...place) {
        if (place[2] === this.canvas.width && this.canvas.closest("#views")) judge(this.canvas);
        return fillRect.apply(this, place);
    };
    CanvasRenderingContext2D.prototype.drawImage = function (image, ...place) {
        const {a, b, e, f} = this.getTransform();
        if (this.canvas.id === "dish")
            drawn.get(this.canvas)?.push([e, f, (Math.hypot(a, b) * place[2]) / 2]);
        return drawImage.call(this, image, ...place);
    };
    CanvasRenderingContext2D.prototype.arc = function (x, y, r, ...angles) {
        // Only discs have this radius.
        if (r === 1) drawn.get(this.canvas)?.push([x, y, r]);
        return arc.call(this, x, y, r, ...angles);
    };
};
for (const [where, numbers] of [
    ...(all ? [5, 8, 20, 48] : [8, 48]).map((n) => [`index.html?discs=${n}&seed=7`, [n]]),
    ["laboratory.html?lang=en", [8, 48]],
    ...(all ? [["laboratory.html?discs=20", [20]]] : []),
]) {
    const page = await browser.newPage({viewport: {width: 360, height: 640}});
    await page.addInitScript(watchOverlaps);
    await page.goto(new URL(where, address).href);
    await page.waitForFunction((wanted) => globalThis.overlaps.images >= wanted, all ? 1000 : 250);
    const {worst, discs} = await page.evaluate(() => ({
        ...globalThis.overlaps,
        discs: [...globalThis.overlaps.discs],
    }));
    for (const number of numbers) assert.ok(discs.includes(number), `${where}: ${discs}`);
    assert.ok(worst <= 0.01, `${where}: discs overlap by ${worst} diameters`);
    await page.close();
}
await browser.close();
