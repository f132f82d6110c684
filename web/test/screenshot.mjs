// Writes the image for docs/how-to/browser_page.md and the README: node screenshot.mjs FILE.html CHROMIUM
// FILE.png. It shows the paper's 48 discs next to 36 spheres of the experiment, after about fifty periods;
// the exact number depends on the machine.
import {pathToFileURL} from "node:url";
import {chromium} from "playwright-core";

const [file, executablePath, image] = process.argv.slice(2);
const periods = 50;

const browser = await chromium.launch({executablePath, args: ["--no-sandbox", "--disable-gpu"]});
const page = await browser.newPage({viewport: {width: 1280, height: 760}});
await page.goto(`${pathToFileURL(file).href}?preset=experiment&discs=36`);
await page.waitForSelector('canvas[aria-label^="36 spheres"]');
await page.evaluate(() => { // periods per second
    const speed = document.getElementById("speed");
    speed.value = "0.7";
    speed.dispatchEvent(new Event("input"));
});
await page.click("#compare");
await page.selectOption("#choose-preset", {index: 1});
await page.waitForSelector('canvas[aria-label^="48 discs"]');
await page.waitForFunction((wanted) => Number(
    document.querySelector("#estimates dd:nth-of-type(3)")?.textContent) > wanted, periods, {timeout: 120_000});
await page.click("#play");
await page.waitForTimeout(500);
await page.evaluate(() => { document.activeElement.blur(); scrollTo(0, 0); });
await page.screenshot({path: image});
await browser.close();
