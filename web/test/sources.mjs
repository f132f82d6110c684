// The sources of the page for the unit tests, in whichever folder they are.
import {readdirSync, readFileSync, statSync} from "node:fs";
import {basename, dirname, join} from "node:path";
import {fileURLToPath, pathToFileURL} from "node:url";
import {build} from "esbuild";

const folder = join(dirname(fileURLToPath(import.meta.url)), "..", "src");

/** The paths of all files with this ending. */
export const filesWith = (ending, at = folder) =>
    readdirSync(at)
        .map((name) => join(at, name))
        .flatMap((each) =>
            statSync(each).isDirectory()
                ? filesWith(ending, each)
                : each.endsWith(ending)
                  ? [each]
                  : [],
        );

/** The path of the file with this name. */
export function pathOf(name) {
    const found = filesWith(name).filter((each) => basename(each) === name);
    if (found.length !== 1) throw new Error(`${found.length} files are ${name}`);
    return found[0];
}

export const textOf = (name) => readFileSync(pathOf(name), "utf-8");

/** A function that bundles a module into a folder and imports it; `as` gives a second copy. */
export const loader =
    (into, settings = {}) =>
    async (name, as = name) => {
        const outfile = join(into, `${as}.mjs`);
        await build({
            entryPoints: [pathOf(`${name}.ts`)],
            bundle: true,
            format: "esm",
            outfile,
            logLevel: "error",
            ...settings,
        });
        return import(pathToFileURL(outfile).href);
    };
