"""Existing files: when a run may overwrite them, files of other runs, and what `swirl verify`
accepts."""

import json
import os
import shutil
import signal
import stat
import subprocess
import unittest
from pathlib import Path

from program import (
    HANG,
    SOURCE,
    SWIRL,
    InFolder,
    read_bytes,
    swirl,
    wait_until,
    without_time,
    worked,
)


class Overwriting(InFolder):
    def run_call(self, *more, seed=1, events="20000"):
        return [
            "run",
            "--discs",
            "8",
            "--events",
            events,
            "--seed",
            seed,
            "--trajectory",
            self.path("t.h5"),
            "--log-events",
            self.path("e.h5"),
            "--json",
            self.path("r.json"),
            "--checkpoint-every",
            "0.01",
            "--quiet",
            *more,
        ]

    def killed(self, *more, seed=1):
        """Starts a long run and kills it at its first checkpoint."""
        process = subprocess.Popen(
            [SWIRL, *map(str, self.run_call(*more, seed=seed, events="1e9"))],
            stderr=subprocess.DEVNULL,
        )
        wait_until(lambda: os.path.exists(self.path("r.json.checkpoint")), process)
        process.kill()
        process.wait()

    def test_a_finished_result_is_overwritten_only_on_request(self):
        self.assert_works(*self.run_call())
        before = without_time(self.path("r.json"))
        self.assert_fails(1, *self.run_call(seed=2), says="r.json' already exists")
        self.assert_fails(1, *self.run_call("--resume", seed=2), says="r.json' already exists")
        self.assertEqual(without_time(self.path("r.json")), before)
        done = swirl(*self.run_call("--resume"))  # it is complete
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_works(*self.run_call("--overwrite", seed=2))
        self.assertNotEqual(without_time(self.path("r.json")), before)
        self.assertEqual(self.left_behind(), ["e.h5", "r.json", "t.h5"])

    def test_overwriting_an_interrupted_run_needs_a_request_and_backs_up_its_checkpoint(self):
        self.killed()
        checkpoint = read_bytes(self.path("r.json.checkpoint"))
        self.assert_fails(1, *self.run_call(seed=2), says="continue it with --resume")
        self.assert_works(*self.run_call("--overwrite", seed=2))
        self.assertEqual(read_bytes(self.path("r.json.checkpoint.backup")), checkpoint)

    def test_a_second_backup_does_not_replace_the_first(self):
        saved = {}
        for seed, name in ((1, "backup"), (2, "backup-2")):
            self.killed("--overwrite", seed=seed)
            saved[name] = read_bytes(self.path("r.json.checkpoint"))
            self.assert_fails(1, *self.run_call(), says=f"r.json.checkpoint.{name}'")
            self.assert_works(*self.run_call("--overwrite"))
        for name, checkpoint in saved.items():
            self.assertEqual(read_bytes(self.path(f"r.json.checkpoint.{name}")), checkpoint)

    def test_recordings_of_another_run_are_neither_overwritten_nor_continued(self):
        self.killed()
        saved = self.path("kept.checkpoint")
        shutil.copy(self.path("r.json.checkpoint"), saved)
        os.remove(self.path("r.json.checkpoint"))
        # Run B would overwrite the recording of run A.
        self.assert_fails(1, *self.run_call(seed=2), says="unfinished recording of another run")
        # B overwrites it and is completed; then A is resumed.
        self.assert_works(*self.run_call("--overwrite", seed=2))
        of_b = read_bytes(self.path("t.h5"))
        self.assert_fails(
            1, "run", "--checkpoint", saved, "--resume", "--quiet", says="recorded by another run"
        )
        self.assertEqual(read_bytes(self.path("t.h5")), of_b)

    def test_a_result_without_requested_measurements_or_recordings_is_not_complete(self):
        call = ["run", "--discs", 8, "--events", 20000, "--json", self.path("r.json"), "--quiet"]
        slip = [*call, "--measure", "slip", "--tables", self.path("tables")]
        self.assert_works(*call)
        self.assert_fails(1, *slip, "--resume", says="r.json' already exists")
        self.assert_works(*slip, "--overwrite")
        for also in (slip, call):
            self.assert_works(*also, "--resume")
        os.remove(self.path("tables/numbers.csv"))
        self.assert_fails(1, *slip, "--resume", says="r.json' already exists")
        recorded = [*call, "--trajectory", self.path("t.h5")]
        self.assert_works(*recorded, "--overwrite")
        self.assert_works(*recorded, "--resume")
        self.assert_fails(
            1, *recorded, "--frames-per-period", 7, "--resume", says="r.json' already exists"
        )

    def test_a_run_killed_between_its_series_and_its_result_is_repeated(self):
        # Before the first checkpoint such a run leaves its recordings and no result.
        def call(*more, periods=6):
            return [
                "run",
                "--discs",
                5,
                "--periods",
                periods,
                "--series",
                self.path("s.csv"),
                "--trajectory",
                self.path("s.h5"),
                "--log-events",
                self.path("s_events.h5"),
                "--json",
                self.path("s.json"),
                "--quiet",
                *more,
            ]

        self.assert_works(*call("--resume"))
        before = [read_bytes(self.path(name)) for name in ("s.csv", "s.json")]
        os.remove(self.path("s.json"))
        self.assert_fails(1, *call(), says="already exists")
        self.assert_works(*call("--resume"))
        self.assertEqual(read_bytes(self.path("s.csv")), before[0])
        os.remove(self.path("s.json"))
        for other in (call("--seed", 2, "--resume"), call("--resume", periods=5)):
            self.assert_fails(1, *other, says="already exists")
        for name in ("s.h5", "s_events.h5"):
            os.remove(self.path(name))
        for other in (call("--seed", 2, "--resume"), call("--resume", periods=5)):
            self.assert_fails(1, *other, says="is the series of another run, or of a longer one")
            self.assertEqual(read_bytes(self.path("s.csv")), before[0])
            for name in ("s.h5.partial", "s_events.h5.partial"):
                os.remove(self.path(name))

    def test_a_resumed_run_does_not_replace_files_of_another_run(self):
        self.killed()
        saved = self.path("kept.checkpoint")
        shutil.copy(self.path("r.json.checkpoint"), saved)
        other = ["run", "--discs", 5, "--events", 2000, "--quiet"]
        for name, option in (
            ("r.json", "--json"),
            ("t.h5", "--trajectory"),
            ("e.h5", "--log-events"),
        ):
            made = self.path("other-" + name)
            self.assert_works(*other, option, made)
            shutil.copy(made, self.path(name))
            self.assert_fails(
                1, "run", "--checkpoint", saved, "--resume", "--quiet", says="it was left unchanged"
            )
            with open(made, "rb") as wanted, open(self.path(name), "rb") as there:
                self.assertEqual(wanted.read(), there.read())
            os.remove(self.path(name))

    def test_concurrent_runs_with_different_measurements_keep_both_results(self):
        runs = [
            subprocess.Popen(
                [
                    SWIRL,
                    "run",
                    "--discs",
                    "8",
                    "--events",
                    "300000",
                    "--measure",
                    name,
                    "--json",
                    self.path("r.json"),
                    "--quiet",
                ],
                stderr=subprocess.PIPE,
                text=True,
            )
            for name in ("slip", "order")
        ]
        errors = [run.communicate(timeout=HANG)[1] for run in runs]
        self.assertEqual(sorted(run.returncode for run in runs), [0, 1], errors)
        self.assertEqual(self.left_behind(), ["r.json", "r.json.second"])
        self.assertEqual(
            {
                *without_time(self.path("r.json"))["measured"],
                *without_time(self.path("r.json.second"))["measured"],
            },
            {"slip", "order"},
        )

    def test_an_interrupted_result_does_not_replace_a_complete_one(self):
        call = [
            "run",
            "--discs",
            "8",
            "--events",
            "20000",
            "--json",
            self.path("r.json"),
            "--quiet",
        ]
        long = [SWIRL, *call[:4], "1e9", *call[5:], "--checkpoint", self.path("c")]
        process = subprocess.Popen(
            [*long, "--checkpoint-every", "0.01"], stderr=subprocess.PIPE, text=True
        )
        wait_until(lambda: os.path.exists(self.path("c")), process)
        # The complete result of the same run, as if written by another process.
        with open(self.path("r.json"), "w", encoding="utf-8") as opened:
            plan = json.loads(swirl(*call[:-3], "--json", "-", "--quiet").stdout)
            plan["config"]["events"] = 1000000000
            json.dump(plan, opened)
        process.send_signal(signal.SIGINT)
        self.assertIn("r.json.second", process.communicate(timeout=HANG)[1])
        self.assertTrue(without_time(self.path("r.json"))["complete"])
        self.assertFalse(without_time(self.path("r.json.second"))["complete"])

    def test_runs_with_different_measurements_have_different_checkpoints(self):
        for name in ("slip", "order"):
            process = subprocess.Popen(
                [SWIRL, "run", "--events", "1e9", "--measure", name, "--quiet"],
                cwd=self.folder,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            self.assertTrue(worked(process, 0.5))
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(timeout=HANG), 130)
        self.assertEqual(len(self.left_behind()), 2, self.left_behind())
        self.assertFalse([name for name in self.left_behind() if "backup" in name])

    def test_overwrite_still_holds_when_the_run_is_resumed(self):
        self.assert_works(*self.run_call())
        process = subprocess.Popen(
            [SWIRL, *map(str, self.run_call("--overwrite", seed=2, events="3000000"))]
        )
        wait_until(lambda: os.path.exists(self.path("r.json.checkpoint")), process)
        process.kill()
        process.wait()
        self.assert_works(*self.run_call("--resume", seed=2, events="3000000"))
        self.assertEqual(without_time(self.path("r.json"))["config"]["seed"], 2)

    def test_concurrent_runs_with_the_same_name_keep_both_results(self):
        runs = [
            subprocess.Popen(
                [
                    SWIRL,
                    "run",
                    "--discs",
                    "8",
                    "--events",
                    "1000000",
                    "--seed",
                    str(seed),
                    "--json",
                    self.path("r.json"),
                    "--quiet",
                ],
                stderr=subprocess.PIPE,
                text=True,
            )
            for seed in (1, 2)
        ]
        errors = [run.communicate(timeout=HANG)[1] for run in runs]
        self.assertEqual(sorted(run.returncode for run in runs), [0, 1], errors)
        self.assertIn("r.json.second'", "".join(errors))
        self.assertEqual(self.left_behind(), ["r.json", "r.json.second"])
        self.assertEqual(
            {without_time(self.path(name))["config"]["seed"] for name in self.left_behind()}, {1, 2}
        )

    def test_closed_standard_streams_do_not_corrupt_files(self):
        done = subprocess.run(
            ["sh", "-c", 'exec "$0" "$@" 0<&- 1>&- 2>&-', SWIRL, *map(str, self.run_call()[:-1])]
        )
        self.assertEqual(done.returncode, 1)  # the report could not be written
        for name in ("r.json", "t.h5", "e.h5"):
            self.assert_works("verify", self.path(name))

    def test_pipes_without_a_writer_are_rejected(self):
        os.mkfifo(self.path("pipe"))
        self.assert_fails(1, "verify", self.path("pipe"), says="regular file")
        self.assert_fails(
            1, "run", "--checkpoint", self.path("pipe"), "--resume", says="regular file"
        )


class Names(InFolder):
    """An output file never replaces another file of the same call, whatever its spelling, nor an
    input file, a device or a pipe."""

    def recorded(self):
        self.assert_works(
            "run", "--discs", 5, "--events", 2000, "--trajectory", self.path("t.h5"), "--quiet"
        )
        return self.path("t.h5")

    def assert_rejected(self, *call, code=2, says="is the name of two different files"):
        self.assert_fails(code, *call, says=says, cwd=self.folder)

    def test_two_outputs_of_a_run_with_the_same_name(self):
        for other in (
            "x.h5",
            "./x.h5",
            "../" + os.path.basename(self.folder) + "/x.h5",
            self.path("x.h5"),
        ):
            self.assert_rejected("run", "--events", 100, "--trajectory", "x.h5", "--json", other)
            self.assert_rejected(
                "run", "--events", 100, "--log-events", "x.h5", "--trajectory", other
            )
        self.assertEqual(self.left_behind(), [])

    def test_a_table_and_another_output_with_the_same_name(self):
        os.mkdir(self.path("tables"))
        measured = [
            "run",
            "--events",
            2000,
            "--measure",
            "density,slip",
            "--tables",
            "tables",
            "--quiet",
        ]
        for other in (
            ["--json", "tables/numbers.csv"],
            ["--checkpoint", "./tables/density.csv"],
            ["--tables", "x", "--json", "x"],
        ):
            self.assert_rejected(*(measured if len(other) == 2 else measured[:5]), *other)
        recording = self.recorded()
        self.assert_rejected(
            "measure",
            recording,
            "--measure",
            "slip",
            "--tables",
            "tables",
            "--json",
            "tables/numbers.csv",
        )
        self.assertEqual(os.listdir(self.path("tables")), [])
        self.assert_rejected(
            "run", "--measure", "slip", "--tables", "--quiet", says="looks like an option"
        )
        self.assertEqual(self.left_behind(), ["t.h5", "tables"])

    def test_two_outputs_of_other_commands_with_the_same_name(self):
        self.assert_rejected("crossing", "--json", "x", "--csv", "./x")
        self.assert_works(
            "sweep",
            "--discs",
            "5,6",
            "--events",
            1000,
            "--out",
            "study",
            "--quiet",
            cwd=self.folder,
        )
        self.assert_rejected("collect", "study", "--csv", "x", "--crossings", "./x")
        self.assert_rejected(
            "collect",
            "study",
            "--csv",
            "x",
            "--crossings",
            "study/plan.json",
            says="belongs to the sweep itself",
        )
        self.assertEqual(self.left_behind(), ["study"])

    def test_an_output_with_the_name_of_its_input(self):
        recording = self.recorded()
        before = read_bytes(recording)
        for name in (recording, "t.h5", "./t.h5"):
            self.assert_rejected("measure", recording, "--json", name)
            self.assert_rejected("export", recording, "--format", "xyz", "--out", name)
        self.assertEqual(read_bytes(recording), before)
        # The same for the file next to a camera's tracks.
        self.assert_rejected("measure", "tracks.csv", "--json", "tracks.camera.json")

    def test_a_table_of_a_sweep_does_not_replace_files_of_the_sweep(self):
        self.assert_works(
            "sweep",
            "--discs",
            "5,6",
            "--events",
            1000,
            "--out",
            "study",
            "--quiet",
            cwd=self.folder,
        )
        os.symlink("study", self.path("link"))
        saved = {
            name: Path(self.path(name)).read_bytes()
            for name in ("study/results/000000.json", "study/plan.json", "study/locks")
        }
        for name in (
            *saved,
            "link/results/000000.json",
            "study/results/new.csv",
            "./study/../study/locks",
        ):
            self.assert_rejected(
                "collect", "study", "--csv", name, says="belongs to the sweep itself"
            )
            self.assert_rejected(
                "collect", "study", "--crossings", name, says="belongs to the sweep itself"
            )
            self.assert_rejected(
                "collect", "link", "--csv", name, says="belongs to the sweep itself"
            )
        for name, before in saved.items():
            self.assertEqual(Path(self.path(name)).read_bytes(), before)
        self.assert_rejected(
            "collect", "study", "--csv", "-", "--crossings", "-", says="standard output"
        )
        self.assert_works(
            "collect",
            "study",
            "--csv",
            "study/results.csv",
            "--crossings",
            "study/N_c.csv",
            cwd=self.folder,
        )

    def test_a_run_does_not_replace_its_configuration(self):
        plan = Path(self.path("plan.toml"))
        plan.write_text("discs = 5\nevents = 1000\n", encoding="utf-8")
        for option in ("--json", "--checkpoint"):  # recordings end in .h5
            for more in ([], ["--overwrite"]):
                self.assert_rejected("run", "plan.toml", option, "./plan.toml", *more)
        self.assertEqual(plan.read_text(encoding="utf-8"), "discs = 5\nevents = 1000\n")
        self.assertEqual(self.left_behind(), ["plan.toml"])

    def test_a_movie_or_image_does_not_replace_its_input(self):
        recording = shutil.copy(self.recorded(), self.path("r.gif"))
        shutil.copy(recording, self.path("r.png"))
        before = Path(recording).read_bytes()
        small = ["--size", "160x90", "--quiet"]
        self.assert_rejected("movie", "r.gif", "--out", "./r.gif", *small)
        self.assert_rejected("image", "r.png", "--out", "./r.png", *small)
        for name in ("r.gif", "r.png"):
            self.assertEqual(Path(self.path(name)).read_bytes(), before)
        says = "it also belongs to the camera images"
        self.assert_rejected(
            "movie", "tracks.csv", "--over", "video.mp4", "--out", "./video.mp4", says=says
        )
        numbered = ["tracks.csv", "--over", "seen/frame-%06d.png"]
        self.assert_rejected("movie", *numbered, "--frame-files", "seen", says=says)
        self.assert_rejected("image", *numbered, "--out", "./seen/frame-000007.png", says=says)
        self.assertEqual(self.left_behind(), ["r.gif", "r.png", "t.h5"])

    def test_a_report_does_not_replace_the_tracks(self):
        os.mkdir(self.path("report"))
        if "no camera support" in swirl("track", "video.mp4", "--out", "x.csv").stderr:
            self.skipTest("this build has no camera")
        self.assert_rejected(
            "track", "video.mp4", "--out", "report/discs.csv", "--report", "report"
        )
        self.assert_rejected("experiment", "video.mp4", "--out", "x", "--json", "video.mp4")
        self.assertEqual(self.left_behind(), ["report"])

    def test_a_pipe_is_not_replaced(self):
        recording = self.recorded()
        os.mkfifo(self.path("pipe"))
        os.mkfifo(self.path("pipe.h5"))
        for call in (
            ["export", recording, "--format", "xyz", "--out", "pipe"],
            ["run", "--events", 100, "--trajectory", "pipe.h5"],
            ["run", "--events", 100, "--log-events", "pipe.h5"],
        ):
            self.assert_rejected(
                *call,
                code=1,
                says="is a device, a pipe or a socket and cannot be replaced by a file",
            )
            self.assertTrue(stat.S_ISFIFO(os.stat(self.path(call[-1])).st_mode), call)
        laboratory = [os.path.join(SOURCE, "web", "lab.sh"), "--out"]
        done = subprocess.run(
            [*laboratory, self.path("pipe")], capture_output=True, text=True, timeout=HANG
        )
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("which exists and is not a file", done.stderr)
        self.assertEqual(self.left_behind(), ["pipe", "pipe.h5", "t.h5"])


if __name__ == "__main__":
    unittest.main()
