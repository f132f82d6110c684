// Tests both pages in Firefox: node --experimental-websocket firefox.mjs PAGES FIREFOX HASH [--all]
// [FOLDER]. The folder PAGES holds them, HASH is that of `swirl run` for the first address below.
// FOLDER gets images of the pages. Without --all the scenes that measure are tried at one size, and
// the layout at the others. It drives the browser by WebDriver BiDi. Exits with 1 and a message if
// a test fails.
import assert from "node:assert/strict";
import {spawn} from "node:child_process";
import {mkdtempSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {hang} from "./browser.mjs";

const all = process.argv.includes("--all");
const [pages, program, wantedHash, folder] = process.argv
    .slice(2)
    .filter((each) => each !== "--all");
const profile = mkdtempSync(join(tmpdir(), "swirl-firefox-"));
const firefox = spawn(
    program,
    ["--headless", "--no-remote", "--profile", profile, "--remote-debugging-port", "0"],
    {stdio: ["ignore", "ignore", "pipe"], env: {...process.env, HOME: profile}},
);
const limit = setTimeout(() => {
    throw new Error("Firefox does not answer");
}, hang);
const url = await new Promise((resolve) =>
    firefox.stderr.on("data", (said) => {
        const found = /WebDriver BiDi listening on (ws:\S+)/.exec(String(said));
        if (found) resolve(found[1]);
    }),
);
const socket = new WebSocket(`${url}/session`),
    waiting = new Map(),
    errors = [];
await new Promise((resolve) => socket.addEventListener("open", resolve));
socket.addEventListener("message", ({data}) => {
    const {id, method, params, ...answer} = JSON.parse(data);
    if (method === "log.entryAdded" && params.level === "error") errors.push(params.text);
    waiting.get(id)?.(answer);
});
const call = (method, params) =>
    new Promise((resolve, reject) => {
        const id = waiting.size + 1;
        waiting.set(id, ({type, result, message}) =>
            type === "success" ? resolve(result) : reject(new Error(`${method}: ${message}`)),
        );
        socket.send(JSON.stringify({id, method, params}));
    });
try {
    await call("session.new", {capabilities: {}});
    const {
        contexts: [{context}],
    } = await call("browsingContext.getTree", {});
    await call("session.subscribe", {events: ["log.entryAdded"]});
    const open = (query) =>
        call("browsingContext.navigate", {
            context,
            url: new URL(query, `${pathToFileURL(pages).href}/`).href,
            wait: "complete",
        });
    const show = async (width, height) =>
        call("browsingContext.setViewport", {context, viewport: {width, height}});
    const keep = async (name) => {
        if (!folder) return;
        const {data} = await call("browsingContext.captureScreenshot", {context});
        writeFileSync(join(folder, `${name}.png`), Buffer.from(data, "base64"));
    };
    /** The value of an expression as soon as it is true. */
    const when = async (expression) => {
        for (;;) {
            const {result} = await call("script.evaluate", {
                expression: `String(${expression} || "")`,
                target: {context},
                awaitPromise: true,
            });
            if (result?.value) return result.value;
            await new Promise((resolve) => setTimeout(resolve, 100));
        }
    };
    const text = (id) => `document.getElementById("${id}").textContent`;
    // The same state as on the command line.
    await show(360, 640);
    await open("laboratory.html?discs=28&mu=0.5&seed=3&events=20000");
    assert.equal(await when(text("state-hash")), wantedHash);
    for (const [width, height] of [
        [360, 640],
        [768, 1024],
        [1440, 900],
    ]) {
        await show(width, height);
        const fits = async () =>
            assert.equal(await when(`document.documentElement.scrollWidth <= ${width}`), "true");
        const measures = all || width === 360;
        // A new visitor of the Laboratory sees both directions and can stir both.
        await open("laboratory.html?lang=en");
        if (measures) {
            await when(
                `${text("headline")} === "The same swirl: 8 discs turn with it, 48 against it."`,
            );
            await when("document.querySelector(\"#discovery-plot [aria-label*='with 2 points']\")");
        } else await when("document.querySelectorAll('#views canvas').length === 2");
        await fits();
        await keep(`laboratory_${width}`);
        if (measures) {
            await when("(document.getElementById('by-hand').click(), true)");
            await when(
                "/^8 discs: \\S+ turns×48 discs: \\S+ turns$/.test(document.getElementById('views').textContent)",
            );
        }
        // The first page: both directions, and the cause on the same discs.
        await open("index.html?lang=en");
        const says = (words) => when(`${text("sentence")} === "${words}"`);
        const press = (id) => when(`(document.getElementById("${id}").click(), true)`);
        await says("8 discs turn with the swirl");
        await fits();
        if (measures) {
            await says("48 discs turn against the swirl");
            await keep(`dish_${width}`);
            await press("discs");
            await says("48 discs turn with the swirl");
            await press("hold");
            await says("48 discs turn against the swirl");
        }
    }
    assert.deepEqual(errors, []);
} finally {
    clearTimeout(limit);
    await call("browser.close", {}).catch(() => {});
    firefox.kill();
    await new Promise((resolve) =>
        firefox.exitCode === null && firefox.signalCode === null
            ? firefox.once("exit", resolve)
            : resolve(),
    );
    socket.close();
    rmSync(profile, {recursive: true, force: true, maxRetries: 5, retryDelay: 200});
}
