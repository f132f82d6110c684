"""Files of earlier versions. Each is read and gives the same result as then, or is rejected with a
message that names its version or format. tests/io/version_1/make.sh made them."""

import csv
import io
import json
import os
import re
import signal
import subprocess
import tarfile
import unittest

from program import (
    HANG,
    SOURCE,
    SWIRL,
    InFolder,
    read_bytes,
    read_json,
    read_text,
    swirl,
    worked,
    write_text,
)

BODIES = ("discs", "spheres")

# Rows and tables of measurements that were renamed after these files were written (CHANGELOG.md).
RENAMED = {
    "slip": {"stays": "resident"},
    "pinned": {
        "places": "positions",
        "becoming_pinned": "pinning",
        "becoming_free": "depinning",
        "becoming_pinned_by_collisions": "pinning_by_collisions",
        "becoming_free_by_collisions": "depinning_by_collisions",
    },
}

RATES = {"by_event": "mean_by_event", "by_time": "mean_by_time"}
SPIN = {"change_of_the_spin": "spin_change", "change_limit_of_the_spin": "spin_change_limit"}


def renamed(values, names):
    return {names.get(name, name): value for name, value in values.items()}


def with_present_names(result):
    """The result in the present format, with the present names in the same order; no number
    changes."""
    result = {
        **renamed(result, {"replica": "replicate"}),
        "format": 2,
        "rotation": renamed(result["rotation"], RATES),
        "steady_state": renamed(result["steady_state"], SPIN),
    }
    if "measured" not in result:
        return result
    measured = {
        measurement: renamed(rows, RENAMED.get(measurement, {}))
        for measurement, rows in result["measured"].items()
    }
    if "positions" in measured.get("pinned", {}):
        columns = {"pinned": "pinning", "free": "depinning"}
        measured["pinned"]["positions"] = renamed(measured["pinned"]["positions"], columns)
    return {**result, "measured": measured}


class OldFiles(InFolder):
    def setUp(self):
        super().setUp()
        with tarfile.open(os.path.join(SOURCE, "tests/io/version_1/files.tar.xz")) as archive:
            # The filter is the default of newer versions of Python, and unknown to Debian 12's.
            archive.extractall(
                self.folder, **({"filter": "data"} if hasattr(tarfile, "data_filter") else {})
            )

    def json(self, name):
        return read_json(self.path(name))

    def run_here(self, *arguments):
        return swirl(*arguments, cwd=self.folder)

    def succeed(self, *arguments):
        done = self.run_here(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout


class Version1(OldFiles):
    """The files of version 1."""

    def assert_resumed(self, done, result, expected):
        """The resumed run ends in the expected state; or it is rejected, if the format of
        checkpoints or the law of motion of these bodies has changed since."""
        if done.returncode == 0:
            self.assertEqual(self.json(result)["state_hash"], self.json(expected)["state_hash"])
            then = renamed(self.json(expected)["rotation"], RATES)
            for average in ("mean_by_event", "mean_by_time", "rigid_by_event", "rigid_by_time"):
                self.assertEqual(self.json(result)["rotation"][average], then[average])
            return
        self.assertEqual(done.returncode, 1)
        self.assertRegex(
            done.stderr,
            r"of swirl 0\.1\.0 \(1ee281701d33\), .* another law of motion \(1 there|"
            r"a checkpoint of format 8, but this program reads format (9|\d\d)\b",
        )
        self.assertFalse(os.path.exists(self.path(result)))

    def test_results_with_former_names_are_rejected(self):
        done = self.run_here("verify", "discs.json")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(
            done.stderr, r"has format 1 of swirl 0\.1\.0 .*, but this program reads format 2\."
        )
        for command in ("collect", "sweep"), ("sweep", "--out", "sweep"):
            done = self.run_here(*command)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(
                done.stderr, r"plan\.json' is in format 1, but this program reads format 2\."
            )

    def test_results_are_verified(self):
        for body in BODIES:
            result = with_present_names(self.json(f"{body}.json"))
            write_text(self.path(f"{body}.json"), json.dumps(result))
            done = self.run_here("verify", f"{body}.json")
            if done.returncode != 0:
                # Discs have the same trajectory and means by event. But the rotation of a few discs
                # by time is now an integral instead of a mean of samples.
                what = "rotation" if body == "discs" else ".*"
                self.assertRegex(
                    done.stderr, f"differs: {what} .*\nhint: it was made by swirl 0.1.0"
                )

    def test_a_checkpoint_of_a_finished_run_is_extended_to_the_same_end(self):
        for body in BODIES:
            done = self.run_here(
                "run",
                "--checkpoint",
                f"{body}.checkpoint",
                "--resume",
                "--periods",
                40,
                "--json",
                f"{body}_longer.json",
                "--quiet",
            )
            self.assert_resumed(done, f"{body}_longer.json", f"{body}.40.json")

    def test_a_stopped_run_is_resumed_with_its_recording_to_the_same_end(self):
        for body in BODIES:
            result = f"{body}_stopped.json"
            done = self.run_here(
                "run", "--checkpoint", f"{body}_stopped.checkpoint", "--resume", "--quiet"
            )
            self.assert_resumed(done, result, f"{body}_whole.json")
            if done.returncode == 0:
                self.assertNotIn(f"{body}_stopped.h5.partial", self.left_behind())
                self.succeed("verify", f"{body}_stopped.h5")

    def test_recordings_are_read_measured_and_exported(self):
        for body in BODIES:
            self.succeed("measure", f"{body}.h5", "--json", "measured.json", "--quiet")
            measured = self.json("measured.json")
            self.assertEqual((measured["frames"], measured["discs"]), (20, 8))
            self.succeed("export", f"{body}.h5", "--format", "csv", "--out", f"{body}.csv")
            with open(self.path(f"{body}.csv"), encoding="utf-8") as file:
                self.assertEqual(len(file.readlines()), 1 + 20 * 8)

    def test_recordings_and_event_logs_are_verified(self):
        for body in BODIES:
            for file in (f"{body}.h5", f"{body}_events.h5"):
                done = self.run_here("verify", file)
                if done.returncode != 0:
                    self.assertIn("made by swirl 0.1.0", done.stderr)
                    self.assertNotEqual(body, "discs")

    def test_tracks_are_read_with_their_camera_data(self):
        then = self.json("tracks.json")
        for file in ("tracks.h5", "tracks.csv"):
            self.succeed("measure", file, "--json", "now.json", "--quiet")
            now = self.json("now.json")
            self.assertEqual((now["frames"], now["discs"]), (then["frames"], then["discs"]))
            # The CSV table has fewer digits than the HDF5 file, and measurements may be refined.
            self.assertAlmostEqual(
                now["rotation"]["mean_by_time"]["mean"], then["rotation"]["by_time"]["mean"], 3
            )

    def test_a_sweep_is_completed_and_collected_to_the_same_table(self):
        plan = renamed(self.json("sweep/plan.json"), {"replicas": "replicates"})
        results = {f"sweep/results/00000{k}.json" for k in range(4)}
        for name, content in [
            ("sweep/plan.json", {**plan, "format": 2}),
            *((name, with_present_names(self.json(name))) for name in results),
        ]:
            write_text(self.path(name), json.dumps(content))
        os.remove(self.path("sweep/results/000002.json"))
        self.succeed(
            "sweep",
            "--out",
            "sweep",
            "--discs",
            "5,8",
            "--replicates",
            2,
            "--periods",
            12,
            "--warmup",
            2,
            "--quiet",
        )
        self.succeed("collect", "sweep", "--csv", "again.csv")
        tables = []
        for table in ("sweep.csv", "again.csv"):
            tables.append(read_text(self.path(table)))
        columns = renamed(
            dict.fromkeys(tables[0].splitlines()[0].split(",")),
            {"replicas": "replicates"}
            | {
                name + ending: new + ending
                for name, new in RATES.items()
                for ending in ("", "_error")
            },
        )
        was, now = (list(csv.DictReader(io.StringIO(table))) for table in tables)
        self.assertEqual(set(now[0]) - set(columns), {"short_runs"})
        self.assertEqual([name for name in now[0] if name in columns], list(columns))
        self.assertEqual(len(was), len(now))
        for then, row in zip(was, now):
            # The rotation of a few discs by time is now an integral instead of a mean of samples.
            for name, before in zip(columns, then.values()):
                after = row[name]
                if name.startswith(
                    ("mean_by_event", "rigid_by_event")
                ):  # their sums have another order
                    self.assertAlmostEqual(float(before) / float(after), 1, delta=1e-12, msg=name)
                elif "by_time" not in name and name != "scatter":
                    self.assertEqual(before, after, name)

    def test_a_configuration_file_gives_the_same_run(self):
        self.succeed("run", "run.toml", "--json", "again.json", "--quiet")
        self.assertEqual(
            self.json("again.json")["state_hash"], self.json("discs.json")["state_hash"]
        )


class OtherFormats(OldFiles):
    """The same files, changed to a format that this program cannot read."""

    def rewrite(self, name, change):
        content = self.json(name)
        change(content)
        write_text(self.path(name), json.dumps(content))

    def rejected(self, *arguments):
        before = self.left_behind()
        done = self.run_here(*arguments)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, r"format 9\b.* (but )?this program reads format [12]\b")
        self.assertEqual(self.left_behind(), before)

    def test_a_result(self):
        self.rewrite("discs.json", lambda result: result.update(format=9))
        self.rejected("verify", "discs.json")

    def test_a_camera(self):
        self.rewrite("tracks.camera.json", lambda camera: camera.update(format=9))
        self.rejected("measure", "tracks.csv")

    def test_a_sweep(self):
        self.rewrite(
            "sweep/plan.json", lambda plan: plan.update(format=2, replicates=plan.pop("replicas"))
        )
        for k in range(4):
            self.rewrite(f"sweep/results/00000{k}.json", lambda result: result.update(format=9))
        self.rejected("collect", "sweep", "--csv", "again.csv")
        self.rewrite("sweep/plan.json", lambda plan: plan.update(format=9))
        self.rejected("collect", "sweep", "--csv", "again.csv")

    def test_a_checkpoint(self):
        content = read_bytes(self.path("discs.checkpoint"))
        number = int(re.match(rb"swirl checkpoint (\d+)\n", content).group(1))
        other = 99
        with open(self.path("discs.checkpoint"), "wb") as file:
            file.write(content.replace(b"checkpoint %d\n" % number, b"checkpoint %d\n" % other, 1))
        done = self.run_here("run", "--checkpoint", "discs.checkpoint", "--resume", "--quiet")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, rf"format {other}, but this program reads format \d+")

    def test_recordings(self):
        # A recording that this program did not finish.
        os.remove(self.path("discs_stopped.h5.partial"))
        os.remove(self.path("discs_stopped.checkpoint"))
        process = subprocess.Popen(
            [
                SWIRL,
                "run",
                "run.toml",
                "--events",
                "4e7",
                "--frame-events",
                "200000",
                "--quiet",
                "--trajectory",
                "discs_stopped.h5",
                "--checkpoint",
                "discs_stopped.checkpoint",
            ],
            cwd=self.folder,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.assertTrue(worked(process, 0.5))
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=HANG)
        for file, command in (
            ("discs.h5", ("measure", "discs.h5")),
            ("discs_events.h5", ("verify", "discs_events.h5")),
            ("tracks.h5", ("measure", "tracks.h5")),
            (
                "discs_stopped.h5.partial",
                ("run", "--checkpoint", "discs_stopped.checkpoint", "--resume", "--quiet"),
            ),
        ):
            with self.subTest(file=file):
                self.edit_hdf5(file, "f['parameters'].attrs['format'] = 9")
                self.rejected(*command)

    def test_new_recordings_contain_their_format(self):
        made = self.run_here(
            "run",
            "run.toml",
            "--periods",
            6,
            "--trajectory",
            "t.h5",
            "--log-events",
            "e.h5",
            "--json",
            "now.json",
            "--quiet",
        )
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(self.json("now.json")["format"], 2)
        for file in ("t.h5", "e.h5"):
            self.assertIn(b"format\0", read_bytes(self.path(file)))


if __name__ == "__main__":
    unittest.main()
