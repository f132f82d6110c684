"""The site: every link has a target, no page makes a request to another host, and only a site is
replaced."""

import os
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

from program import ALL, HANG, SOURCE, SWIRL, made_of_the_web, main, read_text, write_text

SITE = os.path.join(SOURCE, "web", "site.sh")
# With --all the notebooks are executed, with the Python module of this build. Else
# python.notebooks_test executes them, and the site shows them without output.
WITH_MODULE = {
    "SWIRL_PYTHON": "/usr/bin/python3",
    "PYTHONPATH": os.path.join(os.environ["SWIRL_LIBRARIES"], "python"),
}
ENVIRONMENT = {**os.environ, **(WITH_MODULE if ALL else {"SWIRL_PYTHON": "false"})}
CHROMIUM = shutil.which("chromium")
SHORTER = """case " $* " in
    *" --seconds "*) ;;
    " movie "*) set -- "$@" --seconds 0.5 ;;
esac
"""

BROWSER = """
import {existsSync, statSync} from "node:fs";
import {fileURLToPath, pathToFileURL} from "node:url";
import {launch} from "../test/browser.mjs";
const [executablePath, ...files] = process.argv.slice(2);
const browser = await launch(executablePath, "--allow-file-access-from-files");
const page = await browser.newPage({viewport: {width: 360, height: 740}});
const errors = [];
page.on("requestfailed", (request) => {
    // The next page ends the loading of a movie.
    if (!existsSync(fileURLToPath(request.url().replace(/[?#].*/, ""))))
        errors.push(`not found: ${request.url()}`);
});
page.on("pageerror", (error) => errors.push(error.message));
page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) errors.push(request.url());
});
for (const file of files) {
    await page.goto(pathToFileURL(file).href);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    const broken = await page.evaluate(() => [...document.querySelectorAll("article td, article th")].filter(
        (cell) => getComputedStyle(cell).overflowWrap !== "normal").length);
    if (broken) errors.push(`${file} has ${broken} cells whose words may break`);
    if (wide > 360) errors.push(`${file} is ${wide} wide at a width of 360`);
    const fixed = await page.evaluate(() => [...document.querySelectorAll("article table")].filter(
        (table) => table.closest("[tabindex='0']") === null).length);
    if (fixed) errors.push(`${file} has ${fixed} tables that the keyboard cannot scroll`);
}
// What a reader gets who opens the gallery and does not scroll. How far below the window a browser
// loads late images is its own choice, so these do not count; each must have its place and be late.
await page.setViewportSize({width: 1280, height: 800});
await page.goto(pathToFileURL(files.find((file) => file.endsWith("/gallery.html"))).href);
const images = await page.evaluate(() =>
    [...document.querySelectorAll("article img")].map((image) => ({
        url: image.src,
        seen: image.getBoundingClientRect().top < innerHeight,
        late: image.loading === "lazy" && image.hasAttribute("width") && image.hasAttribute("height"),
    })));
const bytes = images
    .filter(({seen}) => seen)
    .reduce((sum, {url}) => sum + statSync(fileURLToPath(url)).size, 0);
if (images.length < 10 || bytes > 2e6)
    errors.push(`the gallery shows ${bytes} bytes at first sight`);
for (const {url, seen, late} of images)
    if (!seen && !late) errors.push(`${url} is loaded at once`);
const search = files.find((file) => file.endsWith("/search.html"));
await page.goto(`${pathToFileURL(search).href}?q=friction`);
await page.waitForSelector("#search-results li a");
await browser.close();
console.log(errors.join("\\n"));
"""


class Links(HTMLParser):
    def __init__(self):
        super().__init__()
        self.links, self.names = [], set()

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.links += [attributes[name] for name in ("href", "src") if attributes.get(name)]
        if attributes.get("id"):
            self.names.add(attributes["id"])


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        # With --all the movies of the gallery have their whole length, else half a second.
        program = os.path.join(folder.name, "swirl")
        write_text(
            program,
            "#!/bin/sh\n"
            + ("" if ALL else SHORTER)
            + f'exec {shlex.quote(os.path.abspath(SWIRL))} "$@"\n',
        )
        os.chmod(program, 0o755)
        # It replaces an older site.
        cls.site = made_of_the_web(
            cls,
            SITE,
            "site",
            before=(".swirl-site", "old.html"),
            arguments=("--address", "https://example.org/swirl"),
            env={**ENVIRONMENT, "SWIRL": program},
        )
        cls.pages = {}
        for place, _, names in os.walk(cls.site):
            for name in names:
                path = os.path.join(place, name)
                if (
                    name.endswith(".html")
                    and name not in ("lab.html", "laboratory.html")
                    and "_static" not in path
                ):
                    parsed = Links()
                    parsed.feed(read_text(path))
                    cls.pages[path] = parsed

    def test_every_link_has_a_target(self):
        checked = 0
        for path, page in self.pages.items():
            for link in page.links:
                parts = urlsplit(link)
                if parts.scheme in ("http", "https", "mailto", "data"):
                    continue
                self.assertEqual(parts.scheme, "", f"{path}: {link}")
                there = (
                    os.path.normpath(os.path.join(os.path.dirname(path), unquote(parts.path)))
                    if parts.path
                    else path
                )
                self.assertTrue(os.path.isfile(there), f"{path}: {link}")
                if parts.fragment and there in self.pages:
                    self.assertIn(
                        unquote(parts.fragment), self.pages[there].names, f"{path}: {link}"
                    )
                checked += 1
        self.assertGreater(checked, 500)

    def test_every_document_has_a_page_in_the_contents(self):
        documents = [
            os.path.join(place, name)
            for place, _, names in os.walk(os.path.join(SOURCE, "docs"))
            for name in names
            if name.endswith(".md")
        ]
        self.assertGreater(len(documents), 10)
        home = os.path.join(self.site, "docs", "index.html")
        listed = {
            os.path.normpath(os.path.join(os.path.dirname(home), urlsplit(link).path))
            for link in self.pages[home].links
        }
        for path in documents:
            page = os.path.join(self.site, os.path.relpath(path, SOURCE)[:-3] + ".html")
            self.assertIn(page, self.pages)
            if page != home:
                self.assertIn(page, listed)

    def test_the_sidebar_has_the_order_of_the_index(self):
        listed = re.findall(
            r"^- .*?\]\(([a-z-]+/\w+)\.md\)",
            read_text(os.path.join(SOURCE, "docs", "index.md")),
            re.M,
        )
        with open(os.path.join(self.site, "docs", "index.html"), encoding="utf-8") as opened:
            sidebar = opened.read().split('class="sidebar-tree"')[1].split("</aside>")[0]
        self.assertGreater(len(listed), 30)
        self.assertEqual(
            [link for link in re.findall(r'href="([a-z-]+/\w+)\.html"', sidebar) if link in listed],
            listed,
        )

    def test_the_front_page_begins_with_name_purpose_and_the_live_dish(self):
        text = read_text(os.path.join(self.site, "docs", "index.html")).split("<article", 1)[1]
        parts = [
            text.index(part)
            for part in ("<h1>swirl", "many against it", "<iframe", '"tiles"', "<h2>Questions")
        ]
        self.assertEqual(parts, sorted(parts))
        tiles = text[parts[3] : parts[4]]
        self.assertEqual(tiles.count("<a href="), 6)
        if shutil.which("ffmpeg"):
            movies = re.findall(r'<video src="\.\./(gallery/[^"]*)"', tiles)
            self.assertEqual(len(movies), 6)
            for movie in movies:
                self.assertLess(os.path.getsize(os.path.join(self.site, movie)), 700_000)

    def test_pages_have_a_title_and_a_text_for_links_to_them(self):
        text = read_text(os.path.join(self.site, "docs", "explanation", "why.html"))
        self.assertIn('<meta property="og:title" content="Why it reverses – swirl"', text)
        for name in ('name="description"', 'property="og:description"'):
            self.assertRegex(text, f'<meta {name} content="For everyone. Move a dish')
        self.assertIn("<title>Why it reverses", text)
        self.assertIn(
            '<link rel="canonical" href="https://example.org/swirl/docs/explanation/why.html"', text
        )

    def test_symbols_have_subscripts_and_formulas_the_size_of_the_text(self):
        text = read_text(os.path.join(self.site, "docs", "explanation", "why.html"))
        self.assertIn("R<sub>c</sub>", text)
        self.assertRegex(
            text, r'class="formula" style="vertical-align: -[0-9.]+em"><svg [^>]*width="[0-9.]+em"'
        )

    def test_options_keep_their_hyphens(self):
        self.assertIn(
            "value of --mu]",
            read_text(os.path.join(self.site, "docs", "reference", "parameters.html")),
        )

    def test_the_home_page_leads_to_the_documentation(self):
        self.assertIn('href="docs/index.html"', read_text(os.path.join(self.site, "index.html")))

    def test_the_search_index_is_a_script(self):  # a browser does not load JSON from file://
        self.assertTrue(
            read_text(os.path.join(self.site, "searchindex.js")).startswith("Search.setIndex(")
        )

    def test_the_gallery_shows_the_output_of_its_commands(self):
        with open(os.path.join(SOURCE, "web", "gallery.txt"), encoding="utf-8") as opened:
            lines = [line.strip().split(" | ") for line in opened if not line.startswith("#")]
        text = read_text(os.path.join(self.site, "gallery.html"))
        self.assertGreater(len([line for line in lines if len(line) == 2]), 5)
        images = re.findall(r'<(?:img|video)[^>]* src="([^"]+)"', text)
        shown = {os.path.basename(src) for src in images}
        for _, command, *stored in lines:
            if not stored and " movie " in command and not shutil.which("ffmpeg"):
                continue
            self.assertIn(command, re.sub(r"<[^>]+>", "", text))
            self.assertIn(os.path.basename(stored[0]) if stored else command.split()[-1], shown)
        # The gallery has all images of the documentation, and one of the ten states of the page.
        stored = {line[2] for line in lines if len(line) == 3}
        images = {
            f"docs/images/{name}"
            for name in os.listdir(os.path.join(SOURCE, "docs", "images"))
            if name.endswith((".png", ".gif"))
        }
        images = {image for image in images if not os.path.basename(image).startswith("lab_")} | {
            "docs/images/lab_start.png"
        }
        self.assertEqual(images - stored, set())

    def test_notebooks_are_pages(self):
        path = os.path.join(self.site, "examples", "first_steps.html")
        self.assertIn(path, self.pages)
        text = read_text(path)
        self.assertRegex(text, r"<h1[^>]*>First steps")
        self.assertIn("swirl.run(discs=12", re.sub(r"<[^>]+>", "", text))
        self.assertNotIn("cell_type", text)

    def test_notebooks_show_their_output(self):
        self.assertEqual("the notebooks are shown without output" in self.warnings, not ALL)
        for name in sorted(os.listdir(os.path.join(SOURCE, "examples"))):
            if not name.endswith(".ipynb"):
                continue
            text = read_text(os.path.join(self.site, "examples", name[:-6] + ".html"))
            shown = re.search(rf'<img [^>]*src="[^"]*{name[:-6]}_[0-9]+_[0-9]+\.(png|svg)"', text)
            self.assertEqual(bool(shown), ALL, name)
            self.assertNotIn("Traceback", text, name)

    def test_no_page_loads_from_another_host(self):
        for path in self.pages:
            text = read_text(path)
            self.assertNotRegex(
                re.sub('<link rel="canonical"[^>]*>', "", text),
                r"""<(script|link|img|iframe|video)[^>]+(src|href)=["']https?:""",
                path,
            )

    def test_the_pages_in_a_browser(self):
        if not CHROMIUM:
            self.skipTest("this test needs chromium")
        script = os.path.join(SOURCE, "web", "node_modules", f".site_test_{os.getpid()}.mjs")
        write_text(script, BROWSER)
        self.addCleanup(os.remove, script)
        documents = [
            path
            for path in sorted(self.pages)
            if re.search(r"/(search|gallery|README)\.html$|/docs/", path)
        ]
        done = subprocess.run(
            ["node", script, CHROMIUM, *documents], capture_output=True, text=True, timeout=HANG
        )
        self.assertEqual((done.returncode, done.stdout.strip()), (0, ""), done.stderr)

    def test_only_a_site_is_replaced(self):
        self.assertFalse(os.path.exists(os.path.join(self.site, "old.html")))
        self.assertEqual(os.listdir(os.path.dirname(self.site)), ["site"])
        other = os.path.join(self.site, "docs")  # a folder with something in it
        done = subprocess.run([SITE, "--out", other], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("neither empty nor a site", done.stderr)
        self.assertTrue(os.listdir(other))

    def test_usage_errors(self):
        for wrong, message in (
            ([], "missing required option --out"),
            (["--out"], "--out needs a value"),
            (["--to", "x"], "'--to'"),
            (["--out", "x", "--report", "/nowhere"], "no report.html"),
        ):
            done = subprocess.run([SITE, *wrong], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, wrong)
            self.assertIn(message, done.stderr)


if __name__ == "__main__":
    main()
