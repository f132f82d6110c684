"""Tables written by hand, so that the verdict on them is known."""

import csv
import os
import sys
import tempfile
import unittest

SOURCE = os.environ.get("SWIRL_SOURCE") or os.path.join(os.path.dirname(__file__), "..", "..")
sys.dont_write_bytecode = True

from paper.claims.study import Study


class HandMadeTables(unittest.TestCase):
    """`self.study` reads the tables in `self.folder`, each of them once."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.study = Study(self.folder)

    def table(self, name, rows):
        self.study = Study(self.folder)
        with open(
            os.path.join(self.folder, f"figure_{name}.csv"), "w", newline="", encoding="utf-8"
        ) as file:
            writer = csv.DictWriter(
                file, fieldnames=list(dict.fromkeys(c for row in rows for c in row))
            )
            writer.writeheader()
            writer.writerows(rows)

    def crossings(self, name, **curves):
        """{curve: (N_c, error)}, or (None, verdict) for a curve that does not cross."""
        self.table(
            f"{name}_crossings",
            [
                {
                    "curve": curve,
                    "verdict": "crosses" if at else error,
                    "crossing": at or "",
                    "crossing_error": error if at else "",
                    "lowest": 0.1,
                    "lowest_error": 0.01,
                    "lowest_discs": 48,
                }
                for curve, (at, error) in curves.items()
            ],
        )

    def rotation(self, name, setting, values, error=0.01):
        """A curve ϖ(N), the same by event and by time; `values` are (N, ϖ/Ω)."""
        self.table(
            name,
            [
                {
                    "setting": setting,
                    "discs": n,
                    "mean_by_event": v,
                    "mean_by_event_error": error,
                    "mean_by_time": v,
                    "mean_by_time_error": error,
                    "point": f"{setting}_N{n}",
                }
                for n, v in values
            ],
        )
