"""What a run and a sweep leave behind when the system fails them: the k-th call of each kind fails
once or for ever, the process is killed before its k-th change of a file, or the power goes. Each
time the program says so in a sentence and does not end with 0, or what it left is right, to the bit.
The same of what is made in one go: exports, pictures, measurements, films with their truth, tracks.

    faults_test.py          a sample of all that, for the default suite
    faults_test.py --all    every k, all errors, and 200 power cuts; prints a table
"""

import errno
import glob
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "cli"))
from program import SWIRL  # noqa: E402

SHIM = os.environ["SWIRL_FAULTS"]
EVERY = "--all" in sys.argv

RUN = ["run", "--discs", "8", "--events", "3000", "--seed", "3", "--warmup", "2", "--frames", "60",
       "--trajectory", "t.h5", "--log-events", "e.h5", "--json", "r.json", "--checkpoint-every",
       "0.001", "--quiet"]
SWEEP = ["sweep", "--discs", "5:8", "--events", "300", "--threads", "1", "--frames", "4", "--out",
         "s", "--quiet"]
# Of a recording in.h5, or of a film in.mp4, each in a folder that no fault touches.
OUTPUTS = [["export", "IN/in.h5", "--to", "gsd", "--out", "o.gsd", "--quiet"],
           ["export", "IN/in.h5", "--to", "vtp", "--range", "0:3", "--out", "o.pvd", "--quiet"],
           ["image", "IN/in.h5", "--size", "64x64", "--out", "o.svg", "--quiet"],
           ["measure", "IN/in.h5", "--measure", "slip", "--json", "o.json", "--quiet"]]
FILM = ["synthetic-video", "--discs", "16", "--container-radius", "6.5", "--scale", "12", "--width", "240",
        "--height", "240", "--frames-per-period", "40", "--length", "1.2", "--quiet", "--out"]
FILMS = [["synthetic-video", "--discs", "3", "--frames", "4", "--width", "64", "--height", "64", "--scale", "3",
          "--quiet", "--out", "o.mp4"],
         ["track", "IN/in.mp4", "--quiet", "--out", "o.h5"],
         ["track", "IN/in.mp4", "--quiet", "--out", "o.csv"]]
CALLS = ("open", "read", "pwrite", "fsync", "truncate", "rename", "unlink", "close")
BEFORE_MAIN = 80  # so many of the first calls of new at most; nobody is there who could say anything
PAGE = 4096


def tell(line):
    """A line of the table, at once: the whole of it may take an hour."""
    print(line, flush=True)


def setting(call, at, error=0, **more):
    return {"LD_PRELOAD": SHIM, "FAULT_CALL": call, "FAULT_AT": str(at), "FAULT_ERRNO": str(error),
            **more}


class Faults(unittest.TestCase):
    def setUp(self):
        place = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
        self._folder = tempfile.TemporaryDirectory(prefix="swirl-faults-", dir=place)
        self.addCleanup(self._folder.cleanup)
        self.folder = self._folder.name
        self.work = os.path.join(self.folder, "work")
        self.choose = random.Random(1)

    def swirl(self, *arguments, **environment):
        return subprocess.run([SWIRL, *arguments], cwd=self.work, capture_output=True, text=True,
                              timeout=120, stdin=subprocess.DEVNULL,
                              env={**os.environ, "NO_COLOR": "1", **environment})

    def anew(self):
        shutil.rmtree(self.work, ignore_errors=True)
        os.mkdir(self.work)

    def count(self, call, arguments):
        """How many calls of a kind there are when nothing fails."""
        self.anew()
        count = os.path.join(self.folder, "count")
        done = self.swirl(*arguments, FAULT_UNDER=self.folder, FAULT_COUNT=count,
                          **setting(call, 0))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(count) as opened:
            return int(opened.read())

    def some(self, numbers, most):
        numbers = list(numbers)
        if EVERY or len(numbers) <= most:
            return numbers
        return sorted(self.choose.sample(numbers, most))

    # --- what is right -----------------------------------------------------------------------------

    def absolute(self, arguments):
        """Names under the folder that the shim watches."""
        return [os.path.join(self.work, a) if a in ("t.h5", "e.h5", "r.json", "s") or a.startswith("o.")
                else a.replace("IN", self.folder) for a in arguments]

    def result(self):
        with open(os.path.join(self.work, "r.json")) as opened:
            found = json.load(opened)
        for of_the_call in ("seconds", "events_per_second", "command"):
            del found[of_the_call]
        return found

    def assert_right(self, where):
        """The three files of the run are those of a run that nothing happened to."""
        self.assertEqual(self.result(), self.wanted, where)
        for name in ("t.h5", "e.h5"):
            with open(os.path.join(self.work, name), "rb") as opened:
                if opened.read() == self.bytes.get(name):
                    continue  # flushed at the same moments, so to the byte
            done = self.swirl("verify", name)
            self.assertEqual(done.returncode, 0, f"{where}: {name}: {done.stderr}")
            self.assertNotIn("not finished", done.stdout)

    def assert_right_sweep(self, where):
        table = self.swirl("collect", "s", "--csv", "-")
        self.assertEqual((table.returncode, table.stdout), (0, self.wanted_table), where)
        for file in glob.glob(os.path.join(self.work, "s/trajectories/*.h5")):
            done = self.swirl("verify", file)
            self.assertEqual(done.returncode, 0, f"{where}: {file}: {done.stderr}")

    def undisturbed(self):
        self.anew()
        self.run_call = self.absolute(RUN)
        done = self.swirl(*self.run_call)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.wanted, self.bytes = self.result(), {}
        for name in ("t.h5", "e.h5"):
            with open(os.path.join(self.work, name), "rb") as opened:
                self.bytes[name] = opened.read()

    def undisturbed_sweep(self):
        self.anew()
        self.sweep_call = self.absolute(SWEEP)
        done = self.swirl(*self.sweep_call)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.wanted_table = self.swirl("collect", "s", "--csv", "-").stdout

    def assert_said(self, done, where):
        """One sentence, after the warnings of a run that was done, and no crash."""
        self.assertIn(done.returncode, (1, 2), f"{where}: {done.stderr}")
        said = [line for line in done.stderr.splitlines(keepends=True)
                if not line.startswith(("warning: ", "hint: "))]
        self.assertTrue("".join(said).startswith("error: "), f"{where}: {done.stderr}")

    def fail_each(self, arguments, assert_right, most, assert_harmless=lambda where: None):
        for call in CALLS:
            calls, said, right = self.count(call, arguments), 0, 0
            for error, ever in ((errno.ENOSPC, "0"), (errno.EIO, "1"), (errno.EIO, "0"))[
                    :3 if EVERY else 2]:
                for k in self.some(range(1, calls + 1), most):
                    where = f"{call} {k} of {calls}, {errno.errorcode[error]}, for ever: {ever}"
                    with self.subTest(where):
                        self.anew()
                        done = self.swirl(*arguments, FAULT_UNDER=self.folder, FAULT_EVER=ever,
                                          FAULT_LOSE="1", **setting(call, k, error))
                        if done.returncode == 0:
                            assert_right(where)
                            right += 1
                            continue
                        self.assert_said(done, where)
                        assert_harmless(where)
                        said += 1
            tell(f"{arguments[0]}, {call} fails: {calls} places, {said + right} tried, "
                 f"{said} said so, {right} right all the same")

    def fail_memory(self, call, only_reads_the_call, assert_right, most):
        calls, said, right, silent = self.count("new", call), 0, 0, 0
        while_the_call_is_read = self.count("new", only_reads_the_call)
        for k in [*self.some(range(1, while_the_call_is_read), most // 3),
                  *self.some(range(while_the_call_is_read, calls + 1), most)]:
            where = f"new {k} of {calls}"
            with self.subTest(where):
                self.anew()
                done = self.swirl(*call, **setting("new", k, errno.ENOMEM))
                if k <= BEFORE_MAIN and done.returncode == -signal.SIGABRT:
                    silent += 1
                elif done.returncode == 0:
                    assert_right(where)
                    right += 1
                else:
                    self.assert_said(done, where)
                    said += 1
        tell(f"{call[0]}, new fails: {calls} places, {said + right + silent} tried, {said} said "
             f"so, {right} right all the same, {silent} before main()")

    def files(self):
        """What stands under a final name in the work folder."""
        found = {}
        for folder, _, names in os.walk(self.work):
            for name in names:
                if not name.endswith((".partial", ".journal")):
                    with open(os.path.join(folder, name), "rb") as opened:
                        found[os.path.relpath(os.path.join(folder, name), self.work)] = opened.read()
        return found

    def output(self, call):
        self.anew()
        call = self.absolute(call)
        done = self.swirl(*call)
        if "no camera support" in done.stderr:
            self.skipTest("this build has no camera support")
        self.assertEqual(done.returncode, 0, done.stderr)
        return call, self.files()

    def fail_output(self, call, most):
        """Calls fail one by one: told, and then nothing else than the right thing stands anywhere."""
        call, wanted = self.output(call)

        def assert_whole(where):
            self.assertEqual({name: bytes == wanted.get(name) for name, bytes in self.files().items()},
                             {name: True for name in wanted}, where)

        def assert_nothing_else(where):
            for name, found in self.files().items():
                self.assertEqual(found, wanted.get(name), f"{where}: {name}")

        self.fail_each(call, assert_whole, most, assert_nothing_else)

    def kill_output(self, call, most):
        call, wanted = self.output(call)

        def assert_clean(where):
            self.assertEqual(self.files(), wanted, where)
            left = [name for _, _, names in os.walk(self.work) for name in names
                    if name.endswith((".partial", ".journal"))]
            self.assertEqual(left, [], where)

        # What is complete already is not made again by who asks before he overwrites.
        self.kill_each(call, call, assert_clean, most, lambda: self.files() == wanted)

    # --- the tests ---------------------------------------------------------------------------------

    def test_a_call_that_fails_in_a_run_is_told_or_does_no_harm(self):
        self.undisturbed()
        self.fail_each(self.run_call, self.assert_right, 5)

    def test_memory_that_is_not_given_in_a_run_is_told_or_does_no_harm(self):
        self.undisturbed()
        self.fail_memory(self.run_call, [*self.run_call, "--dry-run"], self.assert_right, 15)

    def test_memory_that_is_not_given_in_a_sweep_is_told_or_does_no_harm(self):
        self.undisturbed_sweep()
        self.fail_memory(self.sweep_call, ["--version"], self.assert_right_sweep, 8)

    def record_one(self):
        self.anew()
        done = self.swirl("run", "--discs", "8", "--events", "300", "--frames", "4", "--quiet",
                          "--trajectory", os.path.join(self.folder, "in.h5"))
        self.assertEqual(done.returncode, 0, done.stderr)

    def film_one(self):
        if shutil.which("ffmpeg") is None:
            self.skipTest("this test needs ffmpeg")
        self.anew()
        done = self.swirl(*FILM, os.path.join(self.folder, "in.mp4"))
        self.assertEqual(done.returncode, 0, done.stderr)

    def replace_output(self, old, new, most):
        """Killed while it takes the place of another: no file stands beside one that belongs to another."""
        _, before = self.output(old)
        call, after = self.output([*new, "--overwrite"])
        self.assertEqual(set(before), set(after))
        calls = self.count("change", call)
        for k in self.some(range(1, calls + 1), most):
            self.anew()
            for name, content in before.items():
                with open(os.path.join(self.work, name), "wb") as opened:
                    opened.write(content)
            self.swirl(*call, FAULT_UNDER=self.folder, **setting("change", k))
            found = self.files()
            mixed = [[name for name, content in found.items() if content != of[name]]
                     for of in (before, after)]
            self.assertIn([], mixed, f"{new[0]} killed before change {k} of {calls}")
            done = self.swirl(*call)
            self.assertEqual((done.returncode, self.files()), (0, after), done.stderr)
        tell(f"{new[0]} --overwrite, killed before a change: {calls} places, nothing mixed")

    def test_killed_while_files_that_belong_together_are_replaced_they_are_not_mixed(self):
        self.film_one()
        self.replace_output(FILMS[0], [*FILMS[0], "--seed", "2"], 4)
        self.replace_output(FILMS[2], [*FILMS[2], "--frames", "40"], 4)

    def test_a_call_that_fails_while_something_is_made_of_a_recording(self):
        self.record_one()
        for call in OUTPUTS:
            self.fail_output(call, 1)

    def test_killed_before_a_change_of_a_file_an_output_is_made_by_the_same_call(self):
        self.record_one()
        for call in OUTPUTS:
            self.kill_output(call, 2)

    def test_a_call_that_fails_while_a_film_is_made_or_tracked(self):
        self.film_one()
        for call in FILMS if EVERY else FILMS[:2]:
            self.fail_output(call, 1)

    def test_killed_before_a_change_of_a_file_film_and_tracks_are_made_by_the_same_call(self):
        self.film_one()
        for call in FILMS if EVERY else FILMS[1:]:
            self.kill_output(call, 2)

    def test_a_call_that_fails_in_a_sweep_is_told_or_does_no_harm(self):
        self.undisturbed_sweep()
        self.fail_each(self.sweep_call, self.assert_right_sweep, 3)

    def kill_each(self, call, again, assert_clean, most, is_complete=lambda: False):
        """Killed before each of its changes of a file, and called again."""
        calls = self.count("change", call)
        tried = self.some(range(1, calls + 1), most)
        for k in tried:
            where = f"{call[0]} killed before change {k} of {calls}"
            self.anew()
            self.swirl(*call, FAULT_UNDER=self.folder, **setting("change", k))
            if not is_complete():
                done = self.swirl(*again)
                self.assertEqual(done.returncode, 0, f"{where}: {done.stderr}")
            assert_clean(where)
        tell(f"{call[0]}, killed before a change: {calls} places, {len(tried)} tried, all resumed")

    def test_killed_before_a_change_of_a_file_the_run_is_resumed_to_the_same_bits(self):
        def assert_clean(where):
            self.assert_right(where)
            left = [name for name in os.listdir(self.work) if name not in self.bytes]
            self.assertEqual([n for n in left if n.endswith((".partial", ".journal"))], [], where)

        self.undisturbed()
        self.kill_each(self.run_call, [*self.run_call, "--resume"], assert_clean, 20)

    def test_killed_before_a_change_of_a_file_the_sweep_goes_on_to_the_same_bits(self):
        def assert_clean(where):
            self.assert_right_sweep(where)
            self.assertEqual(glob.glob(os.path.join(self.work, "s/**/*.partial"), recursive=True)
                             + glob.glob(os.path.join(self.work, "s/checkpoints/*")), [], where)

        self.undisturbed_sweep()
        self.kill_each(self.sweep_call, self.sweep_call, assert_clean, 8)

    def cut_power(self, call, again, assert_right, few, most_refused):
        """The power goes at any moment, and it is called again. Resumes, or says why not."""
        self.anew()
        record = os.path.join(self.folder, "record")
        done = self.swirl(*call, FAULT_UNDER=self.work, FAULT_RECORD=record, **setting("none", 0))
        self.assertEqual(done.returncode, 0, done.stderr)
        entries = read_record(record)
        cuts, refused = 200 if EVERY else few, 0
        for cut in range(cuts):
            at = self.choose.randrange(len(entries))
            where = f"power cut {cut} of a {call[0]}, after {at} of {len(entries)} entries"
            self.anew()
            disk_after(entries[:at], self.choose).write(self.work)
            done = self.swirl(*again)
            if done.returncode != 0:
                self.assert_said(done, where)
                refused += 1
                continue
            assert_right(where)
        tell(f"{call[0]}, power cut: {cuts} tried, {cuts - refused} resumed, {refused} refused")
        self.assertLess(refused, most_refused(cuts))

    def test_after_a_power_cut_the_run_is_resumed_to_the_same_bits_or_refused(self):
        self.undisturbed()
        self.cut_power(self.run_call, [*self.run_call, "--resume"], self.assert_right, 20,
                       lambda cuts: cuts / 10)

    def test_after_a_power_cut_the_sweep_goes_on_to_the_same_bits_or_is_refused(self):
        self.undisturbed_sweep()
        self.cut_power(self.sweep_call, self.sweep_call, self.assert_right_sweep, 8,
                       lambda cuts: max(2, cuts / 10))


# --- what a disk holds after a power cut -----------------------------------------------------------

def read_record(path):
    """What the shim wrote: (letter, offset or size, path, second path, bytes)."""
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
            content[len(content):] = bytes(max(0, at + len(piece) - len(content)))
            content[at:at + len(piece)] = piece

    def sync(self):
        for change in self.pending:
            self.apply(self.durable, change)
        self.pending = []

    def after_the_cut(self, choose, kept):
        content = bytearray(self.durable)
        for change in self.pending:
            if choose.random() < kept:
                self.apply(content, change)
        return bytes(content)


class Disk:
    """Names and contents, each as far as they are on the disk, and what has changed since."""

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
                self.names[one].pending.append((a + begin, content[begin:begin + PAGE]))
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
        """Names change in order, so some of the last changes are missing; pages in any order."""
        for change in self.changes[:choose.randint(0, len(self.changes))]:
            self.rename(self.durable_names, change)
        kept = choose.choice((0.0, 0.3, 0.7, 1.0))
        self.content = {name: inode.after_the_cut(choose, kept)
                        for name, inode in self.durable_names.items()}

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
