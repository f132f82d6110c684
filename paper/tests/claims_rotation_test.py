"""Claims on ϖ(N), judged by tables written by hand."""

import unittest

from claim_tables import HandMadeTables

from paper import claims
from paper.claims import rotation
from paper.verdicts import FAILS, HOLDS, IN_PART, UNDECIDED


class Rotation(HandMadeTables):
    def test_ordered_crossings_hold(self):
        self.crossings("5b", high=(36, 0.3), medium=(40, 0.3), low=(46, 0.3))
        self.assertEqual(rotation.friction_order(self.study)[0], HOLDS)

    def test_reversed_crossings_fail(self):
        self.crossings("5b", high=(46, 0.3), medium=(40, 0.3), low=(36, 0.3))
        self.assertEqual(rotation.friction_order(self.study)[0], FAILS)

    def test_uncertain_crossings_are_undecided(self):
        self.crossings("5b", high=(36, 3), medium=(38, 3), low=(40, 3))
        self.assertEqual(rotation.friction_order(self.study)[0], UNDECIDED)

    def test_bracket_counts_as_uniform_distribution(self):
        self.table(
            "5b_crossings",
            [
                {
                    "curve": curve,
                    "verdict": "crosses",
                    "crossing": "",
                    "crossing_error": "",
                    "lower": lower,
                    "upper": lower + 2,
                    "lowest": 0.1,
                    "lowest_error": 0.01,
                    "lowest_discs": 48,
                }
                for curve, lower in (("high", 36), ("medium", 40), ("low", 46))
            ],
        )
        verdict, found = rotation.friction_order(self.study)
        self.assertEqual(verdict, HOLDS)
        self.assertIn("N_c between 36 and 38", found)
        self.assertNotIn("not known", found)

    def test_claims_on_whole_runs_need_runs_as_long_as_the_papers(self):
        def judged(statement, setting, events, level=0.97):
            self.table(
                "5b-start",
                [
                    {
                        "setting": setting,
                        "discs": n,
                        "mean_by_event": level if n < 48 else level - 0.07,
                        "mean_by_event_error": 0.001,
                        "point": f"no-disc_N{n}",
                        "events": events,
                    }
                    for n in (8, 16, 24, 28, 32, 36, 40, 44, 48)
                ],
            )
            return claims.claim_stating(statement).judged(self.study)

        for statement, setting, verdict in (
            ("Without disc friction ϖ drops slightly at very high N.", "no-disc", HOLDS),
            ("Without disc friction ϖ remains close to Ω.", "no-disc", HOLDS),
            (
                "Without wall friction the cluster rotates with the frequency of the swirl at "
                "every N.",
                "no-wall",
                FAILS,
            ),
        ):
            self.assertEqual(judged(statement, setting, 1_000_000)[0], verdict, statement)
            self.assertEqual(judged(statement, setting, 200_000)[0], UNDECIDED, statement)
            self.assertIn("runs of 200,000 events", judged(statement, setting, 200_000)[1])

    def test_runs_with_the_memory_of_their_initial_state_decide_nothing(self):
        def judged(periods):
            self.table(
                "5b-steady",
                [
                    {
                        "setting": "no-wall",
                        "discs": n,
                        "mean_by_event": 0.9,
                        "mean_by_event_error": 0.001,
                        "periods": periods,
                        "warmup_periods": 20,
                    }
                    for n in (8, 16, 24, 28, 32, 36, 40, 44, 48, 52, 55)
                ],
            )
            return claims.claim_stating(
                "Without wall friction there is never a transition."
            ).judged(self.study)

        self.assertEqual(judged(70)[0], HOLDS)
        self.assertEqual(judged(69)[0], UNDECIDED)
        self.assertIn("average over 49 periods", judged(69)[1])

    def test_curve_without_crossing_counts_as_later(self):
        self.crossings("5b", high=(36, 0.3), medium=(40, 0.3), low=(None, "always rotates"))
        self.assertEqual(rotation.friction_order(self.study)[0], HOLDS)
        self.crossings("5b", high=(36, 0.3), medium=(40, 0.3), low=(None, "undecided"))
        self.assertEqual(rotation.friction_order(self.study)[0], UNDECIDED)
        self.crossings("5b", high=(None, "always rotates"), medium=(40, 0.3), low=(46, 0.3))
        self.assertNotEqual(rotation.friction_order(self.study)[0], HOLDS)

    def test_transition_has_three_parts(self):
        def judged(first, last, verdict, error=0.01):
            self.rotation("5b", "high", [(5, first), (30, 0.1), (48, last)], error)
            self.crossings("5b", high=verdict)
            return rotation.simulated_transition(self.study)[0]

        self.assertEqual(judged(0.9, -0.3, (36, 0.3)), HOLDS)
        self.assertEqual(judged(0.9, 0.3, (None, "always rotates")), IN_PART)
        self.assertEqual(judged(-0.9, 0.3, (None, "always rotates")), FAILS)
        self.assertEqual(judged(0.9, -0.0, (36, 0.3), error=0.001), IN_PART)  # not a rotation
        undecided = judged(0.9, -0.02, (None, "undecided"))
        self.assertEqual(undecided, UNDECIDED)
        self.assertEqual(undecided.points, {"high_N48"})

    def test_never_crosses_counts_every_n(self):
        never = rotation.never_crosses("no-wall")
        self.rotation("5b", "no-wall", [(20, 0.9), (40, 0.1)])
        self.assertEqual(never(self.study)[0], HOLDS)
        self.rotation("5b", "no-wall", [(20, 0.9), (40, -0.1)])
        self.assertEqual(never(self.study)[0], FAILS)
        self.rotation("5b", "no-wall", [(20, 0.9), (40, 0.02)])
        self.assertEqual(never(self.study)[0], UNDECIDED)
        self.assertEqual(never(self.study)[0].points, {"no-wall_N40"})
        # N beyond the paper's last one count; fewer than one turn in 200 periods is not a rotation.
        self.rotation("5b", "no-wall", [(20, 0.9), (48, 0.1), (54, -0.0083)], error=0.0003)
        verdict, found = never(self.study)
        self.assertEqual(verdict, FAILS)
        self.assertIn("lowest is −0.0083 ± 0.0003 at N = 54", found)
        self.rotation("5b", "no-wall", [(20, 0.9), (48, 0.1), (54, -0.003)], error=0.0003)
        self.assertEqual(never(self.study)[0], HOLDS)

    def test_curve_with_a_numeric_name_is_found(self):
        self.crossings("5b", high=(36, 0.3))
        self.crossings("restitution", **{"1": (36, 0.3), "0.99": (36, 0.3), "0.9": (32, 0.3)})
        self.assertIn("e = 0.9: N_c = 32.0 ± 0.3", rotation.elastic(self.study)[1])

    def test_minimum_needs_a_rise_after_it(self):
        curve = [(5, 0.9), (40, -0.2), (44, -0.3)]
        self.rotation("5b", "high", curve + [(54, -0.2)])  # beyond the paper's last N
        self.assertEqual(rotation.minimum(self.study, "high")[0], HOLDS)
        self.rotation("5b", "high", curve + [(48, -0.4)])
        self.assertEqual(rotation.minimum(self.study, "high")[0], FAILS)
        # A rise within the errors is undecided.
        self.rotation("5b", "high", curve + [(48, -0.29)])
        self.assertEqual(rotation.minimum(self.study, "high")[0], UNDECIDED)
        self.assertEqual(rotation.minimum(self.study, "high")[0].points, {"high_N44", "high_N48"})

    def test_minimum_reports_the_rigid_body_too(self):
        def found(rigid):
            self.table(
                "5b",
                [
                    {
                        "setting": "high",
                        "discs": n,
                        "point": f"high_N{n}",
                        "mean_by_event": v,
                        "mean_by_event_error": 0.001,
                        "rigid_by_event": r,
                        "rigid_by_event_error": 0.001,
                    }
                    for n, v, r in ((48, -0.036, -0.035), (51, -0.042, -0.043), (54, -0.032, rigid))
                ],
            )
            return rotation.minimum(self.study, "high")

        verdict, text = found(-0.049)
        self.assertEqual(verdict, HOLDS)  # the paper's mean is judged
        self.assertIn(
            "Σ r², falls to the end, from −0.0430 ± 0.0010 at N = 51 to −0.0490 ± "
            "0.0010 at N = 54",
            text,
        )
        self.assertIn("also rises", found(-0.030)[1])
        self.assertIn("neither certainly rises nor certainly falls", found(-0.042)[1])

    def test_no_wall_friction_every_n_counts(self):
        at_omega = [(n, 1.0) for n in range(5, 49)]
        self.rotation("5b-start", "no-wall", at_omega)
        self.assertEqual(rotation.no_wall_at_omega(self.study)[0], HOLDS)
        self.rotation("5b-start", "no-wall", at_omega[:-1] + [(48, 0.8)])
        self.assertEqual(rotation.no_wall_at_omega(self.study)[0], FAILS)
        self.rotation("5b-start", "no-wall", at_omega[:-1] + [(48, 0.96)])
        self.assertEqual(rotation.no_wall_at_omega(self.study)[0], UNDECIDED)

    def test_no_disc_friction_is_close_to_omega_below_high_n(self):
        def judged(last, error=0.01, beyond=0.5):
            # From HIGH_N on the paper has a drop, which is another claim.
            self.rotation(
                "5b-start", "no-disc", [(20, 1.0), (30, 1.0), (40, last), (46, beyond)], error
            )
            return rotation.no_disc_close(self.study)[0]

        self.assertEqual(judged(0.95), HOLDS)
        self.assertEqual(judged(0.8), FAILS)
        self.assertEqual(judged(1.2), FAILS)
        self.assertEqual(judged(0.91), UNDECIDED)
        self.assertEqual(judged(0.91).points, {"no-disc_N40"})

    def test_pancake_line_is_approached_and_reached(self):
        def judged(first, last, error=0.003):
            self.table(
                "1b",
                [
                    {
                        "setting": "high",
                        "discs": n,
                        "mean_by_time": v,
                        "mean_by_time_error": error,
                        "pancake": -0.1,
                        "pancake_error": 0,
                        "point": f"high_N{n}",
                    }
                    for n, v in ((24, first), (48, last))
                ],
            )
            return rotation.pancake(self.study, "high")[0]

        self.assertEqual(judged(0.1, -0.08), HOLDS)
        self.assertEqual(judged(0.1, 0.0), IN_PART)  # nearer, but not near
        self.assertEqual(judged(-0.1, -0.13), IN_PART)  # near, but not nearer
        self.assertEqual(judged(0.0, 0.1), FAILS)
        self.assertEqual(judged(0.1, -0.08, error=0.02), UNDECIDED)
        # A distance below the line counts as much as one above it.
        self.assertEqual(judged(0.1, -0.25), IN_PART)

    def test_elastic_discs_cross(self):
        def judged(elastic):
            self.crossings("5b", high=elastic)
            return rotation.elastic(self.study)[0]

        self.assertEqual(judged((36, 0.3)), HOLDS)
        self.assertEqual(judged((None, "always rotates")), FAILS)
        self.assertEqual(judged((None, "undecided")), UNDECIDED)

    def test_drop_exceeds_its_error(self):
        def judged(last, error):
            self.rotation("5b-start", "no-disc", [(30, 1.0), (40, 1.0), (48, last)], error)
            return rotation.no_disc_drop(self.study)[0]

        self.assertEqual(judged(0.9, 0.01), HOLDS)
        self.assertEqual(judged(0.99, 0.01), UNDECIDED)
        self.assertEqual(judged(0.999, 0.001), FAILS)

    def test_drop_of_the_transient_is_reported(self):
        self.rotation("5b-start", "no-disc", [(30, 1.0), (40, 1.0), (48, 0.9)])
        self.rotation("5b-steady", "no-disc", [(40, 1.0), (48, 0.998)])
        self.assertIn(
            "after a long warm-up ϖ/Ω = 0.998 ± 0.010", rotation.no_disc_drop(self.study)[1]
        )

    def test_steady_runs_are_counted(self):
        def judged(*points):
            self.table(
                "5b",
                [
                    {
                        "setting": "high",
                        "discs": 20 + k,
                        "point": f"high_N{20 + k}",
                        "seeds": steady + drifting + short,
                        "steady_runs": steady,
                        "drifting_runs": drifting,
                    }
                    for k, (steady, drifting, short) in enumerate(points)
                ],
            )
            return rotation.steady(self.study, "high")[0]

        self.assertEqual(judged((200, 1, 0)), HOLDS)
        self.assertEqual(judged((100, 100, 0)), FAILS)
        self.assertEqual(judged(*[(8, 0, 0)] * 28), HOLDS)
        # Seeds go to points where runs drift or are too short for the test.
        doubtful = judged((8, 0, 0), (7, 1, 0), (6, 0, 2))
        self.assertEqual(doubtful, UNDECIDED)
        self.assertEqual(doubtful.points, {"high_N21", "high_N22"})
        self.assertEqual(judged((0, 0, 8)).points, {"high_N20"})
        # No run drifts, but there are too few of them.
        self.assertEqual(judged((8, 0, 0), (8, 0, 0)).points, {"high_N20", "high_N21"})

    def test_jumping_point_is_not_steady(self):
        def judged(jumping, switching=0):
            self.table(
                "5b",
                [
                    {
                        "setting": "low",
                        "discs": 5 + k,
                        "point": f"low_N{5 + k}",
                        "seeds": 8,
                        "steady_runs": 8 - j - s,
                        "drifting_runs": 0,
                        "jumping_runs": j,
                        "switching_runs": s,
                    }
                    for k, (j, s) in enumerate([(jumping, switching)] + [(0, 0)] * 130)
                ],
            )
            return rotation.steady(self.study, "high")

        self.assertEqual(judged(0)[0], HOLDS)
        self.assertEqual(judged(1)[0], HOLDS)
        # 8 of 1048 runs are few, but they are all runs of this point.
        verdict, found = judged(8)
        self.assertEqual(verdict, IN_PART)
        self.assertIn("0 drift, 8 jump, 0 switch", found)
        self.assertIn("most runs are not steady at low_N5", found)
        self.assertEqual(judged(0, 8)[0], IN_PART)

    def test_every_point_has_the_same_weight(self):
        def judged(seeds):
            self.table(
                "5b",
                [
                    {
                        "setting": "high",
                        "discs": 20 + k,
                        "point": f"high_N{20 + k}",
                        "seeds": n,
                        "steady_runs": n - drifting,
                        "drifting_runs": drifting,
                    }
                    for k, (n, drifting) in enumerate([(8, 0)] * 27 + [(seeds, seeds // 4)])
                ],
            )
            return rotation.steady(self.study, "high")

        for seeds in (8, 32, 320):  # 1 to 15 % of all runs drift, but always 1 % by points
            verdict, found = judged(seeds)
            self.assertEqual(verdict, HOLDS, seeds)
            self.assertIn("a share of 0.009", found)

    def test_rotation_becomes_counterrotation_once_and_stalls_in_between(self):
        def judged(*curve, error=0.001):
            # N outside the range of the experiment do not count.
            self.rotation(
                "5b",
                "high",
                [(20, -0.2), *((24 + 4 * k, v) for k, v in enumerate(curve)), (52, 0.1)],
                error,
            )
            return rotation.passage(self.study, "high")

        verdict, found = judged(0.2, 0.1, 0.0, -0.1, -0.05)
        self.assertEqual(verdict, HOLDS)  # the stalling point may be on either side
        self.assertIn(
            "at 2 N, the last of them 28, certainly counterrotating at 2, the first of them 36; "
            "stalling at 0.0000 ± 0.0010 at N = 32",
            found,
        )
        self.assertEqual(judged(0.2, 0.1, -0.1, -0.1)[0], IN_PART)  # it does not stall
        self.assertEqual(judged(0.2, 0.1, -0.1, 0.1, -0.1)[0], FAILS)  # and back
        self.assertEqual(judged(0.2, -0.1, 0.004, -0.1, error=0.0001)[0], HOLDS)  # less than a turn
        # Zero within its error, which is as large as a rotation: that is no stalling.
        doubtful = judged(0.2, 0.1, 0.004, -0.1, error=0.006)[0]
        self.assertEqual(doubtful, UNDECIDED)
        self.assertEqual(judged(-0.2, -0.1, 0.1, 0.2)[0], FAILS)

    def test_couple_of_particles_changes_the_direction(self):
        def judged(*curve, error=0.001):
            self.rotation("spheres", "smooth", curve, error)
            return rotation.couple(self.study, "smooth")

        verdict, found = judged((30, 0.1), (34, 0.02), (36, -0.02), (40, -0.1))
        self.assertEqual(verdict, HOLDS)
        self.assertIn("certainly rotating at N = 34, certainly counterrotating at N = 36", found)
        self.assertEqual(judged((30, 0.1), (34, 0.02), (40, -0.1))[0], FAILS)
        doubtful = judged((30, 0.1), (34, 0.02), (36, -0.004), (40, -0.1))[0]
        self.assertEqual(doubtful, UNDECIDED)
        self.assertEqual(doubtful.points, {"smooth_N36"})
        self.assertEqual(judged((30, 0.1), (34, 0.02))[0], UNDECIDED)

    def test_few_spheres_rotate_and_many_counterrotate(self):
        def judged(first, last, crossing):
            self.rotation("spheres", "smooth", [(8, first), (36, 0.0), (48, last), (55, 0.5)])
            self.crossings("spheres", smooth=crossing)
            return rotation.transition(self.study, "smooth")[0]

        self.assertEqual(judged(0.5, -0.1, (36, 0.3)), HOLDS)
        self.assertEqual(judged(0.5, 0.1, (None, "always rotates")), IN_PART)
        self.assertEqual(judged(-0.5, 0.1, (None, "always rotates")), FAILS)

    def test_failed_runs_are_ignored(self):
        self.table(
            "5b",
            [
                {
                    "setting": "high",
                    "discs": n,
                    "mean_by_event": v,
                    "mean_by_event_error": 0.01,
                    "steady_state": "steady" if v else "failed",
                }
                for n, v in ((5, 0.9), (40, -0.2), (44, -0.3), (46, ""), (48, -0.2))
            ],
        )
        self.assertEqual(rotation.minimum(self.study, "high")[0], HOLDS)


if __name__ == "__main__":
    unittest.main()
