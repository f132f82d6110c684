"""Claims on the M-frame profiles and on the pinned region, judged by tables written by hand."""

import os
import unittest

from claim_tables import HandMadeTables
from program import read_rows

from paper import paper_parameters, tables
from paper.claims import profiles, residence
from paper.verdicts import FAILS, HOLDS, IN_PART, UNDECIDED


class Profiles(HandMadeTables):
    def pinned_profile(self, table, name, curve, error=0.01):
        """A profile at N = 24, 36, 48 whose pinned region, from 200° down to 100°, has these
        values; other slices have −5, which must not count."""
        self.table(
            table,
            [
                {
                    "setting": "high",
                    "discs": n,
                    "theta": theta,
                    "visits": 1000,
                    "residence_begin": 200,
                    "residence_end": 100,
                    name: v if 100 <= theta <= 200 else -5.0,
                    f"{name}_error": error,
                    "point": f"high_N{n}",
                }
                for n, v in zip((24, 36, 48), curve)
                for theta in (50, 120, 150, 180, 300)
            ],
        )

    def test_pinned_discs_lag_behind_the_wall_and_reach_it(self):
        def judged(*curve, error=0.01):
            self.pinned_profile("3b", "normalised", curve, error)
            return profiles.pinned_reach_wall(self.study, "high")[0]

        self.assertEqual(judged(0.8, 0.9, 1.0), HOLDS)
        self.assertEqual(judged(0.8, 0.8, 0.8), IN_PART)
        self.assertEqual(judged(1.2, 1.0, 1.0), IN_PART)
        self.assertEqual(judged(0.8, 1.0, 1.2), IN_PART)  # faster than the wall
        self.assertEqual(judged(1.2, 1.0, 0.8), FAILS)
        self.assertEqual(judged(0.8, 0.9, 0.96), UNDECIDED)
        self.assertEqual(judged(0.8, 0.9, 0.96).points, {"high_N48"})
        # Slices of one run are not independent: the error of three equals that of one.
        self.assertEqual(judged(0.8, 0.9, 1.0, error=0.02), UNDECIDED)

    def test_pinned_discs_become_faster_with_n(self):
        def judged(*curve, error=0.01):
            self.pinned_profile("3a", "varpi_m", curve, error)
            return profiles.pinned_faster(self.study, "high")[0]

        self.assertEqual(judged(-0.9, -1.0, -1.1), HOLDS)
        self.assertEqual(judged(-1.1, -1.0, -0.9), FAILS)
        self.assertEqual(judged(-0.9, -0.7, -1.1), FAILS)  # a reversal
        self.assertEqual(judged(-0.9, -0.95, -1.0, error=0.05), UNDECIDED)

    def test_loose_peaks_have_one_shape_wherever_they_are(self):
        """Peaks of |ϖ_M| at 300°, 320° and 340°, that fall by `slope` per 10° down to that of the
        wall."""

        def judged(*shapes, error=0.001):
            self.table(
                "3a",
                [
                    {
                        "setting": "high",
                        "discs": n,
                        "theta": (300 + 20 * k + offset) % 360,
                        "visits": 1000,
                        "varpi_m": -1 - max(height - slope * abs(offset) / 10, 0),
                        "varpi_m_error": error,
                        "point": f"high_N{n}",
                    }
                    for k, (n, (height, slope)) in enumerate(zip((24, 36, 48), shapes))
                    for offset in range(-180, 180, 10)
                ]
                +
                # A slice with few visits is not used.
                [
                    {
                        "setting": "high",
                        "discs": 24,
                        "theta": 5,
                        "visits": 5,
                        "varpi_m": -9,
                        "varpi_m_error": error,
                    }
                ],
            )
            return profiles.loose_peak(self.study, "high")

        same = (0.2, 0.05)
        self.assertEqual(judged(same, same, same)[0], HOLDS)
        # |ϖ_M| is 1.2 and 1.3, equal within 15 %. Above Ω the peaks differ by a half.
        self.assertEqual(judged(same, same, (0.3, 0.05))[0], FAILS)
        self.assertEqual(judged(same, same, (0.2, 0.2))[0], FAILS)  # one is narrow
        self.assertEqual(judged(same, same, same, error=0.1)[0], UNDECIDED)
        self.assertIn(
            "at θ = 300° for N = 24, 0.2000 ± 0.0010 Ω at 340° for N = 48",
            judged(same, same, same)[1],
        )

    def test_all_slices_are_clockwise(self):
        def judged(varpi_m, error=0.01, by_time=0.0):
            self.table(
                "3a",
                [
                    {
                        "setting": "high",
                        "discs": 28,
                        "theta": t,
                        "visits": 1000,
                        "varpi_m": v,
                        "varpi_m_error": error,
                        "point": "high_N28",
                    }
                    for t, v in ((90, -1.0), (180, varpi_m))
                ],
            )
            self.table("1b", [{"setting": "high", "discs": 28, "mean_by_time": by_time}])
            return profiles.clockwise(self.study, "high")

        verdict, found = judged(-1.0)
        self.assertEqual(verdict, HOLDS)
        self.assertIn("not counted as a claim", found)
        self.assertIn("as they must)", found)
        self.assertEqual(judged(0.5)[0], FAILS)
        self.assertEqual(judged(-0.02)[0], UNDECIDED)
        # A broken identity is reported and changes no verdict.
        verdict, found = judged(-1.0, by_time=0.5)
        self.assertEqual(verdict, HOLDS)
        self.assertIn("which they must not", found)
        os.remove(os.path.join(self.folder, "figure_1b.csv"))
        self.assertEqual(profiles.clockwise(self.study, "high")[0], HOLDS)

    def test_oblong_cluster_is_tested_where_discs_pin_and_depin(self):
        """Discs pin at 180° and depin at 90°. The other slices are near the average, except for the
        minimum of |ϖ_M| at 0°, which decides nothing."""

        def judged(*places, error=0.01, slow=-0.8):
            self.table(
                "3a",
                [
                    {
                        "setting": "high",
                        "discs": n,
                        "theta": t,
                        "visits": 1000,
                        "varpi_m": v,
                        "varpi_m_error": error,
                        "distance": d,
                        "distance_error": error,
                        "speed": u,
                        "speed_error": error,
                        "residence_begin": 179,
                        "residence_end": 92,
                    }
                    for n, (distance, speed) in zip((28, 48), places)
                    for t, v, d, u in (
                        (90, slow, distance, speed),
                        (180, slow, distance, speed),
                        (270, -1.2, 4, 2),
                        (0, -0.5, 4, 2),
                        (300, -1.2, 4, 2),
                        (330, -1.2, 4, 2),
                    )
                ],
            )
            return profiles.oblong(self.study, "high")[0]

        self.assertEqual(judged((5, 2)), HOLDS)
        self.assertEqual(judged((3, 2)), IN_PART)
        self.assertEqual(judged((3, 1), slow=-1.3), FAILS)
        self.assertEqual(judged((3, 4), slow=-1.3), FAILS)  # faster fails, too
        self.assertEqual(judged((5, 2), slow=-1.3), IN_PART)  # |ϖ_M| does not fall there
        self.assertEqual(judged((5, 2), error=1), UNDECIDED)
        # It must hold at every N.
        self.assertEqual(judged((5, 2), (3, 2)), IN_PART)
        self.assertEqual(judged((5, 2), (5, 1)), IN_PART)

    def profile(self, *regions, error=0.001):
        """For N = 24 and 48 a pair of regions, pinned (90° to 180°) and loose, each (⟨ϖ_M⟩, visits,
        speed)."""
        self.table(
            "3a",
            [
                {
                    "setting": "high",
                    "discs": n,
                    "theta": theta,
                    "visits": visits,
                    "varpi_m": v,
                    "varpi_m_error": error,
                    "speed": speed,
                    "speed_error": error,
                    "residence_begin": 182,
                    "residence_end": 88,
                    "residence_begin_error": 1,
                    "residence_end_error": 1,
                    "steady_state": "steady",
                    "point": f"high_N{n}",
                }
                for n, (pinned, loose) in zip((24, 48), regions)
                for thetas, (v, visits, speed) in (
                    ((90, 135, 180), pinned),
                    ((0, 45, 225, 270), loose),
                )
                for theta in thetas
            ],
        )

    def test_pinned_region_contributes_more_than_half(self):
        def judged(pinned, loose, error=0.001):
            self.profile(
                ((-0.95, 4000, 1), (-0.95, 3000, 2)),
                ((pinned, 4000, 1), (loose, 3000, 2)),
                error=error,
            )
            return profiles.pinned_decides(self.study, "high")

        self.assertEqual(judged(-1.1, -1.0)[0], HOLDS)
        verdict, found = judged(-1.0, -1.1)
        self.assertEqual(verdict, FAILS)
        # Each region has half of the visits: −0.025 and −0.075.
        self.assertIn(
            "changes by −0.1: by −0.0250 ± 0.0007 because pinned particles are faster, by −0.0750",
            found,
        )
        self.assertEqual(judged(-1.05, -1.05)[0], UNDECIDED)
        self.assertEqual(judged(-1.1, -1.0, error=0.1)[0], UNDECIDED)

    def test_change_of_the_pinned_share_counts_for_neither_region(self):
        self.profile(((-1.0, 1000, 1), (-0.5, 3000, 2)), ((-1.0, 4000, 1), (-0.5, 750, 2)))
        verdict, found = profiles.pinned_decides(self.study, "high")
        self.assertEqual(verdict, FAILS)
        # The share of the visits rises from 0.2 to 0.8; ϖ_M is lower there by 0.5.
        self.assertIn("changes by −0.3: by 0.0000 ± 0.0007", found)
        self.assertIn("by −0.3 because more are pinned", found)

    def test_loose_discs_become_faster_than_at_depinning(self):
        def judged(pinned, loose, error=0.001):
            self.profile(
                ((-1, 4000, pinned), (-1, 3000, loose)), ((-1, 4000, 1), (-1, 3000, 2)), error=error
            )
            return profiles.loose_accelerate(self.study, "high")[0]

        self.assertEqual(judged(1.0, 1.3), HOLDS)
        self.assertEqual(judged(1.0, 1.1), FAILS)  # only a tenth
        self.assertEqual(judged(1.3, 1.0), FAILS)
        self.assertEqual(judged(1.0, 1.16, error=0.01), UNDECIDED)

    def maps(self, **settings):
        """Density maps at N = 28 and 48 along θ = 135°, and with opposite densities at 315°, where
        no disc is pinned."""
        for name, discs in (("2b", 28), ("2c", 48)):
            self.table(
                name,
                [
                    {
                        "setting": setting,
                        "map": "density",
                        "discs": discs,
                        "x": sign * (radius - gap) * -(0.5**0.5),
                        "y": sign * (radius - gap) * 0.5**0.5,
                        "density": d,
                        "density_error": 0.01,
                    }
                    for setting, (radius, densities) in settings.items()
                    for sign, here in ((1, densities[discs]), (-1, (0.1, 0.9, 0.1)))
                    for gap, d in zip((1.2, 2.0, 2.9), here)
                ]
                + [
                    {
                        "setting": setting,
                        "map": "flow",
                        "discs": discs,
                        "u_x": 0.1 * k,
                        "u_y": 1,
                        "x": k,
                        "y": 0,
                    }
                    for setting in settings
                    for k in range(3)
                ],
            )

    def test_layers_are_denser_than_the_gap_between_them_at_both_n(self):
        self.profile(((-1, 4000, 1), (-1, 3000, 2)), ((-1, 4000, 1), (-1, 3000, 2)))
        rows = read_rows(os.path.join(self.folder, "figure_3a.csv"))
        self.table("3a", rows + [row | {"discs": 28} for row in rows if row["discs"] == "24"])

        def judged(few, many=(0.8, 0.05, 0.5)):
            self.maps(high=(paper_parameters.CONTAINER_RADIUS, {28: few, 48: many}))
            return profiles.layers(self.study, "high")[0]

        layered, one, level = (0.8, 0.05, 0.5), (0.8, 0.4, 0.3), (0.8, 0.4, 0.47)
        self.assertEqual(judged(layered), HOLDS)
        self.assertEqual(judged(one), FAILS)  # a single layer is not enough
        self.assertEqual(judged(layered, one), FAILS)
        self.assertEqual(judged((0.8, 0.4, 0.4)), FAILS)
        self.assertEqual(judged(level), UNDECIDED)

    def test_maps_are_compared_cell_by_cell(self):
        def judged(*spheres):
            discs = {28: (0.8, 0.05, 0.5), 48: (0.8, 0.05, 0.5)}
            self.maps(smooth=(8.5, dict(zip((28, 48), spheres))), high=(8.6, discs))
            return profiles.maps_alike(self.study)

        alike, other = (0.7, 0.1, 0.4), (0.1, 0.9, 0.2)
        self.assertEqual(judged(alike, alike)[0], HOLDS)
        verdict, found = judged(alike, other)
        self.assertEqual(verdict, FAILS)
        self.assertIn("1.00 (flow, N = 48)", found)

    def residences(self, *choices, name="depinning", error=1.0):
        """For each choice of the layer an angle or share at N = 24, 36 and 48."""
        numbers = (24, 36, 48)
        self.table(
            "3a",
            [
                {
                    "setting": "high",
                    "discs": n,
                    "point": f"high_N{n}",
                    "residence_begin": 200 + n,
                    "residence_begin_error": 1,
                    "residence_end": 120 - n,
                    "residence_end_error": 1,
                    "residence_end_resultant": 0.8,
                    "residence_share": n / 100,
                    "residence_share_error": 0.01,
                    "share": 0.5,
                    "share_error": 0.01,
                    "pinning": 250,
                    "pinning_error": 1,
                    "depinning": 50,
                    "depinning_error": 1,
                    "depinning_resultant": 0.3,
                }
                for n in numbers
            ],
        )
        # The last digit of the layer differs between N, as in the tables of the program.
        self.table(
            "3a_sensitivity",
            [
                {
                    "setting": "high",
                    "discs": n,
                    "layer": 1.3 + 0.2 * k + (n == 36) * 2e-16 * (1 + k),
                    "min_length": 0.078,
                    name: a,
                    f"{name}_error": error,
                }
                for k, places in enumerate(choices)
                for n, a in zip(numbers, places)
            ],
        )

    def test_angles_pass_through_zero(self):
        near, far = (8, 355, 1), (8, 355, 300)
        self.residences(near)
        verdict, found = residence.free_fixed(self.study, "high")
        self.assertEqual(verdict, HOLDS)  # they span 13°, not 354°
        self.assertIn("by 13 to 13°", found)
        self.residences(far)
        self.assertEqual(residence.free_fixed(self.study, "high")[0], FAILS)
        self.residences(near, error=9.0)
        undecided = residence.free_fixed(self.study, "high")[0]
        self.assertEqual(undecided, UNDECIDED)
        self.assertEqual(undecided.points, {"high_N24", "high_N36"})

    def test_location_that_depends_on_the_layer_is_undecided(self):
        near, far = (100, 105, 95), (100, 80, 60)
        self.residences(near, far, far)
        verdict, found = residence.free_fixed(self.study, "high")
        self.assertEqual(verdict, UNDECIDED)
        self.assertEqual(verdict.points, frozenset())  # more seeds would not decide
        self.assertIn("by 10 to 40° with the 3 choices", found)
        self.assertIn(
            "certainly at the same location with 1 of them, certainly at different ones with 2",
            found,
        )
        self.residences(far, far, far)
        self.assertEqual(residence.free_fixed(self.study, "high")[0], FAILS)

    def test_earlier_pinning_is_at_a_larger_angle_for_every_layer(self):
        def judged(*choices, error=1.0):
            self.residences(*choices, name="pinning", error=error)
            return residence.pinned_earlier(self.study, "high")[0]

        upstream, downstream, a_little = (200, 250, 300), (300, 250, 200), (200, 202, 205)
        self.assertEqual(judged(upstream, upstream), HOLDS)
        self.assertEqual(judged(downstream, downstream), FAILS)
        self.assertEqual(judged(a_little, a_little), FAILS)  # 5° are not "earlier"
        self.assertEqual(judged(upstream, downstream), UNDECIDED)
        self.assertEqual(judged((300, 340, 20)), HOLDS)  # through zero
        self.assertEqual(judged((200, 205, 212)), UNDECIDED)
        self.assertEqual(judged((200, 205, 212)).points, {"high_N24", "high_N48"})

    def test_pinned_region_grows_for_every_layer(self):
        def judged(*choices, error=0.01, begin=(200, 250, 300)):
            self.residences(*choices, name="share", error=error)
            rows = tables.read(os.path.join(self.folder, "figure_3a_sensitivity.csv"))
            at = dict(zip((24, 36, 48), begin))
            self.table(
                "3a_sensitivity",
                [
                    row
                    | {
                        "pinning": at[row["discs"]],
                        "pinning_error": 1.0,
                        "depinning": 90.0,
                        "depinning_error": 1.0,
                    }
                    for row in rows
                ],
            )
            return residence.pinned_grows(self.study, "high")[0]

        up, down = (0.2, 0.3, 0.4), (0.4, 0.25, 0.1)
        self.assertEqual(judged(up, up), HOLDS)
        self.assertEqual(judged(down, down), FAILS)
        self.assertEqual(judged(up, down), UNDECIDED)
        self.assertEqual(judged(up, error=0.2), UNDECIDED)
        # The size counts, and not the share: as many of twice the particles are a larger region.
        self.assertEqual(judged((0.3, 0.3, 0.3), error=0.001), HOLDS)
        self.assertEqual(
            judged(up, begin=(200, 202, 205)), FAILS
        )  # more particles in the same extent
        self.assertEqual(judged(up, begin=(300, 350, 40)), HOLDS)  # through zero

    def test_middle_of_the_pinned_region_is_top_left(self):
        def judged(*places, error=1.0):
            self.table(
                "3a",
                [
                    {
                        "setting": "high",
                        "discs": n,
                        "residence_begin": b,
                        "residence_begin_error": error,
                        "residence_end": e,
                        "residence_end_error": error,
                        "steady_state": "steady",
                        "point": f"high_N{n}",
                    }
                    for n, (b, e) in zip((28, 48), places)
                ],
            )
            return residence.top_left(self.study, "high")

        self.assertEqual(judged((180, 100), (200, 90))[0], HOLDS)
        verdict, found = judged((180, 100), (298, 84))
        self.assertEqual(verdict, IN_PART)
        self.assertIn("140.0 ± 0.7° for N = 28 and 191.0 ± 0.7° for N = 48", found)
        self.assertEqual(
            judged((300, 100), (10, 90))[0], FAILS
        )  # through zero: the middle is at 230°
        self.assertEqual(judged((180, 100), (270, 88))[0], UNDECIDED)
        with self.assertRaises(ValueError):  # verdict "not made"
            judged((180, 100))


if __name__ == "__main__":
    unittest.main()
