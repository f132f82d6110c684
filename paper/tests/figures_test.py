"""The table of every figure has its columns, and its drawings exist. They are drawn from the tables
alone (drawings_test.py). Those of the chapters are in chapters_test.py."""

import os
import unittest

from program import InFolder, read_rows

# Figures that share their runs or have few. With 30,000 events per run, a few periods at the
# highest N, they take seconds.
FIGURES = {
    "1b": {
        "discs",
        "mean_by_time",
        "mean_by_time_error",
        "pancake",
        "pancake_error",
        "centre_x",
        "centre_theta",
        "left",
    },
    "2b": {"map", "x", "y", "density", "density_error", "u_x", "u_y", "visits"},
    "3a": {
        "discs",
        "theta",
        "varpi_m",
        "varpi_m_error",
        "pinning",
        "depinning",
        "residence_begin",
        "residence_end",
        "residence_share",
        "residence_end_resultant",
        "distance",
        "speed",
    },
    "3b": {"discs", "theta", "normalised", "normalised_error", "wall"},
    "4a": {"setting", "discs", "slip_resident", "slip_resident_error", "pinned_region", "cluster"},
    "pinning": {
        "discs",
        "theta",
        "si_pinning",
        "si_depinning",
        "residence_begin",
        "residence_end",
        "si_depinning_resultant",
        "residence_end_resultant",
        "residence_end_mean",
        "residence_end_mean_error",
    },
    "4b": {
        "discs",
        "resident_spin",
        "resident_correlation",
        "psi6_resident",
        "pinned_wall_spin",
        "spin_correlation",
        "triangles",
        "wall_sticking",
        "correlation_by_impulse",
        "pinned_correlation",
        "psi6_pinned",
        "six",
        "six_pinned",
        "disc_disc_rate",
    },
    "4c": {"setting", "mu_disc", "mu_wall", "discs", "mean_by_time", "mean_by_time_error", "seed"},
    "5c": {"discs", "x", "y", "by_event", "by_event_error", "by_time"},
    "5d": {"discs", "x", "y", "u_x", "u_x_error", "u_y", "u_y_error", "visits"},
    "ball": {
        "ball_radius",
        "mu",
        "restitution",
        "gamma",
        "gamma_error",
        "gamma_no_slip",
        "slip",
        "theta",
        "theta_error",
    },
    "condensation": {
        "discs",
        "seeds",
        "condensed",
        "waiting",
        "waiting_error",
        "before_granular",
        "before_coordination_error",
        "after_granular",
        "before_spin_correlation",
    },
    "friction": {"mu", "crosses", "crossing", "crossing_error"},
    "states": {"setting", "discs", "granular", "granular_error", "coriolis", "coriolis_error"},
}


class Figures(InFolder):
    def test_tables_and_drawings(self):
        out = self.path("out")
        self.assert_works(
            "paper", "--figure", *FIGURES, "--quick", "--events", 30_000, "--out", out
        )
        for name, columns in FIGURES.items():
            rows = read_rows(os.path.join(out, f"figure_{name}.csv"))
            self.assertLessEqual(columns, set(rows[0]), name)
            self.assertGreater(len(rows), 1)
            for kind in ("png", "pdf"):
                self.assertGreater(
                    os.path.getsize(os.path.join(out, f"figure_{name}.{kind}")), 5000
                )


if __name__ == "__main__":
    unittest.main()
