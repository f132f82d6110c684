// Tests the page in Firefox: node --experimental-websocket firefox.mjs FILE.html FIREFOX HASH. HASH
// is that of `swirl run` for the first address below. It drives the browser by WebDriver BiDi.
// Exits with 1 and a message if a test fails.
import assert from "node:assert/strict";
import {spawn} from "node:child_process";
import {mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {hang} from "./browser.mjs";

const [file, program, wantedHash] = process.argv.slice(2);
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
    await call("browsingContext.setViewport", {context, viewport: {width: 360, height: 640}});
    const open = (query) =>
        call("browsingContext.navigate", {
            context,
            url: pathToFileURL(file).href + query,
            wait: "complete",
        });
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
    await open("?discs=28&mu=0.5&seed=3&events=20000");
    assert.equal(await when(text("state-hash")), wantedHash);
    // A new visitor sees both directions, on a page that is not wider than a phone, and can stir
    // both.
    await open("?lang=en");
    await when(`${text("headline")} === "The same swirl: 8 discs turn with it, 48 against it."`);
    assert.equal(await when("document.documentElement.scrollWidth <= 360"), "true");
    await when("document.querySelector(\"#discovery-plot [aria-label*='with 2 points']\")");
    await when("(document.getElementById('by-hand').click(), true)");
    await when(
        "/^8 discs: \\S+ turns×48 discs: \\S+ turns$/.test(document.getElementById('views').textContent)",
    );
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
