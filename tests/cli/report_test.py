"""The page of the report: what its first page says of tables made up so that the answer is known, and how
its figures are captioned and arranged."""

import csv
import os
import struct
import sys
import tempfile
import unittest

from program import SOURCE

sys.path.insert(0, os.path.join(SOURCE, "figures"))
import report  # noqa: E402


class Tables(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def write(self, name, rows):
        with open(os.path.join(self.folder, f"figure_{name}.csv"), "w", newline="",
                  encoding="utf-8") as file:
            out = csv.DictWriter(file, list(dict.fromkeys(c for row in rows for c in row)))
            out.writeheader()
            out.writerows(rows)


class FirstPage(Tables):
    def rotation(self, error=0.01, **curves):
        """Figure 5b: (N, ϖ/Ω) of each setting."""
        self.write("5b", [{"setting": setting.replace("_", "-"), "discs": n, "by_event": level,
                           "by_event_error": error, "steady_state": "steady",
                           "point": f"{setting}_N{n}"}
                          for setting, points in curves.items() for n, level in points])

    def crossings(self, **found):
        """(verdict, N_c, error) of each curve."""
        self.write("5b_crossings", [
            {"curve": curve, "verdict": verdict, "crossing": at, "crossing_error": error,
             "lowest": 0.07, "lowest_error": 0.001, "lowest_discs": 47}
            for curve, (verdict, at, error) in found.items()])

    def found(self):
        return " ".join(report.what_was_found(self.folder))

    def test_without_tables_nothing_is_said(self):
        self.assertEqual(report.what_was_found(self.folder), [])

    def test_a_crossing_that_is_told_more_than_once_is_compared(self):
        self.crossings(high=("crosses", 38.0, 0.3), medium=("crosses", 43.7, 0.1))
        self.assertEqual(report.crossings_of_one_setting(self.folder), "")
        self.write("friction", [{"mu": mu, "crosses": crosses, "crossing": at, "crossing_error": 0.4}
                                for mu, crosses, at in ((0.1, 0, ""), (0.5, 0, ""), (1, 1, 39.5))])
        # 1.5 apart, √(.3² + .4²) = .5; with μ = .5 the search found none.
        self.assertEqual(report.crossings_of_one_setting(self.folder),
                         "N_c for both frictions 1 is estimated more than once: 38.0 ± 0.3 (figure 5b, by "
                         "event); 39.5 ± 0.4 (figure friction, by time, searched for). The first is the "
                         "one to quote; the others differ from it by at most 3.0 standard errors.")

    def test_that_few_rotate_and_many_counterrotate(self):
        self.rotation(high=[(5, 0.2), (48, -0.1)])
        self.crossings(high=("crosses", 38.5, 0.2))
        said = self.found()
        self.assertIn("few discs rotate with the swirl and many against it (ϖ/Ω = 0.200 ± 0.010 at "
                      "N = 5, ϖ/Ω = −0.100 ± 0.010 at N = 48)", said)
        self.assertIn("the sense changes at N_c = 38.5 ± 0.2.", said)

    def test_that_they_do_not(self):
        self.rotation(high=[(5, 0.2), (48, 0.1)])
        self.crossings(high=("always rotates", "", ""))
        said = self.found()
        self.assertIn("is confirmed only in part", said)
        self.assertIn("the sense changes not at all (ϖ/Ω is lowest at N = 47, 0.0700 ± 0.0010)", said)
        self.rotation(high=[(5, -0.2), (48, 0.1)])
        self.assertIn("is not confirmed", self.found())

    def test_that_nobody_knows(self):
        self.rotation(high=[(5, 0.2), (48, -0.1)], error=0.09)
        self.crossings(high=("undecided", 38.5, 9.0))
        said = self.found()
        self.assertIn("Whether with friction", said)
        self.assertIn("is undecided", said)
        self.assertNotIn("N_c", said)

    def test_the_order_of_the_frictions(self):
        for medium, words in (((("crosses", 44.0, 0.2)), "The less friction, the later: with μ = 0.5 at "
                               "N_c = 44.0 ± 0.2, with μ = 0.1 not at all"),
                              ((("crosses", 30.0, 0.2)), "Less friction does not always move"),
                              ((("crosses", 39.0, 2.0)), "more discs is undecided")):
            self.crossings(high=("crosses", 38.5, 0.2), medium=medium,
                           low=("always rotates", "", ""))
            self.rotation(high=[(5, 0.2), (48, -0.1)])
            self.assertIn(words, self.found())

    def test_both_frictions_are_needed(self):
        self.rotation(no_wall=[(5, 1.0), (48, 0.9)], no_disc=[(5, 1.0), (48, 0.4)])
        self.assertEqual(self.found(), "The cluster counterrotates only with both: without friction at the "
                         "wall it rotates with the swirl at every N (lowest: ϖ/Ω = 0.900 ± 0.010 at N = "
                         "48), and without friction between the discs it rotates with the swirl at every "
                         "N (lowest: ϖ/Ω = 0.400 ± 0.010 at N = 48).")
        self.rotation(no_wall=[(5, 1.0), (48, 0.02)], no_disc=[(5, 1.0), (48, -0.4)])
        said = self.found()
        self.assertIn("Whether counterrotation needs friction at the wall is undecided", said)
        self.assertIn("Counterrotation does not need friction between the discs: without it there is "
                      "ϖ/Ω = −0.400 ± 0.010 at N = 48", said)

    def test_the_pinned(self):
        def tables(last_speed, slips, error=0.001):
            self.write("3b", [{"discs": n, "theta": 180, "visits": 500, "normalised": speed,
                               "normalised_error": error, "residence_begin": 200, "residence_end": 100}
                              for n, speed in ((24, 0.8), (48, last_speed))])
            self.write("4a", [{"setting": "high", "discs": n, "slip_resident": s,
                               "slip_resident_error": error, "pinned_region": s,
                               "pinned_region_error": error} for n, s in zip((24, 36, 48), slips)])
        tables(0.99, (0.8, 0.9, 0.96))
        self.assertIn("come to move with it, and hardly slip on it any more (angular velocity over the "
                      "wall's, 0.8000 ± 0.0010 at N = 24, 0.9900 ± 0.0010 at N = 48; slip parameter, "
                      "0.8000 ± 0.0010 at N = 24", self.found())
        tables(0.7, (0.9, 0.85, 0.8))
        self.assertIn("come to move with it is confirmed in part, that they hardly slip on it any more is "
                      "not confirmed", self.found())
        tables(0.99, (0.8, 0.9, 0.96), error=0.1)
        self.assertIn("that they hardly slip on it any more is undecided", self.found())

    def test_the_spheres(self):
        def tables(few, many, without, error=0.001):
            self.write("spheres", [{"curve": "0.2", "mu": 0.2, "discs": n, "by_time": level,
                                    "by_time_error": error}
                                   for n, level in ((16, few), (44, many), (48, many))])
            self.write("spheres_ingredients", [
                {"curve": curve, "discs": n, "by_time": level, "by_time_error": error}
                for curve, level in (("0.2", many), ("no-vertical", without),
                                     ("no-vertical-disc", without), ("no-vertical-wall", many))
                for n in (44, 48)])
        tables(0.1, -0.05, 0.04)
        self.assertEqual(self.found(), "Spheres that roll on a floor counterrotate, too, when they are many; "
                         "friction of the contacts along the vertical, which opposes their rolling, "
                         "drives them that way (ϖ/Ω at N = 48, μ = 0.2: −0.0500 ± 0.0010 with it, 0.0400 ± 0.0010 "
                         "without).")
        # Where: of each friction the last change to counterrotation.
        self.write("spheres_sense", [
            {"mu": mu, "crossing": at, "crossing_error": 0.3, "before": at - 1, "after": at + 1, "sense": sense}
            for mu, at, sense in ((0.5, 14, "counterrotation"), (0.2, 20, "counterrotation"),
                                  (0.2, 28, "rotation"), (0.2, 32.4, "counterrotation"))])
        self.write("spheres", [{"curve": "0.2", "mu": 0.2, "discs": n, "by_time": level, "by_time_error": 0.001,
                                "point": f"spheres_0.2_N{n}"} for n, level in ((16, 0.1), (44, -0.05), (48, -0.05))])
        self.assertIn("without). Their sense changes for the last time at these N: 32.4 ± 0.3 (μ = 0.2), "
                      "14.0 ± 0.3 (μ = 0.5).", self.found())
        os.remove(os.path.join(self.folder, "figure_spheres_sense.csv"))
        tables(0.1, -0.05, -0.025)
        self.assertIn("whether friction of the contacts along the vertical", self.found())
        # Where frustration is blamed, the other thing that decides is told.
        tables(0.1, -0.05, 0.04)
        self.write("inertia_crossings", [
            {"curve": inertia, "verdict": verdict, "crossing": at, "crossing_error": 0.2 if at else "",
             "lowest": 0.02, "lowest_error": 0.001, "lowest_discs": 48}
            for inertia, verdict, at in ((0.5, "always rotates", ""), (10, "crosses", 38.3))])
        self.assertIn("where they change their direction depends on their inertia: I = 0.5: no crossing (always "
                      "rotates; lowest ϖ/Ω = 0.0200 ± 0.0010 at N = 48); I = 10: N_c = 38.3 ± 0.2.", self.found())
        tables(0.1, -0.05, -0.09)
        self.assertIn("does not drive them that way", self.found())
        tables(0.1, -0.05, 0.04, error=0.02)
        self.assertIn("Whether many spheres that roll on a floor counterrotate is undecided", self.found())
        tables(0.1, 0.05, 0.06)
        self.assertIn("is not confirmed", self.found())


    def test_the_condensation(self):
        self.write("condensation", [
            {"discs": n, "seeds": 8, "condensed": condensed, "waiting": waiting, "waiting_error": 2,
             "after_by_time": 1.0, "after_by_time_error": 0.001}
            for n, condensed, waiting in ((16, 0, ""), (28, 8, 44), (48, 6, 90))])
        found = self.found()
        self.assertIn("turns with the swirl (ϖ/Ω = 1.000 to 1.000): after 44 ± 2 periods at N = 28, 90 ± 2 periods "
                      "at N = 48. Runs that did not condense: 8 of 8 at N = 16, 2 of 8 at N = 48.", found)
        self.write("condensation", [{"discs": 16, "condensed": 0}])
        self.assertEqual(self.found(), "")


class Figures(Tables):
    def figure(self, name, findings=(), width=1012, height=700, files=()):
        with open(os.path.join(self.folder, f"figure_{name}.png"), "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII", 13, b"IHDR", width, height))
        return {"name": name, "description": "what", "findings": list(findings),
                "files": [f"figure_{name}.png", *files]}

    def html(self, *figures):
        texts = report.figure_texts({"figures": figures})
        return report.figures_html(self.folder, list(figures), texts)

    def test_every_figure_says_what_it_shows_or_asks(self):
        with open(os.path.join(SOURCE, "docs", "paper.md"), encoding="utf-8") as file:
            text = file.read().split("## The figures")[1].split("\n## ")[0]
        names = [name.strip() for line in text.splitlines() if line.startswith("| ")
                 for name in line.split("|")[1].split(",") if name.strip() != "name"]
        self.assertGreater(len(names), 30)
        for name in names:
            self.assertTrue(report.caption_of({"name": name}) or report.question_of({"name": name}),
                            name)

    def test_what_is_said_once_is_not_said_again(self):
        a = self.figure("3a", ["Stays begin at 194°.", "Not shown to be steady: 1 of 2 runs."])
        b = self.figure("3b", ["Stays begin at 194°.", "Only here."])
        page = self.html(a, b)
        self.assertEqual(page.count("Stays begin"), 1)
        self.assertIn("<li>Only here.</li>", page)
        self.assertIn("<p class=small>Not shown to be steady: 1 of 2 runs.</p>", page)
        self.assertIn("<p class=small>More on its runs: Figure 3a.</p>", page)

    def test_points_have_no_names_of_the_program(self):
        for name, words in (
                ("no-wall_N40", "μ_w = 0 with N = 40"),
                ("high_N54", "μ = 1 with N = 54"),
                ("run_no-wall_N48_200000events_seed3", "μ_w = 0 with N = 48 (seed 3)"),
                ("measured_no-wall_N48_200000events_seed11", "μ_w = 0 with N = 48 (seed 11)"),
                ("spheres_0.2_N16_25of75periods", "μ = 0.2 with N = 16"),
                ("spheres_measured_0.15_N30_25of75periods", "μ = 0.15 with N = 30"),
                ("spheres_no-vertical-disc_N52_25of75periods", "no vertical friction between spheres with N = 52"),
                ("spheres_no-floor-rough_N48_25of75periods", "no floor, μ = 0.3 with N = 48"),
                ("spheres_shell_N52_25of75periods", "hollow spheres with N = 52"),
                ("spheres_coins_f0.01_N16_25of75periods", "coins, μ_f = 0.01 with N = 16"),
                ("inertia_0.5_N54_40of240periods", "I = 0.5 with N = 54"),
                ("tangential_1_N44_40of240periods", "β = 1 with N = 44"),
                ("spheres_e0.95_N52_25of75periods", "e = 0.95 with N = 52"),
                ("1 of 3 at map_d0.5_w0_100of300periods, and", "1 of 3 at (μ_d, μ_w) = (0.5, 0), and"),
                ("Most runs change at low_N5, so", "Most runs change at μ = 0.1 with N = 5, so"),
                ("tangential_restitution 0.5: lowest", "β = 0.5: lowest"),
                ("inertia 10: crosses", "I = 10: crosses"),
                ("Figure 1c: drawn; the forces", "the forces"),
                ("between 6e-09 and 2.5e+3, 1e-11", "between 6·10⁻⁹ and 2.5·10³, 10⁻¹¹"),
                ("10^6 events last", "10⁶ events last"),
                ("the column steady_state", "the column steady_state")):
            self.assertEqual(report.in_words(name), words)
        self.assertEqual(report.sentence("e = 1: crosses"), "e = 1: crosses")
        self.assertEqual(report.sentence("a disc"), "a disc")

    def test_the_rule_is_that_of_the_verdicts(self):
        for seeds, errors in ((8, "with 8 seeds these are 4.5 errors"), (3, "with 3 seeds these are 19.2 errors")):
            said = report.how_to_read({"quick": False, "seeds_of_a_point": seeds})
            self.assertIn(errors, said)  # figures/verdicts.py, CERTAIN
            self.assertNotIn("three of them decide", said)

    def test_a_bracket_is_no_number(self):
        self.assertEqual(report.claims.crossing_sentence("between 36 and 40"), "N_c between 36 and 40")
        self.assertEqual(report.claims.crossing_sentence("38.2 ± 0.1"), "N_c = 38.2 ± 0.1")

    def test_titles(self):
        for name, description, title in (
                ("5b", "rotation against N", "Figure 5b: rotation against N"),
                ("5b-steady", "beyond the paper: Figure 5b in the steady state", "Figure 5b in the steady state"),
                ("spheres_map", "spheres that roll: rotation of 36", "Rotation of 36"),
                ("spheres_coins", "spheres that roll, beside them: solid discs", "Solid discs")):
            self.assertEqual(report.title_of({"name": name, "description": description}), title)

    def test_what_is_wide_goes_across(self):
        page = self.html(self.figure("1b"), self.figure("5d", width=2100, height=1080),
                         self.figure("4a"), self.figure("4c"))
        self.assertEqual(page.count('<figure class="wide beside">'), 1)  # 1b, alone in its row
        self.assertEqual(page.count("<figure class=wide>"), 1)
        self.assertEqual(page.count("<figure>"), 2)
        self.assertLess(page.index("Figure 1b"), page.index("Figure 5d"))
        self.assertLess(page.index("Figure 5d"), page.index("Figure 4a"))
        # Made for a column, it is not blown up across the page, however flat.
        self.assertNotIn("class=wide", self.html(self.figure("5c", height=690), self.figure("4a")))

    def test_the_drawn_figures_are_lines_not_points(self):
        with open(os.path.join(self.folder, "figure_2a.svg"), "w", encoding="utf-8") as file:
            file.write("<svg xmlns='http://www.w3.org/2000/svg'/>")
        self.assertIn("data:image/svg+xml;base64,", self.html(self.figure("2a", files=["figure_2a.svg"])))

    def test_columns_are_even(self):
        self.assertEqual(report.in_columns([1.0, 1.0, 1.0, 1.0])[1], [0, 1, 0, 1])
        cost, sides = report.in_columns([2.0, 1.0, 1.0])
        self.assertEqual(sides, [0, 1, 1])
        self.assertLess(cost, 1e-3)
        self.assertEqual(report.arranged([]), [])
        self.assertEqual(report.arranged([(0.7, 0.6)]), [None])
        many = report.arranged([(0.7, 0.1 * (k % 5)) for k in range(30)])
        self.assertEqual(len(many), 30)
        self.assertIn(None, report.arranged([(0.8, 0.5), (0.8, 0.5), (0.7, 0.7)]))


if __name__ == "__main__":
    unittest.main()
