"""Helpers that call the program under test, and read and write files."""

import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

SWIRL = os.environ.get("SWIRL", "build/tests/swirl")
SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)
# Seconds that no call lasts, on a busy machine either. The hour of ctest is longer, so that a
# message names the call.
HANG = 3000

# A script called with --all runs complete, as in the suite `slow` (tests/CMakeLists.txt). Without
# it, it omits tests that take long and whose code the others cover too.
ALL = "--all" in sys.argv


def all_scenes():
    """The scenes of tests/scenes.json: names and values of parameters."""
    with open(os.path.join(SOURCE, "tests", "scenes.json"), encoding="utf-8") as file:
        return json.load(file)


def text_of(value):
    """The text of a parameter; a list is one value with colons."""
    return ":".join(map(str, value)) if isinstance(value, list) else str(value)


def slow(reason):
    """Decorator: the test belongs to the suite `slow`, for this reason."""
    return unittest.skipUnless(ALL, "in the suite slow: " + reason)


def some(cases, count):
    """All cases with --all, else the first ones."""
    return list(cases)[: None if ALL else count]


def main():
    unittest.main(argv=[argument for argument in sys.argv if argument != "--all"])


# The output of a failed call: one error message, and a hint if there is a remedy.
ONE_ERROR = r"\Aerror: [^\n]+\.\n(hint: [^\n]+\n)?\Z"


def swirl(*arguments, timeout=HANG, **more):
    """Runs the program to its end. Returns an object with returncode, stdout and stderr (text)."""
    environment = dict(os.environ, NO_COLOR="1", **more.pop("environment", {}))
    return subprocess.run(
        [SWIRL, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=timeout,
        env=environment,
        stdin=subprocess.DEVNULL,
        **more,
    )


# Commands that tests and other commands call; no help lists them.
HIDDEN = ("synthetic-video",)


def commands():
    """The names in the list of `swirl --help`."""
    listed = swirl("--help").stdout.partition("Examples:")[0]
    return re.findall(r"^  ([a-z][a-z-]*)  ", listed, re.M)


def help_of(name):
    """The help of a command with all of its options."""
    return swirl("help", name, "all").stdout


def described_options(text):
    """(name, description) of each option in a help text; wrapped lines are joined."""
    found = []
    for line in text[: text.index("Examples:")].splitlines():
        option = re.match(r"  (--[a-z-]+)\b(?:\S| (?! ))*(?:  +(\S.*))?$", line)
        if option:
            found.append([option[1], option[2] or ""])
        elif found and re.match(r" {20,}\S", line):
            found[-1][1] = (found[-1][1] + " " + line.strip()).strip()
        elif not line.startswith("  "):
            found.append(["", ""])  # a heading: later lines do not belong to the option before
    return [(name, text) for name, text in found if name]


def wait_until(happens, process=None):
    """Waits until happens() is true. Fails if the process ends before."""
    begin = time.monotonic()
    while not happens():
        if process is not None and process.poll() is not None:
            raise AssertionError(f"the program ended before, with exit code {process.returncode}")
        if time.monotonic() - begin > HANG:
            raise AssertionError(f"did not happen in {HANG} seconds")
        time.sleep(0.005)


def processor_seconds(pid):
    """Processor time of all threads of a process; None if it has ended."""
    try:
        fields = read_text(f"/proc/{pid}/stat").rsplit(")", 1)[1].split()
    except FileNotFoundError:
        return None
    if fields[0] == "Z":
        return None
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def worked(process, seconds):
    """Waits until a process has used that much processor time, on a busy machine, too; False if it
    ended before."""
    while (used := processor_seconds(process.pid)) is not None:
        if used >= seconds:
            return True
        time.sleep(0.005)
    return False


def other_user(program="true"):
    """Arguments of subprocess that choose the user nobody, if this process is root. Skips the test
    if there is none in this namespace, or if that user cannot start `program`."""
    user = {"user": 65534, "group": 65534, "extra_groups": []} if os.getuid() == 0 else {}
    try:
        subprocess.run([program, "--version"], capture_output=True, cwd="/", **user)
    except PermissionError as error:
        raise unittest.SkipTest(f"no other user can run '{program}'") from error
    return user


def read_text(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def read_bytes(path):
    with open(path, "rb") as file:
        return file.read()


def read_json(path):
    return json.loads(read_text(path))


# Keys of results whose option has another name (tests/run/nearest_name_test.cpp compares them).
OPTION_OF_KEY = read_json(os.path.join(SOURCE, "web/src/texts/option_of_key.json"))


def option_of(key):
    return "--" + OPTION_OF_KEY.get(key, key).replace("_", "-")


def options(scene):
    """The options of the command line for a scene."""
    return [word for name, value in scene.items() for word in (option_of(name), text_of(value))]


def read_rows(path):
    """The rows of a table with a header, as dictionaries."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def write_text(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def result_of(*arguments):
    """The JSON of a run. Fails if the run fails."""
    done = swirl("run", *arguments, "--json", "-", "--quiet")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def without_time(file):
    """The result of a run without the keys that differ between equal runs."""
    result = read_json(file)
    for key in ("seconds", "events_per_second", "command"):
        del result[key]
    return result


def made_of_the_web(test_class, script, name, before=(), arguments=(), **more):
    """Runs a script of web/ for all tests of a class and returns its output, a file or a folder
    that contained the empty files `before`; self.warnings is its standard error. Skips the tests if
    clang or Node.js is missing."""
    if not all(shutil.which(tool) for tool in ("clang++-19", "node", "npm")):
        print("skipped: this test needs clang-19 with wasi-libc, Node.js and npm")
        sys.exit(77)
    folder = tempfile.TemporaryDirectory()
    test_class.addClassCleanup(folder.cleanup)
    output = os.path.join(folder.name, name)
    for file in before:
        os.makedirs(output, exist_ok=True)
        open(os.path.join(output, file), "w", encoding="utf-8").close()
    done = subprocess.run(
        [script, "--out", output, *arguments], capture_output=True, text=True, **more
    )
    if done.returncode:
        raise RuntimeError(done.stderr[-4000:])
    test_class.warnings = done.stderr
    return output


def folder_in_memory():
    """The parent for temporary folders: in memory, where no call waits for the disk; the files
    after a kill are the same. None, the usual parent, if that memory is small, as in most
    containers, or forbids programs."""
    memory = "/dev/shm"
    if not os.access(memory, os.W_OK) or os.statvfs(memory).f_flag & os.ST_NOEXEC:
        return None
    return memory if shutil.disk_usage(memory).free > 2e9 else None


class ProgramTest(unittest.TestCase):
    def assert_works(self, *call, **more):
        done = swirl(*call, **more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def assert_fails(self, code, *call, says=(), **more):
        """The call ends with this exit code and one error message, perhaps after warnings and lines
        of progress, which slow machines get; standard error contains `says`, a text or several."""
        done = swirl(*call, **more)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        before = r"\A(warning: [^\n]+\n(hint: [^\n]+\n)?|[^\n]+ %, [^\n]+ left\n)+"
        self.assertRegex(re.sub(before, "", done.stderr), ONE_ERROR)
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, done.stderr)
        return done


class InFolder(ProgramTest):
    """A test with an empty temporary folder, self.folder."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(prefix="swirl-test-", dir=folder_in_memory())
        self.folder = self._folder.name
        self.addCleanup(self._folder.cleanup)

    def shared(self, name, make):
        """The path of a copy of `name`, a file or folder that make(path) writes once for all tests
        of the class."""
        test = type(self)
        if "store" not in test.__dict__:
            test.store = tempfile.TemporaryDirectory(prefix="swirl-test-", dir=folder_in_memory())
            test.addClassCleanup(test.store.cleanup)
        made = os.path.join(test.store.name, name)
        if not os.path.exists(made):
            make(made)
        (shutil.copytree if os.path.isdir(made) else shutil.copy)(made, self.path(name))
        return self.path(name)

    def edit_hdf5(self, file, code):
        """Changes an HDF5 file by Python code in which `f` is the open file. Skips the test if
        there is no h5py."""
        try:
            import h5py
            import numpy
        except ImportError:
            self.skipTest("h5py is not installed; Debian's package python3-h5py provides it.")
        with h5py.File(self.path(file), "r+") as f:
            exec(
                code,
                {
                    "f": f,
                    "particles": f.get("particles/trajectory"),
                    "h5py": h5py,
                    "np": numpy,
                    "nan": numpy.nan,
                    "inf": numpy.inf,
                },
            )

    def path(self, name):
        return os.path.join(self.folder, name)

    def left_behind(self):
        return sorted(os.listdir(self.folder))
