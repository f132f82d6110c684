// Builds one self-contained file: it includes the script, styles, worker and engine.
import {defineConfig} from "vite";
import {viteSingleFile} from "vite-plugin-singlefile";
import {pageTexts} from "./src/texts.ts";

/** Replaces {{name}} in the page by the text of this name in texts.ts. */
const texts = {
    name: "texts",
    transformIndexHtml: {order: "pre", handler: (html) => html.replace(/\{\{(\w+)\}\}/g, (_, name) => {
        if (!(name in pageTexts)) throw new Error(`index.html has {{${name}}}, but src/texts.ts has no such text.`);
        return pageTexts[name].replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/"/g, "&quot;");
    })},
};

export default defineConfig({
    base: "./",
    plugins: [texts, viteSingleFile()],
    assetsInclude: ["**/*.wasm.gz"],
    worker: {format: "iife"},
    build: {outDir: "../build/lab", emptyOutDir: true, assetsInlineLimit: 100_000_000,
            target: "es2022"},
});
