"""swirl crossing over lists: one search for each combination, and a table of all searches."""

import csv
import io
import json
import unittest

from program import InFolder, swirl

SHORT = ["--events", "2e4", "--tolerance", 5, "--quiet"]
FEW = ["--from", 5, "--to", 7]
AROUND = ["--from", 37, "--to", 39]  # where it crosses, so that there is a number to compare


class Crossing(InFolder):
    def good(self, *arguments):
        done = swirl("crossing", *arguments, *SHORT)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_each_value_of_a_list_has_a_search(self):
        said = self.good(*AROUND, "--mu", "0.9,1", "--seed", 4, "--csv", self.path("N_c.csv"), "--json",
                         self.path("all.json"))
        self.assertIn("mu 0.9: ", said)
        with open(self.path("N_c.csv"), encoding="utf-8") as opened:
            rows = list(csv.DictReader(opened))
        self.assertEqual([row["mu"] for row in rows], ["0.9", "1"])
        with open(self.path("all.json"), encoding="utf-8") as opened:
            together = json.load(opened)
        for row, found, mu in zip(rows, together, ("0.9", "1"), strict=True):
            alone = json.loads(self.good(*AROUND, "--mu", mu, "--seed", 4, "--json", "-"))
            self.assertEqual(row["verdict"], alone["verdict"])
            for name in ("N_c", "N_c_error", "N_c_lower", "N_c_upper"):
                self.assertEqual(row[name], "" if alone[name] is None else repr(alone[name]))
                self.assertEqual(found[name], alone[name])
            self.assertEqual(int(row["runs"]), alone["runs"])
            self.assertEqual(int(row["events_in_all"]), alone["events"])

    def test_lists_combine_and_may_be_in_a_file(self):
        with open(self.path("a.toml"), "w", encoding="utf-8") as opened:
            opened.write("mu_disc = [0.9, 1]\nmu_wall = \"0:1\"\n")
        table = list(csv.DictReader(io.StringIO(self.good(self.path("a.toml"), *FEW, "--csv", "-"))))
        self.assertEqual([(row["mu_disc"], row["mu_wall"]) for row in table],
                         [("0.9", "0"), ("0.9", "1"), ("1", "0"), ("1", "1")])
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
        done = swirl("crossing", "--restitution", "0.1,1", "--contact-duration", 0, *FEW, "--csv", "-", *SHORT)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("every run failed in 1 of 2 searches", done.stderr)
        rows = list(csv.DictReader(io.StringIO(done.stdout)))
        self.assertEqual([row["verdict"] for row in rows], ["undecided", "always rotates"])
        self.assertEqual(rows[0]["runs"], "0")
        self.assertGreaterEqual(int(rows[0]["runs_failed"]), 3)
        self.assertEqual(rows[1]["runs_failed"], "0")

    def test_an_invalid_later_search_is_rejected_before_the_first(self):
        done = swirl("crossing", "--container-radius", "8.6,4", *AROUND, "--json", self.path("x.json"), *SHORT)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(self.left_behind(), [])

    def test_only_the_searched_numbers_must_fit(self):
        # 48 discs, the default of a run, do not fit into this container.
        found = json.loads(self.good("--container-radius", 6.3, "--from", 8, "--to", 10, "--json", "-"))
        self.assertEqual(found["verdict"], "always rotates")
        done = swirl("crossing", "--container-radius", 6.3, "--from", 8, "--to", 46, *SHORT)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("46 discs do not fit", done.stderr)
        self.assertNotIn("--discs", done.stderr)

    def test_every_rotation_rate_has_a_crossing(self):
        alone = json.loads(self.good("--from", 35, "--to", 41, "--seed", 4, "--threads", 1, "--json", "-"))
        both = json.loads(self.good("--from", 35, "--to", 41, "--seed", 4, "--threads", 2, "--json", "-"))
        self.assertEqual(alone["by_rate"], both["by_rate"])
        self.assertEqual(alone["rate"], "by_time")
        self.assertEqual(set(alone["by_rate"]), {"by_event", "by_time", "rigid_by_event", "rigid_by_time"})
        self.assertEqual(alone["N_c"], alone["by_rate"]["by_time"]["N_c"])
        rigid = json.loads(self.good("--from", 35, "--to", 41, "--seed", 4, "--rate", "rigid_by_time", "--json", "-"))
        self.assertEqual(rigid["N_c"], rigid["by_rate"]["rigid_by_time"]["N_c"])

    def test_invalid_options_are_rejected(self):
        for wrong, says in ((["--mu", "0.5,0.5"], "the same run"), (["--mu", "1,"], "empty"),
                            (["--step", -1], "1 or more"), (["--rate", "rigid"], "rigid_by_time"),
                            (["--threads", -1], "whole number"), (["--to", 10**9], "--to"),
                            (["--mu", "0.1,2", "--csv", "-", "--json", "-"], "standard output")):
            done = swirl("crossing", *wrong, *SHORT)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(says, done.stderr)


if __name__ == "__main__":
    unittest.main()
