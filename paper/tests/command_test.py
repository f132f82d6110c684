"""swirl paper: tables do not depend on threads or interruptions, and a figure is drawn from its
table alone."""

import os
import shutil
import signal
import subprocess
import time
import unittest

from program import HANG, SOURCE, SWIRL, InFolder, read_bytes, read_rows, swirl, write_text

SETTINGS = {"high", "medium", "low", "no-wall", "no-disc"}


def make(out, **how):
    done = swirl("paper", "--figure", "5b", "--quick", "--events", 6000, "--out", out, **how)
    assert done.returncode == 0, done.stderr
    return done


class Figure5b(InFolder):
    def make(self, out, **how):
        return make(self.path(out), **how)

    def whole(self):
        """The output of an undisturbed call, and what it printed."""

        def make_it(out):
            printed = make(out).stdout
            write_text(os.path.join(out, "printed"), printed)

        self.shared("whole", make_it)

    def bytes_of(self, *name):
        return read_bytes(os.path.join(self.folder, *name))

    def test_table_and_drawings(self):
        self.whole()
        rows = read_rows(self.path("whole/figure_5b.csv"))
        self.assertEqual({row["setting"] for row in rows}, SETTINGS)
        averaged = 0
        for row in rows:
            self.assertEqual(row["seeds"], "3")
            self.assertEqual(row["point"], f"{row['setting']}_N{row['discs']}")
            if row["too_short_to_average"] == "3":
                # For many discs 6000 events are fewer than five periods after the warm-up. All runs
                # are that short, so they count, if they have a whole period.
                self.assertGreater(int(row["discs"]), 24 if row["setting"] != "no-wall" else 8)
                self.assertEqual(
                    row["steady_state"], "too short to tell" if row["mean_by_event"] else "failed"
                )
                if not row["mean_by_event"]:
                    continue
            averaged += 1
            if int(row["discs"]) <= 48:  # beyond the paper's N lengths are in periods
                self.assertEqual(row["events"], "6000")
            for name in ("mean_by_event", "mean_by_time", "rigid_by_event", "rigid_by_time"):
                float(row[name])
        self.assertGreater(averaged, len(rows) / 3)
        self.assertTrue(self.bytes_of("whole", "figure_5b.png").startswith(b"\x89PNG"))
        self.assertTrue(self.bytes_of("whole", "figure_5b.pdf").startswith(b"%PDF"))
        for words in (
            "high friction",
            "medium friction",
            "low friction",
            "no wall friction",
            "no disc friction",
        ):
            self.assertRegex(
                self.bytes_of("whole", "printed").decode(),
                words + r" .*(crosses zero|always rotates)",
            )

    def test_interrupted_calls_on_one_core_continue_to_the_same_table(self):
        self.whole()
        one = {min(os.sched_getaffinity(0))}
        on_one_core = {"preexec_fn": lambda: os.sched_setaffinity(0, one)}
        call = [
            SWIRL,
            "paper",
            "--figure",
            "5b",
            "--quick",
            "--events",
            "6000",
            "--out",
            self.path("cut"),
        ]
        for _ in range(3):
            process = subprocess.Popen(
                call, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **on_one_core
            )
            runs = self.path("cut/runs/rotation/results")
            before = len(os.listdir(runs)) if os.path.isdir(runs) else 0
            while process.poll() is None:
                if os.path.isdir(runs) and len(os.listdir(runs)) > before + 5:
                    process.send_signal(signal.SIGINT)
                    break
                time.sleep(0.001)
            _, message = process.communicate(timeout=HANG)
            if process.returncode == 0:
                break
            self.assertEqual(process.returncode, 130, message)
            self.assertIn("continues", message)
            self.assertNotIn("figure_5b.csv", os.listdir(self.path("cut")))
        printed = self.make("cut", **on_one_core).stdout
        self.assertIn("from an earlier call", printed)
        self.assertEqual(
            self.bytes_of("whole", "figure_5b.csv"), self.bytes_of("cut", "figure_5b.csv")
        )

    def test_script_alone_draws_the_same_bytes(self):
        self.whole()
        shutil.copy(self.path("whole/figure_5b.csv"), self.path("figure_5b.csv"))
        subprocess.run(
            [
                "/usr/bin/python3",
                "-B",
                os.path.join(SOURCE, "paper"),
                "draw",
                self.path("figure_5b.csv"),
            ],
            check=True,
            timeout=HANG,
        )
        for kind in ("png", "pdf"):
            self.assertEqual(
                self.bytes_of("whole", f"figure_5b.{kind}"), self.bytes_of(f"figure_5b.{kind}")
            )

    def test_folder_that_cannot_be_created(self):
        open(self.path("file"), "w").close()
        self.assert_fails(
            1, "paper", "--figure", "5b", "--quick", "--out", self.path("file/out"), says="file/out"
        )


if __name__ == "__main__":
    unittest.main()
