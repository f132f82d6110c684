"""swirl dish, and values with units: every way to describe a dish is the same run, or an error."""

import json
import os
import shlex
import unittest

from program import InFolder, read_json, swirl

MILLIMETRES = ["--radius", "3mm", "--container-radius", "25.5mm", "--amplitude", "11.5mm"]
SHORT = ["--discs", "12", "--periods", "2", "--warmup", "0"]


class Dish(InFolder):
    def dish(self, *arguments):
        """The report without a search, by the names of its lines."""
        text = self.assert_works("dish", *arguments, "--no-search").stdout
        return {line[2:14].strip(): line[14:] for line in text.splitlines()}

    def run_of(self, *arguments):
        return json.loads(
            self.assert_works("run", *arguments, *SHORT, "--json", "-", "--quiet").stdout
        )

    def test_preset_with_sizes_dish_and_ratios_are_the_same_run(self):
        lines = self.dish(*MILLIMETRES, "--rpm", 112.8)
        hashes = set()
        for name in ("run", "in ratios"):
            words = shlex.split(lines[name])
            self.assertEqual(words[:2] + words[-2:-1], ["swirl", "run", "--discs"])
            hashes.add(self.run_of(*words[2:-2])["state_hash"])
        hashes.add(
            self.run_of("--preset", "experiment", *MILLIMETRES, "--period", "112.8rpm")[
                "state_hash"
            ]
        )
        hashes.add(self.run_of("--preset", "experiment", "--period", "112.8rpm")["state_hash"])
        self.assertEqual(len(hashes), 1)
        numbers_alone = [
            "--radius",
            3,
            "--container-radius",
            25.5,
            "--amplitude",
            11.5,
            "--period",
            0.532,
        ]
        self.assert_fails(
            2,
            "run",
            "--preset",
            "experiment",
            *numbers_alone,
            says="needs --gravity with --radius 3",
        )
        self.assert_fails(2, "dish", *numbers_alone, says="needs --gravity")

    def test_the_report_has_the_ratios_and_what_fits(self):
        lines = self.dish(
            "--container-radius", "60mm", "--radius", "8mm", "--amplitude", "15mm", "--rpm", 78
        )
        self.assertEqual(lines["dish"], "r = 8 mm, R = 60 mm, A = 15 mm, 78 rpm, v = 122.5 mm/s")
        # g r/v² = 9.81 m/s² · 8 mm/(122.5 mm/s)².
        self.assertEqual(
            lines["ratios"], "R/r = 7.5, A/r = 1.875, A/R = 0.25, g r/v² = 5.228, AΩ²/g = 0.102"
        )
        self.assertRegex(lines["fits"], r"^at most 4\d spheres; 4\d ")
        self.assertEqual(lines["friction"], "μ = 0.33, e = 0.9")
        self.assertEqual(
            self.dish(*MILLIMETRES, "--rpm", 78, "--mu", 0.2)["friction"], "μ = 0.2, e = 0.9"
        )
        discs = self.dish(*MILLIMETRES, "--period", "0.5s", "--body", "disc")
        self.assertEqual(discs["ratios"], "R/r = 8.5, A/r = 3.833, A/R = 0.451")
        self.assertNotIn("--preset", discs["in ratios"])

    def test_n_c_comes_from_a_search(self):
        found = json.loads(
            self.assert_works(
                "dish",
                "--preset",
                "experiment",
                "--rpm",
                112.8,
                "--from",
                5,
                "--to",
                6,
                "--tolerance",
                5,
                "--json",
                "-",
                "--quiet",
            ).stdout
        )
        self.assertEqual(found["crossing"]["verdict"], "always rotates")
        self.assertEqual(found["config"]["container_radius"], 8.5)

    def test_own_points_are_drawn_beside_the_dish(self):
        with open(self.path("mine.csv"), "w", encoding="utf-8") as mine:
            mine.write("N,turns,circles\n6,9.5,20\n12,8,20\n")
        call = [
            "dish",
            "--preset",
            "experiment",
            "--rpm",
            112.8,
            "--mu",
            "0.2,0.6",
            "--periods",
            8,
            "--warmup",
            1,
            "--replicates",
            1,
            "--my-points",
            self.path("mine.csv"),
            "--out",
            self.path("mine"),
        ]
        said = self.assert_works(*call).stdout
        self.assertRegex(said, r"my points   χ² = \S+ of 2 points for mu 0.2, floor_friction 0.2\n")
        self.assertRegex(said, r"best fit    mu = ")
        for name in ("table.csv", "table.png", "table.pdf", "my_points.csv"):
            self.assertIn(name, os.listdir(self.path("mine")))
        again = self.assert_works(
            "collect", self.path("mine"), "--plot", "--my-points", self.path("mine.csv")
        ).stdout
        self.assertEqual(again, said)
        self.assert_fails(2, *call[:-2], says="--out, the folder for the runs, is not")

    def test_missing_and_doubled_sizes_are_named(self):
        self.assert_fails(2, "dish", "--radius", "8mm", says="missing option --container-radius")
        self.assert_fails(2, "dish", *MILLIMETRES, says="missing option --rpm 78")
        self.assert_fails(
            2,
            "dish",
            *MILLIMETRES,
            "--rpm",
            78,
            "--period",
            "1s",
            says="--rpm and --period are both given",
        )
        self.assert_fails(2, "dish", *MILLIMETRES, "--rpm", "fast", says="--period is fastrpm")

    def test_results_keep_the_units(self):
        file = self.path("r.json")
        said = self.assert_works(
            "run", "--preset", "experiment", "--period", "100rpm", *SHORT, "--json", file
        ).stdout
        self.assertIn("dish        r = 3 mm, R = 25.5 mm, A = 11.5 mm, 100 rpm", said)
        self.assertEqual(read_json(file)["config"]["length_unit"], "3mm")
        self.assert_works("verify", file)
        with open(self.path("dish.toml"), "w", encoding="utf-8") as config:
            config.write('preset = "experiment"\nperiod = "100rpm"\n')
        again = self.run_of(self.path("dish.toml"))
        self.assertEqual(again["state_hash"], read_json(file)["state_hash"])

    def test_a_sweep_takes_values_with_units(self):
        self.assert_works(
            "sweep",
            "--preset",
            "experiment",
            "--container-radius",
            "25.5mm,30mm",
            *SHORT,
            "--out",
            self.path("s"),
            "--quiet",
        )
        table = swirl("collect", self.path("s"), "--csv", "-").stdout
        self.assertIn("25.5mm", table)
        self.assertIn("30mm", table)


if __name__ == "__main__":
    unittest.main()
