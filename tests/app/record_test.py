"""Runs that leave files behind, are killed, run out of disk, and are resumed to the same bits."""

import json
import os
import random
import shutil
import signal
import subprocess
import time
import unittest

from program import SWIRL, InFolder, swirl

RUN = ["run", "--discs", "24", "--events", "300000", "--warmup", "5", "--seed", "3", "--frames", "40",
       "--checkpoint-every", "0.02", "--compression", "0", "--measure", "radial,pinned"]


def without_time(file):
    with open(file) as opened:
        result = json.load(opened)
    for of_the_call in ("seconds", "events_per_second", "command"):
        del result[of_the_call]
    return result


class Recorded(InFolder):
    def arguments(self, folder):
        os.makedirs(folder, exist_ok=True)
        return [*RUN, "--trajectory", os.path.join(folder, "t.h5"),
                "--log-events", os.path.join(folder, "e.h5"),
                "--json", os.path.join(folder, "r.json"), "--quiet", "--resume"]

    def reference(self):
        done = swirl(*self.arguments(self.path("whole")))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(os.listdir(self.path("whole"))), ["e.h5", "r.json", "t.h5"])
        return without_time(self.path("whole/r.json"))

    def data_of(self, file):
        """What an HDF5 file holds, whatever the order of its bytes."""
        dump = subprocess.run(["/usr/bin/python3", "-c", """
import h5py, hashlib, sys
f = h5py.File(sys.argv[1], 'r')
def show(name, x):
    if isinstance(x, h5py.Dataset) and name != 'parameters/command':
        print(name, x.shape, hashlib.sha256(x[()].tobytes() if x.shape else bytes(x[()])).hexdigest())
f.visititems(show)
print(sorted(f['parameters'].attrs.items()))
""", file], capture_output=True, text=True)
        if "No module named 'h5py'" in dump.stderr:
            self.skipTest("h5py is not installed; Debian's package python3-h5py provides it.")
        self.assertEqual(dump.returncode, 0, dump.stderr)
        return dump.stdout

    def kill_until_done(self, folder, kills, seed):
        """Kills at random moments, resumes each time; the number of kills that hit."""
        choose = random.Random(seed)
        hits = 0
        for attempt in range(1000):
            process = subprocess.Popen([SWIRL, *self.arguments(folder)], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE, text=True)
            try:
                complaint = process.communicate(
                    timeout=choose.uniform(0.03, 0.4) if hits < kills else 100)[1]
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                hits += 1
                # Nothing half-written stands under a final name.
                if os.path.exists(os.path.join(folder, "r.json")):
                    without_time(os.path.join(folder, "r.json"))
                continue
            self.assertEqual(process.returncode, 0, complaint)
            return hits
        self.fail("never done")

    def killed_and_resumed(self, kills, seed):
        whole = self.reference()
        wanted = [self.data_of(self.path("whole/" + name)) for name in ("t.h5", "e.h5")]
        hits = 0
        for round_ in range(20):
            folder = self.path(f"killed{round_}")
            hits += self.kill_until_done(folder, kills - hits, seed + round_)
            self.assertEqual(without_time(os.path.join(folder, "r.json")), whole)
            for name, data in zip(("t.h5", "e.h5"), wanted):
                self.assertEqual(self.data_of(os.path.join(folder, name)), data)
            left = [f for f in os.listdir(folder) if not f.endswith(".partial")]
            self.assertEqual(sorted(left), ["e.h5", "r.json", "t.h5"])
            if hits >= kills:
                return
        self.assertGreater(hits, 0)

    def test_killed_at_random_moments_and_resumed_it_ends_with_the_same_bits(self):
        self.killed_and_resumed(kills=6, seed=1)

    @unittest.skipUnless(os.environ.get("SWIRL_SLOW"), "minutes; with SWIRL_SLOW=1")
    def test_fifty_kills(self):
        self.killed_and_resumed(kills=50, seed=100)

    def test_ctrl_c_and_resume(self):
        whole = self.reference()
        process = subprocess.Popen([SWIRL, *self.arguments(self.path("f"))],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        time.sleep(0.1)
        process.send_signal(signal.SIGTERM)
        complaint = process.communicate(timeout=60)[1]
        if process.returncode == 130:
            self.assertIn("--resume goes on", complaint)
            self.assertFalse(os.path.exists(self.path("f/t.h5")))
            # The checkpoint alone says which run it is.
            self.assertEqual(swirl(*self.arguments(self.path("f"))).returncode, 0)
        self.assertEqual(without_time(self.path("f/r.json")), whole)

    def test_a_damaged_checkpoint_is_refused(self):
        folder = self.path("f")
        swirl(*self.arguments(folder), "--periods", 1)
        process = subprocess.Popen([SWIRL, *self.arguments(folder)], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        checkpoint = os.path.join(folder, "r.json.checkpoint")
        for _ in range(2000):
            if os.path.exists(checkpoint):
                break
            time.sleep(0.005)
        process.kill()
        process.wait()
        if not os.path.exists(checkpoint):
            self.skipTest("the run was over before it could be killed")
        with open(checkpoint, "r+b") as opened:
            opened.seek(700)
            byte = opened.read(1)
            opened.seek(700)
            opened.write(bytes([byte[0] ^ 1]))
        done = swirl(*self.arguments(folder))
        self.assertEqual(done.returncode, 1)
        self.assertIn("is damaged", done.stderr)


class Disk(InFolder):
    def small_disk(self, size):
        if os.geteuid() != 0:
            self.skipTest("mounting a small disk needs root")
        disk = self.path("disk")
        os.mkdir(disk)
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", disk],
                                 capture_output=True, text=True)
        if mounted.returncode != 0:
            self.skipTest("no small disk can be mounted here: " + mounted.stderr.strip())
        self.addCleanup(subprocess.run, ["umount", "-l", disk])
        return disk

    def test_full_while_recording_the_last_checkpoint_still_resumes(self):
        disk = self.small_disk("3m")
        arguments = [*RUN, "--trajectory", disk + "/t.h5", "--json", disk + "/r.json", "--quiet"]
        done = swirl(*arguments)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("No space left on device", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertFalse(os.path.exists(disk + "/t.h5"))
        self.assertFalse(os.path.exists(disk + "/r.json"))
        # Room again: what was recorded carries on, and ends like a run that was never disturbed.
        roomy = self.path("roomy")
        shutil.copytree(disk, roomy)
        again = [a.replace(disk, roomy) for a in arguments]
        resumed = swirl(*again, "--resume")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        whole = self.path("whole")
        os.mkdir(whole)
        self.assertEqual(swirl(*[a.replace(disk, whole) for a in arguments]).returncode, 0)
        self.assertEqual(without_time(roomy + "/r.json"), without_time(whole + "/r.json"))
        self.assertEqual(swirl("verify", roomy + "/t.h5").returncode, 0)

    def test_full_while_writing_a_result(self):
        disk = self.small_disk("64k")
        with open(disk + "/filler", "wb", buffering=0) as filler:
            try:
                while filler.write(bytes(4096)):
                    pass
            except OSError:
                pass
        done = swirl("run", "--discs", 5, "--events", 100, "--json", disk + "/r.json", "--quiet")
        self.assertEqual(done.returncode, 1)
        self.assertIn("No space left on device", done.stderr)
        self.assertEqual(os.listdir(disk), ["filler"])

    def test_a_folder_that_vanishes_is_an_error_and_no_crash(self):
        folder = self.path("f")
        os.mkdir(folder)
        process = subprocess.Popen(
            [SWIRL, "run", "--discs", "24", "--events", "1e9", "--checkpoint-every", "0.3",
             "--checkpoint", folder + "/c", "--quiet"], stderr=subprocess.PIPE, text=True)
        time.sleep(0.1)
        shutil.rmtree(folder)
        complaint = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 1)
        self.assertIn("No such file or directory", complaint)

    def test_a_folder_that_is_read_only_is_an_error_before_the_run(self):
        # /proc takes no files, even from root.
        done = swirl("run", "--events", "1e12", "--trajectory", "/proc/t.h5", timeout=20)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
