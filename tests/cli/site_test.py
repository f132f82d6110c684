"""The site: no link leads nowhere, no page asks anybody for anything, and nothing that is no site of
ours is written over."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

from program import SOURCE, made_of_the_web

SITE = os.path.join(SOURCE, "web", "site.sh")
# The module of this build runs the notebooks.
WITH_MODULE = {**os.environ, "SWIRL_PYTHON": "/usr/bin/python3",
               "PYTHONPATH": os.path.join(os.environ["SWIRL_LIBRARIES"], "python")}
WITHOUT_MODULE = {**os.environ, "SWIRL_PYTHON": "false"}
CHROMIUM = shutil.which("chromium")

BROWSER = """
import {chromium} from "playwright-core";
import {pathToFileURL} from "node:url";
const [executablePath, ...files] = process.argv.slice(2);
const browser = await chromium.launch({executablePath, args: ["--no-sandbox", "--disable-gpu",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--allow-file-access-from-files"]});
const page = await browser.newPage({viewport: {width: 360, height: 740}});
const complaints = [];
page.on("pageerror", (error) => complaints.push(error.message));
page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) complaints.push(request.url());
});
for (const file of files) {
    await page.goto(pathToFileURL(file).href);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    if (wide > 360) complaints.push(`${file} is ${wide} wide at a width of 360`);
}
await browser.close();
console.log(complaints.join("\\n"));
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
        cls.site = made_of_the_web(cls, SITE, "site", env=WITH_MODULE)
        cls.pages = {}
        for place, _, names in os.walk(cls.site):
            for name in names:
                path = os.path.join(place, name)
                if name.endswith(".html") and path != os.path.join(cls.site, "lab.html"):
                    parsed = Links()
                    with open(path, encoding="utf-8") as opened:
                        parsed.feed(opened.read())
                    cls.pages[path] = parsed

    def test_no_link_leads_nowhere(self):
        checked = 0
        for path, page in self.pages.items():
            for link in page.links:
                parts = urlsplit(link)
                if parts.scheme in ("http", "https", "mailto", "data"):
                    continue
                self.assertEqual(parts.scheme, "", f"{path}: {link}")
                there = os.path.normpath(os.path.join(os.path.dirname(path), unquote(parts.path))) \
                    if parts.path else path
                self.assertTrue(os.path.isfile(there), f"{path}: {link}")
                if parts.fragment and there in self.pages:
                    self.assertIn(unquote(parts.fragment), self.pages[there].names, f"{path}: {link}")
                checked += 1
        self.assertGreater(checked, 500)

    def test_every_document_and_command_has_its_place(self):
        for name in os.listdir(os.path.join(SOURCE, "docs")):
            if name.endswith(".md"):
                page = os.path.join(self.site, "docs", name[:-3] + ".html")
                self.assertTrue(page in self.pages, name)
        with open(os.path.join(self.site, "commands.html"), encoding="utf-8") as opened:
            text = opened.read()
        for command in ("run", "paper", "sweep", "measure", "lab", "site"):
            self.assertIn(f"<h2 id=\"{command}\">swirl {command}</h2>", text)
        self.assertIn("--mu-disc NUMBER", text)

    def test_the_gallery_shows_what_its_commands_make(self):
        with open(os.path.join(SOURCE, "web", "gallery.txt"), encoding="utf-8") as opened:
            lines = [line.strip().split(" | ") for line in opened if not line.startswith("#")]
        with open(os.path.join(self.site, "gallery.html"), encoding="utf-8") as opened:
            text = opened.read()
        self.assertGreater(len([line for line in lines if len(line) == 2]), 5)
        kept = {line[2] for line in lines if len(line) == 3}
        for _, command, *picture in lines:
            if not picture and " movie " in command and not shutil.which("ffmpeg"):
                continue
            self.assertIn(command, text)
            src = picture[0] if picture else f"gallery/{command.split()[-1]}"
            self.assertIn(f'src="{src}"', text)
        # Every picture of the documents is in it.
        of_documents = {f"docs/{name}" for name in os.listdir(os.path.join(SOURCE, "docs"))
                        if name.endswith((".png", ".gif"))}
        self.assertEqual(of_documents - kept, set())

    def test_notebooks_are_read_as_documents(self):
        path = os.path.join(self.site, "examples", "first_steps.ipynb.html")
        self.assertIn(path, self.pages)
        with open(path, encoding="utf-8") as opened:
            text = opened.read()
        self.assertRegex(text, r"<h1[^>]*>First steps")
        self.assertIn("swirl.run(discs=12", text)
        self.assertNotIn("cell_type", text)

    def test_notebooks_show_what_they_print(self):
        for name in sorted(os.listdir(os.path.join(SOURCE, "examples"))):
            if not name.endswith(".ipynb"):
                continue
            with open(os.path.join(self.site, "examples", name + ".html"), encoding="utf-8") as opened:
                text = opened.read()
            self.assertRegex(text, r'<img src="data:image/png;base64,|<figure><svg', name)
            self.assertNotIn("Traceback", text, name)

    def test_only_who_is_asked_to_speaks_to_others(self):
        for path in self.pages:
            with open(path, encoding="utf-8") as opened:
                text = opened.read()
            self.assertNotRegex(text, r"""<(script|link|img|iframe)[^>]+(src|href)=["']https?:""", path)

    def test_the_pages_in_a_browser(self):
        if not CHROMIUM:
            self.skipTest("this test needs chromium")
        script = os.path.join(SOURCE, "web", "node_modules", f".site_test_{os.getpid()}.mjs")
        with open(script, "w", encoding="utf-8") as opened:
            opened.write(BROWSER)
        self.addCleanup(os.remove, script)
        documents = [path for path in sorted(self.pages)
                     if re.search(r"/(index|commands|gallery)\.html$|/docs/", path)]
        done = subprocess.run(["node", script, CHROMIUM, *documents], capture_output=True, text=True,
                              timeout=150)
        self.assertEqual((done.returncode, done.stdout.strip()), (0, ""), done.stderr)

    def test_a_site_is_replaced_and_nothing_else_is(self):
        with tempfile.TemporaryDirectory() as folder:
            site = os.path.join(folder, "site")
            shutil.copytree(self.site, site)
            with open(os.path.join(site, "old.html"), "w", encoding="utf-8") as opened:
                opened.write("of an older site")
            # Notebooks that cannot be run are shown all the same.
            done = subprocess.run([SITE, "--out", site], check=True, capture_output=True, text=True,
                                  env=WITHOUT_MODULE)
            self.assertIn("without what they print", done.stderr)
            self.assertTrue(os.path.exists(os.path.join(site, "examples", "first_steps.ipynb.html")))
            self.assertEqual(os.listdir(folder), ["site"])
            self.assertFalse(os.path.exists(os.path.join(site, "old.html")))
            mine = os.path.join(site, "docs")  # a folder with something in it
            done = subprocess.run([SITE, "--out", mine], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn("not empty and not a site", done.stderr)
            self.assertTrue(os.listdir(mine))

    def test_wrong_calls(self):
        for wrong, said in (([], "needs --out"), (["--out"], "--out needs a value"),
                            (["--to", "x"], "'--to'"),
                            (["--out", "x", "--report", "/nowhere"], "no report.html")):
            done = subprocess.run([SITE, *wrong], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, wrong)
            self.assertIn(said, done.stderr)


if __name__ == "__main__":
    unittest.main()
