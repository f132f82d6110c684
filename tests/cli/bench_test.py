"""swirl bench: what it prints, what it writes, and what it refuses. How fast it is, is not asked."""

import csv
import json
import pathlib
import subprocess
import sys
import unittest

from program import InFolder, swirl


class Bench(InFolder):
    def test_measures_every_scene_and_writes_json_and_csv(self):
        done = swirl("bench", "--seconds", "0.02", "--quiet", "--json", self.path("b.json"), "--csv",
                     self.path("b.csv"))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("b.json")) as f:
            result = json.load(f)
        rows = {(row["scene"], row["discs"]): row for row in result["rows"]}
        self.assertEqual(len(rows), 28)
        for (scene, _), row in rows.items():
            self.assertIn(scene, done.stdout)
            self.assertGreater(row["rate"], 0)
            # Lanes are filled up, and those a list may take are laid out in columns of 512 (36 bytes
            # each), which counts where the discs are few. In a thin dish there may be 16 cells of 32
            # bytes for each disc, where discs have gathered.
            cells = 16 * 32 if scene.startswith("thin") else 0
            self.assertLess(row["bytes_per_disc"],
                            300 + cells + (4000 + 512 * 36) / row["discs"])
        self.check_rivals(rows)
        self.check_targets(result, done.stdout)
        self.check_table(rows)

    def check_rivals(self, rows):
        """One for every scene, the one that suits it, and the engine is ahead where it is by far."""
        loops = ("loop, baseline", "loop, avx2", "loop, avx512")
        for (scene, discs), row in rows.items():
            if scene == "dish, averages by event":
                self.assertIsNone(row["rival_rate"])
                self.assertIsNone(row["rival"])
                continue
            if scene.startswith("spheres"):
                rivals = ("loop",)
            elif scene.startswith("dish") and discs <= 48:
                rivals = ("lists", *loops)
            else:
                rivals = ("lists",)
            self.assertIn(row["rival"], rivals, scene)
            self.assertGreater(row["rival_rate"], 0)
            self.assertAlmostEqual(row["ratio"], row["rate"] / row["rival_rate"])
        self.assertIn(rows["dish, mu = 1", 5]["rival"], loops)  # lists have nothing to save there
        for ahead in (("dish, mu = 1", 48), ("spheres, mu = 0.2", 48), ("spheres, mu = 0.2", 500)):
            self.assertGreater(rows[ahead]["ratio"], 1)

    def check_targets(self, result, printed):
        """Every ratio and comparison that has a target; without --full nothing else has one."""
        targets = result["targets"]
        rows = result["rows"]
        self.assertEqual(len(targets), sum(row["ratio_target"] is not None for row in rows) +
                         sum(row["comparison"] is not None for row in rows))
        compared = {(row["scene"], row["discs"]): row["comparison"]
                    for row in rows if row["comparison"] is not None}
        self.assertEqual(sum(scene == "dish, exact circle" for scene, _ in compared), 4)
        # A busy machine tells little: the circle is not twice as fast as the polygon, nor ten times
        # slower, and no dish five times as fast as that of the paper.
        for (scene, _), comparison in compared.items():
            least, most = (0.5, 10) if scene == "dish, exact circle" else (0.02, 5)
            self.assertTrue(least < comparison["value"] < most, (scene, comparison))
        for target in targets:
            met = {"at least": target["value"] >= target["target"],
                   "at most": target["value"] <= target["target"],
                   "below": target["value"] < target["target"]}
            self.assertEqual(target["met"], met[target["must_be"]], target["name"])
        by_event = targets[-1]
        self.assertEqual(by_event["name"].split(":")[0], "time over that without")
        self.assertEqual((by_event["must_be"], by_event["target"]), ("at most", 1.15))
        line = next(line for line in printed.splitlines() if by_event["name"] in line)
        self.assertTrue(line.endswith("met" if by_event["met"] else "missed"), line)

    def check_table(self, rows):
        """The CSV has the same rows, and bench/table.py a line for each of them."""
        with open(self.path("b.csv"), newline="") as f:
            lines = list(csv.DictReader(f))
        self.assertEqual([(line["scene"], int(line["discs"])) for line in lines], list(rows))
        described = self.bench_file("results/README.md").read_text()
        for column in lines[0]:
            self.assertIn(column, described)
        table = subprocess.run([sys.executable, "-B", self.bench_file("table.py"), self.path("b.csv")],
                               capture_output=True, text=True, check=True).stdout
        for scene, _ in rows:
            self.assertIn(f"| {scene} |", table)

    def test_compares_only_what_both_commits_have(self):
        """bench/ratios.py, which compare.sh hands its results to."""
        def write(name, rates, targets):
            with open(self.path(name), "w") as f:
                json.dump({"rows": [{"scene": scene, "discs": 5, "width": "avx2", "rate": rate}
                                    for scene, rate in rates.items()],
                           "targets": [{"name": n, "value": v} for n, v in targets.items()]}, f)
        for k, faster in ((1, 1.0), (2, 1.2), (3, 1.4)):
            write(f"old-{k}.json", {"gone": 1.0, "gas": 10.0}, {"events per second: gas": 3})
            write(f"new-{k}.json", {"dish": 7.0, "gas": 10.0 * faster}, {"time on the circle": 2})
        done = subprocess.run([sys.executable, "-B", self.bench_file("ratios.py"), self.path(""), "3"],
                              capture_output=True, text=True, check=True).stdout.splitlines()
        self.assertEqual(done[0], "rate, new over old")
        self.assertRegex(done[1], r"^  gas, N = 5, avx2 +1\.200   \(1\.000 to 1\.400\)$")
        self.assertEqual(done[2:], ["only new: dish, N = 5, avx2", "only old: gone, N = 5, avx2"])

    @staticmethod
    def bench_file(name):
        return pathlib.Path(__file__).parents[2] / "bench" / name

    def test_refuses_what_it_cannot_do_in_a_sentence(self):
        for call, words in ((("--width", "wide"), "'wide'"), (("--seconds", "-1"), "'-1'"),
                            (("--seconds", "nan"), "'nan'"), (("--json", "/no/such/b.json"), "/no")):
            with self.subTest(call=call):
                done = swirl("bench", *call)
                self.assertIn(done.returncode, (1, 2))
                self.assertIn(words, done.stderr)
                self.assertEqual(done.stdout, "")


if __name__ == "__main__":
    unittest.main()
