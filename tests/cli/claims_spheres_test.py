"""Claims on spheres that roll, judged by tables written by hand."""

import unittest

from claim_tables import HandMadeTables

from claims import CLAIMS, spheres
from verdicts import FAILS, HOLDS, IN_PART, UNDECIDED


class Direction(HandMadeTables):
    def changes(self, *found, curve="experiment"):
        """(μ, N_c, error), or (μ, None) without a change of direction."""
        self.table("spheres_friction", [
            {"curve": curve, "mu": mu, "crosses": int(at[0] is not None), "crossing": at[0] or "",
             "crossing_error": at[1] if at[0] else "", "lower": 0, "upper": 0} for mu, *at in found])

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
        self.table("spheres_friction_calibration", [{"curve": "experiment", "discs": 36, "mu": 0.335, "mu_error": 0.004}])
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
            self.table("spheres_few", [
                {"discs": n, "point": f"few_N{n}", "mean_by_time": v, "mean_by_time_error": error, "residence_share": share,
                 "residence_share_error": error} for n, v, share in found])
            return spheres.snake(self.study)[0]
        self.assertEqual(judged((3, 1.0, 0.99), (8, 0.3, 0.2)), HOLDS)
        self.assertEqual(judged((3, 1.0, 0.5), (8, 0.3, 0.99)), FAILS)
        self.assertEqual(judged((12, 1.0, 0.99), (8, 0.3, 0.2)), FAILS)  # 12 are not few
        self.assertEqual(judged((3, 0.96, 0.99), error=0.01), UNDECIDED)


DOWN, UP = [(36, -0.01), (44, -0.04), (48, -0.05)], [(36, 0.2), (44, 0.15), (48, 0.04)]
LESS = [(36, -0.01), (44, -0.03), (48, -0.04)]


class Causes(HandMadeTables):
    def ingredients(self, ending="", **curves):
        name = "spheres_ingredients" + ending.replace("-", "_")
        self.table(name, [{"curve": curve.replace("_", "-") + ending, "discs": n, "mean_by_time": v, "mean_by_time_error": 0.001,
                           "point": f"{curve}_N{n}"} for curve, values in curves.items() for n, v in values])

    def vertical(self, full, without, ending=""):
        self.ingredients(ending, all=full, no_vertical=without, no_vertical_disc=UP, no_vertical_wall=DOWN)

    def test_spheres_without_vertical_friction_counterrotate_less_at_every_n(self):
        def judged(full, without):
            self.vertical(full, without)
            return spheres.vertical_friction(self.study, "smooth")
        verdict, found = judged(DOWN, UP)
        self.assertEqual(verdict, HOLDS)
        self.assertIn("certainly disappears without vertical friction at 3 of 3 N", found)
        self.assertIn("at the wall only −0.0400", found)
        # The paper does not claim that they rotate without it. Half of the counterrotation must disappear.
        self.assertEqual(judged(DOWN, [(36, 0.0), (44, -0.01), (48, -0.02)])[0], HOLDS)
        self.assertEqual(judged(DOWN, [(36, 0.0), (44, -0.01), (48, -0.0255)])[0], UNDECIDED)
        self.assertEqual(judged(DOWN, LESS)[0], IN_PART)
        self.assertEqual(judged(DOWN, DOWN)[0], IN_PART)  # they counterrotate without it, too
        # At every N that counterrotates, not only the largest ones.
        self.assertEqual(judged(DOWN, [(36, -0.01), (44, 0.1), (48, 0.1)])[0], IN_PART)
        # An N at which spheres rotate has no counterrotation that could disappear.
        self.assertEqual(judged([(36, 0.1), *DOWN[1:]], [(36, -0.2), *UP[1:]])[0], HOLDS)
        # Fewer than one turn in 200 periods is not a counterrotation.
        self.assertEqual(judged([(44, -0.0015), (48, -0.001)], UP)[0], FAILS)

    def test_discs_need_friction_between_them_to_counterrotate(self):
        def judged(without, error=0.001):
            self.table("5b", [{"setting": setting, "discs": n, "mean_by_event": v, "mean_by_event_error": error,
                               "point": f"{setting}_N{n}"}
                              for setting, curve in (("high", DOWN), ("no-disc", without)) for n, v in curve])
            return spheres.disc_friction(self.study, "high")[0]
        self.assertEqual(judged(UP), HOLDS)
        self.assertEqual(judged(DOWN), FAILS)
        self.assertEqual(judged([(36, 0.0), (44, 0.0), (48, -0.0255)]), UNDECIDED)

    def test_title_needs_order_outside_triangles_disorder_inside_and_a_cause(self):
        self.table("5b", [{"setting": setting, "discs": n, "mean_by_event": v, "mean_by_event_error": 0.001,
                           "point": f"{setting}_N{n}"}
                          for setting, curve in (("high", DOWN), ("no-disc", UP)) for n, v in curve])

        def judged(chain=-0.4, triangle=0.0, discs=(-0.4, 0.0), without=UP, without_rough=UP):
            self.vertical(DOWN, without)
            self.vertical(DOWN, without_rough, "-rough")
            columns = ("chain_correlation", "triangle_correlation", "spin_correlation", "correlation_by_impulse",
                       "triangles")
            self.table("4b", [
                {"setting": setting, "discs": n, "point": f"{setting}_N{n}", **{f"{c}_error": 0.001 for c in columns},
                 **dict(zip(columns, (*pairs, 0, 0, 0.5)))} for n in (24, 48)
                for setting, pairs in (("smooth", (chain, triangle)), ("rough", (-0.4, 0.0)), ("high", discs))])
            return spheres.frustration(self.study)
        verdict, found = judged()
        self.assertEqual(verdict, HOLDS)
        self.assertIn("Discs with μ = 1: pairs in no triangle have opposed spins (correlation −0.4000", found)
        self.assertEqual(judged(chain=0.0)[0], IN_PART)  # nothing to frustrate
        self.assertEqual(judged(triangle=-0.3)[0], IN_PART)  # triangles do not frustrate
        self.assertEqual(judged(discs=(0.3, 0.3))[0], IN_PART)  # only spheres turn like gears
        self.assertEqual(judged(without=DOWN)[0], IN_PART)  # frustrated, but not the cause
        self.assertEqual(judged(without_rough=DOWN)[0], IN_PART)

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
        self.table("1b", [{"setting": setting, "discs": n, "mean_by_time": v, "mean_by_time_error": 0.001, "pancake": -0.1,
                           "pancake_error": 0, "point": f"{setting}_N{n}"}
                          for setting, last in (("smooth", -0.09), ("half", 0.2), ("high", -0.09))
                          for n, v in ((24, 0.2), (48, last))])
        claim = next(c for c in CLAIMS if "pancake" in c.statement)
        judgement, found = claim.judge(self.study)
        self.assertEqual(judgement, HOLDS)
        first, others = found.split(" For comparison: ")
        self.assertTrue(first.startswith("Smooth spheres: distance from the line of the pancake 0.3000"), first)
        self.assertIn("smooth spheres at A = 5.75 mm, distance from", others)
        self.assertIn("0.3000 ± 0.0010 Ω at N = 48: does not hold; discs with μ = 1, distance", others)
        self.assertEqual(judgement.points, frozenset())


if __name__ == "__main__":
    unittest.main()
