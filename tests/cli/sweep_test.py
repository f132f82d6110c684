"""Sweeps complete after any interruption, and the table does not depend on which process did the
work."""

import json
import os
import random
import re
import resource
import shutil
import subprocess
import time

from program import (
    ALL,
    HANG,
    SWIRL,
    InFolder,
    main,
    read_bytes,
    read_json,
    swirl,
    wait_until,
    without_time,
    write_text,
)

PLAN = [
    "sweep",
    "--discs",
    "5:12",
    "--mu",
    "0.5,1",
    "--replicates",
    "3",
    "--events",
    "20000",
    "--quiet",
]
POINTS = 48


class Sweep(InFolder):
    def table(self, folder):
        done = self.assert_works("collect", folder, "--csv", "-")
        return done.stdout

    def whole(self):
        self.shared("whole", lambda out: self.assert_works(*PLAN, "--out", out))
        table = self.table(self.path("whole"))
        self.assertEqual(len(table.splitlines()), 17)
        self.assertEqual(len(os.listdir(self.path("whole/results"))), POINTS)
        return table

    def test_the_table_does_not_depend_on_threads_parts_and_order(self):
        table = self.whole()
        self.assert_works(*PLAN, "--out", self.path("a"), "--threads", 1)
        self.assertEqual(self.table(self.path("a")), table)
        for part in (3, 1, 2):
            self.assert_works(*PLAN, "--out", self.path("b"), "--part", f"{part}/3")
        self.assertEqual(self.table(self.path("b")), table)

    def test_a_plan_file_equals_the_options(self):
        table = self.whole()
        write_text(
            self.path("plan.toml"), 'discs = "5:12"\nmu = [0.5, 1]\nseeds = 3\nevents = 20000\n'
        )
        self.assert_works("sweep", self.path("plan.toml"), "--out", self.path("a"), "--quiet")
        self.assertEqual(self.table(self.path("a")), table)

    def test_repeated_calls_complete_a_sweep_that_is_killed_many_times(self):
        table = self.whole()
        begin = time.monotonic()
        self.assert_works(*PLAN, "--out", self.path("timed"))
        # The kills are spread from the start to nearly the end, on a machine of any speed.
        longest = 0.5 * (time.monotonic() - begin)
        choose = random.Random(5)
        # Ten kills hit runs, results and the start of the sweep. tests/faults interrupts the
        # renames one by one.
        hits, kills, folders = 0, 50 if ALL else 10, []
        while hits < kills:
            folder = self.path(f"killed{len(folders)}")
            folders.append(folder)
            for _ in range(1000):
                process = subprocess.Popen(
                    [SWIRL, *PLAN, "--out", folder],
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.PIPE,
                    text=True,
                )
                try:
                    errors = process.communicate(
                        timeout=choose.uniform(0.001, longest) if hits < kills else HANG
                    )[1]
                    break
                except subprocess.TimeoutExpired:
                    process.kill()
                    process.communicate()
                    hits += 1
                if os.path.isdir(folder + "/results"):
                    for name in os.listdir(folder + "/results"):
                        if name.endswith(".json"):
                            read_json(f"{folder}/results/{name}")
            self.assertEqual(process.returncode, 0, errors)
            self.assertEqual(len(os.listdir(folder + "/results")), POINTS)  # no leftovers
            self.assertEqual([n for n in os.listdir(folder) if n.endswith(".partial")], [])
            self.assertEqual(self.table(folder), table)

    def test_temporary_files_of_a_kill_are_removed(self):
        folder = self.path("killed")
        os.mkdir(folder)
        left = folder + "/plan.json.0123456789abcdef.partial"
        write_text(left, "{")
        self.assert_works(*PLAN, "--out", folder)
        self.assertFalse(os.path.exists(left))

    def test_results_have_measurements_and_recordings(self):
        plan = [
            "sweep",
            "--discs",
            "8,20",
            "--replicates",
            "2",
            "--events",
            "20000",
            "--measure",
            "slip,radial",
            "--frames-per-period",
            "4",
            "--quiet",
            "--out",
            self.path("a"),
        ]
        self.assert_works(*plan)
        result = read_json(self.path("a/results/000003.json"))
        self.assertEqual(result["generator"], "SplitMix64")
        # The command in a result makes this result.
        alone = self.assert_works(*result["command"].split()[1:], "--json", "-", "--quiet")
        alone = json.loads(alone.stdout)
        for part in ("state_hash", "rotation", "measured", "config"):
            self.assertEqual(alone[part], result[part])
        rows = [line.split(",") for line in self.table(self.path("a")).splitlines()]
        column = rows[0].index("slip.cluster")
        self.assertEqual(rows[0][column + 1], "slip.cluster_error")
        results = [read_json(self.path(f"a/results/{point:06}.json")) for point in (2, 3)]
        slips = [each["measured"]["slip"]["cluster"] for each in results]
        # Runs of equal numbers of events have different lengths, which are their weights.
        lengths = [each["periods"] - each["warmup"]["periods"] for each in results]
        means, errors = ([slip[name] for slip in slips] for name in ("mean", "error"))
        weighted = sum(mean * length for mean, length in zip(means, lengths)) / sum(lengths)
        self.assertAlmostEqual(float(rows[2][column]), weighted, delta=1e-12)
        # The error is at least the one within the runs and the one between them. Student's factor
        # for the few blocks is below 2 if the two agree.
        least = max(abs(means[0] - means[1]) / 2, (errors[0] ** 2 + errors[1] ** 2) ** 0.5 / 2)
        self.assertGreaterEqual(float(rows[2][column + 1]), least)
        self.assertLess(float(rows[2][column + 1]), 2 * least)
        self.assertIn(
            rows[2][rows[0].index("steady_state")], ("steady", "drifting", "too short to tell")
        )
        float(rows[2][rows[0].index("scatter")])
        self.assertEqual(
            sorted(os.listdir(self.path("a/trajectories"))),
            [f"{point:06}.h5" for point in range(4)],
        )
        self.assert_works("verify", self.path("a/trajectories/000003.h5"))
        # The plan in the folder includes measurements and frames.
        os.remove(self.path("a/results/000003.json"))
        self.assert_works("sweep", "--out", self.path("a"), "--quiet")
        self.assertEqual(
            [line.split(",") for line in self.table(self.path("a")).splitlines()], rows
        )
        self.assert_fails(
            1, *[word.replace("slip,radial", "slip") for word in plan], says="holds another sweep"
        )

    def test_a_table_of_points_makes_the_runs_of_a_product(self):
        table = [line.split(",") for line in self.whole().splitlines()]
        points = self.path("points.csv")
        write_text(points, "# chosen points\nmu,discs,seeds\n1,12,3\n0.5,5,3\n")
        call = ["sweep", "--points", points, "--events", 20000, "--out", self.path("a"), "--quiet"]
        for part in ("2/2", "1/2", "1/1"):
            self.assert_works(*call, "--part", part)
        self.assertEqual(len(os.listdir(self.path("a/results"))), 6)
        rows = [line.split(",") for line in self.table(self.path("a")).splitlines()]
        self.assertEqual(rows, [table[0], table[16], table[1]])
        # The table need not exist any more, and a lost result is made again.
        os.remove(points)
        os.remove(self.path("a/results/000004.json"))
        done = swirl("sweep", "--out", self.path("a"))
        self.assertIn("6 of 6 runs done (1 by this call)", done.stdout)
        self.assertRegex(done.stdout, r"points +2 rows, 3 replicates")
        self.assertEqual(
            [line.split(",") for line in self.table(self.path("a")).splitlines()], rows
        )

    def test_a_table_grows_by_rows_and_by_replicates_of_single_points(self):
        points = self.path("points.csv")

        def sweep(text, *more):
            write_text(points, text)
            return swirl(
                "sweep", "--points", points, "--events", 3000, "--out", self.path("a"), *more
            )

        self.assertEqual(sweep("discs\n5\n6\n").returncode, 0)
        self.assertIn("--grow", sweep("discs\n5\n6\n7\n").stderr)
        before = {
            name: os.stat(self.path(f"a/results/{name}")).st_mtime_ns
            for name in os.listdir(self.path("a/results"))
        }
        done = sweep("discs,seeds\n6,3\n7,1\n", "--grow")
        self.assertIn("5 of 5 runs done (3 by this call)", done.stdout)
        self.assertIn("3 rows, 1 to 3 replicates", done.stdout)
        self.assertEqual(
            {name: os.stat(self.path(f"a/results/{name}")).st_mtime_ns for name in before}, before
        )
        self.assertEqual(
            [row.split(",")[:3] for row in self.table(self.path("a")).splitlines()],
            [
                ["discs", "events", "replicates"],
                ["5", "3000", "1"],
                ["6", "3000", "3"],
                ["7", "3000", "1"],
            ],
        )
        for wrong, says in ((["--discs", 9], "table of points"), (["--chain", "mu"], "--chain")):
            self.assert_fails(2, "sweep", "--out", self.path("a"), "--grow", *wrong, says=says)
        done = swirl("sweep", "--out", self.path("a"), "--grow", "--replicates", 2, "--dry-run")
        self.assertIn(
            "7 runs:\n  table of 3 points\n  discs: 5 6 7\n  events: 3000 3000 3000\n"
            "  replicates: 2 3 2\n",
            done.stdout,
        )

    def test_a_table_that_grows_keeps_its_common_parameters(self):
        def sweep(text, *more):
            write_text(self.path("points.csv"), text)
            return swirl(
                "sweep",
                "--points",
                self.path("points.csv"),
                "--out",
                self.path("a"),
                "--quiet",
                *more,
            )

        common = ["--mu", "0.5", "--periods", 3]
        self.assertEqual(sweep("discs\n5\n6\n", *common).returncode, 0)
        for more in ([], common, ["--mu", "0.50"]):
            self.assertEqual(sweep("discs\n7\n", "--grow", *more).returncode, 0)
        self.assertEqual(sweep("discs,mu\n8,0.5\n", "--grow").returncode, 0)
        self.assertEqual(
            [row.split(",")[:3] for row in self.table(self.path("a")).splitlines()],
            [["discs", "mu", "periods"], *([n, "0.5", "3"] for n in "5678")],
        )
        for text, more, says in (
            (
                "discs,mu\n9,1\n",
                [],
                "line 2: mu is 1, but all rows of the sweep in the folder have mu 0.5",
            ),
            ("discs\n9\n", ["--mu", "1"], "--mu is 1, but all rows"),
            ("discs\n9\n", ["--restitution", "0.9"], "has no common value of it"),
        ):
            done = sweep(text, "--grow", *more)
            self.assertEqual(done.returncode, 2)
            self.assertIn(says, done.stderr)
        # The hint for another parameter.
        self.assertEqual(sweep("discs,restitution\n9,0.9\n", "--grow").returncode, 0)

    def test_two_processes_share_one_folder(self):
        table = self.whole()
        both = [
            subprocess.Popen(
                [SWIRL, *PLAN, "--out", self.path("a")], stderr=subprocess.PIPE, text=True
            )
            for _ in range(2)
        ]
        for process in both:
            errors = process.communicate(timeout=HANG)[1]
            self.assertEqual(process.returncode, 0, errors)
        self.assertEqual(self.table(self.path("a")), table)

    def test_running_points_are_locked_and_released_by_a_kill(self):
        def status():
            return swirl("sweep", "--out", self.path("a"), "--status").stdout

        process = subprocess.Popen(
            [
                SWIRL,
                "sweep",
                "--discs",
                "5:8",
                "--events",
                "1e12",
                "--threads",
                "3",
                "--quiet",
                "--out",
                self.path("a"),
            ]
        )
        try:
            wait_until(
                lambda: os.path.exists(self.path("a/plan.json")) and "3 running" in status(),
                process,
            )
            self.assertEqual(status(), "0 of 4 runs done, 3 running, 0 failed, 1 to do\n")
            # Another process takes only the free point.
            other = subprocess.Popen([SWIRL, "sweep", "--quiet", "--out", self.path("a")])
            wait_until(lambda: "4 running" in status(), other)
            other.kill()
            other.wait()
            self.assertIn("3 running", status())
        finally:
            process.kill()
            process.wait()
        self.assertEqual(status(), "0 of 4 runs done, 0 running, 0 failed, 4 to do\n")

    def test_a_failed_run_does_not_stop_the_others(self):
        # Nearly inelastic discs collapse if there are many.
        write_text(self.path("points.csv"), "discs,restitution\n1,0.3\n48,0.3\n2,0.3\n")
        for name, points in (
            ("axes", ["--discs", "1,48,2", "--restitution", 0.3]),
            ("table", ["--points", self.path("points.csv")]),
        ):
            folder = self.path(name)
            self.assert_fails(
                1,
                "sweep",
                *points,
                "--contact-duration",
                0,
                "--events",
                1500,
                "--out",
                folder,
                says=("1 of the runs failed", "the first at point 1: ", "inelastic collapse"),
            )
            self.assertIn(
                "2 of 3 runs done, 0 running, 1 failed",
                swirl("sweep", "--out", folder, "--status").stdout,
            )
            self.assertEqual(len(self.table(folder).splitlines()), 3)

    def test_a_run_without_a_whole_period_has_empty_averages(self):
        self.assert_works(
            "sweep",
            "--discs",
            "5,48",
            "--events",
            2000,
            "--measure",
            "slip",
            "--out",
            self.path("a"),
            "--quiet",
        )
        collected = swirl("collect", self.path("a"), "--csv", "-")
        self.assertIn("1 of the runs completed no whole period", collected.stderr)
        header, five, many = [line.split(",") for line in collected.stdout.splitlines()]
        for name in (
            "mean_by_event",
            "mean_by_event_error",
            "mean_by_time",
            "rigid_by_time",
            "slip.cluster",
        ):
            self.assertNotEqual(five[header.index(name)], "")
            self.assertEqual(many[header.index(name)], "")
        self.assertNotEqual(many[header.index("energy")], "")

    def test_column_names_are_unique(self):
        for length, others in (
            (("--events", 2000), ["mu", "events"]),
            (("--periods", 3), ["mu", "periods"]),
        ):
            folder = self.path(length[0][2:])
            self.assert_works(
                "sweep",
                "--discs",
                "5,6",
                "--mu",
                1,
                *length,
                "--measure",
                "slip",
                "--out",
                folder,
                "--quiet",
            )
            header, *rows = [line.split(",") for line in self.table(folder).splitlines()]
            self.assertEqual(len(set(header)), len(header), header)
            self.assertEqual(header[1:3], others)
            for row in rows:
                self.assertEqual(len(row), len(header))
                self.assertGreaterEqual(float(row[header.index("periods")]), 3)

    def test_a_grown_sweep_keeps_its_results(self):
        table = self.whole()
        small = [
            "sweep",
            "--discs",
            "5,7:9",
            "--mu",
            "1",
            "--replicates",
            "1",
            "--events",
            "20000",
            "--quiet",
            "--out",
            self.path("a"),
        ]
        self.assert_works(*small)
        self.assert_fails(1, "sweep", "--discs", "5:12", "--out", self.path("a"), says="--grow")

        def results():
            folder = self.path("a/results")
            return {
                name: os.stat(os.path.join(folder, name)).st_mtime_ns for name in os.listdir(folder)
            }

        def grow(*more):
            before = results()
            self.assert_works("sweep", "--out", self.path("a"), "--grow", *more, "--quiet")
            after = results()
            # Existing results are unchanged.
            self.assertEqual({name: after[name] for name in before}, before)
            return len(after) - len(before)

        self.assertEqual(grow("--discs", "6"), 1)
        self.assertEqual(grow("--discs", "6"), 0)
        self.assertEqual(grow("--mu", "0.5", "--replicates", 2), 15)
        self.assertEqual(grow("--discs", "10:12", "--replicates", 3), 28)
        # The table is bytewise identical to that of a single call.
        self.assertEqual(self.table(self.path("a")), table)
        # A call with only the folder continues the grown sweep.
        os.remove(self.path("a/results/000040.json"))
        self.assert_works("sweep", "--out", self.path("a"), "--quiet")
        self.assertEqual(self.table(self.path("a")), table)
        for wrong, says in (
            (["--restitution", "0.9"], "not a parameter of this sweep"),
            (["--replicates", 1], "can only grow"),
            (["--frames-per-period", 3], "--frames-per-period"),
            (["--discs", "5.0"], "the same run"),
            (["--sieze", "3"], "--sieze"),
        ):
            self.assert_fails(2, "sweep", "--out", self.path("a"), "--grow", *wrong, says=says)
        self.assertEqual(self.table(self.path("a")), table)

    def test_further_measurements_repeat_the_same_runs(self):
        plan = ["sweep", "--discs", "8,20", "--events", "20000", "--quiet", "--out", self.path("a")]
        self.assert_works(*plan, "--measure", "slip")
        before = [line.split(",") for line in self.table(self.path("a")).splitlines()]
        self.assert_works(
            "sweep", "--out", self.path("a"), "--grow", "--measure", "radial,temperature", "--quiet"
        )
        after = [line.split(",") for line in self.table(self.path("a")).splitlines()]
        self.assertIn("temperature.granular", after[0])
        for old, new in zip(before, after, strict=True):
            for name, value in zip(before[0], old):
                self.assertEqual(new[after[0].index(name)], value)
        self.assertEqual(sorted(os.listdir(self.path("a/results"))), ["000000.json", "000001.json"])
        # New points have all measurements.
        self.assert_works("sweep", "--out", self.path("a"), "--grow", "--discs", 12, "--quiet")
        grown = self.table(self.path("a")).splitlines()
        self.assertEqual([grown[1], grown[3]], [",".join(row) for row in after[1:]])

    def test_a_plan_smaller_than_before_is_rejected(self):
        self.assert_works(
            "sweep", "--discs", "5", "--events", 3000, "--out", self.path("a"), "--quiet"
        )
        self.assert_works("sweep", "--out", self.path("a"), "--grow", "--discs", 6, "--quiet")
        plan = read_json(self.path("a/plan.json"))
        for before in (
            [{"values": [3, 1], "replicates": 1}],
            [{"values": [1, 1], "replicates": 2}],
            [{"values": [1], "replicates": 1}],
            [{"values": [0, 1], "replicates": 1}],
        ):
            write_text(self.path("a/plan.json"), json.dumps({**plan, "before": before}))
            self.assert_fails(1, "collect", self.path("a"), says="the plan before it grew")

    def test_crossings_of_a_collected_sweep(self):
        # Long runs cross between 37 and 39 at mu = 1, and never without friction at the wall.
        self.assert_works(
            "sweep",
            "--discs",
            "30:2:46",
            "--mu-wall",
            "0,1",
            "--mu-disc",
            1,
            "--events",
            "1e5",
            "--replicates",
            2,
            "--out",
            self.path("a"),
            "--quiet",
        )
        self.assert_works("collect", self.path("a"), "--crossings", self.path("N_c.csv"))
        with open(self.path("N_c.csv")) as opened:
            header, smooth, rough = [line.rstrip("\n").split(",") for line in opened]
        self.assertEqual(header[:3], ["mu_disc", "mu_wall", "events"])
        self.assertEqual(smooth[header.index("verdict")], "always rotates")
        self.assertEqual(smooth[header.index("N_c")], "")
        self.assertEqual(rough[header.index("verdict")], "crosses")
        self.assertEqual(rough[header.index("points")], "9")
        # With even numbers only, there is a bracket and no estimate.
        self.assertEqual(rough[header.index("N_c")], "")
        lower, upper = (float(rough[header.index(name)]) for name in ("N_c_lower", "N_c_upper"))
        self.assertEqual((lower % 2, upper % 2), (0, 0))
        self.assertTrue(34 <= lower < upper <= 42, (lower, upper))
        self.assert_works(
            "sweep", "--out", self.path("a"), "--grow", "--discs", "35:2:41", "--quiet"
        )
        done = swirl("collect", self.path("a"), "--crossings", self.path("N_c.csv"))
        with open(self.path("N_c.csv")) as opened:
            header, _, rough = [line.rstrip("\n").split(",") for line in opened]
        numbers = {
            name: float(rough[header.index(name)])
            for name in (
                "N_c",
                "N_c_mean_by_event",
                "N_c_mean_by_time",
                "N_c_rigid_by_event",
                "N_c_rigid_by_time",
            )
        }
        self.assertEqual(rough[header.index("rate")], "mean_by_time")
        self.assertEqual(numbers["N_c"], numbers["N_c_mean_by_time"])
        for name, value in numbers.items():
            # The rigid body crosses about one disc earlier.
            self.assertAlmostEqual(value, 37.0 if "rigid" in name else 38.0, delta=2.0, msg=name)
        self.assert_works(
            "sweep",
            "--mu",
            "0.5,1",
            "--events",
            3000,
            "--discs",
            5,
            "--out",
            self.path("b"),
            "--quiet",
        )
        os.remove(self.path("N_c.csv"))
        self.assertEqual(
            swirl("collect", self.path("b"), "--crossings", "-", "--csv", "-").returncode, 2
        )

    def at_once(self, calls):
        """Exit codes and errors of calls that start at the same time."""
        gate, opened = os.pipe()
        running = [
            subprocess.Popen(
                ["sh", "-c", 'read go; exec "$0" "$@"', SWIRL, *call],
                stdin=gate,
                stderr=subprocess.PIPE,
                text=True,
            )
            for call in calls
        ]
        os.close(gate)
        time.sleep(0.1)
        os.close(opened)
        errors = [process.communicate(timeout=HANG)[1] for process in running]
        return [process.returncode for process in running], errors

    def test_one_of_two_simultaneous_plans_is_rejected(self):
        for k in range(8):
            folder = self.path(str(k))
            codes, errors = self.at_once(
                [
                    ["sweep", "--discs", discs, "--events", "1000", "--out", folder, "--quiet"]
                    for discs in ("5", "6")
                ]
            )
            self.assertEqual(sorted(codes), [0, 1], errors)
            self.assertIn("holds another sweep", "".join(errors))
            accepted = "56"[codes.index(0)]
            self.assertIn(f"\n{accepted},", self.table(folder))

    def test_simultaneous_growth_succeeds_or_is_reported(self):
        self.assert_works(
            "sweep", "--discs", "5,6", "--events", "1000", "--out", self.path("first"), "--quiet"
        )
        for k in range(8):
            folder = shutil.copytree(self.path("first"), self.path(str(k)))
            calls = [
                ["sweep", "--out", folder, "--grow", "--discs", discs, "--quiet"]
                for discs in ("7", "8")
            ]
            for call, code, error in zip(calls, *self.at_once(calls), strict=True):
                if code:
                    self.assertIn("has extended the sweep", error)
                    self.assert_works(*call)
            self.assertEqual(
                [row.split(",")[0] for row in self.table(folder).splitlines()[1:]],
                ["5", "6", "7", "8"],
            )

    def test_results_of_other_formats_and_damaged_ones_are_reported(self):
        self.whole()
        file = self.path("whole/results/000007.json")
        result = read_json(file)
        result["format"] = 0
        write_text(file, json.dumps(result))
        self.assert_fails(1, "collect", self.path("whole"), says="000007.json' is in format 0")

    def test_results_that_are_not_whole_are_made_again(self):
        whole = self.whole()
        file = self.path("whole/results/000007.json")
        bytes_of_result = read_bytes(file)
        runs = len(os.listdir(self.path("whole/results")))
        for damaged in (
            b"",
            b'{"format": 1, "rot',
            bytes_of_result[:-3],
            bytes(len(bytes_of_result)),
            b"null\n",
        ):
            with open(file, "wb") as opened:
                opened.write(damaged)
            for call in (
                ["sweep", "--out", self.path("whole"), "--status"],
                ["collect", self.path("whole")],
            ):
                done = self.assert_works(*call)
                self.assertIn(f"{runs - 1} of {runs} runs", done.stdout)
                self.assertIn("a file of 1 run is missing or not whole", done.stderr)
                self.assertIn("000007.json'", done.stderr)
            done = self.assert_works("sweep", "--out", self.path("whole"))
            self.assertIn("(1 by this call)", done.stdout)
            self.assertEqual(self.table(self.path("whole")), whole)

    CHAIN = [
        "sweep",
        "--discs",
        5,
        "--mu",
        "0.1,0.3,0.5,1",
        "--periods",
        3,
        "--warmup",
        1,
        "--chain",
        "mu",
        "--quiet",
    ]
    IN_ORDER = (0, 2, 4, 6, 7, 5, 3, 1)  # rising, then falling

    def assert_chain_is_repaired(self, **damaged):
        """Damages results and states of these points, and calls the sweep again."""
        folder = self.shared("chain", lambda path: self.assert_works(*self.CHAIN, "--out", path))

        def contents():
            """Of results also `started_from`, the point before."""
            return (
                {
                    point: without_time(f"{folder}/results/{point:06}.json")
                    for point in self.IN_ORDER
                },
                {point: read_bytes(f"{folder}/states/{point:06}.state") for point in self.IN_ORDER},
            )

        whole = contents()
        for part, points in damaged.items():
            for point in points:
                os.truncate(
                    f"{folder}/{part}s/{point:06}.{'json' if part == 'result' else 'state'}", 100
                )
        self.assert_works("sweep", "--out", folder, "--quiet")
        self.assertEqual(contents(), whole)
        shutil.rmtree(folder)

    def test_a_chain_with_several_damaged_results_is_repaired(self):
        order = self.IN_ORDER
        self.assert_chain_is_repaired(result=[order[2], order[4]])  # a whole result between them
        self.assert_chain_is_repaired(result=[order[1], order[3], order[-1]])
        self.assert_chain_is_repaired(result=[order[0], order[2], order[3]])

    def test_a_chain_starts_again_before_a_damaged_state(self):
        order = self.IN_ORDER
        self.assert_chain_is_repaired(state=[order[0]], result=[order[1], order[4]])
        self.assert_chain_is_repaired(state=order[:5], result=[order[5]])
        self.assert_chain_is_repaired(state=[order[-1]], result=[order[0]])

    def test_a_point_without_its_recordings_is_not_done(self):
        folder = self.path("recorded")
        self.assert_works(
            "sweep",
            "--discs",
            "5:7",
            "--periods",
            3,
            "--frames-per-period",
            4,
            "--series",
            "--out",
            folder,
            "--quiet",
        )
        table = self.table(folder)

        def contents():
            return {
                name: read_bytes(os.path.join(folder, name))
                for part in ("trajectories", "series")
                for name in sorted(
                    os.path.join(part, file) for file in os.listdir(os.path.join(folder, part))
                )
            }

        whole = contents()

        def exchange(one, other):
            first, second = (os.path.join(folder, name) for name in (one, other))
            os.rename(first, first + "~")
            os.rename(second, first)
            os.rename(first + "~", second)

        def cut(name):
            os.truncate(os.path.join(folder, name), len(whole[name]) // 2)

        for damage, runs in (
            (lambda: os.remove(folder + "/trajectories/000001.h5"), 1),
            (lambda: cut("trajectories/000001.h5"), 1),
            (lambda: exchange("trajectories/000000.h5", "trajectories/000002.h5"), 2),
            (lambda: os.remove(folder + "/series/000001.csv"), 1),
            (lambda: cut("series/000001.csv"), 1),
            (lambda: exchange("series/000000.csv", "series/000002.csv"), 2),
        ):
            damage()
            done = self.assert_works("sweep", "--out", folder, "--status")
            self.assertIn(f"{3 - runs} of 3 runs done", done.stdout)
            self.assertIn("is missing or not whole", done.stderr)
            self.assertEqual(self.table(folder), table)  # the results are whole
            done = self.assert_works("sweep", "--out", folder)
            self.assertIn(f"({runs} by this call)", done.stdout)
            self.assertEqual(contents(), whole)

    def test_results_of_other_points_and_wrong_types_are_reported(self):
        self.whole()
        results = self.path("whole/results/")

        def assert_rejected(says):
            self.assert_fails(1, "collect", self.path("whole"), says=says)

        result = read_json(results + "000007.json")
        shutil.copy(results + "000006.json", results + "000007.json")
        assert_rejected("000007.json' is not the result of point 7")
        for change, says in (
            ({"point": 7, "config": dict(result["config"], seed=1)}, "is not the result of point"),
            ({"energy": "0.5"}, "has a text instead of a number"),
            ({"rotation": dict(result["rotation"], mean_by_time="fast")}, "a text instead"),
        ):
            write_text(results + "000007.json", json.dumps({**result, **change}))
            assert_rejected(says)

    def test_thousands_of_runs_need_few_open_files(self):
        # More results wait for the disk than a process may have files open.
        self.assert_works(
            "sweep",
            "--discs",
            2,
            "--events",
            5,
            "--replicates",
            4000,
            "--out",
            self.path("a"),
            "--quiet",
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (256, 256)),
        )
        for call in (["sweep", "--out", self.path("a"), "--status"], ["collect", self.path("a")]):
            done = self.assert_works(*call)
            self.assertIn("4000 of 4000 runs", done.stdout)


if __name__ == "__main__":
    main()
