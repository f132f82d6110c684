"""One dish in other units, in the mirror, and in a recording: every way to the same number gives
the same number."""

import json
import math
import unittest

from program import InFolder, read_json, read_text, swirl

# The dish of the experiment in millimetres and seconds, and with r = 1 and the same speed of the
# container.
FLOOR = (
    "--body",
    "sphere",
    "--floor",
    "sliding",
    "--mu",
    0.33,
    "--floor-friction",
    0.33,
    "--restitution",
    0.9,
    "--discs",
    24,
    "--periods",
    60,
)
IN_MM = (
    "--radius",
    3,
    "--container-radius",
    25.5,
    "--amplitude",
    11.5,
    "--period",
    0.532,
    "--gravity",
    9810,
    "--contact-duration",
    2e-5,
)
MEASURED = ("centre", "slip", "temperature", "collisions", "wall", "pair_correlation")


def in_radii(speed):
    """IN_MM with r = 1; `speed` of the container in mm/s."""
    time = 3 / speed  # one unit of time, in seconds
    return (
        "--container-radius",
        8.5,
        "--amplitude",
        11.5 / 3,
        "--period",
        0.532 / time,
        "--gravity",
        9810 / 3 * time**2,
        "--contact-duration",
        2e-5 / time,
    )


class Units(InFolder):
    def json_of(self, *arguments):
        done = swirl(*arguments, "--quiet", "--json", "-", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_a_dish_in_millimetres_has_the_numbers_of_the_dish_in_radii(self):
        measure = ("--measure", ",".join(MEASURED))
        mm = self.json_of("run", *FLOOR, *IN_MM, *measure)
        radii = self.json_of("run", *FLOOR, *in_radii(mm["config"]["speed"]), *measure)
        self.assertEqual(mm["units"]["r"], 3)
        compared = 0
        for measurement, rows in mm["measured"].items():
            for name, value in rows.items():
                other = radii["measured"][measurement][name]
                if (
                    not isinstance(value, dict)
                    or "mean" not in value
                    or None in (value["mean"], value["error"])
                ):
                    continue
                # The trajectories differ after some collisions. Errors of 40 periods are uncertain.
                self.assertLess(
                    abs(value["mean"] - other["mean"]),
                    6 * math.hypot(value["error"], other["error"]),
                    f"{measurement}.{name}",
                )
                compared += 1
        self.assertGreater(compared, 15)
        tables = [
            run["measured"]["pair_correlation"]["function"]["distance"] for run in (mm, radii)
        ]
        self.assertEqual(
            [f"{distance:.9g}" for distance in tables[0]],
            [f"{distance:.9g}" for distance in tables[1]],
        )

    def test_exported_tables_are_in_the_units_of_their_header(self):
        swirl(
            "run",
            "--discs",
            3,
            "--periods",
            2,
            "--radius",
            2,
            "--container-radius",
            17.2,
            "--amplitude",
            3.784,
            "--trajectory",
            "t.h5",
            "--frames-per-period",
            4,
            "--quiet",
            cwd=self.folder,
        )
        swirl("export", "t.h5", "--format", "table", "--quiet", cwd=self.folder)
        header, first = read_text(self.path("t.table.csv")).splitlines()[:2]
        row = dict(zip(header.split(","), first.split(",")))
        self.assertEqual(float(row["radius (r)"]), 1)
        self.assertEqual(float(row["container x (r)"]), 1.892)
        self.assertEqual(float(row["moment of inertia (m r²)"]), 10)

    def test_rotation_counts_with_the_swirl_in_every_command(self):
        clockwise = ("--direction", "clockwise")
        report = swirl(
            "run",
            "--discs",
            12,
            *clockwise,
            "--periods",
            60,
            "--warmup",
            20,
            "--trajectory",
            "cw.h5",
            "--frames-per-period",
            64,
            "--json",
            "cw.json",
            cwd=self.folder,
        ).stdout
        self.assertIn("12 discs rotate with the swirl", report)
        run = read_json(self.path("cw.json"))["rotation"]["mean_by_time"]["mean"]
        self.assertGreater(run, 0.05)
        recorded = self.json_of("measure", "cw.h5", "--warmup", 20, "--measure", "slip")
        self.assertAlmostEqual(recorded["rotation"]["mean_by_time"]["mean"], run, delta=0.02)
        self.assertIsNotNone(recorded["measured"]["slip"]["cluster"]["mean"])
        swirl(
            "sweep",
            "--discs",
            12,
            *clockwise,
            "--periods",
            60,
            "--out",
            "sweep",
            "--quiet",
            cwd=self.folder,
        )
        collected = swirl("collect", "sweep", "--csv", "-", cwd=self.folder).stdout.splitlines()
        row = dict(zip(collected[0].split(","), collected[1].split(",")))
        self.assertGreater(float(row["mean_by_time"]), 0.05)

    def test_frames_after_events_are_weighted_with_their_time(self):
        run = self.json_of(
            "run", "--discs", 5, "--periods", 1000, "--trajectory", "e.h5", "--frame-events", 3
        )
        recorded = self.json_of("measure", "e.h5", "--warmup", 20)["rotation"]["mean_by_time"][
            "mean"
        ]
        by_time, by_event = (
            run["rotation"][name]["mean"] for name in ("mean_by_time", "mean_by_event")
        )
        self.assertLess(abs(recorded - by_time), 0.25 * abs(by_event - by_time))

    def test_errors_of_few_periods_have_students_factor_in_every_file(self):
        # With 6 blocks, Student's t of 5 degrees of freedom is 2.571 for 95 %.
        run = self.json_of("run", "--discs", 12, "--periods", 8, "--warmup", 2, "--series", "s.csv")
        rows = [line.split(",") for line in read_text(self.path("s.csv")).splitlines()]
        column = rows[0].index("rigid_by_time")
        values = [float(row[column]) for row in rows[1:] if row[1] == "1"]
        mean = sum(values) / len(values)
        plain = math.sqrt(
            sum((value - mean) ** 2 for value in values) / len(values) / (len(values) - 1)
        )
        for error in (
            run["rotation"]["rigid_by_time"]["error"],
            run["series"]["averages"]["rigid_by_time"]["error"],
        ):
            # The correlation of the blocks can only increase the error.
            self.assertGreaterEqual(error, 2.5705 / 1.96 * plain * (1 - 1e-4))
        short = self.json_of("run", "--discs", 12, "--periods", 3, "--warmup", 0)
        self.assertIsNone(short["rotation"]["rigid_by_time"]["error"])


if __name__ == "__main__":
    unittest.main()
