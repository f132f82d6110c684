"""The page of the report: how its figures are captioned and arranged."""

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
                ("spheres_no-vertical-disc_N52_25of75periods", "no vertical disc with N = 52"),
                ("spheres_coins_f0.01_N16_25of75periods", "coins, μ_f = 0.01 with N = 16"),
                ("tangential_restitution 0.5: lowest", "β = 0.5: lowest"),
                ("inertia 10: crosses", "I = 10: crosses"),
                ("Figure 1c: drawn; the forces", "the forces"),
                ("the column steady_state", "the column steady_state")):
            self.assertEqual(report.in_words(name), words)

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
