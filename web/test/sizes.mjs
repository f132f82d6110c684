// Tests the page's layout at the sizes of laptops and phones: node sizes.mjs FILE.html CHROMIUM
// [--all] [WIDTH…]. Without --all it tests a laptop at twice the size and the smallest phone only,
// with widths only those. Exits with 1 and a message if a test fails.
import assert from "node:assert/strict";
import {pathToFileURL} from "node:url";
import {launch, violationsOf} from "./browser.mjs";
import {inEachFont} from "./fonts.mjs";

const [file, executablePath, ...more] = process.argv.slice(2);
const widths = more.map(Number).filter((width) => width > 0);
const all = process.argv.includes("--all");
const address = pathToFileURL(file).href;
const browser = await launch(executablePath);

/** Texts have four sizes, and what can be pressed has sides of at least 44 pixels. */
const hasTargets = async (page, where) => {
    const [sizes, small] = await page.evaluate(() => {
        const isShown = (each) => each.getClientRects().length > 0;
        const texts = [...document.querySelectorAll("body *")].filter(
            (each) => isShown(each) && [...each.childNodes].some(({nodeType}) => nodeType === 3),
        );
        const pressed = [...document.querySelectorAll("button, input, select, summary, textarea")]
            .filter(isShown)
            // The label of a box or a button of choice is a part of its target.
            .map((each) => (/checkbox|radio/.test(each.type) ? each.closest("label") : each));
        return [
            texts
                .filter((each) => !/script|style|option|noscript/i.test(each.tagName))
                .map((each) => getComputedStyle(each).fontSize),
            pressed
                .filter((each) => {
                    const {width, height} = each.getBoundingClientRect();
                    return width < 44 || height < 44;
                })
                .map((each) => each.outerHTML.slice(0, 80)),
        ];
    });
    assert.deepEqual(
        [...new Set(sizes)].filter((size) => !["13px", "16px", "17px", "24px"].includes(size)),
        [],
        where,
    );
    assert.deepEqual(small, [], where);
};

const newVisitor = "",
    link = "&seed=1";
const every = [
    [1440, 900],
    [1024, 768],
    [768, 1024],
    [683, 384],
    [683, 800],
    [390, 844],
    [360, 640],
].flatMap((size) =>
    ["light", "dark"].flatMap((scheme) =>
        ["en", "de"].flatMap((lang) =>
            [newVisitor, link].map((query) => [...size, scheme, lang, query]),
        ),
    ),
);
const few = [
    [683, 384, "light", "de", link],
    [360, 640, "light", "de", newVisitor],
    [360, 640, "dark", "de", link],
    [360, 640, "light", "en", newVisitor],
];
for (const [width, height, colorScheme, lang, query] of all ? every : few) {
    if (widths.length > 0 && !widths.includes(width)) continue;
    const isNew = query === "",
        where = `${width} × ${height}, ${colorScheme}, ${lang}, ${isNew ? "a new visitor" : "a link"}`;
    const page = await browser.newPage({
        viewport: {width, height},
        colorScheme,
        reducedMotion: "reduce",
    });
    await page.goto(`${address}?lang=${lang}${query}`);
    await page.waitForFunction(
        () => Number(document.getElementById("period-count")?.textContent.replace(",", ".")) >= 30,
    );
    // (A window of 384 pixels, that of a laptop at twice the size, is too low for all of them.)
    // A new visitor sees two dishes, the sentence, the plot and the hand.
    const first =
        height <= 400
            ? ["views", "play"]
            : isNew && width <= 768
              ? ["views", "headline", "play", "by-hand", "discovery-plot", "slider-discs"]
              : ["views", "headline", "play", "by-hand", "slider-discs", "slider-mu"].concat(
                    isNew ? [] : ["gauge"],
                );
    // Nothing extends beyond the page. The dish, the verdict and both main sliders are in the first
    // screen.
    const fits = async (font, ofPage, high) => {
        const [wide, ...places] = await page.evaluate(
            (ids) => [
                document.documentElement.scrollWidth,
                ...ids.map((id) => {
                    const {left, top, right, bottom} = document
                        .getElementById(id)
                        .getBoundingClientRect();
                    return {id, left, top, right, bottom};
                }),
            ],
            first,
        );
        assert.ok(wide <= ofPage, `${where}, ${font}: the page is ${wide} wide`);
        for (const {id, left, top, right, bottom} of places)
            assert.ok(
                left >= 0 && top >= 0 && right > left && right <= ofPage && bottom <= high,
                `${where}, ${font}: #${id} ends at ${right}, ${bottom}`,
            );
    };
    await fits("Inter", width, height);
    if (width === 360 && isNew) await inEachFont(page, fits);
    const dish = await page.locator("#views canvas").last().boundingBox();
    assert.ok(
        dish.width >= 0.42 * Math.min(width, height),
        `${where}: the dish is ${dish.width} wide`,
    );
    // A name is broken between words only: no word of a label is wider than its place.
    const broken = await page.$$eval("label, button, legend, summary, dt", (all) =>
        all
            .filter((each) => each.offsetParent !== null && each.scrollWidth > each.clientWidth + 1)
            .map((each) => each.outerHTML.slice(0, 80)),
    );
    assert.deepEqual(broken, [], where);
    // The menu opens inside the window.
    await page.click("#share summary");
    const menu = await page.locator("#share .menu").boundingBox();
    assert.ok(
        menu.x >= 0 &&
            menu.y >= 0 &&
            menu.x + menu.width <= width &&
            menu.y + menu.height <= height,
        `${where}: the menu is at ${JSON.stringify(menu)}`,
    );
    await hasTargets(page, where);
    await page.click("#share summary");
    // On a phone the dish stays while the controls scroll.
    await page.evaluate(() => scrollTo(0, 600));
    if (width <= 768) {
        const stays = await page.locator("#views canvas").last().boundingBox();
        assert.ok(stays.y >= 0, `${where}: the dish is at ${stays.y}`);
    }
    await page.evaluate(() => {
        scrollTo(0, 0);
        for (const each of document.querySelectorAll("main details")) each.open = true;
    });
    await hasTargets(page, where);
    // Each name of a parameter belongs to one control.
    const names = await page.$$eval("[id^=slider-], [id^=parameter-]:not(datalist)", (all) =>
        all.map((each) => each.ariaLabel ?? each.labels[0].textContent),
    );
    assert.ok(names.length > 40 && new Set(names).size === names.length, `${where}: ${names}`);
    const wideOpen = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wideOpen <= width, `${where}: the open page is ${wideOpen} wide`);
    assert.deepEqual(await violationsOf(page), [], where);
    // With forced colours and in print the gauge, the sliders and the legends are still there.
    const marks = () =>
        // In one step: a legend that is written again meanwhile has lost its old elements.
        page.evaluate(() =>
            [...document.querySelectorAll(".needle, .shape")].map(
                (each) => getComputedStyle(each).backgroundColor,
            ),
        );
    const seen = await marks();
    assert.ok(seen.length >= 2, where);
    await page.emulateMedia({forcedColors: "active"});
    assert.deepEqual(await marks(), seen, where);
    assert.notEqual(
        ...(await page.$$eval("#keep, #play", (two) =>
            two.map((each) => getComputedStyle(each).backgroundColor),
        )),
        where,
    );
    await page.emulateMedia({forcedColors: "none", media: "print"});
    for (const print of await page.$$eval(".needle, .shape, [type=range]", (all) =>
        all.map((each) => getComputedStyle(each).printColorAdjust),
    ))
        assert.equal(print, "exact", where);
    await page.close();
}
await browser.close();
