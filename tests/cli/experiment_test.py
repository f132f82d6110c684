"""swirl experiment: from films to the paper's figures beside simulation, and one page about them."""

import csv
import json
import os
import re
import unittest

from program import InFolder, swirl

# Coarse films, quick to track: N, and the numbers that a test of a few swirls can hold.
SMALL = ["--container-radius", 6.5, "--scale", 12, "--width", 240, "--height", 240,
         "--frames-per-period", 40, "--noise", 2, "--quality", 14, "--seed", 3, "--length", 1.7]
# The discs of these films are as many per area as 28 and 39 in the paper's dish.
NUMBERS = (16, 22)
SIMULATION = ["--events", "1e4", "--seeds", 2]


def rows(*path):
    with open(os.path.join(*path), encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class Experiment(InFolder):
    def films(self):
        made = []
        for n in NUMBERS:
            made.append(self.path(f"N{n}.mp4"))
            done = swirl("film-test", "--discs", n, *SMALL, "--out", made[-1], "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
        return made

    def run_it(self, *arguments, code=0):
        done = swirl("experiment", *arguments)
        if "has no eyes" in done.stderr:
            self.skipTest("this build was made without OpenCV")
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_from_films_to_a_report(self):
        films, out = self.films(), self.path("out")
        done = self.run_it(*films, *SIMULATION, "--out", out)
        self.assertIn("standard errors apart", done.stdout)
        found = rows(out, "films.csv")
        self.assertEqual([int(row["discs"]) for row in found], list(NUMBERS))
        for row in found:
            # In disc radii, which small discs with soft edges tell to some per cent.
            self.assertAlmostEqual(float(row["container_radius"]), 6.5, delta=0.25)
            self.assertAlmostEqual(float(row["pictures_per_swirl"]), 40, delta=0.1)
            # Hardly two swirls: ϖ is known to a few hundredths; what is off by more is not that of
            # the same dish.
            self.assertLess(abs(float(row["by_time"]) - float(row["simulated"])), 0.15)
            self.assertGreater(float(row["simulated_error"]), 0.0)
        points = rows(out, "points.csv")
        self.assertEqual({(row["source"], int(row["discs"])) for row in points},
                         {(source, n) for source in ("film", "simulation") for n in NUMBERS})
        for row in points:
            self.assertTrue(float(row["pancake"]) < 0.0)
        for n in NUMBERS:
            cells = [row for row in rows(out, f"maps_N{n}.csv") if row["map"] == "density"]
            for source in ("film", "simulation"):
                # Density over the area of the cells is the number of discs.
                part = [float(row["density"]) for row in cells if row["source"] == source]
                reach = max(float(row["x"]) for row in cells if row["source"] == source)
                side = 2.0 * reach / 99
                self.assertAlmostEqual(sum(part) * side * side, n, delta=0.05 * n)
        for name in ("1b", "2_N16", "2_N22", "3a", "3b", "4a"):
            for kind in ("png", "pdf"):
                self.assertGreater(os.path.getsize(os.path.join(out, f"figure_{name}.{kind}")),
                                   4000)
        with open(os.path.join(out, "report.html"), encoding="utf-8") as file:
            page = file.read()
        self.assertNotRegex(page, r'(src|href)="(?!data:)')  # one file, nothing to fetch
        for words in ("Figure 1b", "Figure 3a", "Figure 4a", "N16", "N22",
                      "No film tells the spins", "there is no Figure 4c", "--smooth"):
            self.assertIn(words, page)
        # The same again: nothing is tracked or simulated twice, and the tables are the same.
        again = self.run_it(*films, *SIMULATION, "--out", out, "--json", "-")
        about = json.loads(again.stdout)
        self.assertEqual([film["name"] for film in about["films"]], ["N16", "N22"])
        self.assertEqual(about["runs"], 4)
        self.assertEqual(rows(out, "points.csv"), points)
        self.assertNotIn("finding discs", again.stderr)

        # Tables of tracks do as well, without a simulation; a film that is none leaves a hole.
        with open(self.path("none.mp4"), "w", encoding="utf-8") as file:
            file.write("this is no film")
        done = self.run_it(os.path.join(out, "tracks", "N16.csv"), self.path("none.mp4"),
                           "--smooth", os.path.join(out, "tracks", "N22.csv"), "--no-simulation",
                           "--out", self.path("tables"), code=1)
        self.assertIn("1 of 3 films could not be used", done.stderr)
        found = rows(self.path("tables"), "films.csv")
        self.assertEqual([row["kind"] for row in found], ["rough", "rough", "smooth"])
        self.assertIn("no pictures that can be read", found[1]["failed"])
        self.assertTrue(os.path.exists(self.path("tables/figure_4c.png")))
        with open(self.path("tables/report.html"), encoding="utf-8") as file:
            self.assertTrue(re.search("none could not be used", file.read()))

    def test_wrong_calls(self):
        for words, arguments in (
                ("--out", ["a.mp4"]),
                ("--fps", ["a.mp4", "--out", self.path("x"), "--fps", -1]),
                ("--seeds", ["a.mp4", "--out", self.path("x"), "--seeds", 0]),
                ("called 'a'", ["a.mp4", "b/a.mp4", "--out", self.path("x")]),
                ("--mu", ["a.mp4", "--out", self.path("x"), "--mu", "-1"])):
            done = swirl("experiment", *arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words, done.stderr)
        self.assertEqual(self.left_behind(), [])
        with open(self.path("bare.csv"), "w", encoding="utf-8") as file:
            file.write("frame,particle,x,y\n0,0,1,1\n")
        done = swirl("experiment", self.path("bare.csv"), "--out", self.path("x"), "--quiet")
        self.assertEqual(done.returncode, 1)
        self.assertIn("bare.camera.json", done.stderr)


if __name__ == "__main__":
    unittest.main()
