"""swirl map: adaptive maps are completed after an interruption; the table is the same for any
division of the runs between processes."""

import csv
import io
import json
import os
import subprocess
import unittest

import private_slurm
from program import (
    HANG,
    SOURCE,
    SWIRL,
    InFolder,
    read_json,
    read_rows,
    read_text,
    swirl,
    wait_until,
    write_text,
)

# A small map: rotation of a few discs, a coarse grid and short runs. It crosses the level 0.5.
MAP = [
    "map",
    "--x",
    "mu=0:1",
    "--y",
    "discs=4:40",
    "--steps",
    "7",
    "--level",
    "0.5",
    "--periods",
    "12",
    "--replicates",
    "4",
    "--no-figure",
    "--quiet",
]


class Map(InFolder):
    def table(self, folder):
        return read_text(os.path.join(folder, "map.csv"))

    def results(self, folder):
        return sorted(os.listdir(os.path.join(folder, "results")))

    def whole(self):
        self.shared("whole", lambda out: self.assert_works(*MAP, "--out", out))
        return self.table(self.path("whole")), self.results(self.path("whole"))

    def test_the_table_does_not_depend_on_threads_and_processes(self):
        table, results = self.whole()
        rows = list(csv.DictReader(io.StringIO(table)))
        self.assertEqual(
            list(rows[0]),
            [
                "mu",
                "discs",
                "mean_by_time",
                "mean_by_time_error",
                "verdict",
                "total_periods",
                "replicates",
                "failed",
            ],
        )
        self.assertLess(len(rows), 49)
        self.assertEqual({row["verdict"] for row in rows} - {"undetermined"}, {"above", "below"})
        self.assertEqual(sum(int(row["replicates"]) for row in rows), len(results))
        self.assert_works(*MAP, "--out", self.path("one"), "--threads", 1)
        self.assertEqual(
            (self.table(self.path("one")), self.results(self.path("one"))), (table, results)
        )
        parts = [
            subprocess.Popen(
                [SWIRL, *MAP, "--out", self.path("two"), "--part", f"{k}/2"],
                stderr=subprocess.DEVNULL,
            )
            for k in (1, 2)
        ]
        self.assertEqual([part.wait(HANG) for part in parts], [0, 0])
        self.assertFalse(os.path.exists(self.path("two/map.csv")))  # left to a call without a part
        self.assert_works("map", "--out", self.path("two"), "--no-figure", "--quiet")
        self.assertEqual(
            (self.table(self.path("two")), self.results(self.path("two"))), (table, results)
        )

    def test_each_size_of_the_container_has_the_range_that_fits(self):
        self.assert_works(
            "map",
            "--x",
            "container_radius=3.2,8.6",
            "--quantity",
            "N_c",
            "--from",
            5,
            "--to",
            9,
            "--periods",
            6,
            "--warmup",
            1,
            "--replicates",
            2,
            "--no-figure",
            "--quiet",
            "--out",
            self.path("sizes"),
        )
        rows = read_rows(self.path("sizes/map.csv"))
        self.assertEqual(
            [(row["container_radius"], row["from"], row["to"]) for row in rows],
            [("3.2", "5", "7"), ("8.6", "5", "9")],
        )
        self.assertEqual([row["failed"] for row in rows], ["0", "0"])

    def test_lost_and_damaged_results_are_made_again(self):
        table, results = self.whole()
        with open(self.path(f"whole/results/{results[1]}"), "r+b") as opened:
            opened.truncate(200)
        for name in results[::3]:
            os.remove(self.path(f"whole/results/{name}"))
        status = self.assert_works("map", "--out", self.path("whole"), "--status").stdout
        self.assertRegex(status, r"([2-9]|[1-9]\d+) runs to do")
        self.assert_works("map", "--out", self.path("whole"), "--no-figure", "--quiet")
        self.assertEqual(
            (self.table(self.path("whole")), self.results(self.path("whole"))), (table, results)
        )

    def test_messages_speak_of_maps(self):
        self.whole()
        for call in (
            ["map", "--out", self.path("whole"), "--grow", "--replicates", 2],
            ["collect", self.path("whole"), "--csv", self.path("whole/results/a.csv")],
        ):
            done = self.assert_fails(2, *call, says="the map")
            self.assertNotIn("sweep", done.stderr)
        plan = read_json(self.path("whole/plan.json"))
        plan["map"]["x"] = "restitution"  # names no axis
        write_text(self.path("whole/plan.json"), json.dumps(plan))
        for call in (["--status"], []):
            self.assert_fails(
                1,
                "map",
                "--out",
                self.path("whole"),
                *call,
                says="is damaged: restitution is not a parameter of this map",
            )

    def test_the_folder_is_that_of_a_sweep(self):
        table, results = self.whole()
        collected = self.assert_works("collect", self.path("whole"), "--csv", "-")
        self.assertNotIn("no result yet", collected.stderr)
        found = {
            (row["mu"], row["discs"]): row for row in csv.DictReader(io.StringIO(collected.stdout))
        }
        for row in csv.DictReader(io.StringIO(table)):
            self.assertEqual(row["mean_by_time"], found[row["mu"], row["discs"]]["mean_by_time"])
            self.assertEqual(
                row["mean_by_time_error"], found[row["mu"], row["discs"]]["mean_by_time_error"]
            )
            self.assertEqual(row["replicates"], found[row["mu"], row["discs"]]["replicates"])
        self.assert_fails(2, "sweep", "--out", self.path("whole"), says="swirl map --out")
        # A run has the seed that a sweep of its parameters gives it.
        run = read_json(self.path(f"whole/results/{results[0]}"))
        alone = self.assert_works(*run["command"].split()[1:], "--json", "-", "--quiet")
        self.assertEqual(json.loads(alone.stdout)["state_hash"], run["state_hash"])

    def test_crossings_along_one_parameter(self):
        call = [
            "map",
            "--x",
            "mu=0.9,1",
            "--quantity",
            "N_c",
            "--from",
            36,
            "--to",
            40,
            "--periods",
            40,
            "--tolerance",
            5,
            "--no-figure",
            "--quiet",
            "--out",
            self.path("N_c"),
        ]
        self.assert_works(*call)
        rows = read_rows(self.path("N_c/map.csv"))
        self.assertEqual([row["mu"] for row in rows], ["0.9", "1"])
        # The table of a sweep of these runs has the same crossings.
        self.assert_works(
            "collect",
            self.path("N_c"),
            "--csv",
            self.path("t.csv"),
            "--crossings",
            self.path("c.csv"),
        )
        for ours, other in zip(rows, read_rows(self.path("c.csv")), strict=True):
            for name in ("N_c", "N_c_error", "N_c_lower", "N_c_upper"):
                self.assertEqual(ours[name], other[name])
            if ours["verdict"] == "crosses":
                self.assertTrue(36 <= float(ours["N_c"]) <= 40)

    def test_a_measured_number(self):
        self.assert_works(
            "map",
            "--x",
            "discs=6,30",
            "--quantity",
            "slip.cluster",
            "--level",
            0.5,
            "--periods",
            10,
            "--replicates",
            2,
            "--no-figure",
            "--quiet",
            "--out",
            self.path("slip"),
        )
        rows = read_rows(self.path("slip/map.csv"))
        self.assertEqual([row["discs"] for row in rows], ["6", "30"])
        self.assertGreater(float(rows[1]["slip.cluster"]), 0)

    def test_failed_runs_are_excluded_and_reported(self):
        # Nearly inelastic discs collapse without a contact duration.
        call = [
            "map",
            "--x",
            "restitution=0.1,1",
            "--contact-duration",
            0,
            "--periods",
            10,
            "--replicates",
            2,
            "--no-figure",
            "--quiet",
            "--out",
        ]
        done = self.assert_works(*call, self.path("collapse"))
        self.assertIn("warning: runs failed at 1 of 2 points", done.stderr)
        rows = read_rows(self.path("collapse/map.csv"))
        self.assertEqual(
            [(row["verdict"], row["failed"]) for row in rows], [("failed", "2"), ("below", "0")]
        )  # 48 discs
        self.assert_fails(
            1,
            "map",
            "--x",
            "restitution=0.1,0.2",
            *call[3:],
            self.path("none"),
            says="error: every run failed",
        )

    def test_failed_runs_are_tried_again_and_the_reason_is_reported(self):
        call = [
            "map",
            "--x",
            "restitution=0.1,1",
            "--contact-duration",
            0,
            "--periods",
            10,
            "--replicates",
            2,
            "--no-figure",
            "--quiet",
            "--out",
            self.path("m"),
        ]
        done = self.assert_works(*call)
        self.assertIn(
            "tries them again. The first is --restitution 0.1, replicate 1: the last ", done.stderr
        )
        self.assertIn("inelastic collapse", done.stderr)
        self.assertIn("hint: use a --contact-duration", done.stderr)
        # An error that does not come back, as from a full disk: the run has no result, and its
        # message remains.
        names = self.results(self.path("m"))
        self.assertEqual(len(names), 2)
        before = self.table(self.path("m"))
        os.remove(self.path(f"m/results/{names[0]}"))
        failure = self.path(f"m/failures/{names[0][:-5]}.txt")
        write_text(failure, "the disk is full.\n")
        again = self.assert_works("map", "--out", self.path("m"), "--no-figure", "--quiet")
        self.assertNotIn("disk is full", again.stderr)
        self.assertFalse(os.path.exists(failure))
        self.assertEqual(self.table(self.path("m")), before)
        self.assertEqual(len(os.listdir(self.path("m/failures"))), 2)

    def test_a_grown_map_keeps_its_runs(self):
        self.whole()
        folder = self.path("whole/results")
        made = {
            name: os.stat(os.path.join(folder, name)).st_mtime_ns for name in os.listdir(folder)
        }
        self.assert_works(
            "map",
            "--out",
            self.path("whole"),
            "--grow",
            "--x",
            "mu=0:1.5",
            "--steps",
            10,
            "--replicates",
            8,
            "--no-figure",
            "--quiet",
        )
        for name, time_of in made.items():
            self.assertEqual(os.stat(os.path.join(folder, name)).st_mtime_ns, time_of)
        rows = read_rows(self.path("whole/map.csv"))
        self.assertEqual(sum(int(row["replicates"]) for row in rows), len(os.listdir(folder)))
        self.assertEqual(max(float(row["mu"]) for row in rows), 1.5)
        order = [(float(row["discs"]), float(row["mu"])) for row in rows]
        self.assertEqual(order, sorted(order))
        # The same points at the same seeds as in a map without growth have the same values.
        alone = self.assert_works(
            "map",
            "--x",
            "mu=0,0.5,1,1.5",
            "--y",
            "discs=4:40",
            "--steps",
            7,
            "--level",
            0.5,
            "--periods",
            12,
            "--replicates",
            8,
            "--no-figure",
            "--quiet",
            "--out",
            self.path("alone"),
        )
        self.assertEqual(alone.returncode, 0)
        grown = {(row["mu"], row["discs"]): row for row in rows}
        shared = [
            row
            for row in read_rows(self.path("alone/map.csv"))
            if (row["mu"], row["discs"]) in grown
        ]
        self.assertGreater(len(shared), 4)
        for row in shared:
            if row["replicates"] == grown[row["mu"], row["discs"]]["replicates"]:
                self.assertEqual(row, grown[row["mu"], row["discs"]])
        # The grown map continues with its folder alone, and is as large.
        before = self.table(self.path("whole"))
        self.assert_works("map", "--out", self.path("whole"), "--no-figure", "--quiet")
        self.assertEqual(self.table(self.path("whole")), before)
        for wrong, says in (
            (["--mu", 1], "--mu"),
            (["--quantity", "spin"], "--quantity"),
            ([], "no --x"),
            (["--x", "period=1:2"], "not an axis"),
            (["--replicates", 2], "can only grow"),
            (["--to", 60], "--from and --to belong to maps of N_c"),
            (["--steps", 5, "--replicates", 9], "no axis"),
        ):
            self.assert_fails(2, "map", "--out", self.path("whole"), "--grow", *wrong, says=says)

    def test_the_range_of_the_searches_for_a_crossing_can_grow(self):
        call = ["map", "--x", "mu=1,2", "--quantity", "N_c", "--periods", 40, "--tolerance", 5]
        more = ["--no-figure", "--quiet", "--out", self.path("N_c")]
        self.assert_works(*call, "--from", 24, "--to", 30, *more)
        self.assertEqual(
            [row["verdict"] for row in read_rows(self.path("N_c/map.csv"))], ["always rotates"] * 2
        )
        folder = self.path("N_c/results")
        made = {
            name: os.stat(os.path.join(folder, name)).st_mtime_ns for name in os.listdir(folder)
        }
        for wrong in (["--to", 29], ["--from", 25]):
            self.assert_fails(
                2, "map", "--grow", *wrong, "--out", self.path("N_c"), says="cover 24 to 30 discs"
            )
        self.assert_works("map", "--grow", "--to", 46, *more)
        for name, time_of in made.items():
            self.assertEqual(os.stat(os.path.join(folder, name)).st_mtime_ns, time_of)
        rows = read_rows(self.path("N_c/map.csv"))
        self.assertEqual([row["verdict"] for row in rows], ["crosses"] * 2)
        self.assertEqual(sum(int(row["replicates"]) for row in rows), len(os.listdir(folder)))
        self.assertTrue(all(30 < float(row["N_c"]) < 46 for row in rows))
        # The map continues with its folder alone, and its folder is that of a sweep.
        before = self.table(self.path("N_c"))
        self.assert_works("map", *more)
        self.assertEqual(self.table(self.path("N_c")), before)
        self.assert_works(
            "collect",
            self.path("N_c"),
            "--csv",
            self.path("t.csv"),
            "--crossings",
            self.path("c.csv"),
        )
        for ours, other in zip(rows, read_rows(self.path("c.csv")), strict=True):
            self.assertEqual((ours["N_c"], ours["N_c_error"]), (other["N_c"], other["N_c_error"]))

    def test_invalid_calls_are_rejected_before_anything_is_written(self):
        for wrong, says in (
            (["--x", "mu"], "NAME=VALUES"),
            (["--x", "colour=1:2"], "colour"),
            (["--x", "mu=1:0"], "below"),
            (["--x", "mu=0:1", "--y", "mu=0:1"], "both"),
            (["--x", "mu=0:1", "--quantity", "slip"], "slip.cluster"),
            (["--x", "mu=0:1", "--quantity", "N_c", "--discs", 30], "--from"),
            (["--x", "mu=0:1", "--steps", 1], "--steps"),
            (["--x", "mu=0:1", "--mu", 1], "--mu"),
            (["--x", "mu=0:1", "--part", "3/2"], "PART/PARTS"),
            (["--y", "mu=0:1"], "--x"),
            (["--x", "mu=0:1", "--csv", self.path("m/plan.json")], "figure"),
            ([], "--x"),
            (["--replicates", 4], "--x"),
            (["--x", "mu=0:1", "--seed", 3], "--seed"),
        ):
            self.assert_fails(2, "map", *wrong, "--out", self.path("m"), says=says)
            self.assertEqual(self.left_behind(), [])

    def test_options_may_be_in_a_file(self):
        with open(self.path("map.toml"), "w", encoding="utf-8") as opened:
            opened.write(
                'x = "mu=0:1"\ny = "discs=4:40"\nsteps = 7\nlevel = 0.5\nperiods = 12\nseeds = 4\n'
            )
        self.assert_works(
            "map", self.path("map.toml"), "--no-figure", "--quiet", "--out", self.path("file")
        )
        self.assertEqual(self.table(self.path("file")), self.whole()[0])


class Figure(InFolder):
    def test_the_script_draws_maps_and_curves_from_their_tables_alone(self):
        tables = {
            "map": "mu,amplitude,mean_by_time,mean_by_time_error,verdict,total_periods,replicates,failed\n"
            + "".join(
                f"{x},{y},{x - y + 0.1},0.05,above,100,2,0\n"
                for x in (0, 0.5, 1)
                for y in (0, 1, 2)
            ),
            "few": "mu,amplitude,mean_by_time,mean_by_time_error,verdict,total_periods,replicates,failed\n0,1,0.5,,above,10,1,0\n"
            "1,1,,,failed,,0,2\n",
            "curve": "mu,mean_by_time,mean_by_time_error,verdict,total_periods,replicates,failed\n"
            "0,0.4,0.1,above,10,2,0\n1,-0.4,0.1,below,10,2,0\n",
            "N_c": "mu,N_c,N_c_error,N_c_lower,N_c_upper,verdict,total_periods,replicates,failed\n"
            "0.5,40.1,0.2,39.7,40.5,crosses,10,2,0\n0.1,,,,,always rotates,10,2,0\n",
            "N_c map": "mu,amplitude,N_c,N_c_error,N_c_lower,N_c_upper,verdict,total_periods,replicates,failed\n"
            + "".join(
                f"{x},{y},{35 + 5 * x + y},0.2,34,36,crosses,100,2,0\n"
                for x in (0.5, 0.7, 1)
                for y in (1, 2)
            )
            + "0,1,,,,,always rotates,100,2,0\n0,2,,,,,undecided,100,2,0\n",
        }
        for name, text in tables.items():
            write_text(self.path(f"{name}.csv"), text)
            subprocess.run(
                [
                    "/usr/bin/python3",
                    "-B",
                    os.path.join(SOURCE, "paper"),
                    "parameter_map",
                    self.path(f"{name}.csv"),
                ],
                check=True,
                cwd="/",
            )
            for kind in ("png", "pdf"):
                self.assertGreater(os.path.getsize(self.path(f"{name}.{kind}")), 4000)

    def test_a_map_is_drawn_next_to_its_table(self):
        done = self.assert_works(
            "map",
            "--x",
            "discs=6,12",
            "--periods",
            10,
            "--replicates",
            2,
            "--out",
            self.path("map"),
        )
        self.assertIn("\n  table       " + self.path("map/map.csv") + "\n", done.stdout)
        for kind in ("png", "pdf"):
            self.assertGreater(os.path.getsize(self.path(f"map/map.{kind}")), 4000)


class Cluster(InFolder):
    def test_tasks_of_a_cluster_share_a_map(self):
        slurm, environment = private_slurm.started_for(self, nodes=2)
        out = self.path("a map")
        call = [word for word in MAP if word not in ("--no-figure", "--quiet")]
        self.assert_works(*call, "--out", out, "--slurm", "--tasks", 2, environment=environment)

        def is_over():
            status = swirl("map", "--out", out, "--status", environment=environment).stdout
            return "; 0 runs to do" in status or "no longer in the queue" in status

        wait_until(is_over)
        logs = ""
        for name in os.listdir(out + "/log"):
            logs += read_text(os.path.join(out, "log", name))
        self.assertIn("; 0 runs to do", swirl("map", "--out", out, "--status").stdout, logs)
        self.assert_works("map", "--out", out, "--no-figure", "--quiet")
        self.assert_works(*MAP, "--out", self.path("one"))
        with open(out + "/map.csv", encoding="utf-8") as ours, open(
            self.path("one/map.csv"), encoding="utf-8"
        ) as one:
            self.assertEqual(ours.read(), one.read())
        # The folder can be deleted when no job writes into it.
        wait_until(lambda: not slurm.run("squeue", "-h").stdout)


if __name__ == "__main__":
    unittest.main()
