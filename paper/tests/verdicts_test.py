"""The rules by which claims are judged (paper/verdicts.py)."""

import math
import random
import unittest

import claim_tables  # noqa: F401  (finds paper/)
from paper.verdicts import (
    FAILS,
    HOLDS,
    IN_PART,
    UNDECIDED,
    Judgement,
    Value,
    above,
    agreed,
    below,
    combined,
    any_holds,
    every,
    fact,
    falls,
    largest_reversal,
    mean_of,
    measured,
    rises,
    scattered,
    threshold,
    trend,
    within,
)


class Rules(unittest.TestCase):
    """The probability of three standard deviations, by Student's t."""

    def test_threshold_is_student_t(self):
        # Quantiles of Student's t for 99.73 %, from published tables.
        for freedom, t in (
            (1, 235.8),
            (2, 19.21),
            (4, 6.62),
            (7, 4.53),
            (10, 3.96),
            (20, 3.42),
            (50, 3.16),
            (100, 3.08),
        ):
            self.assertAlmostEqual(threshold(freedom) / t, 1, 2)
        self.assertEqual(threshold(math.inf), 3)
        found = [threshold(k / 4) for k in range(4, 80)]
        self.assertEqual(found, sorted(found, reverse=True))
        self.assertEqual(above(Value(1.0, 0.3, freedom=7), 0), UNDECIDED)
        self.assertEqual(above(Value(1.4, 0.3, freedom=7), 0), HOLDS)
        self.assertEqual(above(Value(-1.4, 0.3, freedom=7), 0), FAILS)
        # One seed decides nothing, unless its value is exact.
        self.assertEqual(above(Value(1.0, 1e-9, freedom=0), 0), UNDECIDED)
        self.assertEqual(above(Value(1.0, 0.0, freedom=0), 0), HOLDS)

    def test_degrees_of_freedom_come_from_averaged_runs(self):
        row = {"mean_by_event": 1.0, "mean_by_event_error": 0.2, "point": "a"}
        self.assertEqual(measured(row, "mean_by_event").freedom, math.inf)
        found = measured({**row, "averaged_runs": 3.0}, "mean_by_event")
        self.assertEqual((found.freedom, found.points), (2, {"a"}))
        self.assertEqual(above(found, 0), UNDECIDED)  # 5 errors, but only three seeds
        self.assertEqual(above(measured({**row, "averaged_runs": 8.0}, "mean_by_event"), 0), HOLDS)
        unknown = measured({**row, "averaged_runs": math.nan}, "mean_by_event")
        self.assertEqual(above(unknown, 0), UNDECIDED)

    def test_combined_error_has_welch_degrees_of_freedom(self):
        a, b = Value(1, 0.3, freedom=7), Value(1, 0.3, freedom=7)
        self.assertAlmostEqual((a - b).freedom, 14)
        self.assertAlmostEqual((a - Value(0, 1e-6, freedom=2)).freedom, 7, 3)
        self.assertEqual((a - 5).freedom, 7)
        self.assertEqual((a * 2).freedom, 7)
        self.assertEqual(abs(-a).freedom, 7)
        self.assertAlmostEqual(mean_of([a, b, a]).freedom, 21)
        self.assertAlmostEqual(mean_of([a, b], [1, 0]).freedom, 7)
        self.assertEqual((a - Value(1, 0.3, freedom=0)).freedom, 0)
        self.assertEqual((Value(1) - Value(2)).freedom, math.inf)
        self.assertEqual(scattered([1.0, 2.0, 3.0]).freedom, 2)
        self.assertEqual(scattered([1.0, 1.1, 1.2], least=5).freedom, math.inf)
        self.assertEqual(trend([1.0, 2.1, 2.9, 4.0, 5.1]).freedom, 3)

    def test_above_below_and_within(self):
        self.assertEqual(above(Value(1.0, 0.3), 0), HOLDS)
        self.assertEqual(above(Value(-1.0, 0.3), 0), FAILS)
        self.assertEqual(above(Value(1.0, 0.34), 0), UNDECIDED)
        self.assertEqual(above(Value(-1.0, 0.34), 0), UNDECIDED)
        self.assertEqual(below(Value(1.0, 0.3), 2), HOLDS)
        self.assertEqual(below(Value(1.0, 0.3), 0), FAILS)
        self.assertEqual(within(Value(1.0, 0.01), 0.9, 1.1), HOLDS)
        self.assertEqual(within(Value(1.0, 0.05), 0.9, 1.1), UNDECIDED)
        self.assertEqual(within(Value(1.3, 0.05), 0.9, 1.1), FAILS)
        # The errors of both values count.
        self.assertEqual(above(Value(5.0, 1.0), Value(0.0, 1.0)), HOLDS)
        self.assertEqual(above(Value(4.0, 1.0), Value(0.0, 1.0)), UNDECIDED)

    def test_exact_value_is_never_undecided(self):
        self.assertEqual(below(Value(1.0), 1), FAILS)
        self.assertEqual(below(Value(0.999), 1), HOLDS)

    def test_unknown_value_is_undecided(self):
        nan = float("nan")
        self.assertEqual(above(Value(1.0, nan), 0), UNDECIDED)
        self.assertEqual(above(Value(nan, 0.1), 0), UNDECIDED)
        self.assertEqual(every([]), UNDECIDED)

    def test_single_statement_never_holds_in_part(self):
        yes, no, undecided = Judgement(HOLDS), Judgement(FAILS), Judgement(UNDECIDED)
        self.assertEqual(every([yes, yes]), HOLDS)
        self.assertEqual(every([yes, no, undecided]), FAILS)
        self.assertEqual(every([yes, undecided]), UNDECIDED)
        self.assertEqual(any_holds([no, yes, undecided]), HOLDS)
        self.assertEqual(any_holds([no, undecided]), UNDECIDED)
        self.assertEqual(any_holds([no, no]), FAILS)

    def test_disagreeing_choices_are_undecided(self):
        yes, no = Judgement(HOLDS), Judgement(FAILS)
        undecided = Judgement(UNDECIDED, ["a"])
        self.assertEqual(agreed([yes, yes]), HOLDS)
        self.assertEqual(agreed([no, no]), FAILS)
        self.assertEqual(agreed([yes, no]), UNDECIDED)
        self.assertEqual(agreed([]), UNDECIDED)
        # More seeds help against errors, not against disagreeing choices.
        self.assertEqual(agreed([yes, undecided]).points, {"a"})
        self.assertEqual(agreed([no, undecided]).points, {"a"})
        self.assertEqual(agreed([yes, no, undecided]), UNDECIDED)
        self.assertEqual(agreed([yes, no, undecided]).points, frozenset())

    def test_several_statements_may_hold_in_part(self):
        yes, no, undecided = Judgement(HOLDS), Judgement(FAILS), Judgement(UNDECIDED)
        self.assertEqual(combined(yes, yes), HOLDS)
        self.assertEqual(combined(no, no), FAILS)
        self.assertEqual(combined(yes, no), IN_PART)
        self.assertEqual(combined(yes, no, undecided), IN_PART)  # independent of the third
        self.assertEqual(combined(yes, undecided), UNDECIDED)
        self.assertEqual(combined(no, undecided), UNDECIDED)

    def test_every_rule_preserves_holds_in_part(self):
        yes, no, half, undecided = (
            Judgement(HOLDS),
            Judgement(FAILS),
            Judgement(IN_PART),
            Judgement(UNDECIDED, ["a"]),
        )
        self.assertEqual(every([half, yes]), IN_PART)
        self.assertEqual(every([half, no]), FAILS)
        self.assertEqual(every([half, undecided]), UNDECIDED)
        self.assertEqual(any_holds([half, no]), IN_PART)
        self.assertEqual(any_holds([half, yes]), HOLDS)
        self.assertEqual(combined(half), IN_PART)
        self.assertEqual(combined(half, yes), IN_PART)
        self.assertEqual(combined(half, no), IN_PART)
        self.assertEqual(combined(half, undecided), IN_PART)  # independent of the other
        # Choices that disagree.
        self.assertEqual(agreed([half, half]), IN_PART)
        self.assertEqual(agreed([half, yes]), UNDECIDED)
        self.assertEqual(agreed([half, no]), UNDECIDED)
        self.assertEqual(agreed([half, yes, undecided]).points, frozenset())

    def test_points_are_those_of_undecided_statements(self):
        certain, doubtful = Value(9, 1, ["a"]), Value(1, 1, ["b"])
        self.assertEqual(every([above(certain, 0), above(doubtful, 0)]).points, {"b"})
        self.assertEqual(above(certain - Value(8, 1, ["c"]), 0).points, {"a", "c"})
        self.assertEqual(above(certain, 0).points, frozenset())
        self.assertEqual(
            combined(above(doubtful, 0), Judgement(FAILS), fact(True)).points, frozenset()
        )
        self.assertEqual(mean_of([certain, doubtful]).points, {"a", "b"})

    def test_mean_of_independent_values(self):
        mean = mean_of([Value(1, 0.3), Value(3, 0.4)])
        self.assertEqual(mean.mean, 2)
        self.assertAlmostEqual(mean.error, 0.25)

    def test_error_from_scatter(self):
        found = scattered([1.0, 2.0, 3.0], ["a"])
        self.assertEqual(found.mean, 2)
        # The margin has Student's t for two degrees of freedom.
        self.assertAlmostEqual(found.error, 1 / 3**0.5)
        self.assertAlmostEqual(found.margin, 19.207 / 3**0.5)
        self.assertEqual(found.points, {"a"})
        self.assertAlmostEqual(scattered([1.0, 1.0, 1.0, 1.0], least=0.5).error, 0.25)
        self.assertEqual(above(scattered([1.0]), 0), UNDECIDED)
        self.assertEqual(above(scattered([]), 0), UNDECIDED)
        many = scattered([0.0, 1.0] * 500)
        self.assertAlmostEqual(many.error, 0.5 / 1000**0.5, 3)

    def test_trend_has_the_error_of_its_residuals(self):
        self.assertAlmostEqual(trend([1.0, 2.0, 3.0]).mean, 1.0)
        self.assertAlmostEqual(trend([1.0, 2.0, 3.0]).error, 0.0)
        self.assertEqual(above(trend([1.0, 2.1, 2.9, 4.0, 5.1]), 0.5), HOLDS)
        self.assertEqual(above(trend([3.0, 3.1, 2.9, 3.0, 3.05]), 0.5), FAILS)
        self.assertEqual(above(trend([3.0, 1.0, 4.0, 2.0, 4.5]), 0.5), UNDECIDED)
        self.assertEqual(above(trend([1.0, 2.0]), 0), UNDECIDED)
        self.assertEqual(above(trend([1.0, 2.0, float("inf")]), 0), UNDECIDED)

    def curve(self, *means, error=0.001):
        return [Value(m, error, [f"p{k}"]) for k, m in enumerate(means)]

    def test_rise_must_exceed_the_least_size(self):
        self.assertEqual(rises(self.curve(0.5, 0.6, 0.8)), HOLDS)
        self.assertEqual(rises(self.curve(0.5, 0.6, 0.8), least=0.2), HOLDS)
        self.assertEqual(rises(self.curve(0.5, 0.6, 0.8), least=0.4), FAILS)
        self.assertEqual(rises(self.curve(0.5, 0.6, 0.8), least=0.299), UNDECIDED)
        self.assertEqual(rises(self.curve(0.8, 0.6, 0.5)), FAILS)
        self.assertEqual(falls(self.curve(0.8, 0.6, 0.5), least=0.2), HOLDS)
        self.assertEqual(falls(self.curve(0.8, 0.6, 0.5), least=0.4), FAILS)
        self.assertEqual(rises(self.curve(0.5, 0.8)), UNDECIDED)

    def test_reversal_is_found_on_any_grid(self):
        # Up by 0.5, down by 0.3, up by 0.5: in 3 steps and in 300.
        ends = (0.0, 0.5, 0.2, 0.7)
        self.assertEqual(rises(self.curve(*ends)), FAILS)
        fine = [a + (b - a) * k / 100 for a, b in zip(ends, ends[1:]) for k in range(100)] + [0.7]
        self.assertLess(max(a - b for a, b in zip(fine, fine[1:])), 0.01)  # between neighbours
        self.assertEqual(rises(self.curve(*fine)), FAILS)
        self.assertEqual(largest_reversal(self.curve(*fine)), (100, 200))
        # A reversal of a tenth of the rise is allowed; the errors must exclude a larger one.
        self.assertEqual(rises(self.curve(0.0, 0.5, 0.46, 0.7)), HOLDS)
        self.assertEqual(rises(self.curve(0.0, 0.5, 0.46, 0.7, error=0.01)), UNDECIDED)
        self.assertEqual(rises(self.curve(0.0, 0.5, 0.4, 0.7, error=0.02)), UNDECIDED)
        self.assertEqual(rises(self.curve(0.0, 0.5, 0.4, 0.7, error=0.02)).points, {"p1", "p2"})
        self.assertEqual(rises(self.curve(0.0, 0.5, 0.3, 0.7, error=0.02)), FAILS)

    def test_largest_reversal_skips_missing_points(self):
        nan = float("nan")
        self.assertEqual(largest_reversal(self.curve(0.5, 0.9, nan, 0.6, 0.8)), (1, 3))
        self.assertIsNone(largest_reversal(self.curve(0.5, 0.6, 0.8)))
        self.assertIsNone(largest_reversal([]))
        self.assertEqual(rises(self.curve(0.5, nan, 0.6, 0.8)), HOLDS)


# Student's t for 95 % divided by 1.96, by degrees of freedom (src/swirl/statistics/replicates.hpp).
STUDENT_95 = {2: 2.195, 3: 1.624, 5: 1.312, 7: 1.206, 11: 1.123, 15: 1.087, 23: 1.055, 31: 1.041}


def replicates(means):
    """The mean of runs of equal length, each with an error of 1 from its blocks, as in
    src/swirl/statistics/replicates.hpp."""
    n, mean = len(means), sum(means) / len(means)
    squares = sum((m - mean) ** 2 for m in means)
    ninth = 2 / (9 * (n - 1))
    disagree = squares > (n - 1) * (1 - ninth + 3 * math.sqrt(ninth)) ** 3
    error = math.sqrt(max(1 / n, squares / (n * (n - 1))))
    return Value(mean, error * (STUDENT_95[n - 1] if disagree else 1), freedom=n - 1)


def share_decided(between, counts, repetitions, source):
    """How often a value exactly on its bound is decided, although no verdict is correct there. The
    runs differ by `between` times the errors of their blocks. Seeds are added until the value is
    decided (add_seeds_to_undecided in paper/command.py)."""
    decided = 0
    for _ in range(repetitions):
        means = [source.gauss(0, math.hypot(1, between)) for _ in range(counts[-1])]
        decided += any(above(replicates(means[:seeds]), 0) != UNDECIDED for seeds in counts)
    return decided / repetitions


class FalseDecisions(unittest.TestCase):
    """How often chance decides."""

    def test_runs_are_combined_as_by_the_program(self):
        # The numbers of tests/statistics/replicates_test.cpp, in units of the errors of the blocks.
        found = replicates([100, 300, 100, 300])
        self.assertAlmostEqual(found.error / 100, math.sqrt(4 / 12) * 3.182446 / 1.959964, 3)
        self.assertAlmostEqual(replicates([5.0, 5.5, 4.5, 5.0]).error, 0.5)

    def test_chance_decides_at_most_one_per_cent_although_seeds_are_added(self):
        source = random.Random(7)
        # Three standard deviations are 0.27 %. 100,000 repetitions gave 0.55 % at worst, that is 22
        # ± 5 of 4000; three standard deviations above it are 1 %. A fixed threshold of three errors
        # would decide 2.4 % with 8 seeds and 9 % with 3.
        for counts in ((4, 8, 16, 32), (3, 6, 12)):
            for between in (0, 2, 20):
                self.assertLessEqual(
                    share_decided(between, counts, 4000, source), 0.01, (counts, between)
                )


if __name__ == "__main__":
    unittest.main()
