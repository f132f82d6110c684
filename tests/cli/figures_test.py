"""The table of every figure has its columns, and its drawings exist. They are drawn from the tables alone
(paper_test.py)."""

import os
import unittest

from program import InFolder, read_rows

# Figures that share their runs or have few. With 30,000 events per run, a few periods at the highest N, they
# take seconds.
FIGURES = {
    "1b": {"discs", "mean_by_time", "mean_by_time_error", "pancake", "pancake_error", "centre_x", "centre_theta", "left"},
    "2b": {"map", "x", "y", "density", "density_error", "u_x", "u_y", "visits"},
    "3a": {"discs", "theta", "varpi_m", "varpi_m_error", "pinning", "depinning",
           "residence_begin", "residence_end", "residence_share", "residence_end_resultant", "distance", "speed"},
    "3b": {"discs", "theta", "normalised", "normalised_error", "wall"},
    "4a": {"setting", "discs", "slip_resident", "slip_resident_error", "pinned_region", "cluster"},
    "pinning": {"discs", "theta", "si_pinning", "si_depinning", "residence_begin", "residence_end", "si_depinning_resultant",
                "residence_end_resultant", "residence_end_mean", "residence_end_mean_error"},
    "4b": {"discs", "resident_spin", "resident_correlation", "psi6_resident", "pinned_wall_spin", "spin_correlation", "triangles", "wall_sticking",
           "correlation_by_impulse", "pinned_correlation", "psi6_pinned", "six", "six_pinned", "disc_disc_rate"},
    "4c": {"setting", "mu_disc", "mu_wall", "discs", "mean_by_time", "mean_by_time_error", "seed"},
    "5c": {"discs", "x", "y", "by_event", "by_event_error", "by_time"},
    "5d": {"discs", "x", "y", "u_x", "u_x_error", "u_y", "u_y_error", "visits"},
    "ball": {"ball_radius", "mu", "restitution", "gamma", "gamma_error", "gamma_no_slip", "slip", "theta",
             "theta_error"},
    "condensation": {"discs", "seeds", "condensed", "waiting", "waiting_error", "before_granular",
                     "before_coordination_error", "after_granular", "before_spin_correlation"},
    "size": {"container_radius", "amplitude_ratio", "packing_fraction", "discs", "largest", "binder_error",
             "susceptibility"},
    "torque": {"discs", "wall_normal", "transfer_loose", "transfer_loose_error", "unaccounted_share"},
    "fields": {"x", "y", "packing", "packing_error", "torque", "torque_error", "relation", "relation_error"},
    "closure": {"container_radius", "discs", "relation", "packing_low", "coefficient", "coefficient_error", "explained"},
    "gears": {"mu", "discs", "correlation_by_impulse", "resident_error", "wall_sticking"},
    "friction": {"mu", "crosses", "crossing", "crossing_error"},
    "cause": {"body", "spins", "contacts", "discs", "slip", "wall_spin", "wall_sticking", "stay", "load", "load_error"},
    "turns": {"case", "kind", "x", "y", "x2", "y2", "value"},
    "material_inertia": {"inertia", "restitution", "crossing", "crossing_error", "lowest", "highest"},
    "states": {"setting", "discs", "granular", "granular_error", "coriolis", "coriolis_error"},
}


class Figures(InFolder):
    def test_tables_and_drawings(self):
        out = self.path("out")
        # Lengths in periods scale with the events; these two need five periods at N = 48.
        long = ("torque", "gears")
        for figures, events in (([f for f in FIGURES if f not in long], 30_000), (long, 150_000)):
            self.assert_works("paper", "--figure", *figures, "--quick", "--events", events, "--out", out)
        for name, columns in FIGURES.items():
            rows = read_rows(os.path.join(out, f"figure_{name}.csv"))
            self.assertLessEqual(columns, set(rows[0]), name)
            self.assertGreater(len(rows), 1)
            for kind in ("png", "pdf"):
                self.assertGreater(os.path.getsize(os.path.join(out, f"figure_{name}.{kind}")), 5000)

if __name__ == "__main__":
    unittest.main()
