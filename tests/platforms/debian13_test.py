"""Debian 13 works from ./swirl to ./check: in a fresh system the launcher installs the packages and
builds with g++ 14 and HDF5 1.14. Runs, recordings, a resumed run and exports are those of the
program of this build. The default tests pass, among them those that stop the program or let its
system calls fail while it records.

Takes half an hour and 6 GB of storage; needs root, mmdebstrap and a mirror. SWIRL_DEBIAN13=FOLDER
keeps the system in that folder, and reuses it with its last build."""

import filecmp
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "cli"))
import debian_root
from program import SOURCE, SWIRL

RUN = [
    "run",
    "--discs",
    "20",
    "--mixture",
    "10:1.2",
    "--periods",
    "6",
    "--warmup",
    "2",
    "--seed",
    "3",
    "--sides",
    "13",
    "--speed",
    "1.3",
    "--measure",
    "all",
    "--quiet",
]
# These need a browser and npm's packages, which are the same programs on any system.
NOT_THERE = r"^cli\.(lab|site|serve)_test$"
NOT_COPIED = (".git", "build", "out", "node_modules", "generated", "__pycache__")
# Keys of a result that differ between machines or calls.
DIFFERENT = ("seconds", "events_per_second", "command", "build", "simd", "version", "machine")


def skip(reason):
    print("skipped:", reason)
    sys.exit(77)


def result(path):
    with open(path) as file:
        return {key: value for key, value in json.load(file).items() if key not in DIFFERENT}


class Debian13(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.here = os.path.join(folder.name, "here")
        cls.root = os.environ.get("SWIRL_DEBIAN13") or os.path.join(folder.name, "root")
        os.mkdir(cls.here)
        cls.is_new = not os.path.exists(os.path.join(cls.root, "etc/debian_version"))
        if cls.is_new:
            debian_root.create("trixie", cls.root)
        for name in ("resolv.conf", "hosts"):
            if os.path.exists("/etc/" + name):
                shutil.copy("/etc/" + name, os.path.join(cls.root, "etc", name))
        cls.there = os.path.join(cls.root, "root/results")
        shutil.rmtree(cls.there, ignore_errors=True)
        os.makedirs(cls.there)
        cls.copy_sources(os.path.join(cls.root, "root/swirl"))

    @staticmethod
    def copy_sources(copy):
        """A file that is the same there keeps its date, so that only changes are compiled."""
        for folder, folders, names in os.walk(SOURCE):
            folders[:] = [name for name in folders if name not in NOT_COPIED]
            target = os.path.join(copy, os.path.relpath(folder, SOURCE))
            os.makedirs(target, exist_ok=True)
            for name in set(os.listdir(target)) - set(names) - set(NOT_COPIED):
                if os.path.isfile(os.path.join(target, name)):
                    os.remove(os.path.join(target, name))
            for name in names:
                here, there = os.path.join(folder, name), os.path.join(target, name)
                if name not in NOT_COPIED and not (
                    os.path.exists(there) and filecmp.cmp(here, there, shallow=False)
                ):
                    shutil.copy(here, there)

    def in_debian13(self, *command):
        """Runs a command in the folder of results there."""
        done = debian_root.run(self.root, *command, inside="/root/results")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done

    def both(self, *arguments):
        self.in_debian13("/root/swirl/swirl", *arguments)
        subprocess.run([SWIRL, *arguments], cwd=self.here, check=True, capture_output=True)

    def assert_same(self, name):
        with open(os.path.join(self.here, name), "rb") as a, open(
            os.path.join(self.there, name), "rb"
        ) as b:
            self.assertTrue(a.read() == b.read(), name)

    def test_1_the_first_call_installs_and_builds(self):
        first = self.in_debian13("/root/swirl/swirl", "run", "--events", "1000", "--quiet")
        if self.is_new:
            self.assertIn("installing Debian packages", first.stderr)
            self.assertIn("building", first.stderr)

    def test_same_results_and_recordings(self):
        versions = self.in_debian13(
            "sh", "-c", "g++ -dumpversion; dpkg-query -W libhdf5-dev"
        ).stdout
        self.assertTrue(versions.startswith("14"), versions)
        self.assertIn("1.14", versions)

        self.both(*RUN, "--json", "run.json", "--trajectory", "run.h5", "--log-events", "events.h5")
        here, there = (
            result(os.path.join(folder, "run.json")) for folder in (self.here, self.there)
        )
        self.assertIn("state_hash", json.dumps(here))
        self.assertEqual(here, there)

        # There the run is interrupted and resumed, here it is not.
        long_run = [
            "run",
            "--discs",
            "20",
            "--periods",
            "20000",
            "--frames-per-period",
            "1",
            "--quiet",
            "--trajectory",
            "two.h5",
            "--json",
            "two.json",
            "--checkpoint-every",
            "0.05",
        ]
        self.in_debian13(
            "sh",
            "-c",
            '"$@" & until [ -e two.json.checkpoint ]; do sleep 0.01; done; '
            "kill -TERM $!; wait $!; [ $? -eq 130 ]",
            "sh",
            "/root/swirl/swirl",
            *long_run,
        )
        self.assertFalse(result(os.path.join(self.there, "two.json"))["complete"])
        self.in_debian13("/root/swirl/swirl", *long_run, "--resume")
        subprocess.run([SWIRL, *long_run], cwd=self.here, check=True, capture_output=True)
        here, there = (
            result(os.path.join(folder, "two.json")) for folder in (self.here, self.there)
        )
        for key in ("complete", "events", "rotation", "state_hash"):
            self.assertEqual(here[key], there[key])

        # Each system reads the recordings of the other.
        for name in ("run", "two"):
            self.both(
                "export",
                name + ".h5",
                "--format",
                "table",
                "--out",
                name + ".csv",
                "--quiet",
                "--stride",
                "7",
            )
            self.assert_same(name + ".csv")
        shutil.copy(os.path.join(self.here, "run.h5"), os.path.join(self.there, "other.h5"))
        shutil.copy(os.path.join(self.there, "run.h5"), os.path.join(self.here, "other.h5"))
        self.both("export", "other.h5", "--format", "table", "--quiet", "--out", "other.csv")
        self.assert_same("other.csv")
        for name in ("run.json", "run.h5", "events.h5", "other.h5"):
            self.both("verify", name, "--quiet")

    def test_locks_are_those_of_the_program(self):
        """With the library's own locks or without, a recording is written and read."""
        for locking in ("TRUE", "FALSE", "BEST_EFFORT"):
            with self.subTest(locking):
                name = locking + ".h5"
                self.in_debian13(
                    "env",
                    "HDF5_USE_FILE_LOCKING=" + locking,
                    "/root/swirl/swirl",
                    "run",
                    "--events",
                    "1000",
                    "--quiet",
                    "--trajectory",
                    name,
                )
                self.in_debian13(
                    "env",
                    "HDF5_USE_FILE_LOCKING=" + locking,
                    "/root/swirl/swirl",
                    "verify",
                    name,
                    "--quiet",
                )

    def test_the_default_tests_pass(self):
        done = self.in_debian13("/root/swirl/check", "--fast", "-E", NOT_THERE)
        self.assertIn("100% tests passed", done.stdout)
        # The journaled file under faults and kills is among them.
        for name in ("faults.faults_test", "cli.record_test", "JournaledFile", "GoldenHash"):
            self.assertIn(name, done.stdout)


if __name__ == "__main__":
    if debian_root.what_is_missing():
        skip(debian_root.what_is_missing())
    unittest.main()
