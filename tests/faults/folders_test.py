"""Any few files of a folder are damaged: what the program then advises makes every file as in the
undisturbed folder.

Up to three files of a folder that can be continued are removed, cut off, or exchanged with a file
of the same kind. The same calls are made again; if they end with an error, its hint says which file
to remove. In a second test, a call that continues such a folder gets an error from the system when
it opens, reads or examines a file: it ends with an error, or it makes the right files, and the next
call makes them in any case. In a third test, the process that makes a folder is killed before it
changes a file: the repeated call makes the right files, and leaves no other.

    folders_test.py          40 damaged folders, 40 faults and 20 kills, for the default suite
    folders_test.py --all    500 damaged folders with a new seed each day, every fault and every
                             kill
"""

import errno
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from folder_kinds import (
    KINDS,
    STOPPED,
    continuing,
    files_of,
    is_superseded,
    write_inputs,
)  # noqa: E402
from program import HANG, SOURCE, SWIRL, folder_in_memory  # noqa: E402

SHIM = os.environ["SWIRL_FAULTS"]
EVERY = "--all" in sys.argv
SEED = int(time.time() // 86400) if EVERY else 1
DAMAGES = 500 if EVERY else 40
FAULTS = 10**6 if EVERY else 40
KILLS = 10**6 if EVERY else 20
MOST_CALLS = 12  # an error names one damaged file, and the calls are made again after it
ERRORS = (errno.EIO, errno.ESTALE, errno.EMFILE)

OPTIONS = {"collect": [], "run": ["--quiet"]}  # of all calls of these commands

PAPER = """
import sys
sys.path.insert(0, sys.argv[1])
from paper import study

def ratio(parameters):
    return {"ratio": parameters["seed"] / 3}

settings = study.Settings(quick=True, events=300, out=sys.argv[2], threads=1)
short = {"discs": 5, "periods": 3, "warmup": 1}
points = [study.Point(settings, "plain", 3, short), study.Point(settings, "measured", 2, short, ("slip",)),
          study.Point(settings, "more", 2, {**short, "discs": 6}, ("slip",)),
          study.Point(settings, "ratio", 2, short, work=ratio)]
try:
    study.make(points, settings)
except (study.swirl.Failure, study.swirl.FileError, OSError) as error:
    sys.exit(f"error: {error}")
if reason := study.broken(points):
    sys.exit(f"error: {reason}")
print([point.result for point in points])
"""


def run(call, folder, inputs, **environment):
    """Ends with its exit code; the paper's runs are made by a Python script."""
    call = [part.replace("FOLDER", folder).replace("INPUT", inputs) for part in call]
    if call[0] == "paper":
        words = ["/usr/bin/python3", "-B", "-c", PAPER, SOURCE, folder]
    else:
        words = [SWIRL, *call, *OPTIONS.get(call[0], ["--threads", "1", "--quiet"])]
    return subprocess.run(
        words,
        capture_output=True,
        text=True,
        timeout=HANG,
        stdin=subprocess.DEVNULL,
        env={**os.environ, "NO_COLOR": "1", **environment},
    )


def counted(call, folder, inputs):
    """An undisturbed call, and its numbers of calls of the system for each kind."""
    with tempfile.NamedTemporaryFile(mode="r", encoding="utf-8") as count:
        done = run(
            call,
            folder,
            inputs,
            LD_PRELOAD=SHIM,
            FAULT_UNDER=folder,
            FAULT_COUNT=count.name,
            FAULT_CALL="none",
            FAULT_AT="0",
        )
        assert done.returncode == 0, (call, done.stderr)
        return done, {
            name: int(number) for name, number in map(str.split, count.read().splitlines())
        }


class Folders(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="swirl-folders-", dir=folder_in_memory())
        cls.addClassCleanup(holder.cleanup)
        cls.top = holder.name
        cls.inputs = os.path.join(cls.top, "in")
        os.mkdir(cls.inputs)
        write_inputs(cls.inputs)
        cls.copy = os.path.join(cls.top, "folder")
        cls.whole, cls.expected, cls.printed, cls.changes = {}, {}, {}, {}
        for kind, calls in KINDS.items():
            # At the path of the copies, since some files contain it.
            os.mkdir(cls.copy)
            cls.changes[kind] = []
            for call in calls:
                done, counts = counted(call, cls.copy, cls.inputs)
                cls.changes[kind].append(counts["change"])
            cls.expected[kind], cls.printed[kind] = files_of(cls.copy), done.stdout
            if kind in STOPPED:
                shutil.rmtree(cls.copy)
                os.mkdir(cls.copy)
                run(
                    calls[0],
                    cls.copy,
                    cls.inputs,
                    LD_PRELOAD=SHIM,
                    FAULT_UNDER=cls.copy,
                    FAULT_CALL="write",
                    FAULT_AT=str(STOPPED[kind]),
                    FAULT_SIGNAL=str(int(signal.SIGTERM)),
                )
                left = files_of(cls.copy)
                assert any(name.endswith(".checkpoint") for name in left), left.keys()
            cls.whole[kind] = os.path.join(cls.top, kind)
            os.rename(cls.copy, cls.whole[kind])

    def setUp(self):
        self.choose = random.Random(SEED)

    def copy_of(self, kind):
        shutil.rmtree(self.copy, ignore_errors=True)
        return shutil.copytree(self.whole[kind], self.copy)

    def repaired(self, kind, folder):
        """Makes the calls until all end without an error; removes the file that an error's hint
        names."""
        calls = list(continuing(kind, folder))
        for _ in range(MOST_CALLS):
            done = run(calls[0], folder, self.inputs)
            if done.returncode == 0:
                del calls[0]
            elif "--resume" in calls[0] and re.search(r"hint: .*--overwrite", done.stderr):
                calls[0] = [word.replace("--resume", "--overwrite") for word in calls[0]]
            elif self.removed_as_advised(done.stderr, folder) == "plan.json":
                calls = list(KINDS[kind])
            if not calls:
                self.assertEqual(done.stdout, self.printed[kind])
                return
        self.fail(f"no end: {done.stderr}")

    def removed_as_advised(self, error, folder):
        quoted = rf"({re.escape(folder)}/[^']*)'"
        named = re.search(rf"hint: remove '{quoted}", error)
        if not named:
            named = re.search(rf"error: (?:'|.*? '){quoted}", error)
            self.assertTrue(named and re.search(r"hint: .*\bremove it\b", error), error)
        os.remove(named[1])
        return os.path.relpath(named[1], folder)

    def damage(self, folder, name):
        """Removes, cuts or exchanges one file. Returns the words for the message."""
        path = os.path.join(folder, name)
        others = sorted(
            other
            for other in os.listdir(os.path.dirname(path))
            if other != os.path.basename(path)
            and other.endswith(os.path.splitext(name)[1])
            and os.path.isfile(os.path.join(os.path.dirname(path), other))
        )
        what = self.choose.choice(("remove", "cut", "exchange") if others else ("remove", "cut"))
        if what == "remove":
            os.remove(path)
        elif what == "cut":
            size = self.choose.randrange(os.path.getsize(path))
            os.truncate(path, size)
            what = f"cut to {size}"
        else:
            other = os.path.join(os.path.dirname(path), self.choose.choice(others))
            os.rename(path, path + ".x")
            os.rename(other, path)
            os.rename(path + ".x", other)
            what = f"exchange with {os.path.basename(other)}"
        return f"{name}: {what}"

    def test_any_few_damaged_files_are_repaired(self):
        # The folder of the paper takes longest, since Python starts.
        kinds = [kind for kind in KINDS for _ in range(1 if kind == "paper" else 3)]
        for number in range(DAMAGES):
            kind = kinds[number % len(kinds)]
            with self.subTest(number=number, kind=kind, seed=SEED):
                folder = self.copy_of(kind)
                names = sorted(
                    name
                    for name, content in files_of(folder).items()
                    if content and not is_superseded(kind, name)
                )
                harm = []
                for name in self.choose.sample(names, self.choose.randint(1, 3)):
                    if os.path.exists(os.path.join(folder, name)) and os.path.getsize(
                        os.path.join(folder, name)
                    ):
                        harm.append(self.damage(folder, name))
                with self.subTest(harm=harm):
                    self.repaired(kind, folder)
                    self.assert_undisturbed(kind, folder)

    def assert_undisturbed(self, kind, folder):
        found = files_of(folder)
        self.assertEqual(sorted(found), sorted(self.expected[kind]))
        for name, content in found.items():
            if name.endswith(".h5") and content != self.expected[kind][name]:
                # A commit at another moment gives other bytes with the same frames.
                done = subprocess.run(
                    [SWIRL, "verify", os.path.join(folder, name)], capture_output=True, text=True
                )
                self.assertIn("bitwise identical", done.stdout, f"{name}: {done.stderr}")
                continue
            self.assertEqual(content, self.expected[kind][name], name)

    def test_a_file_that_cannot_be_read_is_not_absent(self):
        cases = []
        for kind in KINDS:
            folder = self.copy_of(kind)
            for number, call in enumerate(continuing(kind, folder)):
                _, counts = counted(call, folder, self.inputs)
                cases += [
                    (kind, number, kind_of_call, at)
                    for kind_of_call in ("open", "read", "stat")
                    for at in range(1, counts[kind_of_call] + 1)
                ]
        chosen = cases if len(cases) <= FAULTS else self.choose.sample(cases, FAULTS)
        for kind, number, call, at in chosen:
            error = self.choose.choice(ERRORS)
            folder = self.copy_of(kind)
            faulted = continuing(kind, folder)[number]
            with self.subTest(
                kind=kind, call=faulted[:2], fails=f"{call} {at}", error=errno.errorcode[error]
            ):
                for earlier in continuing(kind, folder)[:number]:
                    run(earlier, folder, self.inputs)  # which complete the folder of a stopped call
                done = run(
                    faulted,
                    folder,
                    self.inputs,
                    LD_PRELOAD=SHIM,
                    FAULT_UNDER=folder,
                    FAULT_CALL=call,
                    FAULT_AT=str(at),
                    FAULT_ERRNO=str(error),
                )
                if done.returncode == 0:
                    # A folder of a stopped call has no files of the later calls.
                    for later in continuing(kind, folder)[number + 1 :]:
                        self.assertEqual(run(later, folder, self.inputs).returncode, 0)
                    self.assert_undisturbed(kind, folder)
                else:
                    self.assertRegex(done.stderr, r"(?m)^(error: |\w*Error: )")
                self.repaired(kind, folder)
                self.assert_undisturbed(kind, folder)

    def test_a_killed_call_leaves_nothing_after_its_repetition(self):
        # A worker of the paper's pool that is killed is waited for. stored_runs_test.py has its
        # temporary files.
        cases = [
            (kind, number, at)
            for kind, counts in self.changes.items()
            if kind != "paper"
            for number, count in enumerate(counts)
            for at in range(1, count + 1)
        ]
        for kind, number, at in cases if len(cases) <= KILLS else self.choose.sample(cases, KILLS):
            calls = KINDS[kind]
            with self.subTest(kind=kind, call=calls[number][:2], before_change=at):
                shutil.rmtree(self.copy, ignore_errors=True)
                os.mkdir(self.copy)
                for call in calls[:number]:
                    run(call, self.copy, self.inputs)
                run(
                    calls[number],
                    self.copy,
                    self.inputs,
                    LD_PRELOAD=SHIM,
                    FAULT_UNDER=self.copy,
                    FAULT_CALL="change",
                    FAULT_AT=str(at),
                    FAULT_ERRNO="0",
                )
                for call in calls[number:]:
                    done = run(call, self.copy, self.inputs)
                    self.assertEqual(done.returncode, 0, done.stderr)
                self.assert_undisturbed(kind, self.copy)


if __name__ == "__main__":
    unittest.main(argv=[argument for argument in sys.argv if argument != "--all"])
