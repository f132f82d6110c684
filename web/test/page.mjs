// Tests the page in a real browser: node page.mjs FILE.html CHROMIUM HASH IMAGE.svg FOLDER [--all].
// IMAGE is from `swirl image --no-annotations` of the state with this HASH; downloads are stored in
// FOLDER. Without --all it omits what takes long (`all` below). Exits with 1 and a message if a
// test fails.
import assert from "node:assert/strict";
import {readFileSync, writeFileSync} from "node:fs";
import {createServer} from "node:http";
import {pathToFileURL} from "node:url";
import {launch, violationsOf} from "./browser.mjs";
import {inEachFont} from "./fonts.mjs";

const [file, executablePath, wantedHash, image, folder] = process.argv.slice(2);
const all = process.argv.includes("--all");
/** All cases with --all, else the first ones. */
const some = (cases, count) => (all ? cases : cases.slice(0, count));
const address = pathToFileURL(file).href;
const browser = await launch(executablePath);
const errors = [],
    requests = [];
/** A page whose errors fail the test. It draws about fifteen frames per second: more would take
 *  half of a processor. */
const newPage = async (options) => {
    const made = await browser.newPage({viewport: {width: 1200, height: 800}, ...options});
    made.on("pageerror", (error) => errors.push(error.message));
    await made.addInitScript(() => {
        const frame = globalThis.requestAnimationFrame;
        globalThis.requestAnimationFrame = (draw) => setTimeout(() => frame(draw), 50);
    });
    return made;
};
const page = await newPage();
page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) requests.push(request.url());
});
// Records the full circles that the page draws, in pixels of the canvas.
await page.addInitScript(() => {
    globalThis.drawnCircles = [];
    const arc = CanvasRenderingContext2D.prototype.arc;
    CanvasRenderingContext2D.prototype.arc = function (x, y, r, ...angles) {
        const {a, d, e, f} = this.getTransform();
        if (angles[1] - angles[0] > 6.28)
            globalThis.drawnCircles.push([a * x + e, d * y + f, a * r]);
        return arc.call(this, x, y, r, ...angles);
    };
});
const requireAccessible = async (where) => assert.deepEqual(await violationsOf(page), [], where);
const text = (id) => page.textContent(`#${id}`);
/** The name and the bytes of a button's download. */
const downloaded = async (button) => {
    const [download] = await Promise.all([page.waitForEvent("download"), press(button.slice(1))]);
    const chunks = await (await download.createReadStream()).toArray();
    return [download.suggestedFilename(), Buffer.concat(chunks)];
};
/** Clicks an element, also in a closed menu. */
const press = (id) => page.evaluate((each) => document.getElementById(each).click(), id);
const openParameters = () =>
    page.evaluate(() => {
        document.querySelector("#parameters").open = true;
    });
/** Opens the panel with the choices of view and colour. */
const openViewing = (of = page) =>
    of.evaluate(() => {
        document.querySelector("#viewing details").open = true;
    });
const open = async (query) => {
    await page.goto(address + query);
    await page.waitForFunction(
        () =>
            document.getElementById("state-hash").textContent !== "" ||
            !document.getElementById("error").hidden,
    );
};

// The address sets the parameters, and the page runs to exactly that event.
await open("?discs=28&mu=0.5&seed=3&events=20000");
assert.equal(await text("state-hash"), wantedHash);
assert.equal(await text("event-count"), "20000");
// The command has the page's warm-up as soon as there are averages.
assert.equal(
    await text("command"),
    "./swirl run --discs 28 --mu 0.5 --warmup 20 --seed 3 --events 20000",
);

// The page draws each disc where `swirl image` draws it, to half a pixel. Positions are in disc
// radii from the centre of the container, which is the widest circle.
const circlesOf = (list, radiusOf) => {
    const [cx, cy, widest] = list.reduce((a, b) => (b[2] > a[2] ? b : a));
    const small = list.filter(([, , r]) => r > 0.08 * widest && r < 0.2 * widest);
    const radius = radiusOf(
        widest,
        small.map(([, , r]) => r),
    );
    return {
        radius,
        discs: small
            .filter(([, , r]) => Math.abs(r - radius) < 0.1)
            .map(([x, y]) => [(x - cx) / radius, (y - cy) / radius]),
    };
};
// The widest full circle of the page is the wall.
const ofPage = circlesOf(
    await page.evaluate(() => {
        // of the last frame
        const circles = globalThis.drawnCircles;
        return circles.slice(
            circles.findLastIndex(([, , r]) => r === Math.max(...circles.map((c) => c[2]))),
        );
    }),
    (_, radii) => radii.sort((a, b) => a - b)[Math.floor(radii.length / 2)],
); // most are discs
const ofImage = circlesOf(
    [...readFileSync(image, "utf-8").matchAll(/ d="M ([^"]*)"/g)]
        .map(([, path]) =>
            path
                .split(/[^-\d.]+/)
                .filter(Boolean)
                .map(Number),
        )
        .filter((numbers) => numbers.length >= 26) // circles consist of four curves
        .map((numbers) => {
            const xs = numbers.filter((_, k) => k % 2 === 0),
                ys = numbers.filter((_, k) => k % 2 === 1);
            return [
                0.5 * (Math.min(...xs) + Math.max(...xs)),
                0.5 * (Math.min(...ys) + Math.max(...ys)),
                0.5 * (Math.max(...xs) - Math.min(...xs)),
            ];
        }),
    (_, discs) => Math.max(...discs),
);
assert.equal(new Set(ofPage.discs.map(String)).size, 28);
for (const [x, y] of ofPage.discs) {
    const nearest = Math.min(...ofImage.discs.map(([u, v]) => Math.hypot(u - x, v - y)));
    assert.ok(
        nearest * ofPage.radius < 0.5,
        `a disc is drawn ${nearest * ofPage.radius} pixels off`,
    );
}

// A paused page asks for no animation frames: none in the time in which the browser makes twenty.
const asked = () =>
    page.evaluate(async () => {
        const ask = globalThis.requestAnimationFrame;
        let count = 0;
        globalThis.requestAnimationFrame = (draw) => {
            ++count;
            return ask(draw);
        };
        for (let k = 0; k < 20; ++k) await new Promise((drawn) => ask(drawn));
        globalThis.requestAnimationFrame = ask;
        return count;
    });
assert.equal(await asked(), 0);

assert.equal(await page.isHidden("#error"), true);
await requireAccessible("a container");
await page.emulateMedia({colorScheme: "dark"});
await requireAccessible("the dark theme");
await page.emulateMedia({colorScheme: "light"});
assert.equal(await text("caution"), "");

for (const [query, options] of some(
    [
        ["?discs=48&events=2000", "--discs 48"], // ends within the warm-up
        ["?discs=5&warmup=2&events=3000", "--discs 5 --warmup 2"],
    ],
    1,
)) {
    await open(query);
    assert.equal(
        await text("command"),
        `./swirl run ${options} --events ${query.split("events=")[1]}`,
    );
}

// The simulation runs.
await open("?discs=48");
const before = Number(await text("event-count"));
await page.waitForFunction(
    (n) => Number(document.getElementById("event-count").textContent) > n,
    before + 1000,
);
const painted = await page.evaluate(() => {
    const canvas = document.querySelector("canvas");
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return new Set(Array.from({length: data.length / 400}, (_, k) => data[400 * k])).size;
});
assert.ok(painted > 5, `the canvas shows ${painted} shades`);

// Each numeric parameter has a slider, whose value is shown in the text field.
const withoutSlider = await page.$$eval("#parameters .control", (all) =>
    all
        .filter((row) => !row.querySelector("input[type=range]"))
        .map((row) => row.querySelector("input[type=text], select").id.replace("parameter-", "")),
);
assert.deepEqual(withoutSlider, [
    "preset",
    "body",
    "mixture",
    "sizes",
    "floor",
    "path",
    "direction",
]);
await openParameters();
const ofMuWall = page.locator("#slider-mu_wall");
assert.deepEqual(
    [await ofMuWall.getAttribute("max"), await ofMuWall.getAttribute("step")],
    ["2", "0.05"],
);
await ofMuWall.fill("0.35");
assert.equal(await page.inputValue("#parameter-mu_wall"), "0.35");
await page.fill("#parameter-mu_wall", "");

// Sliders and fields change the parameters; a restart starts a new simulation with them.
await page.fill("#parameter-discs", "5");
await page.waitForSelector('canvas[aria-label^="5 discs"]');
assert.match(await text("command"), /^none/);
await page.click("#restart");
await page.waitForFunction(() =>
    document.getElementById("command").textContent.includes("--discs 5 "),
);
await page.click(".example:nth-of-type(3)"); // the gallery
await page.waitForFunction(() =>
    document.getElementById("command").textContent.includes("--mu-wall 0"),
);
assert.equal(await page.getAttribute(".example:nth-of-type(3)", "aria-pressed"), "true");
await page.fill("#parameter-mu", "0.1"); // replaces both coefficients
await page.waitForFunction(
    () => document.getElementById("parameter-mu_wall").placeholder === "0.1",
);
await page.click("#restart");
await page.waitForFunction(() =>
    /--mu 0.1( |$)/.test(document.getElementById("command").textContent),
);
await openViewing();
await page.selectOption("#choose-view", "both");
assert.equal(await page.locator("#views canvas:visible").count(), 2);
await page.selectOption("#choose-view", "lab");

// Words are in a list of choices. The values of a preset are shown as placeholders.
await page.selectOption("#parameter-preset", "experiment");
await page.waitForSelector('canvas[aria-label^="48 spheres"]');
await page.waitForFunction(() => document.getElementById("parameter-body").value === "sphere");
assert.equal(await page.inputValue("#parameter-restitution"), "");
assert.equal(await page.getAttribute("#parameter-restitution", "placeholder"), "0.9");
await page.selectOption("#parameter-body", "disc");
await page.waitForSelector('canvas[aria-label^="48 discs"]');
await page.selectOption("#parameter-preset", "");
await page.selectOption("#parameter-body", "sphere");
await page.waitForSelector('canvas[aria-label^="48 spheres"]');

// Invalid values show an error message, which disappears after a correction.
await page.fill("#parameter-discs", "1000");
await page.waitForFunction(() => !document.getElementById("error").hidden);
assert.match(await text("error"), /^1000 spheres do not fit.*\nhint: /);
assert.equal(await page.$eval("#error", (shown) => getComputedStyle(shown).whiteSpace), "pre-line");
assert.deepEqual([await text("command"), await page.isDisabled("#copy")], ["", true]);
await page.fill("#parameter-discs", "12");
await page.waitForFunction(
    () =>
        document.getElementById("error").hidden &&
        document.getElementById("command").textContent.includes("--discs 12 "),
);
assert.equal(await page.getAttribute("#play", "aria-label"), "Pause (space)"); // and time continues
// The copied command is the one on display.
const [copied, shown] = await page.evaluate(() => {
    let copied;
    Object.defineProperty(navigator, "clipboard", {
        value: {
            writeText: async (text) => {
                copied = text;
            },
        },
    });
    document.getElementById("copy").click();
    return [copied, document.getElementById("command").textContent];
});
assert.equal(copied, shown);
// Values with line breaks or invisible characters are errors: the command would not be what it
// seems (more in panels.mjs).
await open("?discs=5%0Atouch%20x%20%23");
assert.match(await text("error"), /control character U\+000A,/);
assert.deepEqual(
    [await text("command"), await page.isDisabled("#copy"), await text("event-count")],
    ["", true, ""],
);
// Names that the page does not know, such as those that other sites add to a link, are ignored and
// forgotten.
await open("?discs=12&fbclid=IwAR0x&utm_source=a%26b&gclid=&seed=2");
await page.waitForSelector('canvas[aria-label^="12 discs"]');
assert.equal(await page.isHidden("#error"), true);
await page.fill("#parameter-discs", "13");
await page.waitForFunction(() => location.search === "?discs=13&seed=2");
for (const [query, said] of some(
    [
        ["?lesson=7", /lesson=7, but the lesson has the steps 1 to 6/],
        ["?mu=1e999", /Friction is '1e999'/],
        ["?discs=8#points=8_0.3_0.02_200,48_x,9", /2 points that are damaged/],
        ["?discs=8&events=", /events=/],
        ["?lesson=x", /lesson=x/],
        ["?discs=8&radius=-1", /Disc radius is -1/],
        ["?discs=8#points=", /1 point that is damaged/],
        ["?discs=8&events=x", /events=x/],
        ["?discs=5&events=-1", /events=-1/],
    ],
    4,
)) {
    await page.goto("about:blank"); // another fragment alone would not load the page
    await open(query);
    await page.waitForFunction(
        (wanted) => new RegExp(wanted).test(document.getElementById("error").textContent),
        said.source,
    );
    assert.doesNotMatch(await text("error"), /--/, query);
}

// A new visitor gets a new seed, which the address then has; a link keeps its own, and one without
// a seed has the default.
const seedOf = async (query) => {
    await open(query);
    return page.evaluate(
        () => /--seed (\d+)/.exec(document.getElementById("command").textContent)?.[1],
    );
};
const seeds = [];
for (const query of ["", ...some(["?lang=en&fbclid=1", "?lang=en", "?fbclid=1"], 1), ""])
    seeds.push(await seedOf(query));
assert.ok(seeds.every((seed) => /^\d{4}$/.test(seed)) && new Set(seeds).size > 1, `${seeds}`);
await page.click(".example:nth-of-type(1)"); // an example keeps it
await page.waitForFunction((seed) => location.search === `?seed=${seed}&discs=8`, seeds.at(-1));
assert.equal(await page.getAttribute(".example:nth-of-type(1)", "aria-pressed"), "true");

// A new visitor sees few and many discs at once, which turn in opposite directions; a link has what
// it shows.
await open("");
await page.waitForFunction(
    () =>
        document.getElementById("headline").textContent ===
        "The same swirl: 8 discs turn with it, 48 against it.",
);
assert.equal(await page.locator("#views canvas:visible").count(), 2);
await page.waitForFunction(() => /^\?seed=\d{4}&beside=8$/.test(location.search));
await page.locator("#discovery-plot [role=img][aria-label*='with 2 points']").waitFor(); // the points of both
await requireAccessible("two containers");
// Before most of the file has arrived, there is a picture of both at the same places, in every
// font. The worker of the second is late here, but skips the warm-up, too.
const bytesOfPage = readFileSync(file),
    picturedBy = bytesOfPage.indexOf('<div id="transport">');
assert.ok(
    picturedBy < 0.1 * bytesOfPage.length,
    `the first picture ends after ${picturedBy} bytes`,
);
let finish;
const slow = createServer((_, response) => {
    response
        .writeHead(200, {"content-type": "text/html; charset=utf-8"})
        .write(bytesOfPage.subarray(0, picturedBy));
    finish = () => response.end(bytesOfPage.subarray(picturedBy));
});
await new Promise((resolve) => slow.listen(0, "127.0.0.1", resolve));
const early = await newPage({viewport: {width: 360, height: 640}});
await early.addInitScript(() => {
    const {postMessage} = Worker.prototype;
    globalThis.sent = new Map();
    Worker.prototype.postMessage = function (message, ...more) {
        const kinds = globalThis.sent.get(this) ?? [];
        globalThis.sent.set(this, [...kinds, message.kind]);
        setTimeout(
            () => postMessage.call(this, message, ...more),
            message.kind === "engine" && globalThis.sent.size > 1 ? 1500 : 0,
        );
    };
});
const placesOf = (selector) =>
    inEachFont(early, () =>
        early.$$eval(selector, (all) =>
            all.map((each) =>
                ["x", "y", "width", "height"].map((side) =>
                    Math.round(each.getBoundingClientRect()[side]),
                ),
            ),
        ),
    );
for (const [lang, headline] of [
    ["de", "im Umlaufsinn.*gegensinnig"],
    ["en", "with it.*against it"],
]) {
    await early.goto(`http://127.0.0.1:${slow.address().port}/?lang=${lang}`, {
        waitUntil: "commit",
    });
    await early.waitForSelector("#first svg:last-of-type");
    const pictured = await placesOf("#first svg");
    assert.deepEqual(
        await early.$$eval("#first svg", (all) =>
            all.map((each) => each.querySelectorAll("g path").length > 3),
        ),
        [true, true],
    );
    finish();
    await early.waitForFunction(
        (said) =>
            !document.getElementById("first") &&
            new RegExp(said).test(document.getElementById("headline").textContent),
        headline,
    );
    assert.deepEqual(await placesOf("#views canvas"), pictured, lang);
    for (const [where, [[, , width]]] of Object.entries(pictured))
        assert.ok(width >= 150, `${where}: a dish is ${width} wide`);
}
const orders = await early.evaluate(() =>
    [...globalThis.sent.values()].map((kinds) =>
        kinds
            .filter((kind) => /begin|skip/.test(kind))
            .slice(0, 2)
            .join(" "),
    ),
);
assert.deepEqual(orders.slice(0, 2), ["begin skip", "begin skip"]);
await early.goto(`${address}?discs=9`);
assert.equal(await early.$("#first"), null); // a link shows something else
await early.close();
slow.closeAllConnections();
slow.close();
// A hand stirs both: the same circles turn them in opposite directions.
await press("by-hand");
const many = await page.locator("#views figure:not(#compared) canvas").boundingBox();
for (let k = 0; k < 40; ++k) {
    await page.mouse.move(
        many.x + many.width * (0.5 + 0.1 * Math.cos(k / 3)),
        many.y + many.height * (0.5 + 0.1 * Math.sin(k / 3)),
    );
    await page.waitForTimeout(20);
}
await page.waitForFunction(() =>
    /^8 discs: \S+\d turns×48 discs: \S+\d turns$/.test(
        document.getElementById("views").textContent,
    ),
);
await press("by-hand");
await press("close-compared");
assert.equal(await page.locator("#views canvas:visible").count(), 1);
await page.waitForFunction(() => /^\?seed=\d{4}$/.test(location.search));
await open("?mu=0.5&beside=5&view=both&color=spin&strobe=1");
assert.equal(await page.locator("#views canvas:visible").count(), 3);
assert.deepEqual(
    await page.$eval("#options", (bar) => [
        bar.querySelector("#choose-view").value,
        bar.querySelector("#choose-coloring").value,
        bar.querySelector("#strobe").ariaPressed,
    ]),
    ["both", "spin", "true"],
);
for (const wrong of some(["-3", "", "x", "0", "1e9"], 1)) {
    await open(`?discs=9&beside=${wrong}`);
    await page.waitForFunction(() =>
        /beside=.* from 1 to 300/.test(document.getElementById("error").textContent),
    );
    await page.waitForSelector('canvas[aria-label^="9 discs"]'); // the simulation runs
}
for (const wrong of some(["view=toString", "strobe=yes", "view=top", "color=", "strobe=2"], 1)) {
    await open(`?discs=9&${wrong}`);
    await page.waitForFunction(
        (given) =>
            document
                .getElementById("error")
                .textContent.startsWith(`The address contains ${given}, but it must be`),
        wrong,
    );
    await page.waitForSelector('canvas[aria-label^="9 discs"]');
    await page.waitForFunction(() => location.search === "?discs=9");
}

for (const [query, seed] of some(
    [
        ["?seed=5", "5"],
        ["?discs=9&events=0", undefined],
        ["?discs=9", undefined],
    ],
    2,
))
    assert.equal(await seedOf(query), seed, query);

// Each slider shows its value in effect, given or not, or no value if this is a word or two
// coefficients.
for (const query of some(
    [
        "?mu_disc=0.25&mu_wall=0",
        "?preset=experiment&discs=24&inertia=solid",
        "?discs=12",
        "?preset=experiment",
    ],
    2,
)) {
    await open(query);
    const wrong = await page.$$eval("input[type=range][id^=slider-]", (all) =>
        all.flatMap((slider) => {
            const text = slider.closest(".control").querySelector("input[type=text]"),
                value = text.value || text.placeholder;
            const [low, high, step] = [slider.min, slider.max, slider.step].map(Number),
                number = value === "" ? NaN : Number(value);
            const isUnset = slider.classList.contains("unset");
            const near =
                Math.abs(Number(slider.value) - Math.min(high, Math.max(low, number))) <=
                0.5001 * step;
            return Number.isFinite(number) === !isUnset && (isUnset || near)
                ? []
                : [`${slider.id}: ${slider.value} for ${value}`];
        }),
    );
    assert.deepEqual(wrong, [], query);
}
await open("?mu_disc=1&mu_wall=0");
assert.equal(await page.getAttribute("#parameter-mu", "placeholder"), "1:0");
await open("?discs=30000&radius=0.01");
assert.match(await text("error"), /^30000 discs are too many for the page, .*\nhint: [^-]*\.$/);

// A container that is much smaller than its path is drawn with its wall, its path, S, C, and its
// discs.
await open("?discs=5&amplitude=1e6&events=100");
assert.ok(
    (await page.evaluate(() => {
        globalThis.drawnCircles = [];
        dispatchEvent(new Event("resize"));
        return globalThis.drawnCircles.length;
    })) >= 9,
);
assert.deepEqual(errors, []);

// A collapse is an error, both on the way to an event and while the page runs.
for (const events of ["&events=300000", ""]) {
    await page.goto(`${address}?discs=48&restitution=0.5&contact_duration=0${events}`);
    await page.waitForFunction(() => !document.getElementById("error").hidden);
    assert.match(await text("error"), /\(inelastic collapse\)/);
    if (events) assert.equal(await text("state-hash"), "");
}

// Long computations show their progress.
if (all) {
    await page.goto(`${address}?discs=48&events=1000000`);
    await page.waitForFunction(() =>
        /^\d+ of 1000000 events done\.$/.test(document.getElementById("headline").textContent),
    );
    await page.waitForFunction(
        () => document.getElementById("event-count").textContent === "1000000",
    );
    await page.evaluate(() => {
        globalThis.headlines = [];
        const headline = document.getElementById("headline");
        new MutationObserver(() => globalThis.headlines.push(headline.textContent)).observe(
            headline,
            {childList: true},
        );
    });
    await page.evaluate(() => {
        document.getElementById("keep").click();
    });
    await openParameters();
    await page.fill("#parameter-inertia", "solid");
    await page.fill("#parameter-radius", "0.14");
    await page.fill("#parameter-discs", "2000");
    await page.waitForSelector('canvas[aria-label^="2000 discs"]');
    assert.ok((await page.evaluate(() => globalThis.headlines)).includes("Placing 2000 discs…"));
}

// Too many discs are rejected soon, also while another number is being placed; a correction is not.
await open("?discs=48");
await page.fill("#parameter-discs", "60");
await page.waitForFunction(() =>
    /^60 discs do not fit .* 59\.\nhint: /.test(document.getElementById("error").textContent),
);
assert.equal(
    await page.$eval("#error", (shown) => shown.closest(".control").querySelector("input").id),
    "parameter-discs",
);
await page.fill("#parameter-discs", "8");
await page.waitForSelector('canvas[aria-label^="8 discs"]');
await openParameters();
await page.fill("#parameter-radius", "0.5");
await page.fill("#parameter-discs", "250"); // no arrangement is known to the page
await page.waitForFunction(() =>
    /^250 discs would cover 85 % .*\nhint: /s.test(document.getElementById("error").textContent),
);
await page.fill("#parameter-discs", "251");
await page.waitForFunction(
    () => document.getElementById("headline").textContent === "Placing 251 discs…",
);
await page.fill("#parameter-discs", "20");
await page.waitForSelector('canvas[aria-label^="20 discs"]');
await page.waitForTimeout(1500);
assert.equal(await page.isHidden("#error"), true);

// A change keeps the discs, and there is no command that reproduces the state. Discs are added and
// removed.
await open("?discs=8");
await page.fill("#parameter-mu", "0.2");
await page.waitForFunction(() => document.getElementById("command").textContent.startsWith("none"));
await page.fill("#parameter-discs", "40");
await page.waitForSelector('canvas[aria-label^="40 discs"]');
assert.match(await text("command"), /^none/);
await page.fill("#parameter-discs", "9");
await page.waitForSelector('canvas[aria-label^="9 discs"]');
await openParameters();
await page.fill("#parameter-radius", "0.9"); // needs a new simulation
await page.waitForFunction(() =>
    document.getElementById("command").textContent.includes("--discs 9 --mu 0.2 --radius 0.9 "),
);
await page.fill("#parameter-radius", "");
await press("keep");
await page.click("#play"); // a new simulation does not wait for the end of the period
await page.fill("#parameter-discs", "7");
await page.waitForSelector('canvas[aria-label^="7 discs"]');
await page.fill("#parameter-discs", "900"); // nor does an error message
await page.waitForFunction(() => /do not fit/.test(document.getElementById("error").textContent));
await page.fill("#parameter-discs", "9");
await page.waitForSelector('canvas[aria-label^="9 discs"]');
assert.equal(await page.isHidden("#error"), true);
await page.click("#play");
await press("keep");

// Maps, the stroboscope, moving by hand and dragging, and a second container.
if (all) {
    // Averages are drawn behind the discs: the map covers most of the container with its shades.
    await openViewing();
    for (const kind of ["density", "flow", "spin"]) {
        await page.selectOption("#choose-view", kind);
        await page.waitForFunction(() => {
            const canvas = document.querySelector("#views canvas");
            const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
            return (
                new Set(Array.from({length: data.length / 40}, (_, k) => data[40 * k])).size > 40
            );
        });
    }
    await page.selectOption("#choose-view", "lab");
    await page.click("#profile-panel summary");
    await page.waitForSelector("#profile canvas");
    await page.click("#profile-panel summary");

    // The stroboscope shows one image per period: between two of them the container does not move.
    await open("?discs=12");
    await press("strobe");
    const images = await page.evaluate(
        () =>
            new Promise((resolve) => {
                const canvas = document.querySelector("#views canvas"),
                    seen = new Set(),
                    begun = performance.now();
                const look = () => {
                    // The centre of the container, from the last full circle of its wall.
                    const wall = globalThis.drawnCircles
                        .filter(([, , r]) => r > 0.3 * canvas.width)
                        .at(-1);
                    globalThis.drawnCircles = wall ? [wall] : [];
                    if (wall) seen.add(`${wall[0].toFixed(1)} ${wall[1].toFixed(1)}`);
                    if (performance.now() - begun < 3000) requestAnimationFrame(look);
                    else resolve([...seen]);
                };
                setTimeout(look, 1000);
            }),
    );
    assert.equal(images.length, 1, images.join("; "));
    await press("strobe");

    // By hand: the container follows the pointer until the mode is switched off.
    await open("?discs=9");
    await press("by-hand");
    const dish = await page.locator("#views canvas").boundingBox();
    for (let k = 0; k < 40; ++k) {
        await page.mouse.move(
            dish.x + dish.width * (0.5 + 0.1 * Math.cos(k / 3)),
            dish.y + dish.height * (0.5 + 0.1 * Math.sin(k / 3)),
        );
        await page.waitForTimeout(20);
    }
    assert.match(await text("headline"), /^Move the container/);
    await press("by-hand");
    await page.waitForFunction(() =>
        /^9 discs/.test(document.getElementById("headline").textContent),
    );

    // Without friction energy is not conserved on the polygon; a floor dissipates it.
    await open("?discs=8&mu=0");
    assert.match(
        await text("caution"),
        /^Without friction the energy grows without bound on the polygon\. /,
    );
    await open("?discs=8&mu=0&body=sphere&floor=sliding");
    assert.equal(await text("caution"), "");

    // A dragged disc follows the pointer.
    await open("?discs=1&events=20");
    const table1 = await page.locator("#views canvas").boundingBox();
    const centroid = (of = page) =>
        of.evaluate(() => {
            // of the pixels in the disc's colour
            const canvas = document.querySelector("#views canvas");
            const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
            let n = 0,
                x = 0,
                y = 0;
            for (let k = 0; k < data.length / 4; ++k) {
                if (data[4 * k] !== 86 || data[4 * k + 1] !== 180 || data[4 * k + 2] !== 233)
                    continue;
                n += 1;
                x += k % canvas.width;
                y += Math.floor(k / canvas.width);
            }
            return [(x / n + 0.5) / canvas.width, (y / n + 0.5) / canvas.height];
        });
    await openViewing();
    await page.selectOption("#choose-coloring", "id");
    const held = await centroid();
    await page.mouse.move(table1.x + held[0] * table1.width, table1.y + held[1] * table1.height);
    await page.mouse.down();
    await page.mouse.move(table1.x + 0.5 * table1.width, table1.y + 0.45 * table1.height, {
        steps: 10,
    });
    await page.waitForTimeout(300);
    await page.mouse.move(table1.x + 0.5 * table1.width, table1.y + 0.45 * table1.height);
    await page.waitForTimeout(300);
    const put = await centroid();
    await page.mouse.up();
    // The orientation mark and the rim have another colour, so the tolerance is 0.01 of the image.
    assert.ok(Math.hypot(put[0] - 0.5, put[1] - 0.45) < 0.01, `dragged to ${put}`);

    // Keys do the same: select, move, deselect. Time is paused while a disc is selected.
    const lab = page.locator("#views canvas").first();
    await lab.focus();
    await page.keyboard.press("]");
    assert.match(await text("headline"), /^Disc 1 is selected/);
    const lifted = await centroid();
    for (let k = 0; k < 4; ++k) {
        await page.keyboard.press("ArrowLeft");
        await page.waitForTimeout(150);
    }
    const pushed = await centroid();
    // Four quarters of its radius, in units of the image width, which is R + A with a border of 20
    // pixels.
    const radius = (0.5 - 20 / table1.width) / (8.6 + 1.892);
    assert.ok(
        Math.hypot(lifted[0] - pushed[0] - radius, pushed[1] - lifted[1]) < 0.1 * radius,
        `moved from ${lifted} to ${pushed}`,
    );
    await page.keyboard.press("Escape");
    await page.selectOption("#choose-coloring", "spin");

    // A touch drags a disc vertically. Elsewhere the same touch scrolls the page.
    const phone = await newPage({
        viewport: {width: 360, height: 740},
        hasTouch: true,
        reducedMotion: "reduce",
    });
    await phone.goto(`${address}?discs=1&events=20`);
    await phone.waitForFunction(() => document.getElementById("state-hash").textContent !== "");
    await openViewing(phone);
    await phone.selectOption("#choose-coloring", "id");
    await phone.locator("#views canvas").scrollIntoViewIfNeeded();
    const small = await phone.locator("#views canvas").boundingBox();
    const touched = await centroid(phone);
    const fingers = await phone.context().newCDPSession(phone);
    const touch = (type, y) =>
        fingers.send("Input.dispatchTouchEvent", {
            type,
            touchPoints:
                y === undefined
                    ? []
                    : [{x: small.x + touched[0] * small.width, y: small.y + y * small.height}],
        });
    const way = touched[1] > 0.5 ? -0.2 : 0.2;
    await touch("touchStart", touched[1]);
    for (let k = 1; k <= 20; ++k) {
        await touch("touchMove", touched[1] + (way * k) / 20);
        await phone.waitForTimeout(30);
    }
    const led = await centroid(phone);
    await touch("touchEnd");
    assert.ok(
        Math.hypot(led[0] - touched[0], led[1] - touched[1] - way) < 0.02,
        `the touch moved it to ${led}`,
    );

    // If reduced motion is enabled in the system, the page is paused, after the warm-up and some
    // periods.
    await phone.goto(`${address}?discs=8`);
    await phone.waitForFunction(
        () => Number(document.getElementById("period-count")?.textContent) >= 30,
    );
    assert.equal(await phone.getAttribute("#play", "aria-label"), "Play (space)");
    await phone.close();

    // A compared container keeps its parameters.
    await open("?discs=12");
    await press("compare");
    await page.fill("#parameter-discs", "20");
    await page.waitForFunction(() =>
        /^12 discs: ϖ/.test(document.querySelector("#compared figcaption")?.textContent ?? ""),
    );
    await page.waitForSelector('canvas[aria-label^="20 discs"]');
    await requireAccessible("two containers");
    await page.click("#close-compared");
    assert.equal(await page.locator("#compared").count(), 0);
}

// Every action has a key, and the list of keys is a dialog. Keys do nothing while it is open, or if
// they are off.
await open("?discs=12");
const isPressed = (id) => page.getAttribute(`#${id}`, "aria-pressed");
await page.keyboard.press("s");
assert.equal(await isPressed("strobe"), "true");
await page.keyboard.press("s");
await page.keyboard.press("+");
await page.waitForSelector('canvas[aria-label^="13 discs"]');
await page.keyboard.press("v");
assert.equal(await page.inputValue("#choose-view"), "m");
await page.keyboard.press("c");
assert.equal(await page.inputValue("#choose-coloring"), "spin");
for (const [key, details] of [
    ["o", "#viewing"],
    ["m", "#more"],
    ["e", "#explorer"],
    ["d", "#share"],
]) {
    await page.keyboard.press(key);
    assert.equal(await page.$eval(`${details} details`, (each) => each.open), true, key);
    await page.keyboard.press(key);
}
await page.keyboard.press("?");
assert.equal(await page.isVisible("#keys"), true);
await requireAccessible("the list of keys");
await page.keyboard.press("s");
assert.equal(await isPressed("strobe"), "false");
await page.uncheck("#keys-on");
await page.keyboard.press("Escape");
await page.keyboard.press("s");
assert.equal(await isPressed("strobe"), "false");
await page.evaluate(() => document.getElementById("keys-on").click());
await page.evaluate(() => document.activeElement.blur()); // on a button the space bar presses it
await page.keyboard.press(" ");
assert.equal(await page.getAttribute("#play", "aria-label"), "Play (space)");
await page.keyboard.press("r");
await page.waitForFunction(() =>
    document.getElementById("command").textContent.includes("--discs 13 "),
);

// The number of turns is the mean over the discs, added up: ϖ/Ω times the periods after the
// warm-up.
await open("?discs=48&mu=0.5&seed=3&events=120000");
const [turned, rate, periods] = await page.evaluate(() =>
    ["turned", "rotation", "period-count"].map((id) =>
        parseFloat(document.getElementById(id).textContent.replace("−", "-")),
    ),
);
// The part of a period after the last block counts as turns only; it has at most 0.15 turns.
assert.ok(
    Math.abs(turned - rate * (Math.floor(periods) - 20)) < 0.15 && Math.abs(turned) > 0.3,
    `${turned} turns, ϖ = ${rate} in ${periods} periods`,
);

// The page has an error from 50 periods after the warm-up on.
for (const [events, wanted] of [
    ["60000", /^−0\.\d\d$/],
    ["260000", /^−0\.\d+ ± 0\.\d+$/],
]) {
    // about 3500 events in a period
    await open(`?discs=48&seed=4&events=${events}`);
    assert.match(await text("rotation"), wanted);
}

// A browser whose storage is blocked, and whose address cannot be changed, loses nothing that is on
// the page; two tabs do not disturb each other.
const blocked = await newPage();
await blocked.addInitScript(() => {
    for (const name of ["localStorage", "sessionStorage", "indexedDB", "caches"])
        Object.defineProperty(globalThis, name, {
            get: () => {
                throw new DOMException("blocked", "SecurityError");
            },
        });
    history.replaceState = () => {
        throw new DOMException("full", "QuotaExceededError");
    };
});
const pointsOn = (of, count) =>
    of.waitForFunction(
        (wanted) =>
            document
                .querySelector("#discovery-plot [role=img]")
                .ariaLabel.includes(`with ${wanted} point`),
        count,
    );
await blocked.goto(`${address}?discs=8`);
await pointsOn(blocked, 1);
await open("?discs=8");
await page.fill("#parameter-discs", "9"); // in another tab
await blocked.fill("#parameter-discs", "10");
await pointsOn(blocked, 2);
await blocked.waitForSelector('canvas[aria-label^="10 discs"]');
await page.waitForSelector('canvas[aria-label^="9 discs"]');
assert.equal(await page.inputValue("#parameter-discs"), "9");
await blocked.close();

// The page's policy forbids other scripts and all requests, and its own parts obey it. Playwright's
// waitForFunction needs eval, so all other tests bypass the policy.
const strict = await newPage({bypassCSP: false});
await strict.addInitScript(() => {
    globalThis.violations = [];
    document.addEventListener("securitypolicyviolation", (event) =>
        globalThis.violations.push(`${event.effectiveDirective} ${event.blockedURI}`),
    );
});
await strict.goto(`${address}?discs=8`);
await strict.locator("#discovery-plot [role=img][aria-label*='with 1 point']").waitFor(); // workers run
await strict.evaluate(() => {
    for (const id of ["compare", "record"]) document.getElementById(id).click();
});
await strict.locator("#compared canvas").waitFor();
for (const id of ["save-image", "save-result", "save-table"]) {
    await strict.locator(`#${id}`).waitFor({state: "attached"});
    await Promise.all([
        strict.waitForEvent("download"),
        strict.evaluate((each) => document.getElementById(each).click(), id),
    ]);
}
assert.deepEqual(await strict.evaluate(() => globalThis.violations), []);
assert.equal(
    await strict.evaluate(() => {
        const script = document.createElement("script");
        script.textContent = "globalThis.foreign = true";
        document.body.append(script);
        return globalThis.foreign;
    }),
    undefined,
);
assert.equal(
    await strict.evaluate(() =>
        fetch("https://example.org/").then(
            () => "allowed",
            () => "forbidden",
        ),
    ),
    "forbidden",
);
assert.deepEqual(
    await strict.evaluate(
        () => new Promise((resolve) => setTimeout(() => resolve(globalThis.violations), 100)),
    ),
    ["script-src-elem inline", "connect-src https://example.org/"],
);
await strict.close();

// The page can be found and shared.
assert.equal(await page.title(), "Pancake rotation: why marbles in a swirled dish turn backwards");
for (const name of ["name=description", "property='og:title'", "property='og:description'"])
    assert.ok((await page.getAttribute(`meta[${name}]`, "content")).length > 40, name);
assert.match(await page.getAttribute("link[rel=icon]", "href"), /^data:image\/svg/);
assert.deepEqual(
    await page.evaluate(async () => {
        const image = new Image();
        image.src = document.querySelector("link[rel=icon]").href;
        await image.decode();
        return document.getElementById("send-link").hidden || "share" in navigator;
    }),
    true,
);
const phoneShare = await newPage();
await phoneShare.addInitScript(() => {
    navigator.share = async (shared) => {
        globalThis.shared = shared;
        throw new DOMException("closed", "AbortError");
    };
});
await phoneShare.goto(`${address}?discs=9&seed=3`);
await phoneShare.waitForFunction(() => document.getElementById("state-hash").textContent !== "");
const shared = await phoneShare.evaluate(() => {
    document.getElementById("send-link").click();
    return globalThis.shared;
});
assert.match(shared.url, /\?discs=9&seed=3$/);
// The QR code has the three finder patterns of seven modules, with its border.
await phoneShare.evaluate(() => document.getElementById("show-qr").click());
const finders = await phoneShare.$eval("#qr canvas", (canvas) => {
    const context = canvas.getContext("2d"),
        isDark = (x, y) => context.getImageData(x, y, 1, 1).data[0] === 0;
    let border = 0;
    while (!isDark(border, border)) ++border;
    const module = border / 4,
        size = canvas.width / module;
    const ringAt = (x, y) =>
        [0, 1, 2, 3, 4, 5, 6]
            .map((k) => Number(isDark((x + k + 0.5) * module, (y + 3 + 0.5) * module)))
            .join("");
    return [Number.isInteger(size), ringAt(4, 4), ringAt(size - 11, 4), ringAt(4, size - 11)];
});
assert.deepEqual(finders, [true, "1011101", "1011101", "1011101"]);
await phoneShare.close();

// A single disc is a pancake: it rolls on the wall, so its own turns are shown
// (docs/explanation/why.md).
await open("?discs=1&radius=7&events=2100"); // 60 periods
await page.waitForFunction(
    () => document.getElementById("headline").textContent === "1 disc, so far: against the swirl.",
);
const rolled = Number((await text("rotation")).replace("−", "-"));
assert.ok(rolled < -0.05 && rolled > 1 - 8.6 / 7, `${rolled}`); // it slips while it bounces at the vertices of the path

// Counted turns and a dish in millimetres.
await page.evaluate(() => {
    document.getElementById("my-dish").open = true;
});
await page.fill("#my-points", "8 4.4 20\n48 −0.7 20");
await page.waitForFunction(() => location.hash === "#counted=8_4.4_20,48_-0.7_20");
await page.fill("#my-points", "8 x 20");
await page.waitForFunction(() =>
    /^The point '8 x 20' must be three numbers/.test(document.getElementById("error").textContent),
);
await page.click("#my-text");
await page.waitForFunction(() =>
    ["preset experiment", "container-radius 8.5", "amplitude 3.8333"].every((option) =>
        document.getElementById("command").textContent.includes(`--${option} `),
    ),
);
assert.match(await text("my-found"), /--gravity 1\.59/);
for (const [field, value, said] of [
    ["particle", "30", /radius 30 does not fit into a dish of radius 25.5/],
    ["rate", "x", /'x', .* 0.05 to 20 Hz/],
    ["container", "", /'', .* 0.1 to 1000 mm/],
    ["amplitude", "-3", /'-3'/],
    ["rate", "1e9", /'1e9'/],
]) {
    await page.click("#my-text");
    await page.fill(`#my-${field}`, value);
    await page.click("#my-show");
    assert.match(await text("my-found"), said);
}
// A class link gives each phone its own seed and then vanishes from the address.
const classSeeds = [];
for (let k = 0; k < 2; ++k) {
    await open("?discs=9&seed=7&class=1");
    await page.waitForFunction(() => /^\?discs=9&seed=\d{4}$/.test(location.search));
    classSeeds.push(await page.evaluate(() => location.search));
}
assert.ok(new Set(classSeeds).size > 1, `${classSeeds}`);
await page.evaluate(() => {
    document.getElementById("my-dish").open = true;
    Object.defineProperty(navigator, "clipboard", {
        value: {
            writeText: async (copiedText) => {
                globalThis.classLink = copiedText;
            },
        },
        configurable: true,
    });
});
await page.click("#class-link");
assert.match(await page.evaluate(() => globalThis.classLink), /\?discs=9&class=1$/);
await page.fill(
    "#class-results",
    "?seed=1#points=8_0.1_0.01_200\n?seed=2#points=8_0.2_0.01_200\n?mu=0.1#points=8_0.2_0.01_200",
);
// The worker pools the points.
await page.waitForFunction(
    (wanted) => document.getElementById("class-found").textContent === wanted,
    "1 point from 2 seeds. Lines without points, or with other parameters: 1.",
);

// A browser that reads QR codes adds those in a photograph; without one, or in another browser,
// there are only pasted links.
assert.equal(await page.isVisible("#class-photo"), false);
await page.click("#class-code");
await page.waitForSelector("#qr canvas");
await page.keyboard.press("Escape");
const reader = await newPage();
await reader.addInitScript(() => {
    globalThis.BarcodeDetector = class {
        constructor({formats: [format]}) {
            this.format = format;
        }
        async detect({width}) {
            return width > 1 && this.format === "qr_code"
                ? [{rawValue: "?seed=3#points=8_0.1_0.01_200"}]
                : [];
        }
    };
});
await reader.goto(`${address}?discs=9`);
await reader.waitForFunction(() => document.getElementById("my-dish"));
await reader.evaluate(() => {
    document.getElementById("my-dish").open = true;
});
await reader.fill("#class-results", "?seed=4#points=8_0.2_0.01_200\n");
const imageOf = (width) =>
    reader.evaluate(
        (size) =>
            Object.assign(document.createElement("canvas"), {
                width: size,
                height: size,
            }).toDataURL(),
        width,
    );
for (const [width, said] of [
    [2, /^$/],
    [1, /No QR code was found/],
    [0, /No QR code was found/],
]) {
    // of width 0: no image
    const buffer = Buffer.from((await imageOf(width)).split(",")[1], "base64");
    await reader.setInputFiles("#class-photo", {name: "a.png", mimeType: "image/png", buffer});
    await reader.waitForFunction(
        () =>
            document.getElementById("class-photo").value === "" &&
            /^1 point from 2 seeds/.test(document.getElementById("class-found").textContent),
    );
    await reader.waitForFunction(
        (wanted) => new RegExp(wanted).test(document.getElementById("error").textContent),
        said.source,
    );
}
assert.equal(
    await reader.inputValue("#class-results"),
    "?seed=4#points=8_0.2_0.01_200\n?seed=3#points=8_0.1_0.01_200",
);
await reader.close();

// A browser that records MP4 only saves a movie of that kind.
const apple = await newPage();
await apple.addInitScript(() => {
    globalThis.MediaRecorder = class {
        static isTypeSupported(type) {
            return type === "video/mp4";
        }
        state = "recording";
        start() {}
        stop() {
            this.ondataavailable({data: new Blob(["mp4"])});
            this.onstop();
        }
    };
});
await apple.goto(`${address}?discs=8`);
await apple.waitForFunction(() => document.getElementById("state-hash").textContent !== "");
for (let k = 0; k < 2; ++k) await apple.evaluate(() => document.getElementById("record").click());
const [movie] = await Promise.all([
    apple.waitForEvent("download"),
    apple.evaluate(() => document.getElementById("save-movie").click()),
]);
assert.deepEqual(
    [movie.suggestedFilename(), await apple.textContent("#save-movie")],
    ["swirl.mp4", "Save movie (MP4)"],
);
await apple.close();

// A recording gives a movie.
await page.setViewportSize({width: 1200, height: 640}); // a busy machine cannot encode larger images in time
await open("?discs=28");
await openViewing();
await page.selectOption("#choose-coloring", "spin");
await press("record");
await page.waitForTimeout(1500);
await press("record");
await page.waitForSelector("#save-movie", {state: "attached"});

// Downloads.
const saved = {},
    canvasSize = await page.$eval("#views canvas", ({width, height}) => [width, height]);
for (const [button, name, begins] of [
    ["#save-image", "swirl.png", "\x89PNG"],
    ["#save-table", "rotation.csv", "period,varpi,varpi_rigid\n"],
    ["#save-movie", "swirl.webm", "\x1a\x45\xdf\xa3"],
    ["#save-result", "result.json", "{\n"],
]) {
    const [called, bytes] = await downloaded(button);
    assert.equal(called, name);
    saved[name] = bytes;
    assert.ok(saved[name].toString("latin1").startsWith(begins), name);
}

// The image has the canvas, and a row with the address; tests/cli/lab_test.py decodes it.
assert.deepEqual(
    [16, 20].map((at) => saved["swirl.png"].readUInt32BE(at)),
    [canvasSize[0], canvasSize[1] + 22],
);
assert.ok(canvasSize[0] >= 300, `${canvasSize}`);

if (folder)
    for (const [name, bytes] of Object.entries(saved)) writeFileSync(`${folder}/${name}`, bytes);

assert.deepEqual(errors, []);
assert.deepEqual(requests, []);

// Without JavaScript the page shows a message.
const plain = await browser.newPage({javaScriptEnabled: false});
await plain.goto(address);
assert.match(await plain.innerText("body"), /JavaScript, which is turned off here/);
await browser.close();

// Without SIMD, which Chromium disables on old processors, the page shows an error message.
const old = await launch(
    executablePath,
    "--js-flags=--no-enable-sse4-1 --no-enable-ssse3 --no-enable-sse3",
);
const without = await old.newPage();
await without.goto(address);
await without.waitForFunction(
    () =>
        document.getElementById("state-hash").textContent !== "" ||
        !document.getElementById("error").hidden,
);
assert.match(
    await without.textContent("#error"),
    /^This browser does not support WebAssembly with SIMD/,
);
await old.close();
