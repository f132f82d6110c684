"""Calling the program under test, for the tests in this folder."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

SWIRL = os.environ.get("SWIRL", "build/tests/swirl")
SOURCE = os.environ.get("SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__)))))

# What the program prints when it fails: one sentence, and what to do about it if there is a remedy.
ONE_ERROR = r"\Aerror: [^\n]+\.\n(hint: [^\n]+\n)?\Z"


def swirl(*arguments, timeout=100, **more):
    """Runs the program to its end; .returncode, .stdout and .stderr (text)."""
    environment = dict(os.environ, NO_COLOR="1", **more.pop("environment", {}))
    return subprocess.run([SWIRL, *map(str, arguments)], capture_output=True, text=True,
                          timeout=timeout, env=environment, stdin=subprocess.DEVNULL, **more)


def result_of(*arguments):
    """The JSON of a run that must succeed."""
    done = swirl("run", *arguments, "--json", "-", "--quiet")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def without_time(file):
    """The result of a run, but for what is of the call that made it."""
    with open(file) as opened:
        result = json.load(opened)
    for of_the_call in ("seconds", "events_per_second", "command"):
        del result[of_the_call]
    return result


def made_of_the_web(test_class, script, name, **more):
    """What a script of web/ writes for all tests of a class: its place, gone when they have ended. Without
    the tools that takes, the test says so and is skipped."""
    if not all(shutil.which(tool) for tool in ("clang++-19", "node", "npm")):
        print("skipped: this test needs clang-19 with wasi-libc, Node.js and npm")
        sys.exit(77)
    folder = tempfile.TemporaryDirectory()
    test_class.addClassCleanup(folder.cleanup)
    place = os.path.join(folder.name, name)
    done = subprocess.run([script, "--out", place], capture_output=True, text=True, **more)
    if done.returncode:
        raise RuntimeError(done.stderr[-4000:])
    return place


class InFolder(unittest.TestCase):
    """A test with an empty folder of its own, self.folder; with in_memory on no disk, where that is
    possible: a kill leaves the same behind, and nobody waits for what brings it onto the disk."""

    in_memory = False

    def setUp(self):
        place = "/dev/shm" if self.in_memory and os.access("/dev/shm", os.W_OK) else None
        self._folder = tempfile.TemporaryDirectory(prefix="swirl-test-", dir=place)
        self.folder = self._folder.name
        self.addCleanup(self._folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder, name)

    def left_behind(self):
        return sorted(os.listdir(self.folder))
