// Builds one self-contained file: it includes the script, styles, worker and engine.
import {defineConfig} from "vite";
import {viteSingleFile} from "vite-plugin-singlefile";
import {fileURLToPath} from "node:url";
import {pageTexts} from "./src/texts.en.ts";

/** Replaces {{name}} in the page by the English text of this name; translatePage() of texts.ts replaces it by another language. */
const texts = {
    name: "texts",
    transformIndexHtml: {order: "pre", handler: (html) => html.replace(/\{\{(\w+)\}\}/g, (_, name) => {
        if (!(name in pageTexts)) throw new Error(`index.html has {{${name}}}, but src/texts.en.ts has no such text.`);
        return pageTexts[name].replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/"/g, "&quot;");
    })},
};

export default defineConfig({
    base: "./",
    plugins: [texts, viteSingleFile()],
    resolve: {alias: [
        // The sources of jsfive without its copy of pako: the page has a smaller library for the same format.
        {find: /^jsfive$/, replacement: fileURLToPath(new URL("node_modules/jsfive/esm/high-level.js", import.meta.url))},
        {find: /^.*\/pako\.esm\.mjs$/, replacement: fileURLToPath(new URL("src/inflate.ts", import.meta.url))},
    ]},
    assetsInclude: ["**/*.wasm.gz"],
    worker: {format: "iife"},
    build: {outDir: "../build/lab", emptyOutDir: true, assetsInlineLimit: 100_000_000,
            target: "es2022"},
});
