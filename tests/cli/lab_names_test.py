"""`swirl lab --out` writes where it says, and builds the page once. The tests run web/lab.sh in a
small tree like a fresh clone, with stand-ins for the tools of a build."""

import os
import shutil
import subprocess
import unittest

from program import HANG, SOURCE, InFolder, read_text, write_text

# Programs in the PATH. npm runs in the folder web; its build is counted.
PROGRAMS = {
    "cmake": 'case $1 in --build) echo engine | tee "$2/dish.wasm" >"$2/swirl.wasm" ;; -S) mkdir -p "$4" ;; esac',
    "zopfli": "echo packed",
    "npm": '[ "$1" != run ] || { echo x >>../builds && mkdir -p ../build/lab && echo dish '
    ">../build/lab/index.html && echo page >../build/lab/laboratory.html; }",
}


class LabNames(InFolder):
    def setUp(self):
        super().setUp()
        for folder in ("clone/web", "clone/bin", "clone/cmake", "elsewhere/inner"):
            os.makedirs(self.path(folder))
        for name in ("web/lab.sh", "cmake/launcher.sh"):
            shutil.copy(os.path.join(SOURCE, name), self.path("clone/" + name))
        open(self.path("clone/packages"), "w").close()
        for name, script in PROGRAMS.items():
            write_text(self.path("clone/bin/" + name), f"#!/bin/sh\n{script}\n")
            os.chmod(self.path("clone/bin/" + name), 0o755)

    def lab(self, out):
        return subprocess.run(
            [self.path("clone/web/lab.sh"), "--out", out],
            cwd=self.path("elsewhere"),
            capture_output=True,
            text=True,
            timeout=HANG,
            env={**os.environ, "PATH": self.path("clone/bin") + ":" + os.environ["PATH"]},
        )

    def test_a_relative_path_is_that_of_the_caller_and_the_page_is_built_once(self):
        before = sorted(os.listdir(self.path("clone/web")))
        absolute = self.path("elsewhere/absolute.html")
        for out, written in (
            ("page.html", "page.html"),
            ("page.html", "page.html"),
            ("inner/page.html", "inner/page.html"),
            ("./inner/../b.html", "b.html"),
            (absolute, "absolute.html"),
        ):
            with self.subTest(out):
                done = self.lab(out)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(read_text(self.path("elsewhere/" + written)), "page\n")
                self.assertEqual(read_text(self.path("clone/builds")), "x\n")
        self.assertEqual(sorted(os.listdir(self.path("clone/web"))), sorted([*before, "generated"]))

    def test_a_folder_gets_both_pages(self):
        for out in ("both/", "both", "inner"):
            with self.subTest(out):
                done = self.lab(out)
                self.assertEqual(done.returncode, 0, done.stderr)
                folder = self.path("elsewhere/" + out)
                self.assertEqual(sorted(os.listdir(folder)), ["index.html", "laboratory.html"])
                self.assertEqual(read_text(os.path.join(folder, "index.html")), "dish\n")
                self.assertEqual(read_text(os.path.join(folder, "laboratory.html")), "page\n")


if __name__ == "__main__":
    unittest.main()
