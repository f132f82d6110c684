"""Existing files: when a run may overwrite them, files of other runs, and what `swirl verify` accepts."""

import json
import os
import shutil
import signal
import stat
import subprocess
import time
import unittest
from pathlib import Path

from program import ONE_ERROR, SOURCE, SWIRL, InFolder, swirl, without_time


class Overwriting(InFolder):
    in_memory = True

    def run_call(self, *more, seed=1, events="20000"):
        return ["run", "--discs", "8", "--events", events, "--seed", seed, "--trajectory",
                self.path("t.h5"), "--log-events", self.path("e.h5"), "--json", self.path("r.json"),
                "--checkpoint-every", "0.01", "--quiet", *more]

    def killed(self, *more, seed=1):
        """Starts a long run and kills it at its first checkpoint."""
        process = subprocess.Popen([SWIRL, *map(str, self.run_call(*more, seed=seed, events="1e9"))],
                                   stderr=subprocess.DEVNULL)
        while not os.path.exists(self.path("r.json.checkpoint")):
            self.assertIsNone(process.poll(), "over without a checkpoint")
            time.sleep(0.001)
        process.kill()
        process.wait()

    def assert_rejected(self, *call, says):
        done = swirl(*call)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn(says, done.stderr)
        self.assertRegex(done.stderr, r"\A[^\n]+\n(hint: [^\n]+\n)?\Z")

    def test_a_finished_result_is_overwritten_only_on_request(self):
        self.assertEqual(swirl(*self.run_call()).returncode, 0)
        before = without_time(self.path("r.json"))
        self.assert_rejected(*self.run_call(seed=2), says="r.json' already exists")
        self.assert_rejected(*self.run_call("--resume", seed=2), says="r.json' already exists")
        self.assertEqual(without_time(self.path("r.json")), before)
        done = swirl(*self.run_call("--resume"))  # it is complete
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(swirl(*self.run_call("--overwrite", seed=2)).returncode, 0)
        self.assertNotEqual(without_time(self.path("r.json")), before)
        self.assertEqual(self.left_behind(), ["e.h5", "r.json", "t.h5"])

    def test_overwriting_an_interrupted_run_needs_a_request_and_backs_up_its_checkpoint(self):
        self.killed()
        with open(self.path("r.json.checkpoint"), "rb") as opened:
            checkpoint = opened.read()
        self.assert_rejected(*self.run_call(seed=2), says="continue it with --resume")
        done = swirl(*self.run_call("--overwrite", seed=2))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("r.json.checkpoint.backup"), "rb") as opened:
            self.assertEqual(opened.read(), checkpoint)

    def test_a_second_backup_does_not_replace_the_first(self):
        saved = {}
        for seed, name in ((1, "backup"), (2, "backup-2")):
            self.killed("--overwrite", seed=seed)
            with open(self.path("r.json.checkpoint"), "rb") as opened:
                saved[name] = opened.read()
            self.assert_rejected(*self.run_call(), says=f"r.json.checkpoint.{name}'")
            done = swirl(*self.run_call("--overwrite"))
            self.assertEqual(done.returncode, 0, done.stderr)
        for name, checkpoint in saved.items():
            with open(self.path(f"r.json.checkpoint.{name}"), "rb") as opened:
                self.assertEqual(opened.read(), checkpoint)

    def test_recordings_of_another_run_are_neither_overwritten_nor_continued(self):
        self.killed()
        saved = self.path("kept.checkpoint")
        shutil.copy(self.path("r.json.checkpoint"), saved)
        os.remove(self.path("r.json.checkpoint"))
        # Run B would overwrite the recording of run A.
        self.assert_rejected(*self.run_call(seed=2), says="unfinished recording of another run")
        # B overwrites it and is completed; then A is resumed.
        self.assertEqual(swirl(*self.run_call("--overwrite", seed=2)).returncode, 0)
        with open(self.path("t.h5"), "rb") as opened:
            of_b = opened.read()
        self.assert_rejected("run", "--checkpoint", saved, "--resume", "--quiet",
                     says="recorded by another run")
        with open(self.path("t.h5"), "rb") as opened:
            self.assertEqual(opened.read(), of_b)

    def test_a_result_without_requested_measurements_or_recordings_is_not_complete(self):
        call = ["run", "--discs", 8, "--events", 20000, "--json", self.path("r.json"), "--quiet"]
        slip = [*call, "--measure", "slip", "--tables", self.path("tables")]
        self.assertEqual(swirl(*call).returncode, 0)
        self.assert_rejected(*slip, "--resume", says="r.json' already exists")
        self.assertEqual(swirl(*slip, "--overwrite").returncode, 0)
        for also in (slip, call):
            done = swirl(*also, "--resume")
            self.assertEqual(done.returncode, 0, done.stderr)
        os.remove(self.path("tables/numbers.csv"))
        self.assert_rejected(*slip, "--resume", says="r.json' already exists")
        recorded = [*call, "--trajectory", self.path("t.h5")]
        self.assertEqual(swirl(*recorded, "--overwrite").returncode, 0)
        self.assertEqual(swirl(*recorded, "--resume").returncode, 0)
        self.assert_rejected(*recorded, "--frames", 7, "--resume", says="r.json' already exists")

    def test_a_resumed_run_does_not_replace_files_of_another_run(self):
        self.killed()
        saved = self.path("kept.checkpoint")
        shutil.copy(self.path("r.json.checkpoint"), saved)
        other = ["run", "--discs", 5, "--events", 2000, "--quiet"]
        for name, option in (("r.json", "--json"), ("t.h5", "--trajectory"), ("e.h5", "--log-events")):
            made = self.path("other-" + name)
            self.assertEqual(swirl(*other, option, made).returncode, 0)
            shutil.copy(made, self.path(name))
            self.assert_rejected("run", "--checkpoint", saved, "--resume", "--quiet", says="it was left unchanged")
            with open(made, "rb") as wanted, open(self.path(name), "rb") as there:
                self.assertEqual(wanted.read(), there.read())
            os.remove(self.path(name))

    def test_concurrent_runs_with_different_measurements_keep_both_results(self):
        runs = [subprocess.Popen([SWIRL, "run", "--discs", "8", "--events", "300000", "--measure", name,
                                  "--json", self.path("r.json"), "--quiet"], stderr=subprocess.PIPE, text=True)
                for name in ("slip", "order")]
        errors = [run.communicate(timeout=100)[1] for run in runs]
        self.assertEqual(sorted(run.returncode for run in runs), [0, 1], errors)
        self.assertEqual(self.left_behind(), ["r.json", "r.json.second"])
        self.assertEqual({*without_time(self.path("r.json"))["measured"],
                          *without_time(self.path("r.json.second"))["measured"]}, {"slip", "order"})

    def test_an_interrupted_result_does_not_replace_a_complete_one(self):
        call = ["run", "--discs", "8", "--events", "20000", "--json", self.path("r.json"), "--quiet"]
        long = [SWIRL, *call[:4], "1e9", *call[5:], "--checkpoint", self.path("c")]
        process = subprocess.Popen([*long, "--checkpoint-every", "0.01"], stderr=subprocess.PIPE, text=True)
        while not os.path.exists(self.path("c")):
            self.assertIsNone(process.poll(), "over without a checkpoint")
            time.sleep(0.001)
        # The complete result of the same run, as if written by another process.
        with open(self.path("r.json"), "w", encoding="utf-8") as opened:
            plan = json.loads(swirl(*call[:-3], "--json", "-", "--quiet").stdout)
            plan["config"]["events"] = 1000000000
            json.dump(plan, opened)
        process.send_signal(signal.SIGINT)
        self.assertIn("r.json.second", process.communicate(timeout=150)[1])
        self.assertTrue(without_time(self.path("r.json"))["complete"])
        self.assertFalse(without_time(self.path("r.json.second"))["complete"])

    def test_runs_with_different_measurements_have_different_checkpoints(self):
        for name in ("slip", "order"):
            process = subprocess.Popen([SWIRL, "run", "--events", "1e9", "--measure", name, "--quiet"],
                                       cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(0.5)
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(timeout=150), 130)
        self.assertEqual(len(self.left_behind()), 2, self.left_behind())
        self.assertFalse([name for name in self.left_behind() if "backup" in name])

    def test_overwrite_still_holds_when_the_run_is_resumed(self):
        self.assertEqual(swirl(*self.run_call()).returncode, 0)
        process = subprocess.Popen(
            [SWIRL, *map(str, self.run_call("--overwrite", seed=2, events="3000000"))])
        while not os.path.exists(self.path("r.json.checkpoint")):
            self.assertIsNone(process.poll(), "over without a checkpoint")
            time.sleep(0.001)
        process.kill()
        process.wait()
        done = swirl(*self.run_call("--resume", seed=2, events="3000000"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(without_time(self.path("r.json"))["config"]["seed"], 2)

    def test_concurrent_runs_with_the_same_name_keep_both_results(self):
        runs = [subprocess.Popen([SWIRL, "run", "--discs", "8", "--events", "1000000", "--seed", str(seed),
                                  "--json", self.path("r.json"), "--quiet"], stderr=subprocess.PIPE, text=True)
                for seed in (1, 2)]
        errors = [run.communicate(timeout=100)[1] for run in runs]
        self.assertEqual(sorted(run.returncode for run in runs), [0, 1], errors)
        self.assertIn("r.json.second'", "".join(errors))
        self.assertEqual(self.left_behind(), ["r.json", "r.json.second"])
        self.assertEqual({without_time(self.path(name))["config"]["seed"] for name in self.left_behind()},
                         {1, 2})

    def test_closed_standard_streams_do_not_corrupt_files(self):
        done = subprocess.run(["sh", "-c", 'exec "$0" "$@" 0<&- 1>&- 2>&-', SWIRL,
                               *map(str, self.run_call()[:-1])])
        self.assertEqual(done.returncode, 1)  # the report could not be written
        for name in ("r.json", "t.h5", "e.h5"):
            done = swirl("verify", self.path(name))
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_pipes_without_a_writer_are_rejected(self):
        os.mkfifo(self.path("pipe"))
        self.assert_rejected("verify", self.path("pipe"), says="regular file")
        self.assert_rejected("run", "--checkpoint", self.path("pipe"), "--resume", says="regular file")

    def test_verify_detects_every_change_of_a_recording(self):
        self.assertEqual(swirl(*self.run_call()).returncode, 0)
        change = """
import h5py, sys, numpy
file, what = sys.argv[1:]
f = h5py.File(file, 'r+')
t = 'particles/trajectory/'
def cut(group, part):
    def shorten(name, x):
        if isinstance(x, h5py.Dataset) and x.maxshape and x.maxshape[0] is None:
            x.resize(int(x.shape[0] * part), axis=0)
    f[group].visititems(shorten)
if what == 'radius': f[t + 'radius'][3] = numpy.nan
if what == 'mass': f[t + 'mass'][3] *= 2
if what == 'container': f['parameters'].attrs['container_radius'] = 0.0
if what == 'period': f['parameters'].attrs['period'] = 0.0
if what == 'events': f['observables/events/value'][7] += 1
if what == 'centre': f['observables/container_x/value'][7] += 1e-9
if what == 'no frames':
    cut('particles', 0)
    cut('observables', 0)
if what in ('id', 'particle', 'species', 'xyz'): f[t + what][2] += 1
if what == 'height': f[t + 'position/value'][7, 3, 2] = 1.0
if what == 'rise': f[t + 'velocity/value'][7, 3, 2] = 1.0
if what in ('step', 'time'): f[t + 'position/' + what][7] += 1
if what in ('table', 'nothing'):
    rows = len(f[t + 'position/step'])
    del f[t + 'position/step']
    f[t + 'position/step'] = numpy.zeros((rows, 2 if what == 'table' else 0), 'i8')
if what == 'velocities': f[t + 'velocity/value'].resize(5, axis=0)
if what == 'impulses': f['events/normal_impulse'].resize(5, axis=0)
if what == 'sticks': f['events/sticks'][7] = 2
if what == 'first': f['initial/radius'][0] = numpy.nan
if what == 'no events': cut('events', 0)
if what == 'quarter': cut('events', 0.25)
"""
        for name, changes in (("t.h5", ("radius", "mass", "container", "period", "events", "centre",
                                        "no frames", "id", "particle", "species", "xyz", "step", "time",
                                        "height", "rise", "table", "nothing", "velocities")),
                              ("e.h5", ("first", "container", "period", "no events", "quarter", "impulses",
                                        "sticks"))):
            for what in changes:
                shutil.copy(self.path(name), self.path("changed.h5"))
                changed = subprocess.run(["/usr/bin/python3", "-c", change, self.path("changed.h5"),
                                          what], capture_output=True, text=True)
                if "No module named 'h5py'" in changed.stderr:
                    self.skipTest("h5py is not installed; Debian's package python3-h5py provides it.")
                self.assertEqual(changed.returncode, 0, changed.stderr)
                says = {"velocities": "differ in length", "impulses": "differ in length",
                        "table": "must have one value per frame", "nothing": "must have one value per frame",
                        "radius": "radius of disc 3 is nan", "first": "radius of disc 0 is nan",
                        "container": "container radius is 0", "period": "period is 0",
                        "sticks": "event 7 is damaged"}.get(what, "differs from")
                self.assert_rejected("verify", self.path("changed.h5"), says=says)
        floor = """
import h5py, sys
saved = h5py.File(sys.argv[1], 'r+')['parameters'].attrs
saved[sys.argv[2]] = int(sys.argv[3])
"""
        self.assertEqual(swirl("run", "--body", "sphere", "--floor", "sliding", "--discs", 5, "--events", 500,
                               "--trajectory", self.path("spheres.h5"), "--quiet").returncode, 0)
        for attribute, value in (("floor", 0), ("lie_flat", 1)):
            shutil.copy(self.path("spheres.h5"), self.path("changed.h5"))
            subprocess.run(["/usr/bin/python3", "-c", floor, self.path("changed.h5"), attribute, str(value)],
                           check=True)
            self.assert_rejected("verify", self.path("changed.h5"), says="differs from frame 0")


class Names(InFolder):
    """An output file never replaces another file of the same call, whatever its spelling, nor an input file,
    a device or a pipe."""

    in_memory = True

    def recorded(self):
        done = swirl("run", "--discs", 5, "--events", 2000, "--trajectory", self.path("t.h5"), "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.path("t.h5")

    def assert_rejected(self, *call, code=2, says="is the name of two different files"):
        done = swirl(*call, cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertRegex(done.stderr, ONE_ERROR)
        self.assertIn(says, done.stderr)

    def test_two_outputs_of_a_run_with_the_same_name(self):
        for other in ("x.h5", "./x.h5", "../" + os.path.basename(self.folder) + "/x.h5", self.path("x.h5")):
            self.assert_rejected("run", "--events", 100, "--trajectory", "x.h5", "--json", other)
            self.assert_rejected("run", "--events", 100, "--log-events", "x.h5", "--trajectory", other)
        self.assertEqual(self.left_behind(), [])

    def test_a_table_and_another_output_with_the_same_name(self):
        os.mkdir(self.path("tables"))
        measured = ["run", "--events", 2000, "--measure", "density,slip", "--tables", "tables", "--quiet"]
        for other in (["--json", "tables/numbers.csv"], ["--checkpoint", "./tables/density.csv"],
                      ["--tables", "x", "--json", "x"]):
            self.assert_rejected(*(measured if len(other) == 2 else measured[:5]), *other)
        recording = self.recorded()
        self.assert_rejected("measure", recording, "--measure", "slip", "--tables", "tables", "--json",
                     "tables/numbers.csv")
        self.assertEqual(os.listdir(self.path("tables")), [])
        self.assert_rejected("run", "--measure", "slip", "--tables", "--quiet", says="looks like an option")
        self.assertEqual(self.left_behind(), ["t.h5", "tables"])

    def test_two_outputs_of_other_commands_with_the_same_name(self):
        self.assert_rejected("crossing", "--json", "x", "--csv", "./x")
        self.assertEqual(swirl("sweep", "--discs", "5,6", "--events", 1000, "--out", "study", "--quiet",
                               cwd=self.folder).returncode, 0)
        self.assert_rejected("collect", "study", "--csv", "x", "--crossings", "./x")
        self.assert_rejected("collect", "study", "--csv", "x", "--crossings", "study/plan.json",
                     says="belongs to the sweep itself")
        self.assertEqual(self.left_behind(), ["study"])

    def test_an_output_with_the_name_of_its_input(self):
        recording = self.recorded()
        with open(recording, "rb") as opened:
            before = opened.read()
        for name in (recording, "t.h5", "./t.h5"):
            self.assert_rejected("measure", recording, "--json", name)
            self.assert_rejected("export", recording, "--format", "xyz", "--out", name)
        with open(recording, "rb") as opened:
            self.assertEqual(opened.read(), before)
        # The same for the file next to a camera's tracks.
        self.assert_rejected("measure", "tracks.csv", "--json", "tracks.camera.json")

    def test_a_table_of_a_sweep_does_not_replace_files_of_the_sweep(self):
        self.assertEqual(swirl("sweep", "--discs", "5,6", "--events", 1000, "--out", "study", "--quiet",
                               cwd=self.folder).returncode, 0)
        os.symlink("study", self.path("link"))
        saved = {name: Path(self.path(name)).read_bytes()
                for name in ("study/results/000000.json", "study/plan.json", "study/locks")}
        for name in (*saved, "link/results/000000.json", "study/results/new.csv", "./study/../study/locks"):
            self.assert_rejected("collect", "study", "--csv", name, says="belongs to the sweep itself")
            self.assert_rejected("collect", "study", "--crossings", name, says="belongs to the sweep itself")
            self.assert_rejected("collect", "link", "--csv", name, says="belongs to the sweep itself")
        for name, before in saved.items():
            self.assertEqual(Path(self.path(name)).read_bytes(), before)
        self.assert_rejected("collect", "study", "--csv", "-", "--crossings", "-", says="standard output")
        done = swirl("collect", "study", "--csv", "study/results.csv", "--crossings", "study/N_c.csv",
                     cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)

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
        self.assert_rejected("movie", "tracks.csv", "--over", "video.mp4", "--out", "./video.mp4", says=says)
        numbered = ["tracks.csv", "--over", "seen/frame-%06d.png"]
        self.assert_rejected("movie", *numbered, "--frame-files", "seen", says=says)
        self.assert_rejected("image", *numbered, "--out", "./seen/frame-000007.png", says=says)
        self.assertEqual(self.left_behind(), ["r.gif", "r.png", "t.h5"])

    def test_a_report_does_not_replace_the_tracks(self):
        os.mkdir(self.path("report"))
        if "no camera support" in swirl("track", "video.mp4", "--out", "x.csv").stderr:
            self.skipTest("this build has no camera")
        self.assert_rejected("track", "video.mp4", "--out", "report/discs.csv", "--report", "report")
        self.assert_rejected("experiment", "video.mp4", "--out", "x", "--json", "video.mp4")
        self.assertEqual(self.left_behind(), ["report"])

    def test_a_pipe_is_not_replaced(self):
        recording = self.recorded()
        os.mkfifo(self.path("pipe"))
        os.mkfifo(self.path("pipe.h5"))
        for call in (["export", recording, "--format", "xyz", "--out", "pipe"],
                     ["run", "--events", 100, "--trajectory", "pipe.h5"],
                     ["run", "--events", 100, "--log-events", "pipe.h5"]):
            self.assert_rejected(*call, code=1, says="is a device, a pipe or a socket and cannot be replaced by a file")
            self.assertTrue(stat.S_ISFIFO(os.stat(self.path(call[-1])).st_mode), call)
        laboratory = [os.path.join(SOURCE, "web", "lab.sh"), "--out"]
        for place in (self.path("pipe"), self.folder):
            done = subprocess.run([*laboratory, place], capture_output=True, text=True, timeout=150)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("which exists and is not a file", done.stderr)
        self.assertEqual(self.left_behind(), ["pipe", "pipe.h5", "t.h5"])


if __name__ == "__main__":
    unittest.main()
