"""Claims on spheres that roll, judged by tables written by hand."""

import unittest

from claim_tables import HandMadeTables

from paper.claims import CLAIMS, spheres
from paper.verdicts import FAILS, HOLDS, IN_PART, UNDECIDED


class Direction(HandMadeTables):
    def changes(self, *found, curve="experiment"):
        """(μ, N_c, error), or (μ, None) without a change of direction."""
        self.table(
            "spheres_friction",
            [
                {
                    "curve": curve,
                    "mu": mu,
                    "crosses": int(at[0] is not None),
                    "crossing": at[0] or "",
                    "crossing_error": at[1] if at[0] else "",
                    "lower": 0,
                    "upper": 0,
                }
                for mu, *at in found
            ],
        )

    def test_some_friction_coefficient_must_change_near_36(self):
        def judged(*found):
            self.changes(*found)
            return spheres.change_near_36(self.study)

        self.assertEqual(judged((0.1, None), (0.3, 36.9, 0.1), (0.4, 34, 0.1))[0], HOLDS)
        self.assertEqual(judged((0.3, 44, 0.1), (0.4, 40, 0.1))[0], FAILS)
        # A coefficient between two runs counts, but not across a jump.
        self.assertEqual(judged((0.15, 38.2, 0.05), (0.2, 34.3, 0.05))[0], HOLDS)
        verdict, found = judged((0.15, 40, 0.1), (0.2, 32, 0.1))
        self.assertEqual(verdict, FAILS)
        self.assertIn("between μ = 0.15 and 0.2 it jumps", found)
        self.assertEqual(judged((0.15, 40, 0.2), (0.2, 33.5, 1.0))[0], UNDECIDED)

    def test_fitted_coefficient_and_half_the_amplitude_are_reported(self):
        def row(curve, mu, at):
            return {"curve": curve, "mu": mu, "crosses": 1, "crossing": at, "crossing_error": 0.1}

        self.table("spheres_friction", [row("experiment", 0.3, 36.9), row("A5.75", 0.3, 40)])
        self.table(
            "spheres_friction_calibration",
            [{"curve": "experiment", "discs": 36, "mu": 0.335, "mu_error": 0.004}],
        )
        found = spheres.change_near_36(self.study)[1]
        self.assertIn("μ = 0.335 ± 0.004", found)
        self.assertIn("At A = 5.75 mm: μ = 0.3: 40.00 ± 0.10", found)

    def test_smooth_and_roughened_spheres_need_ordered_coefficients(self):
        def judged(*found):
            self.changes(*found)
            return spheres.roughened(self.study)[0]

        self.assertEqual(judged((0.3, 36.5, 0.2), (0.5, 32, 0.2), (0.7, 27.9, 0.2)), HOLDS)
        # There is a coefficient for the smooth spheres, but N jumps over 28.
        self.assertEqual(judged((0.17, 36, 0.2), (0.23, 31, 0.2), (0.25, 19, 0.2)), FAILS)
        # Sandpaper cannot lower the coefficient.
        self.assertEqual(judged((0.17, 28, 0.2), (0.24, 36, 0.2)), FAILS)
        self.assertEqual(judged((0.17, 36, 0.2), (0.24, 30, 0.5)), UNDECIDED)

    def test_rougher_spheres_change_earlier_by_one_disc_and_never_later(self):
        def judged(*found, error=0.2):
            self.changes(*((mu, at, error) for mu, at in zip((0.1, 0.2, 0.3, 0.5), found)))
            return spheres.friction_order(self.study)[0]

        self.assertEqual(judged(44, 36, 30, 28), HOLDS)
        # A step within the errors, between close coefficients, does not matter.
        self.assertEqual(judged(44, 36, 35.9, 28), HOLDS)
        self.assertEqual(judged(36, 35.9, 35.8, 35.5, error=0.05), FAILS)  # half a disc in total
        self.assertEqual(judged(28, 30, 36, 44), FAILS)
        # Later by 6 of 16 in total, also if not between neighbours.
        self.assertEqual(judged(44, 30, 36, 28), FAILS)
        self.assertEqual(judged(44, 30, 32, 28), UNDECIDED)

    def test_line_of_spheres_rolls_with_the_swirl_at_the_wall(self):
        def judged(*found, error=0.001):
            self.table(
                "spheres_few",
                [
                    {
                        "discs": n,
                        "point": f"few_N{n}",
                        "mean_by_time": v,
                        "mean_by_time_error": error,
                        "residence_share": share,
                        "residence_share_error": error,
                    }
                    for n, v, share in found
                ],
            )
            return spheres.snake(self.study)[0]

        self.assertEqual(judged((3, 1.0, 0.99), (8, 0.3, 0.2)), HOLDS)
        self.assertEqual(judged((3, 1.0, 0.5), (8, 0.3, 0.99)), FAILS)
        self.assertEqual(judged((12, 1.0, 0.99), (8, 0.3, 0.2)), FAILS)  # 12 are not few
        self.assertEqual(judged((3, 0.96, 0.99), error=0.01), UNDECIDED)


DOWN, UP = [(36, -0.01), (44, -0.04), (48, -0.05)], [(36, 0.2), (44, 0.15), (48, 0.04)]


class Causes(HandMadeTables):
    def ingredients(self, **curves):
        self.table(
            "spheres_ingredients",
            [
                {
                    "curve": curve.replace("_", "-"),
                    "discs": n,
                    "mean_by_time": v,
                    "mean_by_time_error": 0.001,
                    "point": f"{curve}_N{n}",
                }
                for curve, values in curves.items()
                for n, v in values
            ],
        )

    def cause(self, body, *rotations, error=0.001):
        """Rows of figure "cause": without friction between particles, free and stopped, and stopped
        at a smooth wall."""
        cases = (
            ("free", "none between particles"),
            ("stopped", "none between particles"),
            ("stopped", "none at the wall" if body == "discs" else "none at all"),
        )
        return [
            {
                "body": body,
                "spins": spins,
                "contacts": contacts,
                "discs": n,
                "mean_by_time": v if n == 48 else 0.5,
                "mean_by_time_error": error,
                "point": f"{body}_{spins}_N{n}",
            }
            for (spins, contacts), v in zip(cases, rotations)
            for n in (24, 48)
        ]

    def test_title_needs_order_outside_triangles_disorder_inside_and_stopped_spins_that_reverse(
        self,
    ):
        def judged(
            chain=-0.4,
            triangle=0.0,
            discs=(1, -0.006, 0.06),
            spheres_=(1, -0.04, 0.5),
            others=(-0.4, 0.0),
        ):
            self.table("cause", self.cause("discs", *discs) + self.cause("spheres", *spheres_))
            columns = (
                "chain_correlation",
                "triangle_correlation",
                "spin_correlation",
                "correlation_by_impulse",
                "triangles",
            )
            self.table(
                "4b",
                [
                    {
                        "setting": setting,
                        "discs": n,
                        "point": f"{setting}_N{n}",
                        **{f"{c}_error": 0.001 for c in columns},
                        **dict(zip(columns, (*pairs, 0, 0, 0.5))),
                    }
                    for n in (24, 48)
                    for setting, pairs in (
                        ("smooth", (chain, triangle)),
                        ("rough", others),
                        ("high", others),
                    )
                ],
            )
            return spheres.frustration(self.study)

        verdict, found = judged()
        self.assertEqual(verdict, HOLDS)
        self.assertIn(
            "Discs with μ = 1: pairs in no triangle have opposed spins (correlation −0.4000", found
        )
        self.assertIn("the same, if they cannot spin: −0.0060 ± 0.0010 at N = 48", found)
        self.assertEqual(judged(chain=0.0)[0], IN_PART)  # nothing to frustrate
        self.assertEqual(judged(triangle=-0.3)[0], IN_PART)  # triangles do not frustrate
        self.assertEqual(judged(discs=(1, 0.006, 0.06))[0], IN_PART)  # stopped spins do not reverse
        self.assertEqual(
            judged(spheres_=(-0.1, -0.04, 0.5))[0], IN_PART
        )  # spheres that spin freely reverse, too
        self.assertEqual(
            judged(discs=(1, -0.006, -0.02))[0], IN_PART
        )  # without a wall that grips they reverse, too
        self.assertEqual(
            judged(0.0, -0.3, (1, 0.006, 0.06), (1, 0.04, 0.5), (0.0, -0.3))[0], FAILS
        )  # no part is true

    def test_damping_is_not_needed_if_both_counterrotate_without_it(self):
        def judged(*rotations, discs=(38, 0.2)):
            self.ingredients(no_damping=list(zip((44, 48), rotations)))
            self.crossings("5b", high=discs)
            return spheres.no_damping(self.study)[0]

        self.assertEqual(judged(-0.03, -0.05), HOLDS)
        self.assertEqual(judged(0.03, -0.05), IN_PART)
        self.assertEqual(judged(0.03, -0.05, discs=(None, "always rotates")), FAILS)
        self.assertEqual(judged(-0.006, -0.05), UNDECIDED)
        self.assertEqual(judged(-0.006, -0.05).points, {"no_damping_N44"})
        self.assertEqual(judged(-0.0015, -0.05), IN_PART)  # one turn in 700 periods

    def test_ingredient_is_not_critical_if_spheres_counterrotate_without_it(self):
        def judged(floor, vertical, damping, full=DOWN):
            self.ingredients(all=full, no_floor=floor, no_vertical=vertical, no_damping=damping)
            return spheres.substrate(self.study)[0]

        self.assertEqual(judged(DOWN, DOWN, DOWN), HOLDS)
        self.assertEqual(judged(UP, UP, DOWN), IN_PART)  # only damping is not critical
        self.assertEqual(judged(UP, UP, UP), FAILS)
        self.assertEqual(judged([(44, -0.04), (48, -0.006)], DOWN, DOWN), UNDECIDED)
        self.assertEqual(judged(DOWN, DOWN, DOWN, full=UP), FAILS)  # there is no transition


class Settings(HandMadeTables):
    def test_claim_on_spheres_reports_discs_and_half_the_amplitude(self):
        """Only smooth spheres decide."""
        self.table(
            "1b",
            [
                {
                    "setting": setting,
                    "discs": n,
                    "mean_by_time": v,
                    "mean_by_time_error": 0.001,
                    "pancake": -0.1,
                    "pancake_error": 0,
                    "point": f"{setting}_N{n}",
                }
                for setting, last in (("smooth", -0.09), ("half", 0.2), ("high", -0.09))
                for n, v in ((24, 0.2), (48, last))
            ],
        )
        claim = next(c for c in CLAIMS if "pancake" in c.statement)
        judgement, found = claim.judge(self.study)
        self.assertEqual(judgement, HOLDS)
        first, others = found.split(" For comparison: ")
        self.assertTrue(
            first.startswith("Smooth spheres: distance from the line of the pancake 0.3000"), first
        )
        self.assertIn("smooth spheres at A = 5.75 mm, distance from", others)
        self.assertIn(
            "0.3000 ± 0.0010 Ω at N = 48: does not hold; discs with μ = 1, distance", others
        )
        self.assertEqual(judgement.points, frozenset())


if __name__ == "__main__":
    unittest.main()
