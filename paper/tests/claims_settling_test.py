"""Claims on spheres that settle at the wall. What is measured is first tried on particles for which
each claim must fail."""

import math
import random
import unittest

from claim_tables import HandMadeTables

import numpy as np
from paper.claims import settling
from paper.figures import figure_settling
from paper.verdicts import FAILS, HOLDS, IN_PART, UNDECIDED


class Judges(HandMadeTables):
    def judged(self, judge, error=0.005, **columns):
        default = {
            "rigid_resident": (0.07, 0.07),
            "rigid_loose": (0.3, 0.3),
            "encounters": (6, 7),
            "two_encounters": (0.9, 1),
            "rolling_single_file": (0.4, 0.4),
            "rolling_side_by_side": (0.6, 0.6),
        } | columns
        self.table(
            "settling",
            [
                {
                    "setting": "smooth",
                    "discs": n,
                    "point": f"smooth_N{n}",
                    "averaged_runs": 8,
                    **{name: found[k] for name, found in default.items()},
                    **{f"{name}_error": error for name in default},
                }
                for k, n in enumerate((24, 48))
            ],
        )
        return judge(self.study, "smooth")[0]

    def test_each_claim_holds_fails_and_stays_open(self):
        for judge, name, (good, bad, doubtful) in (
            (settling.settles, "encounters", (3, 1, 2.01)),
            (settling.single_file, "rolling_single_file", (0.2, 0.7, 0.49)),
            (settling.side_by_side, "rolling_side_by_side", (0.6, 0.3, 0.41)),
        ):
            with self.subTest(name):
                self.assertEqual(self.judged(judge, **{name: (good, good)}), HOLDS)
                self.assertEqual(self.judged(judge, **{name: (good, bad)}), FAILS)
                self.assertEqual(self.judged(judge, **{name: (good, doubtful)}), UNDECIDED)

    def test_each_n_is_a_part_of_the_claim_on_rigidity(self):
        for values, verdict in (
            ((0.05, 0.05), HOLDS),
            ((0.2, 0.2), FAILS),
            ((0.2, 0.05), IN_PART),
            ((0.05, 0.09), UNDECIDED),
        ):
            self.assertEqual(self.judged(settling.rigid, rigid_resident=values), verdict, values)

    def test_resident_spheres_that_are_no_more_rigid_than_loose_ones_are_not_a_structure(self):
        self.assertEqual(self.judged(settling.rigid, rigid_loose=(0.02, 0.02)), FAILS)


class Measured(unittest.TestCase):
    """Particles for which the answer is known."""

    def test_a_rigid_body_has_no_other_motion_and_a_gas_has_nothing_else(self):
        noise = np.random.default_rng(1)
        x = noise.uniform(-5, 5, size=(12, 2))
        rigid = np.array([0.3, -0.2]) + 0.7 * np.column_stack([-x[:, 1], x[:, 0]])
        self.assertLess(figure_settling.nonrigid(x, rigid), 1e-28)
        # The mean over many gases of unit variance per component is 1: 2n − 3 degrees of freedom
        # remain.
        squares = [figure_settling.nonrigid(x, noise.normal(size=(12, 2))) for _ in range(2000)]
        self.assertAlmostEqual(np.mean(squares), 1, delta=4 * math.sqrt(2 / 21 / 2000))
        self.assertIsNone(figure_settling.nonrigid(x[:3], rigid[:3]))

    def test_bounces_on_one_partner_are_one_encounter(self):
        bounces = [(k * 0.001, 7) for k in range(100)]
        self.assertEqual(figure_settling.encounters_before(bounces, 0, 1), 1)
        self.assertEqual(
            figure_settling.encounters_before([(0.1, 1), (0.11, 2), (0.12, -1), (0.5, 1)], 0, 1), 4
        )
        self.assertEqual(
            figure_settling.encounters_before([(0.1, 1), (0.3, 2)], 0.2, 0.25), 0
        )  # before and after
        self.assertEqual(figure_settling.encounters_before([], 0, 1), 0)

    def test_arrivals_are_the_beginnings_of_residences(self):
        resident = np.array([[math.nan, 1], [0, 1], [1, 0], [1, 1], [0, 1]])
        self.assertEqual(sorted(figure_settling.arrivals(resident)), [(2, 0), (3, 1)])

    def test_pairs_are_sorted_by_their_direction_and_only_contacts_count(self):
        def shares(gap, angle, rolls):
            at = np.array([[0.0, 0], [(2 + gap) * math.cos(angle), (2 + gap) * math.sin(angle)]])
            return figure_settling.rolling_in_contact(
                at, np.array([[1.0, 0], [1.0, 0]]), rolls, 0.1
            )

        self.assertEqual(
            shares(0.001, 0.2, [True, False]), {"single_file": (1, 2), "side_by_side": (0, 0)}
        )
        self.assertEqual(
            shares(0.001, 1.4, [True, True]), {"single_file": (0, 0), "side_by_side": (2, 2)}
        )
        self.assertEqual(
            shares(0.001, math.pi - 0.2, [False, False])["single_file"], (0, 2)
        )  # behind is as in front
        for nothing in (shares(0.1, 0.2, [True, True]), shares(0.001, math.pi / 4, [True, True])):
            self.assertEqual(nothing, {"single_file": (0, 0), "side_by_side": (0, 0)})

    def test_pairs_at_random_prefer_neither_direction(self):
        """Rolling that does not depend on the direction gives equal shares, so the claim on side by
        side fails there."""
        random.seed(3)
        sums = {name: np.zeros(2) for name in figure_settling.FILES}
        for _ in range(3000):
            angle = random.uniform(0, 2 * math.pi)
            at = np.array([[0.0, 0], [2.001 * math.cos(angle), 2.001 * math.sin(angle)]])
            rolls = [random.random() < 0.6, random.random() < 0.6]
            found = figure_settling.rolling_in_contact(
                at, np.array([[1.0, 0], [1.0, 0]]), rolls, 0.1
            )
            sums = {name: sums[name] + found[name] for name in sums}
        shares = [rolling / all_ for rolling, all_ in sums.values()]
        self.assertAlmostEqual(shares[0], shares[1], delta=4 * math.sqrt(0.25 / 1000))


if __name__ == "__main__":
    unittest.main()
