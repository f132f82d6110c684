// Writes the images of docs/how-to/browser_page.md: node screenshots.mjs PAGES CHROMIUM FOLDER
// [NAME…], where the folder PAGES holds both pages. Each shows a page in one state, "preview" for link previews; the exact number of
// periods depends on the machine. ffmpeg reduces their colours.
import {execFileSync} from "node:child_process";
import {mkdtempSync, rmSync, statSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {launch} from "./browser.mjs";

const [pages, executablePath, folder, ...wanted] = process.argv.slice(2);
const addressOf = (name) => pathToFileURL(join(pages, name)).href;
const mostBytes = 120_000;

const hasPeriods = (page, periods) =>
    page.waitForFunction(
        (wanted) => Number(document.getElementById("period-count")?.textContent) > wanted,
        periods,
    );
const choose = (page, id, value) =>
    page.evaluate(
        ([name, wanted]) => {
            const select = document.getElementById(name);
            select.value = wanted;
            select.dispatchEvent(new Event("change"));
        },
        [id, value],
    );
const click = (page, id) => page.evaluate((name) => document.getElementById(name).click(), id);

/** Name, query, what happens, and options of the page; the name "dish" is that of the first page. */
const states = [
    [
        "dish",
        "",
        async (page) => {
            for (const number of [8, 20, 28, 33, 36, 41, 44, 52, 48]) {
                const {x, y, width, height} = await page.locator("#row").boundingBox();
                await page.mouse.click(x + 18 + ((number - 3) * (width - 36)) / 52, y + height / 2);
                await page.waitForFunction(
                    (wanted) =>
                        new RegExp(`^${wanted} discs (turn|hardly)`).test(
                            document.getElementById("sentence").textContent,
                        ),
                    number,
                );
            }
            await page.waitForTimeout(9000); // until the arc shows the direction
        },
        {viewport: {width: 1000, height: 660}},
    ],
    ["start", "", (page) => hasPeriods(page, 68)],
    ["preview", "", (page) => hasPeriods(page, 60), {viewport: {width: 1200, height: 630}}],
    ["few", "?discs=8", (page) => hasPeriods(page, 36), {colorScheme: "dark"}],
    ["time_lapse", "?seed=1", (page) => hasPeriods(page, 40)],
    [
        "cause",
        "",
        async (page) => {
            await hasPeriods(page, 68);
            await page.evaluate(() => {
                document.getElementById("cause").open = true;
                document.getElementById("show-contacts").click();
            });
            await page.waitForTimeout(1500);
            await hasPeriods(page, 72);
        },
    ],
    [
        "strobe",
        "?seed=1",
        async (page) => {
            await hasPeriods(page, 33);
            await choose(page, "choose-view", "both");
            await click(page, "strobe");
            await hasPeriods(page, 36);
        },
    ],
    [
        "density",
        "?seed=1",
        async (page) => {
            await choose(page, "choose-view", "density");
            await hasPeriods(page, 100);
        },
    ],
    [
        "flow",
        "?discs=28",
        async (page) => {
            await choose(page, "choose-view", "flow");
            await hasPeriods(page, 100);
        },
        {colorScheme: "dark"},
    ],
    ["spheres", "?preset=experiment&discs=36", (page) => hasPeriods(page, 36)],
    [
        "change",
        "?discs=30",
        async (page) => {
            await hasPeriods(page, 36);
            await page.fill("#parameter-discs", "44");
            await page.waitForSelector('canvas[aria-label^="44 discs"]');
            await hasPeriods(page, 33);
            await page.evaluate(() =>
                document.getElementById("curve").scrollIntoView({block: "end"}),
            );
        },
    ],
    [
        "parameters",
        "?seed=1",
        async (page) => {
            await hasPeriods(page, 33);
            await page.keyboard.press("m");
            await page.evaluate(() =>
                document.getElementById("more").scrollIntoView({block: "center"}),
            );
        },
    ],
    [
        "phone",
        "",
        (page) => hasPeriods(page, 68),
        {viewport: {width: 390, height: 844}, hasTouch: true},
    ],
];

const browser = await launch(executablePath);
const temporary = mkdtempSync(join(tmpdir(), "swirl-screenshots-"));
try {
    for (const [name, query, act, options] of states.filter(
        ([each]) => wanted.length === 0 || wanted.includes(each),
    )) {
        const page = await browser.newPage({
            viewport: {width: 1280, height: 800},
            locale: "en-GB",
            ...options,
        });
        await page.goto(addressOf(name === "dish" ? "index.html" : "laboratory.html") + query);
        await act(page);
        await page.evaluate(() => document.activeElement.blur());
        const raw = join(temporary, `${name}.png`),
            image = join(folder, `lab_${name}.png`);
        await page.screenshot({path: raw});
        await page.close();
        // Fewer colours, until the image is small enough.
        const size = [256, 64, 32, 16].reduce((bytes, colors) => {
            if (bytes <= mostBytes) return bytes;
            execFileSync("ffmpeg", [
                "-loglevel",
                "error",
                "-y",
                "-i",
                raw,
                "-vf",
                "split[a][b];[a]palettegen=max_colors=" +
                    `${colors}:reserve_transparent=0[p];[b][p]paletteuse=dither=none`,
                image,
            ]);
            return statSync(image).size;
        }, Infinity);
        console.log(`${image}: ${size} bytes`);
        if (size > mostBytes) throw new Error(`${image} is larger than ${mostBytes} bytes`);
    }
} finally {
    rmSync(temporary, {recursive: true});
    await browser.close();
}
