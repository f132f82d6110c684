// Starts Chromium for the tests. They wait for events, and never for a time.
import assert from "node:assert/strict";
import {createRequire} from "node:module";
import {chromium} from "playwright-core";

/** Milliseconds that no event takes, on a busy machine either. The hour of ctest is longer, so a
 *  message names the event. */
export const hang = 3_000_000;

/** A browser whose pages accept the scripts of tests and wait as long as needed. */
export async function launch(executablePath, ...moreArguments) {
    const browser = await chromium.launch({
        executablePath,
        timeout: hang,
        args: [
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            ...moreArguments,
        ],
    });
    return {
        newPage: async (options) => {
            const page = await browser.newPage({bypassCSP: true, ...options});
            page.setDefaultTimeout(hang);
            return page;
        },
        newBrowserCDPSession: () => browser.newBrowserCDPSession(),
        close: () => browser.close(),
    };
}

const axe = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
const rules = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"];

/** What axe-core finds in the page against WCAG 2.2, levels A and AA: its rule and the first
 *  element. */
export async function violationsOf(page) {
    if (!(await page.evaluate(() => "axe" in globalThis))) await page.addScriptTag({path: axe});
    const {violations, passes} = await page.evaluate(
        (runOnly) => globalThis.axe.run({runOnly}),
        rules,
    );
    assert.ok(passes.length > 15, `only ${passes.length} rules were tried`);
    return violations.map(({id, nodes}) => `${id}: ${nodes[0].html}`);
}
