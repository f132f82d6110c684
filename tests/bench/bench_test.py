"""bench/run: its report, its files and its errors. No test asserts a rate or a ratio."""

import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

BENCH = pathlib.Path(__file__).parents[2] / "bench"


def bench(*options):
    return subprocess.run([os.environ["SWIRL_BENCH"], *options], capture_output=True, text=True)


class Bench(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def path(self, name):
        return str(self.folder / name)

    def test_json_csv_and_report_have_every_scene(self):
        done = bench(
            "--seconds",
            "0.02",
            "--quiet",
            "--json",
            self.path("b.json"),
            "--csv",
            self.path("b.csv"),
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("b.json")) as f:
            result = json.load(f)
        rows = {(row["scene"], row["discs"]): row for row in result["rows"]}
        self.assertEqual(len(rows), 33)
        for (scene, _), row in rows.items():
            self.assertIn(scene, done.stdout)
            self.assertGreater(row["rate"], 0)
            # Memory: lanes are padded, and candidates for a list take columns of 512 entries of 36
            # bytes, which counts where discs are few. A dilute container may have 16 cells of 32
            # bytes per disc.
            cells = 16 * 32 if scene.startswith("dilute") else 0
            self.assertLess(row["bytes_per_disc"], 300 + cells + (4000 + 512 * 36) / row["discs"])
        self.check_baselines(rows)
        self.check_targets(result, done.stdout)
        self.check_table(rows)

    def check_baselines(self, rows):
        """Every scene but the averages has a baseline of the right kind, and the ratio belongs to
        it."""
        loops = ("loop, baseline", "loop, avx2", "loop, avx512")
        for (scene, discs), row in rows.items():
            if scene.endswith(", averages"):
                self.assertIsNone(row["baseline_rate"])
                self.assertIsNone(row["baseline"])
                continue
            if scene.startswith("spheres"):
                baselines = ("loop",)
            elif scene.startswith("container") and discs <= 48:
                baselines = ("lists", *loops)
            else:
                baselines = ("lists",)
            self.assertIn(row["baseline"], baselines, scene)
            self.assertGreater(row["baseline_rate"], 0)
            self.assertAlmostEqual(row["ratio"], row["rate"] / row["baseline_rate"])

    def check_targets(self, result, printed):
        """Every ratio and comparison with a target is listed, and `met` follows from its value."""
        targets = result["targets"]
        rows = result["rows"]
        self.assertEqual(
            len(targets),
            sum(row["ratio_target"] is not None for row in rows)
            + sum(row["comparison"] is not None for row in rows),
        )
        compared = {
            (row["scene"], row["discs"]): row["comparison"]
            for row in rows
            if row["comparison"] is not None
        }
        self.assertEqual(sum(scene == "container, exact circle" for scene, _ in compared), 4)
        for target in targets:
            if target["target"] is None:
                continue
            met = {
                "at least": target["value"] >= target["target"],
                "at most": target["value"] <= target["target"],
                "below": target["value"] < target["target"],
            }
            self.assertEqual(target["met"], met[target["must_be"]], target["name"])
        by_event = targets[-1]
        self.assertEqual(by_event["name"].split(":")[0], "time / time without averages")
        self.assertEqual((by_event["must_be"], by_event["target"]), ("at most", 1.1))
        line = next(line for line in printed.splitlines() if by_event["name"] in line)
        self.assertTrue(line.endswith("met" if by_event["met"] else "missed"), line)

    def check_table(self, rows):
        """The CSV has the same rows, README.md explains its columns, table.py prints every
        scene."""
        with open(self.path("b.csv"), newline="") as f:
            lines = list(csv.DictReader(f))
        self.assertEqual([(line["scene"], int(line["discs"])) for line in lines], list(rows))
        described = (BENCH / "results/README.md").read_text()
        for column in lines[0]:
            self.assertIn(column, described)
        table = subprocess.run(
            [sys.executable, "-B", BENCH / "table.py", self.path("b.csv")],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for scene, _ in rows:
            self.assertIn(f"| {scene} |", table)

    def test_a_text_that_no_scene_contains_is_an_error_that_names_the_scenes(self):
        done = bench("--only", "nosuch", "--quiet", "--json", "-")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("error: no scene has 'nosuch' in its name\nhint: the scenes are", done.stderr)
        self.assertIn("container, mu = 1; ", done.stderr)

    def test_ratios_compares_only_scenes_of_both_commits(self):
        """bench/ratios.py, which reads the results of compare.sh."""

        def write(name, rates, targets):
            with open(self.path(name), "w") as f:
                json.dump(
                    {
                        "rows": [
                            {"scene": scene, "discs": 5, "width": "avx2", "rate": rate}
                            for scene, rate in rates.items()
                        ],
                        "targets": [{"name": n, "value": v} for n, v in targets.items()],
                    },
                    f,
                )

        for k, faster in ((1, 1.0), (2, 1.2), (3, 1.4)):
            write(f"old-{k}.json", {"gone": 1.0, "gas": 10.0}, {"events per second: gas": 3})
            write(f"new-{k}.json", {"dish": 7.0, "gas": 10.0 * faster}, {"time on the circle": 2})
        done = subprocess.run(
            [sys.executable, "-B", BENCH / "ratios.py", self.folder, "3"],
            capture_output=True,
            text=True,
            check=True,
        ).stdout.splitlines()
        self.assertEqual(done[0], "rates, new / old")
        self.assertRegex(done[1], r"^  gas, N = 5, avx2 +1\.200   \(1\.000 to 1\.400\)$")
        self.assertEqual(done[2:], ["only new: dish, N = 5, avx2", "only old: gone, N = 5, avx2"])

        for which, count in (("old", 2000.0), ("new", 1000.0)):
            with open(self.path(f"{which}-instructions.json"), "w") as f:
                json.dump({"container": count}, f)
        done = subprocess.run(
            [
                sys.executable,
                "-B",
                BENCH / "ratios.py",
                self.folder,
                "3",
                "--csv",
                self.path("ratios.csv"),
                "--instructions",
            ],
            capture_output=True,
            text=True,
            check=True,
        ).stdout.splitlines()
        self.assertRegex(done[3], r"^  container +0\.500 ")
        with open(self.path("ratios.csv"), newline="") as f:
            lines = list(csv.reader(f))
        self.assertEqual(
            lines[1:],
            [
                ["rates", "gas, N = 5, avx2", "1.2000", "1.0000", "1.4000", "3"],
                ["instructions per event", "container", "0.5000", "0.5000", "0.5000", "1"],
            ],
        )

    def test_wrong_options_are_rejected_with_their_value(self):
        for call, words in (
            (("--width", "wide"), "wide"),
            (("--seconds", "-1"), "-1"),
            (("--seconds", "nan"), "nan"),
        ):
            with self.subTest(call=call):
                done = bench(*call)
                self.assertEqual(done.returncode, 2)
                self.assertIn(words, done.stderr)
                self.assertEqual(done.stdout, "")

    def test_unwritable_file_is_an_error(self):
        done = bench(
            "--seconds", "0.001", "--only", "mu_disc = 0", "--quiet", "--json", "/no/such/b.json"
        )
        self.assertEqual(done.returncode, 1)
        self.assertIn("/no/such", done.stderr)


if __name__ == "__main__":
    unittest.main()
