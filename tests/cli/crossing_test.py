"""swirl crossing over lists: one search for each combination, and a table of all searches."""

import csv
import io
import json
import os
import signal
import subprocess
import time
import unittest

import private_slurm
from program import (
    HANG,
    SWIRL,
    InFolder,
    read_json,
    read_rows,
    read_text,
    swirl,
    wait_until,
    write_text,
)

SHORT = ["--events", "2e4", "--tolerance", 5, "--quiet"]
FEW = ["--from", 5, "--to", 7]
AROUND = ["--from", 35, "--to", 41]  # where it crosses, so that there is a number to compare


class Crossing(InFolder):
    def good(self, *arguments):
        done = self.assert_works("crossing", *arguments, *SHORT)
        return done.stdout

    def test_each_value_of_a_list_has_a_search(self):
        said = self.good(
            *AROUND,
            "--mu",
            "0.9,1",
            "--seed",
            4,
            "--csv",
            self.path("N_c.csv"),
            "--json",
            self.path("all.json"),
        )
        self.assertIn("mu 0.9: ", said)
        rows = read_rows(self.path("N_c.csv"))
        self.assertEqual([row["mu"] for row in rows], ["0.9", "1"])
        together = read_json(self.path("all.json"))
        for row, found, mu in zip(rows, together, ("0.9", "1"), strict=True):
            alone = json.loads(self.good(*AROUND, "--mu", mu, "--seed", 4, "--json", "-"))
            self.assertEqual(row["verdict"], alone["verdict"])
            for name in ("N_c", "N_c_error", "N_c_lower", "N_c_upper"):
                self.assertEqual(row[name], "" if alone[name] is None else repr(alone[name]))
                self.assertEqual(found[name], alone[name])
            self.assertEqual(int(row["runs"]), alone["runs"])
            self.assertEqual(int(row["events_in_all"]), alone["events"])

    def test_lists_combine_and_may_be_in_a_file(self):
        write_text(self.path("a.toml"), 'mu_disc = [0.9, 1]\nmu_wall = "0:1:1"\n')
        table = list(
            csv.DictReader(io.StringIO(self.good(self.path("a.toml"), *FEW, "--csv", "-")))
        )
        self.assertEqual(
            [(row["mu_disc"], row["mu_wall"]) for row in table],
            [("0.9", "0"), ("0.9", "1"), ("1", "0"), ("1", "1")],
        )
        # So few discs rotate for all friction coefficients.
        self.assertEqual([row["verdict"] for row in table], ["always rotates"] * 4)
        self.assertEqual([row["N_c"] for row in table], [""] * 4)

    def test_the_step_sets_the_numbers_of_the_coarse_scan(self):
        # So few discs do not change their direction of rotation.
        found = json.loads(self.good("--from", 5, "--to", 8, "--step", 2, "--json", "-"))
        self.assertEqual(found["sign_changes"], [])
        self.assertLessEqual({5, 7, 8}, {point["discs"] for point in found["points"]})

    def test_a_search_whose_runs_all_fail_does_not_stop_the_others(self):
        # Nearly inelastic discs collapse at once without a contact duration.
        done = self.assert_fails(
            1,
            "crossing",
            "--restitution",
            "0.1,1",
            "--contact-duration",
            0,
            *FEW,
            "--csv",
            "-",
            *SHORT,
            says="every run failed in 1 of 2 searches",
        )
        rows = list(csv.DictReader(io.StringIO(done.stdout)))
        self.assertEqual([row["verdict"] for row in rows], ["undecided", "always rotates"])
        self.assertEqual(rows[0]["runs"], "0")
        self.assertGreaterEqual(int(rows[0]["runs_failed"]), 3)
        self.assertEqual(rows[1]["runs_failed"], "0")

    def test_an_invalid_later_search_is_rejected_before_the_first(self):
        self.assert_fails(
            2,
            "crossing",
            "--container-radius",
            "8.6,4",
            *AROUND,
            "--json",
            self.path("x.json"),
            *SHORT,
        )
        self.assertEqual(self.left_behind(), [])

    def test_the_range_ends_at_what_fits_and_says_so(self):
        for given, range_of in (([], (5, 29)), (["--to", 40], (5, 29)), (["--to", 28], (5, 28))):
            done = self.assert_works(
                "crossing",
                "--container-radius",
                6.25,
                *given,
                "--events",
                "1e3",
                "--tolerance",
                5,
                "--json",
                self.path("range.json"),
            )
            found = read_json(self.path("range.json"))
            self.assertEqual((found["from"], found["to"]), range_of)
            self.assertEqual(
                "range       N = 5 to 29; " in done.stdout, range_of == (5, 29), done.stdout
            )
        table = self.good("--container-radius", "5,5.5", *FEW, "--csv", "-")
        self.assertEqual(
            [(row["from"], row["to"]) for row in csv.DictReader(io.StringIO(table))],
            [("5", "7")] * 2,
        )

    def test_my_points_are_compared_with_the_points_of_the_search(self):
        write_text(self.path("mine.csv"), "N,turns,circles\n5,9,20\n7,8,20\n")
        mine = ["--my-points", self.path("mine.csv"), "--csv", self.path("N_c.csv"), "--plot"]
        done = self.assert_works(
            "crossing", "--mu", "0.5,1", *FEW, "--events", "1e3", "--tolerance", 5, *mine
        )
        self.assertRegex(
            done.stdout, r"(?s)  my points   χ² = \S+ of 2 points for mu 0.5\n.*  best fit    mu = "
        )
        self.assertIn("N_c.png", self.left_behind())
        self.assert_fails(2, "crossing", *FEW, "--plot", says="--csv N_c.csv")
        write_text(self.path("wrong.csv"), "N,turns\n5,9\n")
        self.assert_fails(
            2,
            "crossing",
            *FEW,
            "--my-points",
            self.path("wrong.csv"),
            says="the columns are N, turns and circles",
        )

    def test_searches_in_dishes_of_several_sizes_share_a_folder(self):
        several = [
            "--container-radius",
            "3.2,8.6",
            "--from",
            5,
            "--to",
            9,
            "--out",
            self.path("sizes"),
        ]
        first = list(csv.DictReader(io.StringIO(self.good(*several, "--csv", "-"))))
        self.assertEqual([row["to"] for row in first], ["7", "9"])
        again = list(csv.DictReader(io.StringIO(self.good(*several, "--csv", "-"))))
        self.assertEqual([row["N_c_upper"] for row in again], [row["N_c_upper"] for row in first])

    def test_only_the_searched_numbers_must_fit(self):
        # 48 discs, the default of a run, do not fit into this container.
        found = json.loads(
            self.good("--container-radius", 6.3, "--from", 8, "--to", 10, "--json", "-")
        )
        self.assertEqual(found["verdict"], "always rotates")
        done = self.assert_fails(
            2,
            "crossing",
            "--container-radius",
            6.3,
            "--from",
            40,
            "--to",
            46,
            *SHORT,
            says="40 discs do not fit",
        )
        self.assertNotIn("--discs", done.stderr)

    def test_every_rotation_rate_has_a_crossing(self):
        alone = json.loads(
            self.good("--from", 35, "--to", 41, "--seed", 4, "--threads", 1, "--json", "-")
        )
        both = json.loads(
            self.good("--from", 35, "--to", 41, "--seed", 4, "--threads", 2, "--json", "-")
        )
        self.assertEqual(alone["by_rate"], both["by_rate"])
        self.assertEqual(alone["rate"], "mean_by_time")
        self.assertEqual(
            set(alone["by_rate"]),
            {"mean_by_event", "mean_by_time", "rigid_by_event", "rigid_by_time"},
        )
        self.assertEqual(alone["N_c"], alone["by_rate"]["mean_by_time"]["N_c"])
        rigid = json.loads(
            self.good(
                "--from", 35, "--to", 41, "--seed", 4, "--rate", "rigid_by_time", "--json", "-"
            )
        )
        self.assertEqual(rigid["N_c"], rigid["by_rate"]["rigid_by_time"]["N_c"])

    def points_of(self, *arguments):
        return {
            point["discs"]: point
            for point in json.loads(self.good(*arguments, "--json", "-"))["points"]
        }

    def test_every_number_of_discs_is_validated(self):
        # 45 of 5 discs cannot be small; with equal discs instead, the answer would be wrong.
        done = self.assert_fails(2, "crossing", "--mixture", "45:0.8", *SHORT)
        self.assertEqual(done.stderr, swirl("run", "--discs", 5, "--mixture", "45:0.8").stderr)
        self.assertIn("a share, such as --mixture 50%:0.8", done.stderr)

    def test_a_share_of_a_mixture_gives_the_runs_of_its_counts(self):
        call = ["--from", 6, "--to", 7, "--seed", 3]
        points = self.points_of(*call, "--mixture", "50%:0.8")
        for discs, count in ((6, 3), (7, 4)):
            runs = [
                json.loads(
                    swirl(
                        "run",
                        "--discs",
                        discs,
                        "--mixture",
                        f"{count}:0.8",
                        "--events",
                        "2e4",
                        "--seed",
                        seed,
                        "--json",
                        "-",
                        "--quiet",
                    ).stdout
                )
                for seed in (3, 4, 5)
            ]
            # The search weights its runs with their periods, which differ by less than a hundredth.
            mean = sum(run["rotation"]["mean_by_time"]["mean"] for run in runs) / 3
            self.assertAlmostEqual(points[discs]["mean_by_time"], mean, delta=1e-3)
        said = swirl(
            "crossing",
            *call,
            "--mixture",
            "50%:0.8",
            "--events",
            "2e4",
            "--tolerance",
            5,
            "--verbose",
        )
        self.assertIn("4 of 7 discs have radius 0.8: 50 %, rounded to whole discs", said.stdout)

    def test_listed_sizes_have_no_crossing(self):
        write_text(self.path("radii.csv"), "radius\n1\n0.8\n1\n")
        for call in (
            ["crossing"],
            ["map", "--x", "mu=0:1", "--quantity", "N_c", "--out", self.path("map")],
        ):
            done = self.assert_fails(
                2,
                *call,
                "--sizes",
                "file:" + self.path("radii.csv"),
                says="a search for N_c varies their number",
            )
            self.assertNotIn("--discs", done.stderr)

    def test_a_clockwise_path_has_the_crossing_of_its_mirror_image(self):
        # Both searches are short: they agree within five of their errors.
        found = [
            json.loads(self.good("--from", 34, "--to", 43, "--direction", direction, "--json", "-"))
            for direction in ("counter-clockwise", "clockwise")
        ]
        for direction in found:
            self.assertEqual(direction["verdict"], "crosses")
        self.assertLess(
            abs(found[0]["N_c"] - found[1]["N_c"]),
            5 * (found[0]["N_c_error"] + found[1]["N_c_error"]),
        )

    def test_distributed_sizes_get_more_seeds(self):
        # Each seed draws other sizes, so longer runs would not end the search.
        self.assert_works(
            "crossing",
            "--sizes",
            "normal:1:0.2",
            "--from",
            30,
            "--to",
            45,
            "--tolerance",
            2,
            "--quiet",
            "--json",
            self.path("a.json"),
        )
        self.assertTrue(read_json(self.path("a.json"))["within_tolerance"])

    def test_a_stopped_search_prints_its_points_and_continues(self):
        call = ["crossing", "--mu", "1", "--from", 30, "--to", 44, "--tolerance", 0.8]
        folder = ["--out", self.path("N_c")]
        whole = self.assert_works(*call, "--json", "-", "--quiet")
        process = subprocess.Popen(
            [SWIRL, *map(str, call + folder)],
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        results = self.path("N_c/results")
        while process.poll() is None and not (
            os.path.isdir(results) and len(os.listdir(results)) > 4
        ):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        said, errors = process.communicate(timeout=HANG)
        self.assertEqual(process.returncode, 130, errors)
        self.assertRegex(said, r"N = \d+ +ϖ/Ω = ")
        self.assertIn("repeat the call to continue", errors)
        done = self.assert_works(*call, *folder, "--json", "-", "--quiet")
        ours, others = json.loads(done.stdout), json.loads(whole.stdout)
        for key in ("N_c", "N_c_error", "points", "runs", "events", "sign_changes"):
            self.assertEqual(ours[key], others[key])
        # The folder is that of a sweep; each run is repeated by its command.
        self.assert_works("collect", self.path("N_c"), "--csv", "-")
        run = read_json(os.path.join(results, sorted(os.listdir(results))[0]))
        alone = swirl(*run["command"].split()[1:], "--json", "-", "--quiet")
        self.assertEqual(json.loads(alone.stdout)["state_hash"], run["state_hash"])
        self.assert_fails(2, *call, *folder, "--mu", "0.9", "--quiet")  # --mu twice
        self.assert_fails(
            1, "crossing", "--mu", "0.9", *folder, "--quiet", says="holds another search for N_c"
        )
        self.assertEqual(swirl("sweep", "--out", self.path("N_c")).returncode, 2)

    def test_invalid_options_are_rejected(self):
        for wrong, says in (
            (["--mu", "0.5,0.5"], "the same run"),
            (["--mu", "1,"], "empty"),
            (["--step", -1], "1 or more"),
            (["--rate", "rigid"], "rigid_by_time"),
            (["--threads", -1], "whole number"),
            (["--to", 10**9], "--to"),
            (["--mu", "0.1,2", "--csv", "-", "--json", "-"], "standard output"),
        ):
            self.assert_fails(2, "crossing", *wrong, *SHORT, says=says)


class Cluster(InFolder):
    def test_tasks_of_a_cluster_share_the_searches(self):
        slurm, environment = private_slurm.started_for(self, nodes=2)
        call, out = ["crossing", "--mu", "0.5,1", *FEW, *SHORT], self.path("two searches")
        submitted = self.assert_works(
            *call, "--out", out, "--slurm", "--tasks", 2, environment=environment
        )
        self.assertIn("Submitted as job", submitted.stdout)
        wait_until(lambda: not slurm.run("squeue", "-h").stdout)
        logs = "".join(
            read_text(os.path.join(out, "log", name)) for name in os.listdir(out + "/log")
        )
        made = sorted(os.listdir(out + "/results"))
        table = self.assert_works(*call, "--out", out, "--csv", "-").stdout
        # The tasks have made all runs of both searches.
        self.assertEqual(sorted(os.listdir(out + "/results")), made, logs)
        self.assertEqual(table, self.assert_works(*call, "--csv", "-").stdout)
        self.assertEqual(len(list(csv.DictReader(io.StringIO(table)))), 2)


if __name__ == "__main__":
    unittest.main()
