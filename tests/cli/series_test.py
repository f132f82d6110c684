"""`--series`, `--ramp` and `--chain`: the files they write, interruptions, and rejected calls."""

import csv
import json
import os
import signal
import subprocess
import unittest

from program import (
    HANG,
    ONE_ERROR,
    SWIRL,
    InFolder,
    read_json,
    read_rows,
    read_text,
    swirl,
    wait_until,
    write_text,
)

RAMP = ("--discs", 24, "--ramp", "mu=0.2:1:0.2@3..23", "--ramp", "amplitude=1:2@5..20")


def rows(file):
    return read_rows(file)


class Series(InFolder):
    def run_swirl(self, *arguments):
        done = self.assert_works(*arguments, cwd=self.folder)
        return done

    def test_each_period_is_a_row_with_the_value_of_its_ramp(self):
        self.run_swirl("run", *RAMP, "--series", "s.csv", "--measure", "slip", "--json", "r.json")
        table = rows(self.path("s.csv"))
        self.assertEqual([row["period"] for row in table], [str(k) for k in range(24)])
        self.assertEqual([float(table[k]["ramp.mu"]) for k in (0, 3, 13, 23)], [0.2, 0.2, 1, 0.2])
        self.assertTrue(all(row["slip.cluster"] for row in table))
        result = read_json(self.path("r.json"))
        self.assertEqual(sum(int(row["events"]) for row in table), result["events"]["total"])
        self.assertEqual(result["series"]["periods"], 24)
        average = result["series"]["averages"]["slip.cluster"]
        self.assertGreaterEqual(average["autocorrelation_time"], 1)
        self.assertAlmostEqual(
            average["blocks"] / average["autocorrelation_time"], average["effective_samples"]
        )

    def test_the_fluctuations_are_those_of_the_columns_and_of_the_measurement(self):
        done = self.run_swirl(
            "run",
            "--discs",
            16,
            "--periods",
            120,
            "--warmup",
            20,
            "--series",
            "s.csv",
            "--measure",
            "fluctuations",
            "--json",
            "r.json",
        )
        values = [
            float(row["rigid_by_time"]) for row in rows(self.path("s.csv")) if row["counted"] == "1"
        ]
        result = read_json(self.path("r.json"))
        found = result["series"]["averages"]["rigid_by_time"]["fluctuations"]
        n = len(values)
        self.assertEqual(n, 100)
        mean = sum(values) / n
        second = sum((x - mean) ** 2 for x in values) / n
        tau = found["correlation_time"]["mean"]
        self.assertAlmostEqual(found["n_variance"]["mean"], 16 * second / (1 - tau / n), 12)
        self.assertAlmostEqual(
            found["skewness"]["mean"], sum((x - mean) ** 3 for x in values) / n / second**1.5, 9
        )
        binder = 1 - sum((x - mean) ** 4 for x in values) / n / (3 * second**2)
        self.assertAlmostEqual(found["binder"]["mean"], binder, 12)
        # The measurement samples 64 other times of each period, so its means differ slightly.
        measured = result["measured"]["fluctuations"]
        self.assertAlmostEqual(measured["n_variance"]["mean"] / found["n_variance"]["mean"], 1, 0)
        self.assertIn("Binder cumulant", done.stdout)

    def test_a_ramp_has_no_fluctuations(self):
        self.run_swirl("run", *RAMP, "--series", "s.csv", "--json", "r.json")
        averages = read_json(self.path("r.json"))["series"]["averages"]
        self.assertFalse([name for name, value in averages.items() if "fluctuations" in value])

    def test_a_run_without_the_last_value_of_its_ramp_names_the_period_that_has_it(self):
        ramp = ("run", "--discs", 5, "--ramp", "mu=1:0.5@0..3", "--periods")
        self.assertIn(
            "the run ended after 3.0 periods, but its ramp has its last value in period 3, which "
            "begins after 3 periods",
            self.run_swirl(*ramp, 3).stderr,
        )
        self.assertNotIn("last value", self.run_swirl(*ramp, 4).stderr)

    def test_a_killed_and_resumed_run_has_the_same_series(self):
        whole = ("--discs", 48, "--ramp", "mu=0.2:1@3..203", "--ramp", "period=12:9@3..203")
        self.run_swirl("run", *whole, "--series", "whole.csv", "--quiet")
        call = (
            "run",
            *whole,
            "--series",
            "s.csv",
            "--trajectory",
            "t.h5",
            "--checkpoint",
            "c",
            "--checkpoint-every",
            "0.01",
            "--quiet",
        )
        kills = 0
        for _ in range(40):
            started = subprocess.Popen(
                [SWIRL, *map(str, call), "--resume"],
                cwd=self.folder,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            if kills < 3:
                try:
                    started.wait(0.15)
                except subprocess.TimeoutExpired:
                    started.send_signal(signal.SIGKILL if kills % 2 else signal.SIGTERM)
                    kills += 1
            if started.wait(HANG) == 0:
                break
        self.assertEqual(started.returncode, 0)
        with open(self.path("s.csv")) as one, open(self.path("whole.csv")) as other:
            self.assertEqual(one.read(), other.read())
        self.run_swirl("verify", "t.h5")

    def test_the_series_grows_while_the_run_runs(self):
        call = (
            "run",
            "--discs",
            48,
            "--periods",
            1000000,
            "--series",
            "live.csv",
            "--trajectory",
            "live.h5",
            "--frames-per-period",
            1,
            "--quiet",
        )
        running = subprocess.Popen(
            [SWIRL, *map(str, call)], cwd=self.folder, stdout=subprocess.DEVNULL
        )
        try:
            lengths = set()

            def has_grown_twice():
                if os.path.exists(self.path("live.csv.partial")):
                    lengths.add(len(rows(self.path("live.csv.partial"))))
                return len(lengths) >= 3

            wait_until(has_grown_twice, running)
            measure = (
                "measure",
                self.path("live.h5.partial"),
                "--measure",
                "radial",
                "--json",
                "-",
            )
            wait_until(
                lambda: swirl(*measure).returncode == 0, running
            )  # the first frames are on the disk
            self.assertFalse(os.path.exists(self.path("live.csv")))
            # The recording changes while it is read, so it is opened again. It has the frames that
            # it had when it was opened first.
            for _ in range(3):
                done = self.run_swirl(*measure)
                found = json.loads(done.stdout)
                self.assertGreater(found["frames"], 0)
        finally:
            running.send_signal(signal.SIGINT)
            running.wait(HANG)
        self.assertFalse(os.path.exists(self.path("live.csv.partial")))
        table = rows(self.path("live.csv"))
        self.assertEqual([row["period"] for row in table], [str(k) for k in range(len(table))])
        self.assertGreaterEqual(len(table), max(lengths))

    def test_existing_files_and_other_endings_are_rejected(self):
        write_text(self.path("s.csv"), "mine\n")
        for arguments, part in (
            (("--series", "s.csv"), "already exists"),
            (("--series", "s.h5"), "must end in .csv"),
            (
                ("--ramp", "period=12:9@2..9", "--log-events", "e.h5"),
                "an event log cannot record a ramp of period",
            ),
            (
                ("--ramp", "period=12:9@2..9", "--trajectory", "t.h5", "--frame-interval", "1"),
                "--frame-interval cannot be used",
            ),
            (("--ramp", "inertia=1:2@2..9"), "property of the particles"),
        ):
            done = swirl("run", "--discs", 8, *arguments, cwd=self.folder)
            self.assertIn(part, done.stderr)
            self.assertRegex(done.stderr, ONE_ERROR)
            self.assertNotEqual(done.returncode, 0)
        self.assertEqual(read_text(self.path("s.csv")), "mine\n")

    def test_a_configuration_file_holds_ramps_and_options_replace_its_values(self):
        write_text(
            self.path("plan.toml"),
            'discs = 12\nramp = "mu=0.1:1@2..9; amplitude=1:2@2..9"\nseries = "a.csv"\n',
        )
        self.run_swirl("run", "plan.toml", "--quiet")
        self.assertEqual(len(rows(self.path("a.csv"))), 10)
        write_text(self.path("mu.toml"), "discs = 12\nmu = 0.5\n")
        done = self.run_swirl("run", "mu.toml", "--ramp", "mu=0.1:1@2..9", "--dry-run")
        self.assertIn('ramp = "mu=0.1:1@2..9"', done.stdout)

    def test_other_commands_have_no_ramp(self):
        for command in (("crossing",), ("movie", "--out", "m.mp4")):
            self.assert_fails(
                2,
                *command,
                "--ramp",
                "mu=0.1:1@2..9",
                cwd=self.folder,
                says="there is no option --ramp",
            )


class Chain(InFolder):
    SWEEP = (
        "sweep",
        "--discs",
        20,
        "--mu",
        "0.2,0.6,1",
        "--amplitude",
        "1.5,2",
        "--periods",
        8,
        "--warmup",
        2,
        "--replicates",
        2,
        "--chain",
        "mu",
        "--quiet",
    )

    def results(self, name):
        folder = os.path.join(self.folder, name, "results")
        found = {}
        for file in sorted(os.listdir(folder)):
            found[file] = read_json(os.path.join(folder, file))
        return found

    def sweep(self, name, *more):
        self.assert_works(*self.SWEEP, "--out", name, *more, cwd=self.folder)

    def test_each_run_starts_from_its_neighbour_in_both_directions(self):
        self.sweep("loop", "--series")
        results = self.results("loop")
        self.assertEqual(len(results), 2 * 3 * 2 * 2)
        for result in results.values():
            if result["started_from"] is None:
                self.assertEqual((result["direction"], result["config"]["mu_disc"]), ("up", 0.2))
                continue
            before = results[f"{result['started_from']:06}.json"]
            self.assertEqual(result["config"]["amplitude"], before["config"]["amplitude"])
            self.assertEqual(result["replicate"], before["replicate"])
            step = result["config"]["mu_disc"] - before["config"]["mu_disc"]
            turns = result["direction"] == "down" and before["direction"] == "up"
            self.assertAlmostEqual(
                step, 0 if turns else 0.4 if result["direction"] == "up" else -0.4
            )
            # Velocities do not change between two runs of a chain, so the energy at the start
            # equals that at the end of the run before.
            self.assertAlmostEqual(result["energy_at_start"] / before["energy"], 1, delta=1e-12)
        done = swirl("collect", "loop", "--csv", "-", cwd=self.folder)
        table = list(csv.DictReader(done.stdout.splitlines()))
        self.assertEqual(len(table), 12)
        self.assertEqual({row["direction"] for row in table}, {"up", "down"})
        self.assertEqual(len(os.listdir(os.path.join(self.folder, "loop", "series"))), 24)
        verified = swirl("verify", "loop/results/000002.json", cwd=self.folder)
        self.assertIn("started from the end of another", verified.stderr)

    def test_the_area_of_a_loop_is_the_integral_between_its_branches(self):
        self.sweep("loop", "--plot")
        for file in ("table.csv", "table.png", "table.pdf", "loops.csv"):
            self.assertGreater(os.path.getsize(os.path.join(self.folder, "loop", file)), 100)
        rows = read_rows(os.path.join(self.folder, "loop", "loops.csv"))
        self.assertEqual(
            [(row["amplitude"], row["replicates"]) for row in rows], [("1.5", "2"), ("2", "2")]
        )
        areas = {}  # (amplitude, replica): of every loop, from its runs
        for result in self.results("loop").values():
            key = result["config"]["amplitude"], result["replicate"]
            # 0.4 between the values: half of it for the outer ones.
            weight = 0.4 if result["config"]["mu_disc"] == 0.6 else 0.2
            sign = 1 if result["direction"] == "down" else -1
            rate = result["rotation"]["mean_by_time"]
            areas[key] = areas.get(key, 0.0) + sign * weight * rate["mean"]
        for row in rows:
            pair = [areas[float(row["amplitude"]), replica] for replica in (0, 1)]
            self.assertAlmostEqual(float(row["mean_by_time"]), sum(pair) / 2, delta=1e-12)
            # The scatter of the two loops alone, with Student's t of one degree of freedom: 12.706.
            # The errors of the runs would be wrong, since runs of a chain are not independent. The
            # program rounds 1.96 in it.
            error = abs(pair[0] - pair[1]) / 2 * 12.70620474 / 1.959963985
            self.assertAlmostEqual(float(row["mean_by_time_error"]) / error, 1, delta=1e-6)
        done = swirl("collect", "loop", cwd=self.folder)
        self.assertRegex(
            done.stdout, r"loop area of mean_by_time --amplitude 1.5: \S+ ± \S+ \(2 loops\)"
        )
        # A loop with a missing run does not count.
        os.remove(os.path.join(self.folder, "loop", "results", "000000.json"))
        done = swirl("collect", "loop", "--loops", "-", "--csv", "t.csv", cwd=self.folder)
        self.assertEqual(
            [row["replicates"] for row in csv.DictReader(done.stdout.splitlines())], ["1", "2"]
        )
        for wrong, says in (
            (("collect", "plain", "--loops", "l.csv"), "not a chain"),
            (("sweep", "--out", "plain", "--plot", "--slurm"), "--plot"),
        ):
            if not os.path.exists(os.path.join(self.folder, "plain")):
                swirl(
                    "sweep",
                    "--discs",
                    "5,6",
                    "--events",
                    500,
                    "--out",
                    "plain",
                    "--quiet",
                    cwd=self.folder,
                )
            self.assert_fails(2, *wrong, cwd=self.folder, says=says)

    def test_a_continued_chain_is_bitwise_identical(self):
        self.sweep("whole")
        self.sweep("parts")
        # As after an interruption: the later results of some chains are missing.
        gone = [
            file
            for file, result in self.results("parts").items()
            if result["direction"] == "down" or result["config"]["mu_disc"] == 1
        ]
        for file in gone:
            os.remove(os.path.join(self.folder, "parts", "results", file))
        self.sweep("parts")
        whole, parts = self.results("whole"), self.results("parts")
        self.assertEqual(
            {file: r["state_hash"] for file, r in whole.items()},
            {file: r["state_hash"] for file, r in parts.items()},
        )

    def test_wrong_chains_are_rejected(self):
        for arguments, part in (
            (("--mu", "0.1,1", "--chain", "mu"), "needs runs of whole periods"),
            (("--mu", "1", "--periods", 5, "--chain", "mu"), "fewer than two values"),
            (("--inertia", "1,2", "--periods", 5, "--chain", "inertia"), "must be one of: mu"),
            (
                ("--mu", "0.1,1", "--periods", 5, "--chain", "mu", "--frames-per-period", 8),
                "--frames-per-period",
            ),
        ):
            self.assert_fails(2, "sweep", *arguments, "--out", "bad", cwd=self.folder, says=part)
            self.assertFalse(os.path.exists(os.path.join(self.folder, "bad")))
        self.sweep("loop")
        grown = swirl("sweep", "--out", "loop", "--grow", "--mu", "0.4", cwd=self.folder)
        self.assertIn("a sweep with a chain cannot grow", grown.stderr)

    def test_the_table_is_drawn(self):
        self.sweep("loop")
        self.assert_works("collect", "loop", "--plot", cwd=self.folder)
        for kind in ("png", "pdf"):
            self.assertGreater(
                os.path.getsize(os.path.join(self.folder, "loop", f"table.{kind}")), 1000
            )
        done = swirl("collect", "loop", "--plot", "--quantity", "nonsense", cwd=self.folder)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("no column 'nonsense'", done.stderr)


if __name__ == "__main__":
    unittest.main()
