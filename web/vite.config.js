// One file that needs nothing but itself: script, styles, worker and the engine stand in it.
import {defineConfig} from "vite";
import {viteSingleFile} from "vite-plugin-singlefile";
import {pageTexts} from "./src/texts.ts";

/** {{name}} in the page is what texts.ts calls so. */
const texts = {
    name: "texts",
    transformIndexHtml: {order: "pre", handler: (html) => html.replace(/\{\{(\w+)\}\}/g, (_, name) => {
        if (!(name in pageTexts)) throw new Error(`index.html has {{${name}}}, which src/texts.ts has not.`);
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
