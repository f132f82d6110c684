"""The verdicts of the report, on tables made up so that the answer is known."""

import csv
import os
import sys
import tempfile
import unittest

SOURCE = os.environ.get("SWIRL_SOURCE") or os.path.join(os.path.dirname(__file__), "..", "..")
sys.path.insert(0, os.path.join(SOURCE, "figures"))
sys.dont_write_bytecode = True

import claims  # noqa: E402
import report  # noqa: E402


class OnMadeUpTables(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = claims.Folder(self.scratch.name)

    def table(self, name, rows):
        with open(os.path.join(self.scratch.name, f"figure_{name}.csv"), "w", newline="") as file:
            writer = csv.DictWriter(file, fieldnames=list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)

    def crossings(self, name, **curves):
        self.table(f"{name}_crossings", [
            {"curve": curve, "verdict": "crosses" if at else "always rotates",
             "crossing": at or "", "crossing_error": error if at else "", "lowest": 0.1,
             "lowest_error": 0.01, "lowest_discs": 48}
            for curve, (at, error) in curves.items()])

    def rotation(self, name, setting, values, error=0.01):
        self.table(name, [{"setting": setting, "discs": n, "by_event": v, "by_event_error": error}
                          for n, v in values])

    def test_crossings_in_order_hold(self):
        self.crossings("5b", high=(36, 0.3), medium=(40, 0.3), low=(46, 0.3))
        self.assertEqual(claims.friction_order(self.folder)[0], claims.HOLDS)

    def test_crossings_in_the_wrong_order_do_not(self):
        self.crossings("5b", high=(46, 0.3), medium=(40, 0.3), low=(36, 0.3))
        self.assertEqual(claims.friction_order(self.folder)[0], claims.FAILS)

    def test_crossings_too_uncertain_to_be_ordered_do_not_hold(self):
        self.crossings("5b", high=(36, 3), medium=(38, 3), low=(40, 3))
        self.assertNotEqual(claims.friction_order(self.folder)[0], claims.HOLDS)

    def test_a_curve_that_crosses_is_no_curve_that_never_does(self):
        self.crossings("5b", **{"no-wall": (30, 0.2)})
        self.assertEqual(claims.never_crosses("no-wall")(self.folder)[0], claims.FAILS)
        self.crossings("5b", **{"no-wall": (None, None)})
        self.assertEqual(claims.never_crosses("no-wall")(self.folder)[0], claims.HOLDS)

    def test_a_curve_named_by_a_number_is_found(self):
        self.crossings("restitution", **{"1": (36, 0.3), "0.99": (36, 0.3), "0.9": (32, 0.3)})
        self.assertEqual(claims.elastic(self.folder)[0], claims.HOLDS)

    def test_a_minimum_needs_a_rise_after_it(self):
        self.rotation("5b", "high", [(5, 0.9), (40, -0.2), (44, -0.3), (48, -0.2)])
        self.assertEqual(claims.minimum(self.folder)[0], claims.HOLDS)
        self.rotation("5b", "high", [(5, 0.9), (40, -0.2), (44, -0.3), (48, -0.4)])
        self.assertEqual(claims.minimum(self.folder)[0], claims.FAILS)
        # A rise within the errors is no rise.
        self.rotation("5b", "high", [(5, 0.9), (40, -0.2), (44, -0.3), (48, -0.299)])
        self.assertEqual(claims.minimum(self.folder)[0], claims.FAILS)

    def test_without_wall_friction_every_n_counts(self):
        at_omega = [(n, 1.0) for n in range(5, 49)]
        self.rotation("5b", "no-wall", at_omega)
        self.assertEqual(claims.no_wall_at_omega("5b")(self.folder)[0], claims.HOLDS)
        self.rotation("5b", "no-wall", at_omega[:-3] + [(n, 0.8) for n in (46, 47, 48)])
        self.assertEqual(claims.no_wall_at_omega("5b")(self.folder)[0], claims.IN_PART)

    def test_a_drop_is_more_than_its_error(self):
        self.rotation("5b", "no-disc", [(30, 1.0), (40, 1.0), (48, 0.9)])
        self.assertEqual(claims.no_disc_drop("5b")(self.folder)[0], claims.HOLDS)
        self.rotation("5b", "no-disc", [(30, 1.0), (40, 1.0), (48, 0.99)])
        self.assertEqual(claims.no_disc_drop("5b")(self.folder)[0], claims.IN_PART)
        self.rotation("5b", "no-disc", [(30, 1.0), (40, 1.0), (48, 0.999)], error=0.001)
        self.assertEqual(claims.no_disc_drop("5b")(self.folder)[0], claims.FAILS)

    def test_angles_pass_through_zero(self):
        self.table("3a", [{"discs": n, "becoming_free": a, "becoming_free_error": 1.0,
                           "becoming_free_by_collisions": 50, "becoming_free_by_collisions_error": 1}
                          for n, a in ((24, 8), (36, 355), (48, 1))])
        verdict, found = claims.free_fixed(self.folder)
        self.assertEqual(verdict, claims.HOLDS)  # they span 13°, not 354°
        self.assertIn("13°", found)

    def test_rises_ignores_noise_but_not_a_fall(self):
        def rows(values):
            return [{"discs": k, "s": v, "s_error": 0.01} for k, v in enumerate(values)]
        self.assertEqual(claims.rises(rows([0.5, 0.6, 0.59, 0.8]), "s"), claims.HOLDS)
        self.assertEqual(claims.rises(rows([0.5, 0.9, 0.6, 0.8]), "s"), claims.IN_PART)
        self.assertEqual(claims.rises(rows([0.8, 0.6, 0.5]), "s"), claims.FAILS)
        self.assertEqual(claims.rises(rows([0.8, 0.6, 0.5]), "s", sign=-1), claims.HOLDS)

    def test_a_table_that_is_not_there_is_said(self):
        for claim in claims.CLAIMS:
            verdict, found = claim.verdict(self.scratch.name)
            if claim.figure:
                self.assertEqual(verdict, claims.MISSING, claim.says)
                self.assertIn("is not there", found)
            else:
                self.assertEqual(verdict, claims.UNTESTABLE)

    def test_numbers_have_the_digits_of_their_errors(self):
        self.assertEqual(claims.number(-0.03621, 0.0009), "−0.0362 ± 0.0009")
        self.assertEqual(claims.number(36.42, 0.12), "36.42 ± 0.12")
        self.assertEqual(claims.number(36.42, 0.3), "36.4 ± 0.3")

    def test_a_run_that_failed_is_not_looked_at(self):
        self.table("5b", [
            {"setting": "high", "discs": n, "by_event": v, "by_event_error": 0.01,
             "steady_state": "steady" if v else "failed"}
            for n, v in ((5, 0.9), (40, -0.2), (44, -0.3), (46, ""), (48, -0.2))])
        self.assertEqual(claims.minimum(self.folder)[0], claims.HOLDS)

    def test_a_table_without_runs_is_no_verdict(self):
        self.table("5b", [{"setting": "high", "discs": 5, "by_event": "", "by_event_error": "",
                           "steady_state": "failed"}])
        for claim in claims.CLAIMS:
            if claim.judge is claims.minimum:
                self.assertEqual(claim.verdict(self.scratch.name)[0], claims.MISSING)

    def test_what_disagrees_comes_first(self):
        judged = [(claims.Claim("x", f"{v} {k}", "5b", None), v, "found")
                  for v, n in ((claims.HOLDS, 3), (claims.IN_PART, 1), (claims.FAILS, 2))
                  for k in range(n)]
        self.assertEqual(report.counts(judged),
                         "Of 6 claims 3 hold, 1 holds in part, 2 do not hold.")
        self.assertEqual([heading for heading, _ in report.in_short(judged)],
                         ["Does not hold", "Holds in part"])

    def test_letters_below_the_line(self):
        self.assertEqual(report.rich("N_c < 5, ϖ_M, R_ball, steady_state"),
                         "N<sub>c</sub> &lt; 5, ϖ<sub>M</sub>, R<sub>ball</sub>, steady_state")
        self.assertEqual(report.sentence("ϖ by time"), "ϖ by time")

    def test_the_report_is_one_page_with_everything_in_it(self):
        about = {"command": "swirl paper", "version": "1", "build": "b", "quick": True, "seed": 1,
                 "events_of_a_run": 1000, "runs": 2, "runs_of_earlier_calls": 0, "seconds": 100.0,
                 "seconds_on_one_core": 200.0,
                 "defaults": {"inertia": 10, "container_radius": 8.6, "amplitude": 1.892,
                              "sides": 30, "period": 11.866071, "restitution": 1},
                 "figures": [{"name": "5b", "description": "ϖ < 0 & more", "findings": ["found"],
                              "files": ["figure_5b.png"]}]}
        with open(os.path.join(self.scratch.name, "figure_5b.png"), "wb") as file:
            file.write(b"\x89PNG")
        page = report.page(self.scratch.name, about, report.judge(self.scratch.name))
        self.assertIn("data:image/png;base64,iVBORw", page)
        self.assertIn("ϖ &lt; 0 &amp; more", page)
        self.assertNotIn('src="figure', page)
        for claim in claims.CLAIMS:
            self.assertIn(report.rich(claim.says), page)
        text = report.markdown(about, report.judge(self.scratch.name))
        self.assertEqual(text.count("\n| "), len(claims.CLAIMS) + len(report.CONTRADICTIONS) +
                         len(report.parameter_rows(about)) + 3)


if __name__ == "__main__":
    unittest.main()
