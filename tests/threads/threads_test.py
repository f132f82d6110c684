"""Everything that works on several threads, under the thread sanitizer (preset `threads`): sweeps,
recordings with their writers, crossings, movies. A data race ends the program with exit code 66."""

import os
import subprocess
import sys
import tempfile
import unittest

SWIRL = os.environ["SWIRL"]
SUPPRESSIONS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "suppressions.txt")
ENVIRONMENT = {
    **os.environ,
    "TSAN_OPTIONS": f"halt_on_error=1 exitcode=66 suppressions={SUPPRESSIONS}",
}


class Threads(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def swirl(self, *arguments):
        done = subprocess.run(
            [SWIRL, *arguments],
            cwd=self.folder.name,
            env=ENVIRONMENT,
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, done.stderr[-4000:])

    def test_a_recorded_run(self):
        self.swirl(
            "run",
            "--discs",
            "12",
            "--events",
            "20000",
            "--trajectory",
            "frames.h5",
            "--log-events",
            "events.h5",
            "--checkpoint",
            "kept",
            "--checkpoint-every",
            "0.01",
            "--measure",
            "all",
            "--json",
            "result.json",
        )
        self.swirl("verify", "frames.h5")

    def test_a_sweep_with_more_threads_than_cores(self):
        self.swirl(
            "sweep",
            "--discs",
            "5:12",
            "--mu",
            "0.1,1",
            "--replicates",
            "2",
            "--events",
            "3000",
            "--frames-per-period",
            "30",
            "--measure",
            "slip",
            "--threads",
            "7",
            "--out",
            "sweep",
        )
        self.swirl("collect", "sweep", "--csv", "table.csv")

    def test_a_crossing(self):
        self.swirl("crossing", "--mu", "1", "--from", "30", "--to", "40", "--events", "20000")

    def test_a_movie(self):
        self.swirl("movie", "--discs", "5", "--start", "0", "--periods", "1", "--out", "movie.mp4")


if __name__ == "__main__":
    sys.exit(unittest.main())
