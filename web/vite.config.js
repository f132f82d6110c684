// One file that needs nothing but itself: script, styles, worker and the engine stand in it.
import {defineConfig} from "vite";
import {viteSingleFile} from "vite-plugin-singlefile";

export default defineConfig({
    base: "./",
    plugins: [viteSingleFile()],
    assetsInclude: ["**/*.wasm.gz"],
    worker: {format: "iife"},
    build: {outDir: "../build/lab", emptyOutDir: true, assetsInlineLimit: 100_000_000,
            target: "es2022"},
});
