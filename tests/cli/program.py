"""Helpers that call the program under test."""

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

# A script called with --all runs complete, as in the suite `slow` (tests/CMakeLists.txt). Without it, it omits
# tests that take long and whose code the others cover too.
ALL = "--all" in sys.argv


def slow(reason):
    """Decorator: the test belongs to the suite `slow`, for this reason."""
    return unittest.skipUnless(ALL, "in the suite slow: " + reason)


def some(cases, count):
    """All cases with --all, else the first ones."""
    return list(cases)[:None if ALL else count]


def main():
    unittest.main(argv=[argument for argument in sys.argv if argument != "--all"])


# The output of a failed call: one error message, and a hint if there is a remedy.
ONE_ERROR = r"\Aerror: [^\n]+\.\n(hint: [^\n]+\n)?\Z"


def swirl(*arguments, timeout=150, **more):
    """Runs the program to its end. Returns an object with returncode, stdout and stderr (text)."""
    environment = dict(os.environ, NO_COLOR="1", **more.pop("environment", {}))
    return subprocess.run([SWIRL, *map(str, arguments)], capture_output=True, text=True,
                          timeout=timeout, env=environment, stdin=subprocess.DEVNULL, **more)


def result_of(*arguments):
    """The JSON of a run. Fails if the run fails."""
    done = swirl("run", *arguments, "--json", "-", "--quiet")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def without_time(file):
    """The result of a run without the keys that differ between equal runs."""
    with open(file) as opened:
        result = json.load(opened)
    for key in ("seconds", "events_per_second", "command"):
        del result[key]
    return result


def made_of_the_web(test_class, script, name, **more):
    """Runs a script of web/ for all tests of a class and returns the folder of its output, which is removed
    after the tests. Skips the tests if clang or Node.js is missing."""
    if not all(shutil.which(tool) for tool in ("clang++-19", "node", "npm")):
        print("skipped: this test needs clang-19 with wasi-libc, Node.js and npm")
        sys.exit(77)
    folder = tempfile.TemporaryDirectory()
    test_class.addClassCleanup(folder.cleanup)
    output = os.path.join(folder.name, name)
    done = subprocess.run([script, "--out", output], capture_output=True, text=True, **more)
    if done.returncode:
        raise RuntimeError(done.stderr[-4000:])
    return output


def folder_in_memory():
    """The parent for temporary folders in memory. None, the usual parent, if the system has none."""
    return "/dev/shm" if os.access("/dev/shm", os.W_OK) else None


class InFolder(unittest.TestCase):
    """A test with an empty temporary folder, self.folder. With in_memory it is in /dev/shm if possible: the
    files after a kill are the same, and no call waits for the disk."""

    in_memory = False

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(
            prefix="swirl-test-", dir=folder_in_memory() if self.in_memory else None)
        self.folder = self._folder.name
        self.addCleanup(self._folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder, name)

    def left_behind(self):
        return sorted(os.listdir(self.folder))
