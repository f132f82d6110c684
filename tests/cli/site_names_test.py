"""`swirl site` replaces a whole site by a whole one, whatever comes between its two names: web/site.sh in a
tree of its own, whose pages are made in a moment, with an `mv` that is interrupted."""

import os
import shutil
import subprocess
import unittest

from program import SOURCE, InFolder

# Each is a program in the PATH; of the arguments of node the second is the folder of the pages.
PROGRAMS = {
    "web/lab.sh": 'for a; do case $a in *.html) echo lab >"$a" ;; esac; done',
    "bin/node": '[ -z "${FAIL-}" ] || exit 1\necho "$PAGE" >"$3/index.html"\necho 1 pages',
    # The k-th call is told, or ends, the shell that called it: before it has done anything, or after.
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
        for empty in ("packages", "web/gallery.txt", "web/site.mjs", "web/notebooks.py"):
            open(self.path(empty), "w").close()
        for name, script in PROGRAMS.items():
            with open(self.path(name), "w", encoding="utf-8") as opened:
                opened.write(f"#!/bin/sh\n{script}\n")
            os.chmod(self.path(name), 0o755)
        os.mkdir(self.path("out"))
        self.site = self.path("out/site")

    def make(self, page, **more):
        if os.path.exists(self.path("count")):
            os.remove(self.path("count"))
        settings = {"AT": "0", "WHEN": "", "SIGNAL": "", **more}
        return subprocess.run([self.path("web/site.sh"), "--out", self.site], capture_output=True, text=True,
                              timeout=60, env={**os.environ, **settings, "PAGE": page,
                                               "COUNT": self.path("count"), "SWIRL": self.path("bin/swirl"),
                                               "SWIRL_PYTHON": "false",
                                               "PATH": self.path("bin") + ":" + os.environ["PATH"]})

    def page(self):
        with open(os.path.join(self.site, "index.html"), encoding="utf-8") as opened:
            return opened.read().strip()

    def test_stopped_at_a_name_it_is_the_old_site_or_the_new_one(self):
        everywhere = [("TERM", at, when) for at in ("1", "2") for when in ("before", "after")]
        for signal, at, when in [*everywhere, ("INT", "2", "before"), ("HUP", "2", "before")]:
            with self.subTest(signal=signal, at=at, when=when):
                self.assertEqual(self.make("old").returncode, 0)
                self.make("new", SIGNAL=signal, AT=at, WHEN=when)
                self.assertIn(self.page(), ("old", "new"))
                self.assertEqual(os.listdir(self.path("out")), ["site"])

    def test_killed_at_a_name_nothing_is_lost(self):
        for at in ("1", "2"):
            for when in ("before", "after"):
                with self.subTest(at=at, when=when):
                    self.assertEqual(self.make("old").returncode, 0)
                    self.make("new", SIGNAL="KILL", AT=at, WHEN=when)
                    # The next call, even one that comes to nothing, brings back what was there.
                    self.assertEqual(self.make("newer", FAIL="1").returncode, 1)
                    self.assertIn(self.page(), ("old", "new"))
                    done = self.make("newer")
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertEqual(self.page(), "newer")
                    self.assertEqual(os.listdir(self.path("out")), ["site"])

    def test_a_site_that_another_call_is_making_is_left_alone(self):
        self.assertEqual(self.make("old").returncode, 0)
        theirs = self.site + ".a1B2c3.partial"
        os.mkdir(theirs)
        with subprocess.Popen(["flock", os.path.join(theirs, "lock"), "sleep", "60"]) as holder:
            while not os.path.exists(os.path.join(theirs, "lock")):
                self.assertIsNone(holder.poll())
            self.assertEqual(self.make("new").returncode, 0)
            self.assertEqual(sorted(os.listdir(self.path("out"))), ["site", "site.a1B2c3.partial"])
            holder.terminate()


if __name__ == "__main__":
    unittest.main()
