"""`swirl site` replaces a complete site by a complete site, even if it is interrupted between its
two renames. The tests run web/site.sh in a small tree with stand-ins for its tools, among them an
interrupted `mv`."""

import fcntl
import os
import shutil
import subprocess
import unittest

from program import HANG, SOURCE, InFolder, read_text, write_text

# Programs in the PATH. The last argument of sphinx-build is the output folder.
PROGRAMS = {
    "web/lab.sh": 'for a; do :; done; mkdir -p "$a"; for p in index laboratory; do '
    'echo \'<meta charset="utf-8"><a href="index.html">\' >"$a$p.html"; done',
    "bin/sphinx-build": '[ -z "${FAIL-}" ] || exit 1\nfor a; do :; done\n'
    'echo "$PAGE${SWIRL_SITE_ADDRESS:+ at $SWIRL_SITE_ADDRESS}" >"$a/index.html"',
    # Call number AT sends SIGNAL to the calling shell, before or after its rename.
    "bin/mv": """count=$(($(cat "$COUNT" 2>/dev/null || echo 0) + 1))
echo $count >"$COUNT"
if [ "$count.$WHEN" = "$AT.before" ]; then kill -"$SIGNAL" $PPID; fi
[ "$count.$WHEN.$SIGNAL" = "$AT.before.KILL" ] || /bin/mv "$@"
if [ "$count.$WHEN" = "$AT.after" ]; then kill -"$SIGNAL" $PPID; fi""",
    "bin/swirl": "echo help",
}


class SiteNames(InFolder):
    def setUp(self):
        super().setUp()
        for folder in ("web", "bin", "cmake", "examples"):
            os.mkdir(self.path(folder))
        shutil.copy(os.path.join(SOURCE, "web/site.sh"), self.path("web/site.sh"))
        shutil.copy(os.path.join(SOURCE, "cmake/launcher.sh"), self.path("cmake/launcher.sh"))
        for empty in ("packages", "web/gallery.txt", "web/site.py", "web/notebooks.py"):
            open(self.path(empty), "w").close()
        for name, script in PROGRAMS.items():
            write_text(self.path(name), f"#!/bin/sh\n{script}\n")
            os.chmod(self.path(name), 0o755)
        os.mkdir(self.path("out"))
        self.site = self.path("out/site")

    def make(self, page, *options, **more):
        if os.path.exists(self.path("count")):
            os.remove(self.path("count"))
        settings = {"AT": "0", "WHEN": "", "SIGNAL": "", **more}
        return subprocess.run(
            [self.path("web/site.sh"), "--out", self.site, *options],
            capture_output=True,
            text=True,
            timeout=HANG,
            env={
                **os.environ,
                **settings,
                "PAGE": page,
                "COUNT": self.path("count"),
                "SWIRL": self.path("bin/swirl"),
                "SWIRL_PYTHON": "false",
                "PATH": self.path("bin") + ":" + os.environ["PATH"],
            },
        )

    def page(self):
        return read_text(os.path.join(self.site, "index.html")).strip()

    def test_a_stop_at_a_rename_leaves_the_old_or_the_new_site(self):
        everywhere = [("TERM", at, when) for at in ("1", "2") for when in ("before", "after")]
        for signal, at, when in [*everywhere, ("INT", "2", "before"), ("HUP", "2", "before")]:
            with self.subTest(signal=signal, at=at, when=when):
                self.assertEqual(self.make("old").returncode, 0)
                self.make("new", SIGNAL=signal, AT=at, WHEN=when)
                self.assertIn(self.page(), ("old", "new"))
                self.assertEqual(os.listdir(self.path("out")), ["site"])

    def test_a_kill_at_a_rename_loses_nothing(self):
        for at in ("1", "2"):
            for when in ("before", "after"):
                with self.subTest(at=at, when=when):
                    self.assertEqual(self.make("old").returncode, 0)
                    self.make("new", SIGNAL="KILL", AT=at, WHEN=when)
                    # The next call restores the old site, even if that call fails.
                    self.assertEqual(self.make("newer", FAIL="1").returncode, 1)
                    self.assertIn(self.page(), ("old", "new"))
                    done = self.make("newer")
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertEqual(self.page(), "newer")
                    self.assertEqual(os.listdir(self.path("out")), ["site"])

    def test_an_address_makes_the_site_known_to_search_engines_and_link_previews(self):
        os.makedirs(self.path("docs/images"))
        write_text(self.path("docs/images/lab_preview.png"), "picture")
        self.assertEqual(self.make("page", "--address", "https://example.org/swirl").returncode, 0)
        read = lambda name: open(
            os.path.join(self.site, name), encoding="utf-8"
        ).read()  # noqa: E731
        at = "https://example.org/swirl/"
        self.assertEqual(
            read("sitemap.txt"), f"{at}index.html\n{at}lab.html\n{at}laboratory.html\n"
        )
        self.assertEqual(read("robots.txt"), f"Sitemap: {at}sitemap.txt\n")
        for page in ("lab.html", "laboratory.html"):
            for tag in (
                f'<link rel="canonical" href="{at}{page}">',
                f'<meta property="og:image" content="{at}preview.png">',
                '<a href="lab.html">',
            ):
                self.assertIn(tag, read(page))
        self.assertEqual(read("preview.png"), "picture")
        self.assertEqual(
            self.page(), f"page at {at}"
        )  # docs/conf.py makes the tags of the documentation
        self.assertEqual(self.make("page").returncode, 0)
        self.assertFalse({"sitemap.txt", "robots.txt", "preview.png"} & set(os.listdir(self.site)))
        self.assertNotIn("canonical", read("lab.html"))
        for wrong in (
            "example.org",
            "https://",
            "https://example.org/a b",
            "https://example.org/'><script>",
        ):
            done = self.make("page", "--address", wrong)
            self.assertEqual(done.returncode, 2, wrong)
            self.assertIn("--address is", done.stderr)

    def test_a_site_in_progress_of_another_call_is_not_touched(self):
        self.assertEqual(self.make("old").returncode, 0)
        other = self.site + ".partial.a1B2c3"
        os.makedirs(os.path.join(other, "notebooks"))
        holder = os.open(other, os.O_RDONLY)
        fcntl.flock(holder, fcntl.LOCK_EX)
        self.assertEqual(self.make("new").returncode, 0)
        self.assertEqual(sorted(os.listdir(self.path("out"))), ["site", "site.partial.a1B2c3"])
        os.close(holder)
        self.assertEqual(self.make("new").returncode, 0)
        self.assertEqual(os.listdir(self.path("out")), ["site"])


if __name__ == "__main__":
    unittest.main()
