"""The instructions of packaging/container/Containerfile give an image whose program works. A folder
with a new Debian takes the place of each base image, so no container engine is needed.

Compiles the program once; needs root, mmdebstrap and a mirror."""

import glob
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "cli"))
import debian_root
from program import SOURCE

RELEASES = {"debian:12": "bookworm"}
CONTAINERFILE = os.path.join(SOURCE, "packaging", "container", "Containerfile")


def instructions():
    """The instructions as (word, rest of the line)."""
    with open(CONTAINERFILE) as file:
        lines = [
            line
            for line in file.read().replace("\\\n", " ").splitlines()
            if line and line[0] != "#"
        ]
    return [tuple(line.split(None, 1)) for line in lines]


def copy(source, target):
    """As COPY: a folder's contents, or files by a pattern."""
    if os.path.isdir(source):
        ignored = shutil.ignore_patterns("build", "out", "node_modules", "__pycache__")
        shutil.copytree(source, target, ignore=ignored, symlinks=True, dirs_exist_ok=True)
        return
    os.makedirs(target, exist_ok=True)
    found = glob.glob(source)
    assert found, source
    for name in found:
        shutil.copy(name, target)


class Container(unittest.TestCase):
    def run_in(self, root, *command, inside="/"):
        done = debian_root.run(root, *command, inside=inside)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def built(self, folder):
        """Follows the instructions; returns the root folder of the last image and the entry
        point."""
        stages, root, entry = {}, None, None
        for word, rest in instructions():
            if word == "FROM":
                base, *name = rest.split(" AS ")
                root = os.path.join(folder, f"root{len(stages)}")
                stages[name[0] if name else "last"] = root
                debian_root.create(RELEASES[base], root)
                for file in ("resolv.conf", "hosts"):
                    shutil.copy("/etc/" + file, os.path.join(root, "etc", file))
            elif word == "COPY":
                *options, source, target = rest.split()
                base = stages[options[0].partition("=")[2]] if options else SOURCE
                copy(os.path.join(base, source.lstrip("/")), root + target)
            elif word == "RUN":
                self.run_in(root, "sh", "-c", rest)
            elif word == "WORKDIR":
                os.makedirs(root + rest, exist_ok=True)
            elif word == "ENTRYPOINT":
                entry = json.loads(rest)
            else:
                self.fail(f"unknown instruction {word}")
        return root, entry

    def test_the_image_runs_the_program_and_the_module(self):
        with tempfile.TemporaryDirectory() as folder:
            root, entry = self.built(folder)
            self.assertEqual(entry, ["swirl"])
            shutil.copy(os.path.join(SOURCE, "packaging", "test_installation.py"), root + "/data")
            for command in (
                ["python3", "test_installation.py"],
                ["python3", "test_installation.py", *entry],
            ):
                self.assertIn("expected state hashes", self.run_in(root, *command, inside="/data"))
            self.run_in(
                root,
                *entry,
                "paper",
                "--figure",
                "1b",
                "--quick",
                "--events",
                "2000",
                "--quiet",
                inside="/data",
            )
            self.assertTrue(os.path.exists(root + "/data/out/figure_1b.pdf"))


if __name__ == "__main__":
    if debian_root.what_is_missing():
        print("skipped:", debian_root.what_is_missing())
        sys.exit(77)
    unittest.main()
