"""Faults of the system during a run, a sweep and other commands: the k-th call of each kind fails
once or always, the process is killed before its k-th change of a file, or the power is cut. In each
case either the program reports an error, or its files are bitwise identical to those of an
undisturbed run.

    faults_test.py          a sample of these, for the default suite
    faults_test.py --all    every k, all errors, and 200 power cuts; prints a table
"""

import errno
import glob
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from folder_kinds import files_of  # noqa: E402
from program import HANG, HIDDEN, SWIRL, commands  # noqa: E402

SHIM = os.environ["SWIRL_FAULTS"]
EVERY = "--all" in sys.argv

RUN = [
    "run",
    "--discs",
    "8",
    "--events",
    "3000",
    "--seed",
    "3",
    "--warmup",
    "2",
    "--frames-per-period",
    "60",
    "--trajectory",
    "t.h5",
    "--log-events",
    "e.h5",
    "--json",
    "r.json",
    "--checkpoint-every",
    "0.001",
    "--quiet",
]
SWEEP = [
    "sweep",
    "--discs",
    "5:8",
    "--events",
    "300",
    "--threads",
    "1",
    "--frames-per-period",
    "4",
    "--out",
    "s",
    "--quiet",
]
# Commands that read a recording in.h5 or a video in.mp4, which are in a folder without faults.
OUTPUTS = [
    ["export", "IN/in.h5", "--format", "gsd", "--out", "o.gsd", "--quiet"],
    ["export", "IN/in.h5", "--format", "vtp", "--range", "0:3", "--out", "o.pvd", "--quiet"],
    ["image", "IN/in.h5", "--size", "64x64", "--out", "o.svg", "--quiet"],
    ["measure", "IN/in.h5", "--measure", "slip", "--json", "o.json", "--quiet"],
]
VIDEO_CALL = [
    "synthetic-video",
    "--discs",
    "6",
    "--container-radius",
    "4.5",
    "--scale",
    "9",
    "--width",
    "130",
    "--height",
    "130",
    "--frames-per-period",
    "24",
    "--periods",
    "1.2",
    "--quiet",
    "--out",
]
VIDEO_CALLS = [
    [
        "synthetic-video",
        "--discs",
        "3",
        "--frame-count",
        "4",
        "--width",
        "64",
        "--height",
        "64",
        "--scale",
        "3",
        "--quiet",
        "--out",
        "o.mp4",
    ],
    ["track", "IN/in.mp4", "--quiet", "--out", "o.h5"],
    ["track", "IN/in.mp4", "--quiet", "--out", "o.csv"],
]
# The other commands that write files, and the other kinds of outputs. IN has a sweep and a table,
# too.
DISH = [
    "dish",
    "--container-radius",
    "60mm",
    "--radius",
    "8mm",
    "--amplitude",
    "15mm",
    "--rpm",
    "78",
    "--quiet",
]
SHORT = ["--periods", "3", "--warmup", "1", "--quiet", "--out", "s"]
FURTHER = [
    [*DISH, "--no-search", "--json", "o.json"],
    ["collect", "IN/sweep", "--csv", "o.csv", "--crossings", "o.crossings"],
    ["measure", "IN/in.h5", "--measure", "density", "--tables", "o.tables", "--quiet"],
    ["image", "IN/in.h5", "--size", "64x64", "--out", "o.png", "--quiet"],
    ["movie", "IN/in.h5", "--size", "64x64", "--periods", "0.1", "--out", "o.mp4", "--quiet"],
    [
        "movie",
        "IN/in.h5",
        "--size",
        "64x64",
        "--periods",
        "0.1",
        "--frame-files",
        "o.frames",
        "--quiet",
    ],
]
# These draw figures or track a video, and take seconds.
LONGER = [
    [*DISH, "--my-points", "IN/points.csv", "--mu", "0.2,0.5", "--replicates", "1", *SHORT],
    [
        "crossing",
        "--mu",
        "0.5,1",
        "--from",
        "4",
        "--to",
        "7",
        "--events",
        "300",
        "--tolerance",
        "2",
        "--plot",
        "--csv",
        "o.csv",
        "--json",
        "o.json",
        "--threads",
        "1",
        "--quiet",
        "--out",
        "s",
    ],
    [
        "map",
        "--x",
        "mu=0:1",
        "--steps",
        "3",
        "--discs",
        "5",
        "--replicates",
        "2",
        "--threads",
        "1",
        *SHORT,
    ],
    [
        "track",
        "IN/in.mp4",
        "--out",
        "o.csv",
        "--overlay",
        "o.overlay.mp4",
        "--report",
        "o.report",
        "--json",
        "o.json",
        "--quiet",
    ],
    ["experiment", "IN/in.mp4", "--replicates", "1", *SHORT],
]
WITHOUT_KILLS = {
    "camera": "synthetic-video writes its video, and is killed",
    "verify": "writes no file",
    "paper": "waits for a process of its pool that is killed; stored_runs_test.py kills it",
}
CALLS = ("open", "read", "pwrite", "fsync", "truncate", "rename", "unlink", "close")
BEFORE_MAIN = 80  # upper limit of the calls of new before main(), where no error can be reported
PAGE = 4096


def report(line):
    """Prints a line of the table at once, since the whole table may take an hour."""
    print(line, flush=True)


def setting(call, at, error=0, **more):
    return {
        "LD_PRELOAD": SHIM,
        "FAULT_CALL": call,
        "FAULT_AT": str(at),
        "FAULT_ERRNO": str(error),
        **more,
    }


class Faults(unittest.TestCase):
    def setUp(self):
        parent = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
        self._folder = tempfile.TemporaryDirectory(prefix="swirl-faults-", dir=parent)
        self.addCleanup(self._folder.cleanup)
        self.folder = self._folder.name
        self.work = os.path.join(self.folder, "work")
        self.choose = random.Random(1)
        self.counted = {}  # by arguments

    def swirl(self, *arguments, **environment):
        return subprocess.run(
            # The program of the command, without the one that becomes it.
            [f"{SWIRL}-{arguments[0]}", *arguments[1:]],
            cwd=self.work,
            capture_output=True,
            text=True,
            timeout=HANG,
            stdin=subprocess.DEVNULL,
            env={**os.environ, "NO_COLOR": "1", **environment},
        )

    def empty_work_folder(self):
        shutil.rmtree(self.work, ignore_errors=True)
        os.mkdir(self.work)

    def count(self, call, arguments):
        """The number of calls of a kind in an undisturbed run, which counts those of all kinds."""
        if (known := self.counted.get(tuple(arguments))) is None:
            self.empty_work_folder()
            count = os.path.join(self.folder, "count")
            done = self.swirl(
                *arguments, FAULT_UNDER=self.folder, FAULT_COUNT=count, **setting("new", 0)
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(count) as opened:
                known = self.counted[tuple(arguments)] = dict(line.split() for line in opened)
        return int(known[call])

    def sample(self, numbers, size):
        numbers = list(numbers)
        if EVERY or len(numbers) <= size:
            return numbers
        return sorted(self.choose.sample(numbers, size))

    # --- expected results
    # --------------------------------------------------------------------------

    def absolute(self, arguments):
        """The arguments with absolute file names, in the folder that the shim watches."""
        return [
            os.path.join(self.work, a)
            if a in ("t.h5", "e.h5", "r.json", "s") or a.startswith("o.")
            else a.replace("IN", self.folder)
            for a in arguments
        ]

    def result(self):
        with open(os.path.join(self.work, "r.json")) as opened:
            found = json.load(opened)
        for of_the_call in ("seconds", "events_per_second", "command"):
            del found[of_the_call]
        return found

    def assert_correct(self, where):
        """The three files of the run have the content of those of an undisturbed run."""
        self.assertEqual(self.result(), self.expected, where)
        for name in ("t.h5", "e.h5"):
            with open(os.path.join(self.work, name), "rb") as opened:
                if opened.read() == self.bytes.get(name):
                    continue  # flushed at the same times, so even the bytes agree
            done = self.swirl("verify", name)
            self.assertEqual(done.returncode, 0, f"{where}: {name}: {done.stderr}")
            self.assertNotIn("unfinished", done.stdout)

    def assert_correct_sweep(self, where):
        table = self.swirl("collect", "s", "--csv", "-")
        self.assertEqual((table.returncode, table.stdout), (0, self.expected_table), where)
        for file in glob.glob(os.path.join(self.work, "s/trajectories/*.h5")):
            done = self.swirl("verify", file)
            self.assertEqual(done.returncode, 0, f"{where}: {file}: {done.stderr}")

    def undisturbed(self):
        self.empty_work_folder()
        self.run_call = self.absolute(RUN)
        done = self.swirl(*self.run_call)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.expected, self.bytes = self.result(), {}
        for name in ("t.h5", "e.h5"):
            with open(os.path.join(self.work, name), "rb") as opened:
                self.bytes[name] = opened.read()

    def undisturbed_sweep(self):
        self.empty_work_folder()
        self.sweep_call = self.absolute(SWEEP)
        done = self.swirl(*self.sweep_call)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.expected_table = self.swirl("collect", "s", "--csv", "-").stdout

    def assert_error_reported(self, done, where):
        """The process did not crash and reported an error, perhaps after warnings."""
        self.assertIn(done.returncode, (1, 2), f"{where}: {done.stderr}")
        errors = [
            line
            for line in done.stderr.splitlines(keepends=True)
            if not line.startswith(("warning: ", "hint: "))
        ]
        self.assertTrue("".join(errors).startswith("error: "), f"{where}: {done.stderr}")

    def fail_each(
        self, arguments, assert_correct, most, assert_harmless=lambda where: None, kinds=CALLS
    ):
        for call in kinds:
            calls, reported, right = self.count(call, arguments), 0, 0
            for error, ever in ((errno.ENOSPC, "0"), (errno.EIO, "1"), (errno.EIO, "0"))[
                : 3 if EVERY else 2
            ]:
                for k in self.sample(range(1, calls + 1), most):
                    where = f"{call} {k} of {calls}, {errno.errorcode[error]}, always: {ever}"
                    with self.subTest(where):
                        self.empty_work_folder()
                        done = self.swirl(
                            *arguments,
                            FAULT_UNDER=self.folder,
                            FAULT_EVER=ever,
                            FAULT_LOSE="1",
                            **setting(call, k, error),
                        )
                        if done.returncode == 0:
                            assert_correct(where)
                            right += 1
                            continue
                        self.assert_error_reported(done, where)
                        assert_harmless(where)
                        reported += 1
            report(
                f"{arguments[0]}, {call} fails: {calls} calls, {reported + right} tried, "
                f"{reported} reported, {right} correct"
            )

    def fail_memory(self, call, parse_only_call, assert_correct, most):
        calls, reported, right, unreported = self.count("new", call), 0, 0, 0
        while_parsing = self.count("new", parse_only_call)
        for k in [
            *self.sample(range(1, while_parsing), most // 3),
            *self.sample(range(while_parsing, calls + 1), most),
        ]:
            where = f"new {k} of {calls}"
            with self.subTest(where):
                self.empty_work_folder()
                done = self.swirl(*call, **setting("new", k, errno.ENOMEM))
                if k <= BEFORE_MAIN and done.returncode == -signal.SIGABRT:
                    unreported += 1
                elif done.returncode == 0:
                    assert_correct(where)
                    right += 1
                else:
                    self.assert_error_reported(done, where)
                    reported += 1
        report(
            f"{call[0]}, new fails: {calls} calls, {reported + right + unreported} tried, "
            f"{reported} reported, {right} correct, {unreported} before main()"
        )

    def files(self):
        """The content of all published files in the work folder."""
        found = {}
        for folder, _, names in os.walk(self.work):
            for name in names:
                if not name.endswith((".partial", ".journal")):
                    with open(os.path.join(folder, name), "rb") as opened:
                        found[
                            os.path.relpath(os.path.join(folder, name), self.work)
                        ] = opened.read()
        return found

    def output(self, call):
        self.empty_work_folder()
        call = self.absolute(call)
        done = self.swirl(*call)
        if "no camera support" in done.stderr:
            self.skipTest("this build has no camera support")
        self.assertEqual(done.returncode, 0, done.stderr)
        return call, self.files()

    def fail_output(self, call, most, kinds=CALLS):
        """System calls fail one by one: an error is reported, and no published file has wrong
        content."""
        call, wanted = self.output(call)

        def assert_whole(where):
            self.assertEqual(
                {name: bytes == wanted.get(name) for name, bytes in self.files().items()},
                {name: True for name in wanted},
                where,
            )

        def assert_nothing_else(where):
            for name, found in self.files().items():
                self.assertEqual(found, wanted.get(name), f"{where}: {name}")

        self.fail_each(call, assert_whole, most, assert_nothing_else, kinds)

    def kill_output(self, call, most):
        call, wanted = self.output(call)

        def assert_clean(where):
            self.assertEqual(self.files(), wanted, where)
            left = [
                name
                for _, _, names in os.walk(self.work)
                for name in names
                if name.endswith((".partial", ".journal"))
            ]
            self.assertEqual(left, [], where)

        # Commands that refuse to overwrite are not repeated if the output is complete.
        self.kill_each(call, call, assert_clean, most, lambda: self.files() == wanted)

    # --- the tests
    # ---------------------------------------------------------------------------------

    def test_failing_calls_in_a_run_are_reported_or_harmless(self):
        self.undisturbed()
        self.fail_each(self.run_call, self.assert_correct, 3)

    def test_failing_allocations_in_a_run_are_reported_or_harmless(self):
        self.undisturbed()
        self.fail_memory(self.run_call, [*self.run_call, "--dry-run"], self.assert_correct, 9)

    def test_failing_allocations_in_a_sweep_are_reported_or_harmless(self):
        self.undisturbed_sweep()
        self.fail_memory(self.sweep_call, ["sweep", "--help"], self.assert_correct_sweep, 6)

    def record_one(self):
        self.empty_work_folder()
        done = self.swirl(
            "run",
            "--discs",
            "8",
            "--events",
            "300",
            "--frames-per-period",
            "4",
            "--quiet",
            "--trajectory",
            os.path.join(self.folder, "in.h5"),
        )
        self.assertEqual(done.returncode, 0, done.stderr)

    def video_one(self):
        if shutil.which("ffmpeg") is None:
            self.skipTest("this test needs ffmpeg")
        self.empty_work_folder()
        done = self.swirl(*VIDEO_CALL, os.path.join(self.folder, "in.mp4"))
        self.assertEqual(done.returncode, 0, done.stderr)

    def replace_output(self, old, new, most):
        """Killed while it replaces files that belong together: old and new files are never
        mixed."""
        _, before = self.output(old)
        call, after = self.output([*new, "--overwrite"])
        self.assertEqual(set(before), set(after))
        calls = self.count("change", call)
        for k in self.sample(range(1, calls + 1), most):
            self.empty_work_folder()
            for name, content in before.items():
                with open(os.path.join(self.work, name), "wb") as opened:
                    opened.write(content)
            self.swirl(*call, FAULT_UNDER=self.folder, **setting("change", k))
            found = self.files()
            mixed = [
                [name for name, content in found.items() if content != of[name]]
                for of in (before, after)
            ]
            self.assertIn([], mixed, f"{new[0]} killed before change {k} of {calls}")
            done = self.swirl(*call)
            self.assertEqual((done.returncode, self.files()), (0, after), done.stderr)
        report(f"{new[0]} --overwrite, killed before a change: {calls} calls, nothing mixed")

    def test_a_kill_does_not_mix_old_and_new_files(self):
        self.video_one()
        self.replace_output(VIDEO_CALLS[0], [*VIDEO_CALLS[0], "--seed", "2"], 4 if EVERY else 2)
        if EVERY:
            self.replace_output(VIDEO_CALLS[2], [*VIDEO_CALLS[2], "--max-frames", "27"], 2)

    def test_failing_calls_while_a_recording_is_processed(self):
        self.record_one()
        for call in OUTPUTS:
            self.fail_output(call, 1)

    def test_commands_on_a_recording_succeed_after_a_kill(self):
        self.record_one()
        for call in OUTPUTS:
            self.kill_output(call, 2)

    def test_failing_calls_while_a_video_is_made_or_tracked(self):
        # Each call decodes or encodes a video. The sample has the kinds of calls that change files;
        # the reading ones are those of the other commands.
        self.video_one()
        for call in VIDEO_CALLS if EVERY else VIDEO_CALLS[:1]:
            self.fail_output(call, 1, CALLS if EVERY else ("pwrite", "rename"))

    def test_video_commands_succeed_after_a_kill(self):
        self.video_one()
        for call in VIDEO_CALLS if EVERY else VIDEO_CALLS[1:2]:
            self.kill_output(call, 1)

    def inputs(self):
        self.record_one()
        with open(os.path.join(self.folder, "points.csv"), "w", encoding="utf-8") as file:
            file.write("N,turns,circles\n8,3,10\n12,-2,10\n")
        done = self.swirl(
            "sweep",
            "--discs",
            "4:6",
            "--replicates",
            "2",
            "--events",
            "300",
            "--quiet",
            "--out",
            os.path.join(self.folder, "sweep"),
        )
        self.assertEqual(done.returncode, 0, done.stderr)

    def kill_and_repeat(self, call, most):
        """The repeated call, with --overwrite if its error asks for that, leaves the files of one
        undisturbed call."""
        call, _ = self.output(call)
        wanted = files_of(self.work)
        self.assertTrue(wanted, call)
        calls = self.count("change", call)
        for k in self.sample(range(1, calls + 1), most):
            self.empty_work_folder()
            self.swirl(*call, FAULT_UNDER=self.folder, **setting("change", k))
            done = self.swirl(*call)
            if "--overwrite" in done.stderr:
                done = self.swirl(*call, "--overwrite")
            with self.subTest(call=call[:2], before_change=k):
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(files_of(self.work), wanted)
        report(f"{call[0]}, killed before a change: {calls} calls, all repeated")

    def test_every_command_that_writes_files_succeeds_after_a_kill(self):
        self.empty_work_folder()
        self.inputs()
        for call in FURTHER:
            self.kill_and_repeat(call, 2)
        if EVERY:
            self.video_one()
            for call in LONGER:
                self.kill_and_repeat(call, 2)

    def test_every_command_that_writes_files_is_killed(self):
        self.empty_work_folder()
        killed = {call[0] for call in [RUN, SWEEP, *OUTPUTS, *VIDEO_CALLS, *FURTHER, *LONGER]}
        self.assertEqual({*commands(), *HIDDEN}, killed | set(WITHOUT_KILLS))

    def test_failing_calls_in_a_sweep_are_reported_or_harmless(self):
        self.undisturbed_sweep()
        self.fail_each(self.sweep_call, self.assert_correct_sweep, 2)

    def kill_each(self, call, again, assert_clean, most, is_complete=lambda: False):
        """Kills the command before each of its changes of a file, and calls it again."""
        calls = self.count("change", call)
        tried = self.sample(range(1, calls + 1), most)
        for k in tried:
            where = f"{call[0]} killed before change {k} of {calls}"
            self.empty_work_folder()
            self.swirl(*call, FAULT_UNDER=self.folder, **setting("change", k))
            if not is_complete():
                done = self.swirl(*again)
                self.assertEqual(done.returncode, 0, f"{where}: {done.stderr}")
            assert_clean(where)
        report(f"{call[0]}, killed before a change: {calls} calls, {len(tried)} tried, all resumed")

    def test_a_killed_run_resumes_to_the_same_result(self):
        def assert_clean(where):
            self.assert_correct(where)
            left = [name for name in os.listdir(self.work) if name not in self.bytes]
            self.assertEqual([n for n in left if n.endswith((".partial", ".journal"))], [], where)

        self.undisturbed()
        self.kill_each(self.run_call, [*self.run_call, "--resume"], assert_clean, 10)

    def test_a_killed_sweep_continues_to_the_same_result(self):
        def assert_clean(where):
            self.assert_correct_sweep(where)
            self.assertEqual(
                glob.glob(os.path.join(self.work, "s/**/*.partial"), recursive=True)
                + glob.glob(os.path.join(self.work, "s/checkpoints/*")),
                [],
                where,
            )

        self.undisturbed_sweep()
        self.kill_each(self.sweep_call, self.sweep_call, assert_clean, 5)

    def cut_power(self, call, again, assert_correct, few, max_rejected):
        """Cuts the power at random times and calls the command again: it resumes, or reports an
        error."""
        self.empty_work_folder()
        record = os.path.join(self.folder, "record")
        done = self.swirl(*call, FAULT_UNDER=self.work, FAULT_RECORD=record, **setting("none", 0))
        self.assertEqual(done.returncode, 0, done.stderr)
        entries = read_record(record)
        cuts, rejected = 200 if EVERY else few, 0
        for cut in range(cuts):
            at = self.choose.randrange(len(entries))
            where = f"power cut {cut} of a {call[0]}, after {at} of {len(entries)} entries"
            self.empty_work_folder()
            disk_after(entries[:at], self.choose).write(self.work)
            done = self.swirl(*again)
            if done.returncode != 0:
                self.assert_error_reported(done, where)
                rejected += 1
                continue
            assert_correct(where)
        report(
            f"{call[0]}, power cut: {cuts} tried, {cuts - rejected} resumed, {rejected} rejected"
        )
        self.assertLess(rejected, max_rejected(cuts))

    def test_after_a_power_cut_the_run_resumes_to_the_same_result_or_is_rejected(self):
        self.undisturbed()
        self.cut_power(
            self.run_call,
            [*self.run_call, "--resume"],
            self.assert_correct,
            10,
            lambda cuts: max(2, cuts / 10),
        )

    def test_after_a_power_cut_the_sweep_continues_to_the_same_result_or_is_rejected(self):
        self.undisturbed_sweep()
        self.cut_power(
            self.sweep_call,
            self.sweep_call,
            self.assert_correct_sweep,
            5,
            lambda cuts: max(2, cuts / 10),
        )


# --- the content of a disk after a power cut
# --------------------------------------------------------


def read_record(path):
    """The entries that the shim recorded: (letter, offset or size, path, second path, bytes)."""
    entries = []
    with open(path, "rb") as opened:
        while line := opened.readline():
            what, a, size, one, two = line.rstrip(b"\n").split(b"\t")
            content = opened.read(int(size)) if what == b"w" else b""
            entries.append((what.decode(), int(a), one.decode(), two.decode(), content))
    return entries


class Inode:
    def __init__(self):
        self.durable, self.pending = bytearray(), []

    def apply(self, content, change):
        at, piece = change
        if piece is None:
            content[:] = content[:at].ljust(at, b"\0")
        else:
            content[len(content) :] = bytes(max(0, at + len(piece) - len(content)))
            content[at : at + len(piece)] = piece

    def sync(self):
        for change in self.pending:
            self.apply(self.durable, change)
        self.pending = []

    def after_the_cut(self, choose, share):
        content = bytearray(self.durable)
        for change in self.pending:
            if choose.random() < share:
                self.apply(content, change)
        return bytes(content)


class Disk:
    """Names and contents: what is on the disk, and the changes since."""

    def __init__(self):
        self.names, self.durable_names, self.changes = {}, {}, []

    def change_name(self, change):
        self.changes.append(change)
        self.rename(self.names, change)

    @staticmethod
    def rename(names, change):
        what, one, two, inode = change
        if what == "c":
            names[one] = inode
        elif what == "u":
            names.pop(one, None)
        elif one in names:
            names[two] = names.pop(one)

    def add(self, entry):
        what, a, one, two, content = entry
        if what == "c":
            if one not in self.names:
                self.change_name(("c", one, "", Inode()))
        elif what in "ru":
            self.change_name((what, one, two, None))
        elif what == "w":
            for begin in range(0, len(content), PAGE):
                self.names[one].pending.append((a + begin, content[begin : begin + PAGE]))
        elif what == "t":
            self.names[one].pending.append((a, None))
        elif what == "S":  # the whole file system
            for inode in self.names.values():
                inode.sync()
            self.names_are_durable()
        elif one in self.names:
            self.names[one].sync()
        else:  # a folder: the names in it
            self.names_are_durable()

    def names_are_durable(self):
        for change in self.changes:
            self.rename(self.durable_names, change)
        self.changes = []

    def cut(self, choose):
        """Some of the last changes of names are lost, and any of the unsynced pages."""
        for change in self.changes[: choose.randint(0, len(self.changes))]:
            self.rename(self.durable_names, change)
        share = choose.choice((0.0, 0.3, 0.7, 1.0))
        self.content = {
            name: inode.after_the_cut(choose, share) for name, inode in self.durable_names.items()
        }

    def write(self, folder):
        for name, content in self.content.items():
            file = os.path.join(folder, os.path.relpath(name, folder))
            os.makedirs(os.path.dirname(file), exist_ok=True)
            with open(file, "wb") as opened:
                opened.write(content)


def disk_after(entries, choose):
    disk = Disk()
    for entry in entries:
        disk.add(entry)
    disk.cut(choose)
    return disk


if __name__ == "__main__":
    unittest.main(argv=[a for a in sys.argv if a != "--all"])
