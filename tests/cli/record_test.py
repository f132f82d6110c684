"""Runs that write files: they are killed, run out of disk space, and are resumed to the same
result."""

import os
import random
import shutil
import signal
import subprocess
import time

from program import (
    ALL,
    HANG,
    SWIRL,
    InFolder,
    main,
    read_json,
    swirl,
    wait_until,
    without_time,
    worked,
    write_text,
)

RUN = [
    "run",
    "--discs",
    "24",
    "--events",
    "100000",
    "--warmup",
    "5",
    "--seed",
    "3",
    "--frames-per-period",
    "120",
    "--checkpoint-every",
    "0.01",
    "--compression",
    "0",
    "--measure",
    "radial,pinned",
]


class Recorded(InFolder):
    def arguments(self, folder):
        os.makedirs(folder, exist_ok=True)
        return [
            *RUN,
            "--trajectory",
            os.path.join(folder, "t.h5"),
            "--log-events",
            os.path.join(folder, "e.h5"),
            "--json",
            os.path.join(folder, "r.json"),
            "--quiet",
            "--resume",
        ]

    def reference(self):
        self.assert_works(*self.arguments(self.path("whole")))
        self.assertEqual(sorted(os.listdir(self.path("whole"))), ["e.h5", "r.json", "t.h5"])
        return without_time(self.path("whole/r.json"))

    def data_of(self, *files):
        """A text for each HDF5 file that identifies its content, independent of the layout of the
        file."""
        dump = subprocess.run(
            [
                "/usr/bin/python3",
                "-c",
                """
import h5py, hashlib, sys
for file in sys.argv[1:]:
    f = h5py.File(file, 'r')
    text = []
    def show(name, x):
        if isinstance(x, h5py.Dataset) and name != 'parameters/command':
            data = x[()].tobytes() if x.shape else bytes(x[()])
            text.append(f'{name} {x.shape} {hashlib.sha256(data).hexdigest()}')
    f.visititems(show)
    print(text, sorted(f['parameters'].attrs.items()))
""",
                *files,
            ],
            capture_output=True,
            text=True,
        )
        if "No module named 'h5py'" in dump.stderr:
            self.skipTest("h5py is not installed; Debian's package python3-h5py provides it.")
        self.assertEqual(dump.returncode, 0, dump.stderr)
        return dump.stdout.splitlines()

    def kill_until_done(self, folder, kills, choose, longest):
        """Kills the run at random times and resumes it until it is complete. Returns the number of
        kills."""
        hits = 0
        for attempt in range(1000):
            process = subprocess.Popen(
                [SWIRL, *self.arguments(folder)],
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                text=True,
            )
            try:
                errors = process.communicate(
                    timeout=choose.uniform(0.001, longest) if hits < kills else HANG
                )[1]
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                hits += 1
                # A published file is complete.
                if os.path.exists(os.path.join(folder, "r.json")):
                    without_time(os.path.join(folder, "r.json"))
                continue
            self.assertEqual(process.returncode, 0, errors)
            return hits
        self.fail("the run was never completed")

    def test_a_run_killed_many_times_ends_with_the_same_result(self):
        begin = time.monotonic()
        whole = self.reference()
        # Kill times cover nearly the whole run, on machines of any speed.
        longest = 0.9 * (time.monotonic() - begin)
        wanted = self.data_of(self.path("whole/t.h5"), self.path("whole/e.h5"))
        choose = random.Random(1)
        # Each kill restarts the program. Ten meet every phase of the run but the renames, which
        # tests/faults covers one by one.
        hits, kills, folders = 0, 50 if ALL else 10, []
        while hits < kills:
            folder = self.path(f"killed{len(folders)}")
            folders.append(folder)
            hits += self.kill_until_done(folder, kills - hits, choose, longest)
            self.assertEqual(without_time(os.path.join(folder, "r.json")), whole)
            left = [f for f in os.listdir(folder) if not f.endswith(".partial")]
            self.assertEqual(sorted(left), ["e.h5", "r.json", "t.h5"])
        found = self.data_of(
            *(f"{folder}/{name}" for folder in folders for name in ("t.h5", "e.h5"))
        )
        self.assertEqual(found, wanted * len(folders))

    def test_verify_reports_the_first_difference_of_result_recording_and_log(self):
        self.reference()
        for name in ("r.json", "t.h5", "e.h5"):
            done = self.assert_works("verify", self.path("whole/" + name))
            self.assertIn("bitwise identical", done.stdout)
        self.edit_hdf5("whole/e.h5", "f['events/normal_impulse'][70000] *= 1 + 2**-52")
        self.edit_hdf5("whole/t.h5", "particles['velocity/value'][1000, 3, 1] *= 1 + 2**-52")
        for name, where in (("e.h5", "event 70000 on"), ("t.h5", "frame 1000 on")):
            self.assert_fails(1, "verify", self.path("whole/" + name), says="differs from " + where)

    def test_an_array_in_place_of_a_text_is_rejected(self):
        self.assert_works(
            "run", "--discs", 5, "--events", 1000, "--trajectory", self.path("t.h5"), "--quiet"
        )
        self.edit_hdf5(
            "t.h5",
            """
text = f['parameters/parameters'][()]
dtype = f['parameters/parameters'].dtype
del f['parameters/parameters']
f.create_dataset('parameters/parameters', data=[text] * 5000, dtype=dtype)
""",
        )
        self.assert_fails(1, "verify", self.path("t.h5"), says="is not a single text")

    def test_a_pipe_without_a_writer_is_rejected(self):
        os.mkfifo(self.path("pipe"))
        for call in (
            ["measure"],
            ["movie", "--out", self.path("m.mp4")],
            ["image", "--out", self.path("p.png")],
            ["verify"],
            ["export", "--format", "xyz"],
            ["track", "--out", self.path("t.csv")],
        ):
            done = swirl(call[0], self.path("pipe"), *call[1:], timeout=HANG)
            self.assertIn(done.returncode, (1, 2), call)
            self.assertRegex(done.stderr, "regular file|video must be a file")

    def stopped_at_its_first_checkpoint(self, arguments, folder, how):
        """Starts a run and sends it a signal at its first checkpoint; exit code and errors."""
        process = subprocess.Popen(
            [SWIRL, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
        checkpoint = os.path.join(folder, "r.json.checkpoint")
        while process.poll() is None and not os.path.exists(checkpoint):
            time.sleep(0.001)
        process.send_signal(how)
        errors = process.communicate(timeout=HANG)[1]
        return process.returncode, errors

    def test_ctrl_c_and_resume(self):
        whole = self.reference()
        for attempt in range(30):  # on a busy machine the run may be over before the signal comes
            folder = self.path(f"f{attempt}")
            code, errors = self.stopped_at_its_first_checkpoint(
                self.arguments(folder), folder, signal.SIGINT if attempt % 2 else signal.SIGTERM
            )
            if code != 0:
                break
        self.assertEqual(code, 130, errors)
        self.assertIn("--resume to continue", errors)
        self.assertFalse(os.path.exists(folder + "/t.h5"))
        # The checkpoint alone contains the parameters and the options of the call.
        self.assert_works(
            "run", "--checkpoint", folder + "/r.json.checkpoint", "--resume", "--quiet"
        )
        self.assertEqual(without_time(folder + "/r.json"), whole)
        self.assertEqual(sorted(os.listdir(folder)), ["e.h5", "r.json", "t.h5"])

    def test_a_damaged_checkpoint_is_rejected(self):
        folder = self.path("f")
        arguments = [a if a != "100000" else "1e9" for a in self.arguments(folder)]
        self.stopped_at_its_first_checkpoint(arguments, folder, signal.SIGKILL)
        checkpoint = os.path.join(folder, "r.json.checkpoint")
        with open(checkpoint, "r+b") as opened:
            opened.seek(700)
            byte = opened.read(1)
            opened.seek(700)
            opened.write(bytes([byte[0] ^ 1]))
        self.assert_fails(1, *arguments, says="is damaged")


class More(InFolder):
    def test_a_finished_run_can_be_extended(self):
        run = ["run", "--discs", 12, "--seed", 5, "--measure", "slip"]
        first = self.assert_works(
            *run, "--events", "1.2e5", "--json", self.path("r.json"), "--keep-checkpoint"
        )
        self.assertIn("--resume with more --events", first.stderr)
        # The checkpoint contains the other options of the call.
        self.assert_works(
            "run",
            "--checkpoint",
            self.path("r.json.checkpoint"),
            "--resume",
            "--events",
            "1.6e5",
            "--quiet",
        )
        self.assert_works(*run, "--events", "1.6e5", "--json", self.path("whole.json"), "--quiet")
        self.assertEqual(without_time(self.path("r.json")), without_time(self.path("whole.json")))
        self.assertEqual(self.left_behind(), ["r.json", "whole.json"])
        # Without a checkpoint the run cannot continue, and it overwrites nothing.
        self.assert_fails(
            1,
            *run,
            "--events",
            "2e5",
            "--json",
            self.path("r.json"),
            "--resume",
            says="already exists",
        )

    def test_a_recorded_run_cannot_be_extended_with_its_recording(self):
        run = [
            "run",
            "--discs",
            12,
            "--json",
            self.path("r.json"),
            "--trajectory",
            self.path("t.h5"),
            "--quiet",
        ]
        self.assert_works(*run, "--events", "1.2e5", "--keep-checkpoint")
        self.assert_fails(
            2,
            *run,
            "--events",
            "1.6e5",
            "--resume",
            says="the length of a recorded run cannot be changed",
        )

    def test_a_recorded_run_can_be_extended_without_its_recording(self):
        run = ["run", "--discs", 12]
        recording = ["--trajectory", self.path("t.h5"), "--log-events", self.path("e.h5")]
        first = self.assert_works(
            *run, *recording, "--events", "1.2e5", "--keep-checkpoint", "--warmup", 10
        )
        checkpoint = self.path("t.h5.checkpoint")
        self.assertIn(
            "the same command without --trajectory and --log-events (a recording has a fixed "
            f"length) and with --checkpoint {checkpoint} --resume with more --events",
            first.stderr,
        )
        more = [*run, "--warmup", 10, "--quiet", "--events"]
        for too_little in ([*more, "1.2e5"], [*more, "1.6e5", "--mu", 0.5]):
            self.assert_fails(
                2,
                *too_little,
                "--checkpoint",
                checkpoint,
                "--resume",
                says="belongs to another run",
            )
        self.assert_works(
            *more, "1.6e5", "--checkpoint", checkpoint, "--resume", "--json", self.path("r.json")
        )
        self.assert_works(*more, "1.6e5", "--json", self.path("whole.json"))
        self.assertEqual(without_time(self.path("r.json")), without_time(self.path("whole.json")))
        self.assertEqual(self.left_behind(), ["e.h5", "r.json", "t.h5", "whole.json"])


class Clock(InFolder):
    """The time of day may jump when a clock is set; the program must not depend on it."""

    JUMPS = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <sys/time.h>
#include <time.h>
static long jump(void) { static long calls; return ++calls % 2 ? 100000 : -100000; }
int clock_gettime(clockid_t clock, struct timespec* t) {
    static int (*real)(clockid_t, struct timespec*);
    if (!real) real = (int (*)(clockid_t, struct timespec*))dlsym(RTLD_NEXT, "clock_gettime");
    const int result = real(clock, t);
    if (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE) t->tv_sec += jump();
    return result;
}
int gettimeofday(struct timeval* t, void* zone) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    t->tv_sec = now.tv_sec;
    t->tv_usec = now.tv_nsec / 1000;
    return 0;
}
time_t time(time_t* to) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (to) *to = now.tv_sec;
    return now.tv_sec;
}
"""

    def jumping(self):
        """An environment in which the time of day jumps by a day at every call."""
        write_text(self.path("jumps.c"), self.JUMPS)
        compiled = subprocess.run(
            [
                "gcc",
                "-shared",
                "-fPIC",
                "-O1",
                "-o",
                self.path("jumps.so"),
                self.path("jumps.c"),
                "-ldl",
            ],
            capture_output=True,
            text=True,
        )
        self.assertEqual(compiled.returncode, 0, compiled.stderr)
        environment = {"LD_PRELOAD": self.path("jumps.so")}
        seen = subprocess.run(
            ["/usr/bin/python3", "-c", "import time; print(abs(time.time() - time.time()) > 1e5)"],
            env={**os.environ, **environment},
            capture_output=True,
            text=True,
        )
        self.assertEqual(seen.stdout, "True\n", "the clock does not jump: " + seen.stderr)
        return environment

    def test_a_run_and_its_checkpoints_ignore_jumps(self):
        environment = self.jumping()
        folder = self.path("f")
        os.mkdir(folder)
        arguments = [
            *RUN,
            "--trajectory",
            folder + "/t.h5",
            "--json",
            folder + "/r.json",
            "--quiet",
        ]
        self.assert_works(*arguments)
        undisturbed = without_time(folder + "/r.json")
        # The run is killed at its first checkpoint, which proves that checkpoints are written.
        arguments.append("--overwrite")
        long = [a if a != "100000" else "2e6" for a in arguments]
        process = subprocess.Popen(
            [SWIRL, *long], env={**os.environ, **environment}, stderr=subprocess.DEVNULL
        )
        wait_until(lambda: os.path.exists(folder + "/r.json.checkpoint"), process)
        process.kill()
        process.wait()
        os.remove(folder + "/r.json.checkpoint")
        self.assert_works(*arguments, environment=environment)
        self.assertEqual(without_time(folder + "/r.json"), undisturbed)
        self.assertTrue(0 < read_json(folder + "/r.json")["seconds"] < 1e5)

    def test_a_sweep_ignores_jumps_and_file_dates(self):
        environment = self.jumping()
        plan = ["sweep", "--discs", "5:10", "--events", "3000", "--quiet", "--out"]
        self.assert_works(*plan, self.path("undisturbed"))
        self.assert_works(*plan, self.path("a"), "--part", "1/2", environment=environment)
        for k, name in enumerate(sorted(os.listdir(self.path("a/results")))):
            date = (0, 4e9)[k % 2]  # 1970, 2096
            os.utime(self.path("a/results/" + name), (date, date))
        os.utime(self.path("a/plan.json"), (4e9, 4e9))
        self.assert_works(*plan, self.path("a"), environment=environment)
        self.assertIn(
            "6 of 6 runs done", swirl("sweep", "--out", self.path("a"), "--status").stdout
        )
        tables = [
            swirl("collect", self.path(name), "--csv", "-").stdout for name in ("a", "undisturbed")
        ]
        self.assertEqual(tables[0], tables[1])
        self.assertEqual(len(tables[0].splitlines()), 7)


class Disk(InFolder):
    def small_disk(self, size):
        if os.geteuid() != 0:
            self.skipTest("mounting a small disk needs root")
        disk = self.path("disk")
        os.mkdir(disk)
        mounted = subprocess.run(
            ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", disk],
            capture_output=True,
            text=True,
        )
        if mounted.returncode != 0:
            self.skipTest("no small disk can be mounted here: " + mounted.stderr.strip())
        self.addCleanup(subprocess.run, ["umount", "-l", disk])
        return disk

    def test_a_disk_full_while_recording_leaves_a_resumable_checkpoint(self):
        disk = self.small_disk("3m")
        arguments = [*RUN, "--trajectory", disk + "/t.h5", "--json", disk + "/r.json", "--quiet"]
        done = self.assert_fails(1, *arguments, says="No space left on device")
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertFalse(os.path.exists(disk + "/t.h5"))
        self.assertFalse(os.path.exists(disk + "/r.json"))
        # With free space the recording continues and ends like an undisturbed run.
        larger = self.path("larger")
        shutil.copytree(disk, larger)
        again = [a.replace(disk, larger) for a in arguments]
        self.assert_works(*again, "--resume")
        whole = self.path("whole")
        os.mkdir(whole)
        self.assert_works(*[a.replace(disk, whole) for a in arguments])
        self.assertEqual(without_time(larger + "/r.json"), without_time(whole + "/r.json"))
        self.assert_works("verify", larger + "/t.h5")

    def fill(self, disk):
        with open(disk + "/filler", "wb", buffering=0) as filler:
            try:
                while filler.write(bytes(4096)):
                    pass
            except OSError:
                pass

    def test_a_disk_full_while_writing_a_checkpoint_leaves_the_previous_one(self):
        disk = self.small_disk("512k")  # two checkpoints of up to 170 kB each
        arguments = [
            "run",
            "--discs",
            "24",
            "--events",
            "1e7",
            "--checkpoint-every",
            "0.02",
            "--checkpoint",
            disk + "/c",
            "--quiet",
        ]
        process = subprocess.Popen([SWIRL, *arguments], stderr=subprocess.PIPE, text=True)
        while not os.path.exists(disk + "/c"):
            self.assertIsNone(process.poll(), "over without a checkpoint")
            time.sleep(0.001)
        self.fill(disk)
        errors = process.communicate(timeout=HANG)[1]
        self.assertEqual(process.returncode, 1, errors)
        self.assertIn("No space left on device", errors)
        self.assertEqual(errors.count("\n"), 1)
        self.assertEqual(sorted(os.listdir(disk)), ["c", "filler"])
        # With free space the run resumes from the previous checkpoint.
        os.remove(disk + "/filler")
        process = subprocess.Popen(
            [SWIRL, *arguments, "--resume"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.assertTrue(worked(process, 0.2))
        process.send_signal(signal.SIGTERM)
        errors = process.communicate(timeout=HANG)[1]
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn("--resume to continue", errors)

    def test_a_disk_full_while_a_sweep_writes_keeps_finished_results(self):
        disk = self.small_disk("256k")
        plan = [
            "sweep",
            "--discs",
            "5:30",
            "--replicates",
            "6",
            "--events",
            "1000",
            "--quiet",
            "--out",
        ]
        done = swirl(*plan, disk + "/s")  # 156 results of 4 kB
        self.assertEqual(done.returncode, 1)
        self.assertIn("No space left on device", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)
        there = [name for name in os.listdir(disk + "/s/results") if name.endswith(".json")]
        for name in there:
            read_json(f"{disk}/s/results/{name}")
        larger = self.path("larger")
        shutil.copytree(disk + "/s", larger)
        self.assert_works(*plan, larger)
        self.assert_works(*plan, self.path("whole"))
        tables = [
            swirl("collect", self.path(name), "--csv", "-").stdout for name in ("larger", "whole")
        ]
        self.assertEqual(tables[0], tables[1])

    def test_a_disk_full_while_writing_a_result(self):
        disk = self.small_disk("64k")
        self.fill(disk)
        self.assert_fails(
            1,
            "run",
            "--discs",
            5,
            "--events",
            100,
            "--json",
            disk + "/r.json",
            "--quiet",
            says="No space left on device",
        )
        self.assertEqual(os.listdir(disk), ["filler"])

    def disturbed(self, arguments, what, first_file, **more):
        """Starts a run or a sweep that would not end, and calls `what` when `first_file` exists;
        the error message."""
        process = subprocess.Popen(
            [SWIRL, *arguments, "--quiet"], stderr=subprocess.PIPE, text=True, **more
        )
        while not os.path.exists(first_file):
            self.assertIsNone(process.poll(), process.stderr)
            time.sleep(0.001)
        what()
        errors = process.communicate(timeout=HANG)[1]
        self.assertEqual(process.returncode, 1, errors)
        self.assertEqual(errors.count("\n"), 1, errors)
        return errors

    def test_a_removed_folder_is_an_error(self):
        folder = self.path("f")

        def vanish():
            while os.path.exists(folder):
                shutil.rmtree(folder, ignore_errors=True)  # while the program writes to it

        run = [
            "run",
            "--discs",
            "24",
            "--events",
            "1e9",
            "--checkpoint-every",
            "0.1",
            "--checkpoint",
            folder + "/c",
        ]
        for more in ([], ["--trajectory", folder + "/t.h5"]):
            os.mkdir(folder)
            self.assertIn(
                "No such file or directory", self.disturbed(run + more, vanish, folder + "/c")
            )
        sweep = [
            "sweep",
            "--discs",
            "5:48",
            "--replicates",
            "1000",
            "--events",
            "10000",
            "--out",
            folder,
        ]
        self.assertIn(
            "No such file or directory", self.disturbed(sweep, vanish, folder + "/plan.json")
        )

    def test_a_folder_that_becomes_read_only_is_an_error(self):
        if os.geteuid() != 0:
            self.skipTest("changing to a user without write permission needs root")
        other_user = 65534
        os.chmod(self.folder, 0o755)
        try:
            subprocess.run([SWIRL, "--version"], user=other_user, capture_output=True)
        except PermissionError:
            self.skipTest("other users cannot execute the program")
        folder = self.path("f")
        os.mkdir(folder)
        os.chown(folder, other_user, -1)

        def lock_all():
            for entered, _, _ in os.walk(folder):
                os.chmod(entered, 0o555)

        run = [
            "run",
            "--discs",
            "24",
            "--events",
            "1e9",
            "--checkpoint-every",
            "0.1",
            "--checkpoint",
            folder + "/c",
        ]
        self.assertIn(
            "Permission denied", self.disturbed(run, lock_all, folder + "/c", user=other_user)
        )
        self.assertEqual(os.listdir(folder), ["c"])
        os.chmod(folder, 0o755)
        sweep = [
            "sweep",
            "--discs",
            "5:48",
            "--replicates",
            "1000",
            "--events",
            "10000",
            "--out",
            folder + "/s",
        ]
        self.assertIn(
            "Permission denied",
            self.disturbed(sweep, lock_all, folder + "/s/plan.json", user=other_user),
        )

    def test_a_read_only_folder_is_an_error_before_the_run(self):
        # /proc takes no files, even from root.
        done = self.assert_fails(
            1, "run", "--events", "1e12", "--trajectory", "/proc/t.h5", timeout=HANG
        )
        self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    main()
