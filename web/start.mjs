// The parameters that `swirl lab` got as options: checks them with the engine, and prints them for the page.
//
//     node start.mjs ENGINE.wasm NAME=VALUE…             the query of the page's address
//     node start.mjs --page PAGE.html QUERY              the page that starts with this query (src/texts/start.ts)
//
// Exits with 2 and the engine's message for a value that is not valid.
import {readFileSync, writeSync} from "node:fs";

/** Writes all of a text, also into a pipe. */
const print = (text) => {
    for (let bytes = Buffer.from(text); bytes.length > 0; )
        bytes = bytes.subarray(writeSync(1, bytes));
};

const [mode, ...words] = process.argv.slice(2);
if (mode === "--page") {
    const [page, query] = words,
        content = query.replace(/&/g, "&amp;").replace(/"/g, "&quot;");
    print(
        readFileSync(page, "utf-8").replace(
            /<meta charset="utf-8">/,
            (charset) => `${charset}\n<meta name="swirl-start" content="${content}">`,
        ),
    );
} else {
    const given = words.map((word) => [
        word.slice(0, word.indexOf("=")),
        word.slice(word.indexOf("=") + 1),
    ]);
    const noSystem = new Proxy({}, {get: () => () => 52});
    const memory = () => engine.memory.buffer;
    const reject = (at, size) => {
        const {text} = JSON.parse(Buffer.from(memory(), at, size).toString());
        process.stderr.write(`error: ${text}\n`);
        process.exit(2);
    };
    const module = await WebAssembly.compile(readFileSync(mode));
    const engine = (
        await WebAssembly.instantiate(module, {wasi_snapshot_preview1: noSystem, page: {reject}})
    ).exports;
    engine._initialize();
    for (const [name, value] of given)
        if (/[\p{Cc}\p{Cf}\p{Zl}\p{Zp}]/u.test(value)) {
            process.stderr.write(
                `error: --${name.replaceAll("_", "-")} contains a control character, but a value must be ` +
                    "one line of text.\n",
            );
            process.exit(2);
        }
    const lines = Buffer.from(given.map(([name, value]) => `${name}=${value}\n`).join(""));
    const at = engine.buffer_for(lines.length);
    Buffer.from(memory(), at, lines.length).set(lines);
    engine.begin();
    print(new URLSearchParams(given).toString());
}
