"""swirl experiment: the paper's figures from videos, compared with simulations, and a report."""

import csv
import json
import os
import re
import shutil
import subprocess
import unittest

from program import SOURCE, SWIRL, InFolder, swirl

# Small, short videos that are tracked quickly.
SMALL = [
    "--container-radius",
    6.5,
    "--scale",
    12,
    "--width",
    240,
    "--height",
    240,
    "--frames-per-period",
    40,
    "--noise",
    2,
    "--quality",
    14,
    "--seed",
    3,
]
# The packing fractions equal those of 28 and 39 discs in the paper's container.
NUMBERS = (16, 22)
SIMULATION = ["--events", "1e4", "--replicates", 2]


def rows(*path):
    with open(os.path.join(*path), encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class Experiment(InFolder):
    def videos(self):
        made = []
        for n in NUMBERS:
            made.append(self.path(f"N{n}.mp4"))
            length = ["--periods", 4.2 if n == NUMBERS[0] else 1.7]
            done = swirl(
                "synthetic-video", "--discs", n, *SMALL, *length, "--out", made[-1], "--quiet"
            )
            self.assertEqual(done.returncode, 0, done.stderr)
        return made

    def experiment(self, *arguments, code=0):
        done = swirl("experiment", *arguments)
        if "no camera support" in done.stderr:
            self.skipTest("this build has no camera support")
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_report_from_videos(self):
        videos, out = self.videos(), self.path("out")
        done = self.experiment(*videos, *SIMULATION, "--out", out)
        self.assertRegex(done.stdout, "N16: .*standard errors apart")
        self.assertNotRegex(done.stdout, "N22: .*standard errors apart")
        # N22 has no error.
        self.assertRegex(
            done.stdout, r"rough videos next to their simulations: χ² = \S+ of 1 point\."
        )
        self.assertIn("N22 shows 1.7 periods, too few for an error", done.stdout)
        found = rows(out, "videos.csv")
        self.assertEqual([int(row["discs"]) for row in found], list(NUMBERS))
        for row in found:
            # In disc radii; the radius of small discs with soft edges is known to a few per cent.
            self.assertAlmostEqual(float(row["container_radius"]), 6.5, delta=0.25)
            self.assertAlmostEqual(float(row["frames_per_period"]), 40, delta=0.1)
            # One video lasts less than two periods, so the error of ϖ is a few hundredths. A wrong
            # container would change ϖ by more than 0.15.
            self.assertLess(abs(float(row["mean_by_time"]) - float(row["simulated"])), 0.15)
            self.assertGreater(float(row["simulated_error"]), 0.0)
        points = rows(out, "points.csv")
        self.assertEqual(
            {(row["source"], int(row["discs"])) for row in points},
            {(source, n) for source in ("video", "simulation") for n in NUMBERS},
        )
        for row in points:
            self.assertTrue(float(row["pancake"]) < 0.0)
        for n in NUMBERS:
            cells = [row for row in rows(out, f"maps_N{n}.csv") if row["map"] == "density"]
            for source in ("video", "simulation"):
                # The integral of the density is the number of discs.
                part = [float(row["density"]) for row in cells if row["source"] == source]
                reach = max(float(row["x"]) for row in cells if row["source"] == source)
                side = 2.0 * reach / 99
                self.assertAlmostEqual(sum(part) * side * side, n, delta=0.05 * n)
        # Figure 4a needs residences, and these need 120 frames per period.
        self.assertFalse(os.path.exists(os.path.join(out, "figure_4a.png")))
        for name in ("1b", "2_N16", "2_N22", "3a", "3b"):
            for kind in ("png", "pdf"):
                self.assertGreater(
                    os.path.getsize(os.path.join(out, f"figure_{name}.{kind}")), 4000
                )
        with open(os.path.join(out, "report.html"), encoding="utf-8") as file:
            page = file.read()
        self.assertNotRegex(page, r'(src|href)="(?!data:)')  # self-contained
        for words in (
            "Figure 1b",
            "Figure 3a",
            "N16",
            "N22",
            "No video has the spins",
            "there is no Figure 4c",
            "--smooth-discs",
        ):
            self.assertIn(words, page)
        # A repeated call neither tracks nor simulates again, and gives the same tables.
        again = self.experiment(*videos, *SIMULATION, "--out", out, "--json", "-")
        about = json.loads(again.stdout)
        self.assertEqual([video["name"] for video in about["videos"]], ["N16", "N22"])
        self.assertEqual(about["runs"], 4)
        self.assertEqual(rows(out, "points.csv"), points)
        self.assertNotIn("finding discs", again.stderr)

        # The videos are points for the curves of any model, with the same χ².
        with open(self.path("points.csv"), "w", encoding="utf-8") as file:
            file.writelines(
                f"{row['discs']},{row['mean_by_time']},{row['mean_by_time_error']}\n"
                for row in [
                    dict(
                        discs="discs",
                        mean_by_time="mean_by_time",
                        mean_by_time_error="mean_by_time_error",
                    ),
                    found[0],
                ]
            )
        compared = self.assert_works(
            "crossing",
            "--container-radius",
            6.5,
            "--from",
            14,
            "--to",
            18,
            "--events",
            "1e4",
            "--tolerance",
            5,
            "--my-points",
            self.path("points.csv"),
            "--quiet",
        )
        self.assertRegex(compared.stdout, r"χ² = \S+ of 1 point")

        # Tracks are accepted instead of videos; an invalid video is omitted.
        with open(self.path("none.mp4"), "w", encoding="utf-8") as file:
            file.write("this is no video")
        done = self.experiment(
            os.path.join(out, "tracks", "N16.csv"),
            self.path("none.mp4"),
            "--smooth-discs",
            os.path.join(out, "tracks", "N22.csv"),
            "--no-simulation",
            "--out",
            self.path("tables"),
            code=1,
        )
        self.assertIn("1 of 3 videos could not be used", done.stderr)
        found = rows(self.path("tables"), "videos.csv")
        self.assertEqual([row["surface"] for row in found], ["rough", "rough", "smooth"])
        self.assertIn("no readable frames", found[1]["failed"])
        self.assertTrue(os.path.exists(self.path("tables/figure_4c.png")))
        with open(self.path("tables/report.html"), encoding="utf-8") as file:
            self.assertTrue(re.search("none could not be used", file.read()))

        # Of two videos with another container each, neither is the odd one.
        tracks = os.path.join(out, "tracks", "N16.csv")
        shutil.copy(tracks, self.path("larger.csv"))
        with open(tracks[:-4] + ".camera.json", encoding="utf-8") as file:
            camera = json.load(file)
        camera["camera"]["container-radius"] *= 1.05
        with open(self.path("larger.camera.json"), "w", encoding="utf-8") as file:
            json.dump(camera, file)
        done = self.experiment(
            tracks, self.path("larger.csv"), "--no-simulation", "--out", self.path("two")
        )
        for name in ("N16", "larger"):
            self.assertRegex(
                done.stdout,
                rf"The container radius of {name} is \S+ disc radii, but that of the other video is",
            )

    def test_nothing_begins_without_the_packages_of_the_figures(self):
        # A Python without its installed packages.
        bare = self.path("bare")
        with open(bare, "w", encoding="utf-8") as file:
            file.write('#!/bin/sh\nexec /usr/bin/python3 -S "$@"\n')
        os.chmod(bare, 0o755)
        done = swirl(
            "experiment",
            self.path("none.mp4"),
            "--out",
            self.path("x"),
            environment={"SWIRL_PYTHON": bare},
        )
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, r"\Aerror: figures and report need the Debian packages ")
        self.assertIn("hint: apt install python3-numpy python3-matplotlib", done.stderr)
        self.assertFalse(os.path.exists(self.path("x")))

    def test_tracks_need_no_camera_support(self):
        """A program without `swirl track` compares tracks, and says what a video needs."""
        video = self.videos()[1]
        done = swirl("track", video, "--out", self.path("N22.csv"), "--quiet")
        if "no camera support" in done.stderr:
            self.skipTest("this build has no camera support")
        self.assertEqual(done.returncode, 0, done.stderr)
        os.mkdir(self.path("bin"))
        for name in ("swirl", "swirl-experiment"):
            shutil.copy(os.path.join(os.path.dirname(SWIRL), name), self.path("bin"))

        def call(*words):
            return subprocess.run(
                [self.path("bin/swirl"), "experiment", *map(str, words)],
                capture_output=True,
                text=True,
                env=dict(os.environ, SWIRL_FIGURES=os.path.join(SOURCE, "paper")),
            )

        done = call(self.path("N22.csv"), "--no-simulation", "--out", self.path("tables"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(rows(self.path("tables"), "videos.csv")[0]["discs"], "22")
        done = call(video, "--no-simulation", "--out", self.path("videos"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("the program of `swirl track`, swirl-track, is not installed", done.stderr)

    def test_invalid_options_are_rejected(self):
        for words, arguments in (
            ("--out", ["a.mp4"]),
            ("--fps", ["a.mp4", "--out", self.path("x"), "--fps", -1]),
            ("--replicates", ["a.mp4", "--out", self.path("x"), "--replicates", 0]),
            ("called 'a'", ["a.mp4", "b/a.mp4", "--out", self.path("x")]),
            ("--mu", ["a.mp4", "--out", self.path("x"), "--mu", "-1"]),
        ):
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
