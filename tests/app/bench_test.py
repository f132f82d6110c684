"""swirl bench: what it prints, what it writes, and what it refuses. How fast it is, is not asked."""

import json
import unittest

from program import InFolder, swirl


class Bench(InFolder):
    def test_measures_every_scene_and_writes_json_and_csv(self):
        done = swirl("bench", "--seconds", "0.02", "--quiet", "--json", self.path("b.json"), "--csv",
                     self.path("b.csv"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("dish, mu = 1", done.stdout)
        self.assertIn("gas, packing 0.2", done.stdout)
        with open(self.path("b.json")) as f:
            result = json.load(f)
        rows = {(row["scene"], row["discs"]): row for row in result["rows"]}
        self.assertEqual(len(rows), 11)
        for row in rows.values():
            self.assertGreater(row["rate"], 0)
            # Lanes are filled up, and those a list may take are laid out in columns of 512 (36 bytes
            # each), which counts where the discs are few.
            self.assertLess(row["bytes_per_disc"], 300 + (4000 + 512 * 36) / row["discs"])
        dish = rows["dish, mu = 1", 48]
        self.assertGreater(dish["ratio"], 1)  # the plain loop never wins at N = 48
        self.assertAlmostEqual(dish["ratio"], dish["rate"] / dish["plain_rate"])
        self.assertIn(dish["plain_width"], ("baseline", "avx2", "avx512"))
        for spheres in (48, 500):
            row = rows["spheres, mu = 0.2", spheres]
            self.assertEqual(row["plain_width"], "scalar")
            self.assertGreater(row["ratio"], 1)
        for gas in (("gas, packing 0.7", 100000), ("gas, packing 0.2", 1000), ("gas, packing 0.01", 1000)):
            self.assertEqual(rows[gas]["plain_width"], "lists")
            self.assertGreater(rows[gas]["plain_rate"], 0)
        self.assertIsNone(rows["large dish, mu = 1", 100000]["plain_rate"])
        self.assertIsNone(rows["large dish, mu = 1", 100000]["plain_width"])
        self.check_targets(result, done.stdout)
        with open(self.path("b.csv")) as f:
            self.assertEqual(len(f.readlines()), 12)

    def check_targets(self, result, printed):
        """Every rate and ratio that has a target, and what else was measured without --full."""
        targets = result["targets"]
        rates = sum(row["target"] is not None for row in result["rows"])
        ratios = sum(row["ratio_target"] is not None for row in result["rows"])
        self.assertEqual(ratios, 4)
        circles = [target for target in targets if "on the circle" in target["name"]]
        self.assertEqual(len(circles), 4)
        # A busy machine tells little: not twice as fast as the polygon, nor ten times slower.
        for circle in circles:
            self.assertTrue(0.5 < circle["value"] < 10, circle)
        self.assertEqual(len(targets), rates + ratios + len(circles) + 1)
        for target in targets:
            met = {"at least": target["value"] >= target["target"],
                   "at most": target["value"] <= target["target"],
                   "below": target["value"] < target["target"]}
            self.assertEqual(target["met"], met[target["must_be"]], target["name"])
        by_event = targets[-1]
        self.assertEqual((by_event["must_be"], by_event["target"], by_event["unit"]),
                         ("below", 30, "%"))
        self.assertAlmostEqual(by_event["value"], 100 * result["by_event_cost"])
        line = next(line for line in printed.splitlines() if by_event["name"] in line)
        self.assertTrue(line.endswith("met" if by_event["met"] else "missed"), line)

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
