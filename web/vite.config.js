// Builds one self-contained file, which includes the script, styles, worker and engine: the first
// page, or with `--mode laboratory` the second one.
import {defineConfig} from "vite";
import {viteSingleFile} from "vite-plugin-singlefile";
import {createHash} from "node:crypto";
import {readFileSync} from "node:fs";
import look from "./src/drawing/look.json" with {type: "json"};
import english from "./src/texts/texts.en.json" with {type: "json"};

/** A text of the Laboratory, with "dish." one of the first page, or with "sector." a colour. */
const textOf = (name) => {
    const [table, key] = name.split(".");
    if (key === undefined) return english.page[name];
    return {dish: english.dish, sector: look.sectors}[table]?.[key];
};
const signals = ({with: w, against}) => `--with:${w};--against:${against}`;
/** The colours of the directions for style.css, and an icon of both pages: three discs in a dish. */
const discs = [
    [10, 17, 2],
    [19, 12, 0],
    [19, 22, 4],
].map(([x, y, k]) => `<circle cx='${x}' cy='${y}' r='5' fill='${look.sectors[k]}'/>`);
const icon =
    "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 32 32'>" +
    "<circle cx='16' cy='16' r='14' fill='#fff' stroke='#1d2328' stroke-width='3'/>" +
    `${discs.join("")}</svg>`;
const headOfBoth =
    `<link rel="icon" href="data:image/svg+xml,${encodeURIComponent(icon)}">\n` +
    `<style>:root{${signals(look.light)}}` +
    `@media (prefers-color-scheme: dark){:root{${signals(look.dark)}}}</style>`;

/** Replaces {{name}} in the page by the English text of this name; translatePage() of texts.ts
    replaces it by another language. */
const texts = {
    name: "texts",
    transformIndexHtml: {
        order: "pre",
        handler: (html) =>
            html
                .replace("</head>", `${headOfBoth}\n</head>`)
                .replace(/\{\{([\w.]+)\}\}/g, (_, name) => {
                    if (textOf(name) === undefined)
                        throw new Error(
                            `the page has {{${name}}}, but src/texts/texts.en.json has no such text.`,
                        );
                    return textOf(name)
                        .replace(/&/g, "&amp;")
                        .replace(/</g, "&lt;")
                        .replace(/"/g, "&quot;");
                }),
    },
};

/** The page among the files of a build. */
const pageOf = (bundle) => Object.values(bundle).find(({fileName}) => fileName.endsWith(".html"));

/** Moves the script to the end, so that a slow connection shows the first picture before the engine
    has arrived. */
const late = {
    name: "late",
    enforce: "post",
    generateBundle: (_, bundle) => {
        const page = pageOf(bundle),
            [script] = /<script type="module"[^]*?<\/script>/.exec(page.source);
        page.source = page.source
            .replace(script, "")
            .replace("</body>", () => `${script}\n</body>`);
    },
};

/** Adds the Content-Security-Policy: the page runs its own script and engine only, and requests
    nothing. Its worker comes from a blob (as data: if the browser has none), the engine from data:.
    */
const policy = {
    name: "policy",
    enforce: "post",
    generateBundle: (_, bundle) => {
        const page = pageOf(bundle);
        const hashes = [...page.source.matchAll(/<script[^>]*>([^]*?)<\/script>/g)].map(
            ([, script]) => `'sha256-${createHash("sha256").update(script).digest("base64")}'`,
        );
        const rules = [
            "default-src 'none'",
            `script-src ${hashes.join(" ")} 'wasm-unsafe-eval'`,
            "worker-src blob: data:",
            "style-src 'unsafe-inline'",
            "font-src data:",
            "img-src data: blob:",
            "connect-src data:",
            "base-uri 'none'",
            "form-action 'none'",
        ];
        page.source = page.source.replace(
            '<meta charset="utf-8">',
            (charset) =>
                `${charset}\n<meta http-equiv="Content-Security-Policy" content="${rules.join("; ")}">`,
        );
    },
};

const read = (name) => readFileSync(new URL(name, import.meta.url), "utf-8");

/** The licences of the font and of the libraries in the engine, as a comment at the end of the
    page. */
const notices = {
    name: "notices",
    enforce: "post",
    generateBundle: (_, bundle) => {
        const page = pageOf(bundle),
            font = page.source.includes("data:font") ? read("../LICENSES/OFL-1.1.txt") : "";
        page.source += `<!--\n${read("notices.txt")}\n${font}-->\n`;
    },
};

export default defineConfig(({mode}) => ({
    base: "./",
    plugins: [texts, viteSingleFile(), late, policy, notices],
    assetsInclude: ["**/*.wasm.gz"],
    worker: {format: "iife"},
    build: {
        outDir: "../build/lab",
        emptyOutDir: mode !== "laboratory",
        rollupOptions: {input: mode === "laboratory" ? "laboratory.html" : "index.html"},
        assetsInlineLimit: 100_000_000,
        target: "es2022",
    },
}));
