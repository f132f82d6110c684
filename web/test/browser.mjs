// Starts Chromium for the tests. They wait for events, and never for a time.
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
