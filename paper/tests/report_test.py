"""The report: the results on its first page, from tables written by hand, and the captions and the
arrangement of its figures."""

import os
import struct
import unittest
from unittest import mock

from claim_tables import SOURCE, HandMadeTables
from program import read_rows

from paper import captions, catalogue, command, console, html_page, point_names, report, study
from paper.claims import CLAIMS
from paper.claims.catalogue import DENSE, OF_5B
from paper.claims.claim import Claim, Judged
from paper.claims.study import crossing_sentence
from paper.claims.wording import headline
from paper.summary import main_results
from paper.verdicts import FAILS, HOLDS, IN_PART, UNDECIDED, Judgement


class FirstPage(HandMadeTables):
    def rotations(self, error=0.01, absent=(), periods=300, **curves):
        """Tables 5b and 5b-steady: each setting from its first ϖ/Ω at N = 8 to its last, at all N
        that the claims need but `absent`."""
        for figure, numbers in (("5b", (*OF_5B, *DENSE)), ("5b-steady", OF_5B)):
            self.table(
                figure,
                [
                    {
                        "setting": setting.replace("_", "-"),
                        "discs": n,
                        "mean_by_event": first if n < 44 else last,
                        "mean_by_event_error": error,
                        "steady_state": "steady",
                        "periods": periods,
                        "warmup_periods": 20,
                        "point": f"{setting}_N{n}",
                    }
                    for setting, (first, last) in curves.items()
                    for n in numbers
                    if n not in absent
                ],
            )

    def crossings_5b(self, **found):
        """(verdict, N_c, error) of each curve."""
        self.table(
            "5b_crossings",
            [
                {
                    "curve": curve,
                    "verdict": verdict,
                    "crossing": at,
                    "crossing_error": error,
                    "lowest": 0.07,
                    "lowest_error": 0.001,
                    "lowest_discs": 47,
                }
                for curve, (verdict, at, error) in found.items()
            ],
        )

    def found(self):
        return " ".join(main_results(self.folder))

    def test_no_tables_give_no_results(self):
        self.assertEqual(main_results(self.folder), [])

    def test_title_is_judged_by_stopped_spins(self):
        """Not by the correlations of figure 4b, which decide a part of it."""
        cases = (
            ("free", "none between particles", 1.0),
            ("stopped", "none between particles", -0.006),
        )
        self.table(
            "cause",
            [
                {
                    "body": body,
                    "spins": spins,
                    "contacts": contacts,
                    "discs": n,
                    "mean_by_time": level if n == 48 else 0.5,
                    "mean_by_time_error": 0.001,
                    "point": f"{body}_{spins}_N{n}",
                }
                for body, smooth in (("discs", "none at the wall"), ("spheres", "none at all"))
                for spins, contacts, level in (*cases, ("stopped", smooth, 0.06))
                for n in (24, 48)
            ],
        )
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
                    **dict(zip(columns, (-0.4, -0.3, 0, 0, 0.5))),
                    **{f"{column}_error": 0.001 for column in columns},
                }
                for setting in ("smooth", "rough", "high")
                for n in (24, 28, 36, 40, 44, 48)
            ],
        )
        said = self.found()
        self.assertIn(
            "The title, geometric frustration induces counterrotation, is confirmed only in part.",
            said,
        )
        self.assertIn(
            "for discs is confirmed (ϖ/Ω 1.0000 ± 0.0010 at N = 48 if they can spin, −0.0060 ± "
            "0.0010 at N = 48 if they cannot) and for spheres is confirmed",
            said,
        )
        self.assertNotIn("Correlation", said)

    def test_transition_is_confirmed(self):
        self.rotations(high=(0.2, -0.1))
        self.crossings_5b(high=("crosses", 38.5, 0.2))
        said = self.found()
        self.assertIn(
            "few discs rotate with the swirl and many against it (ϖ/Ω = 0.200 ± 0.010 at "
            "N = 8, ϖ/Ω = −0.100 ± 0.010 at N = 48)",
            said,
        )
        self.assertIn("the direction changes at N_c = 38.5 ± 0.2.", said)

    def test_transition_is_not_confirmed(self):
        self.rotations(high=(0.2, 0.1))
        self.crossings_5b(high=("always rotates", "", ""))
        said = self.found()
        self.assertIn("is confirmed only in part", said)
        self.assertIn(
            "the direction changes at no N that was run (ϖ/Ω is lowest at N = 47, 0.0700 ± 0.0010)",
            said,
        )
        self.rotations(high=(-0.2, 0.1))
        self.assertIn("is not confirmed", self.found())

    def test_transition_is_undecided(self):
        self.rotations(high=(0.2, -0.1), error=0.09)
        self.crossings_5b(high=("undecided", 38.5, 9.0))
        said = self.found()
        self.assertIn("Whether with friction", said)
        self.assertIn("is undecided", said)
        self.assertNotIn("N_c", said)

    def test_order_of_the_friction_coefficients(self):
        for medium, words in (
            (
                (("crosses", 44.0, 0.2)),
                "With less friction the direction changes at higher N: with "
                "μ = 0.5 at N_c = 44.0 ± 0.2, with μ = 0.1 at no N that was run",
            ),
            ((("crosses", 30.0, 0.2)), "Less friction does not always move"),
            ((("crosses", 39.0, 2.0)), "It is undecided whether less friction always moves"),
        ):
            self.crossings_5b(
                high=("crosses", 38.5, 0.2), medium=medium, low=("always rotates", "", "")
            )
            self.rotations(high=(0.2, -0.1), medium=(0.2, -0.1), low=(0.2, 0.1))
            self.assertIn(words, self.found())

    def test_both_frictions_are_needed(self):
        self.rotations(no_wall=(1.0, 0.9), no_disc=(1.0, 0.4))
        self.assertEqual(
            self.found(),
            "The cluster counterrotates only with both: without friction at the wall it never does "
            "(lowest of 9 N up to 48: ϖ/Ω = 0.900 ± 0.010 at N = 44), and without friction "
            "between the discs it "
            "never does (lowest of 11 N up to 55: ϖ/Ω = 0.400 ± 0.010 at N = 44).",
        )
        self.rotations(no_wall=(1.0, 0.02), no_disc=(1.0, -0.4))
        said = self.found()
        self.assertIn("Whether counterrotation needs friction at the wall is undecided", said)
        self.assertIn(
            "Counterrotation does not need friction between the discs (lowest of 11 N up to 55: "
            "ϖ/Ω = −0.400 ± 0.010 at N = 44)",
            said,
        )

    def test_few_points_and_shortened_runs_decide_no_sentence(self):
        """As in the table of claims, which names what is missing."""
        self.crossings_5b(
            high=("crosses", 38.5, 0.2),
            medium=("crosses", 44.0, 0.2),
            low=("always rotates", "", ""),
        )
        frictions = {
            "high": (0.2, -0.1),
            "medium": (0.2, -0.1),
            "low": (0.2, 0.1),
            "no_wall": (1.0, 0.9),
            "no_disc": (1.0, 0.4),
        }
        decided = (
            "few discs rotate with the swirl and many against it (",
            "With less friction the direction changes",
            "The cluster counterrotates only with both",
        )
        undecided = (
            "Whether with friction at the wall",
            "It is undecided whether less friction always moves",
            "Whether counterrotation needs friction at the wall is undecided",
            "Whether counterrotation needs friction between the discs is undecided",
        )
        self.rotations(**frictions)
        self.assert_says(decided, undecided)
        self.rotations(**frictions, absent=(16, 52))
        self.assert_says(undecided, decided)
        self.rotations(**frictions, periods=60)
        self.assert_says(undecided, decided)

    def assert_says(self, sentences, others):
        said = self.found()
        for sentence in sentences:
            self.assertIn(sentence, said)
        for sentence in others:
            self.assertNotIn(sentence, said)

    def test_spheres_of_the_experiment(self):
        def said(last, verdict, error=0.001):
            self.table(
                "spheres",
                [
                    {
                        "setting": "smooth",
                        "discs": n,
                        "mean_by_time": 0.5 if n < 48 else last,
                        "mean_by_time_error": error,
                    }
                    for n in (8, 16, 24, 28, 32, 36, 40, 44, 48)
                ],
            )
            self.crossings(
                "spheres",
                smooth=(36.1, 0.1) if verdict == "crosses" else (None, verdict),
                half=(None, "undecided"),
            )
            return self.found()

        self.assertEqual(
            said(-0.07, "crosses"),
            "Few spheres that roll on a floor rotate with the swirl and many "
            "against it, as in the experiment; their direction changes: that of smooth spheres at "
            "N_c = 36.10 ± 0.10; that of smooth spheres at A = 5.75 mm at no N for certain (ϖ/Ω is "
            "lowest at N = 48, 0.100 ± 0.010) (paper: 36 "
            "for smooth, 28 for roughened spheres; each friction coefficient is fitted to it).",
        )
        self.assertIn("is confirmed only in part", said(0.07, "always rotates"))
        self.assertIn("Whether few spheres", said(-0.07, "crosses", error=0.1))

    def test_predictions_for_the_pinned_spheres(self):
        def said(slips, spins=(2.2, 0.8, 0.3), error=0.001):
            for name, column, other, values in (
                ("4a", "slip_resident", "pinned_region", slips),
                ("4b", "resident_spin", "pinned_wall_spin", spins),
            ):
                self.table(
                    name,
                    [
                        {
                            "setting": "smooth",
                            "discs": n,
                            column: v,
                            f"{column}_error": error,
                            other: v,
                            f"{other}_error": error,
                            "triangles": 0.5,
                            "triangles_error": 0,
                        }
                        for n, v in zip(
                            (24, 28, 32, 36, 40, 44, 48),
                            (
                                *(values[0] + k / 3 * (values[1] - values[0]) for k in range(3)),
                                *(values[1] + k / 3 * (values[2] - values[1]) for k in range(4)),
                            ),
                        )
                    ],
                )
            return self.found()

        self.assertEqual(
            said((0.5, 0.9, 1.0)),
            "With the assumed restitution and floor friction: that the slip parameter of "
            "pinned spheres rises from about 0.5 to nearly 1 is confirmed (0.5000 ± 0.0010 at N = "
            "24, 1.0000 ± 0.0010 at "
            "N = 48); that their spin at the wall falls is confirmed (2.2000 ± 0.0010 at N = 24, "
            "0.3000 ± 0.0010 at N = 48, in Ω).",
        )
        self.assertIn("nearly 1 is confirmed in part", said((0.7, 0.9, 1.0)))
        self.assertIn("at the wall falls is not confirmed", said((0.5, 0.9, 1.0), (0.3, 0.8, 2.2)))
        self.assertIn("nearly 1 is undecided", said((0.5, 0.9, 1.0), error=0.1))

    def condensation(self, granular=1.0, after=0.05, error=0.001):
        """Temperature before and after it condenses, next to 0.3 with both kinds of friction."""

        def columns(**values):
            return values | {f"{name}_error": error for name in values}

        self.table(
            "condensation",
            [
                {
                    "discs": n,
                    "seeds": 8,
                    "condensed": condensed,
                    "events": 2e5,
                    "longest": 300,
                    **columns(
                        waiting=waiting,
                        after_mean_by_time=1.0,
                        before_granular=granular,
                        before_coordination=0.5,
                        after_granular=after,
                        after_coordination=3.0,
                    ),
                }
                for n, condensed, waiting in ((16, 0, ""), (28, 8, 44), (48, 6, 90))
            ],
        )
        self.table(
            "states",
            [
                {"setting": "high", "discs": n, **columns(granular=0.3, coordination=2.0)}
                for n in (28, 48)
            ],
        )
        return self.found()

    def test_condensation(self):
        claim = (
            "ithout friction between the discs the cluster is a gas at first and then "
            "condenses into a crystal"
        )
        self.assertEqual(
            self.condensation(),
            f"W{claim} that rotates with the swirl (ϖ/Ω = 1.000 to 1.000, after 44.0000 ± 0.0010 "
            "periods "
            "at N = 28, 90.0000 ± 0.0010 periods at N = 48). Runs that did not condense: 8 of 8 at "
            "N = 16, 2 of 8 at N = 48.",
        )
        self.assertIn(
            f"That w{claim} that rotates with the swirl, is confirmed only in part",
            self.condensation(granular=0.2),
        )
        self.assertIn(
            f"Whether w{claim} that rotates with the swirl, is undecided",
            self.condensation(error=0.5),
        )
        self.table("condensation", [{"discs": 16, "condensed": 0}])
        self.assertEqual(self.found(), "")


class Figures(HandMadeTables):
    def figure(self, name, findings=(), width=1012, height=700):
        with open(os.path.join(self.folder, f"figure_{name}.png"), "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII", 13, b"IHDR", width, height))
        return {
            "name": name,
            "description": "what",
            "findings": list(findings),
            "files": [f"figure_{name}.png"],
        }

    def html(self, *figures):
        texts = captions.figure_texts({"figures": figures})
        rows = [report.figure_row(self.folder, figure, texts) for figure in figures]
        return html_page.rendered(
            "report.html.j2", self.folder, title="t", blocks=[("figures", rows)]
        )

    def test_every_figure_has_a_caption_or_a_question(self):
        figures = catalogue.named(["all"])
        self.assertGreater(len(figures), 50)
        for figure in figures:
            about = {"name": figure.name, "caption": figure.caption}
            self.assertTrue(
                captions.caption_of(about) or captions.question_of(about),
                f"figure '{figure.name}' needs a caption in its file",
            )

    def test_findings_are_not_repeated(self):
        a = self.figure(
            "3a", ["Residences begin at 194°.", "Steady state not verified: 1 of 2 runs."]
        )
        b = self.figure("3b", ["Residences begin at 194°.", "Only here."])
        page = self.html(a, b)
        self.assertEqual(page.count("Residences begin"), 1)
        self.assertIn("<li>Only here.</li>", page)
        self.assertIn("<p class=small>Steady state not verified: 1 of 2 runs.</p>", page)
        self.assertIn("<p class=small>More on its runs: Figure 3a.</p>", page)

    def test_point_names_become_words(self):
        for name, words in (
            ("no-wall_N40", "μ_w = 0 with N = 40"),
            ("high_N54", "μ = 1 with N = 54"),
            ("run_no-wall_N48_200000events_seed3", "μ_w = 0 with N = 48 (seed 3)"),
            ("measured_no-wall_N48_200000events_seed11", "μ_w = 0 with N = 48 (seed 11)"),
            ("spheres_0.2_N16_25of75periods", "μ = 0.2 with N = 16"),
            ("measured_smooth_N30_50of200periods_seed2", "smooth spheres with N = 30 (seed 2)"),
            (
                "spheres_no-vertical-disc_N52_25of75periods",
                "no vertical friction between spheres with N = 52",
            ),
            ("spheres_no-floor-rough_N48_25of75periods", "no floor, roughened with N = 48"),
            ("spheres_shell_N52_25of75periods", "hollow spheres with N = 52"),
            ("inertia_0.5_N54_40of240periods", "I = 0.5 with N = 54"),
            ("tangential_1_N44_40of240periods", "β = 1 with N = 44"),
            ("spheres_e0.95_N52_25of75periods", "e = 0.95 with N = 52"),
            ("1 of 3 at map_d0.5_w0_100of300periods, and", "1 of 3 at (μ_d, μ_w) = (0.5, 0), and"),
            ("Most runs drift at low_N5, so", "Most runs drift at μ = 0.1 with N = 5, so"),
            ("tangential_restitution 0.5: lowest", "β = 0.5: lowest"),
            ("inertia 10: crosses", "I = 10: crosses"),
            ("Figure 1c: drawn; the forces", "the forces"),
            ("between 6e-09 and 2.5e+3, 1e-11", "between 6·10⁻⁹ and 2.5·10³, 10⁻¹¹"),
            ("10^6 events last", "10⁶ events last"),
            ("the column steady_state", "the column steady_state"),
        ):
            self.assertEqual(point_names.in_words(name), words)
        self.assertEqual(captions.sentence("e = 1: crosses"), "e = 1: crosses")
        self.assertEqual(captions.sentence("a disc"), "a disc")

    def test_threshold_is_that_of_the_verdicts(self):
        for seeds, errors in (
            (8, "With 8 seeds this needs 4.5 standard errors"),
            (3, "With 3 seeds this needs 19.2 standard errors"),
        ):
            said = report.how_to_read({"quick": False, "seeds_of_a_point": seeds})
            self.assertIn(errors, said)  # paper/verdicts.py, STUDENT_T
            self.assertNotIn("three of them decide", said)

    def test_bracket_in_a_sentence(self):
        self.assertEqual(crossing_sentence("between 36 and 40"), "N_c between 36 and 40")
        self.assertEqual(crossing_sentence("38.2 ± 0.1"), "N_c = 38.2 ± 0.1")

    def test_titles(self):
        for name, description, title in (
            ("5b", "rotation against N", "Figure 5b: rotation against N"),
            (
                "5b-steady",
                "beyond the paper: Figure 5b in the steady state",
                "Figure 5b in the steady state",
            ),
            ("spheres_few", "spheres that roll: a few of them", "A few of them"),
        ):
            self.assertEqual(captions.title_of({"name": name, "description": description}), title)

    def test_wide_images_span_the_page(self):
        page = self.html(
            self.figure("1b"),
            self.figure("5d", width=2100, height=1080),
            self.figure("4a"),
            self.figure("4c"),
        )
        self.assertEqual(page.count("<figure class=wide>"), 1)
        self.assertEqual(page.count("<figure>"), 3)
        self.assertLess(page.index("Figure 1b"), page.index("Figure 5d"))
        self.assertLess(page.index("Figure 5d"), page.index("Figure 4a"))
        # An image made for a column is not enlarged across the page, however flat.
        self.assertNotIn("class=wide", self.html(self.figure("5c", height=690), self.figure("4a")))


class Page(HandMadeTables):
    def test_counts_and_dependence_on_the_sizes(self):
        judged = [
            Judged(
                Claim("x", f"{v} {k}", "5b", None, "discs"), Judgement(v), "found", {0.5: v, 2: v}
            )
            for v, n in ((HOLDS, 3), (IN_PART, 1), (FAILS, 2), (UNDECIDED, 1))
            for k in range(n)
        ]
        self.assertEqual(
            report.counts(judged),
            "Of 7 claims 3 hold, 1 holds in part, 2 do not hold, 1 is undecided.",
        )
        self.assertEqual(report.with_sizes(judged[0]), "")
        judged[0].scaled = {0.5: HOLDS, 2: UNDECIDED}
        self.assertEqual(
            report.with_sizes(judged[0]), "depends on the size: holds at half, undecided at twice"
        )
        self.assertIn(" The verdicts on 1 depend on the required sizes", report.counts(judged))

    def test_subscripts(self):
        self.assertEqual(
            html_page.rich("N_c < 5, ϖ_M, R_ball, steady_state"),
            "N<sub>c</sub> &lt; 5, ϖ<sub>M</sub>, R<sub>ball</sub>, steady_state",
        )
        self.assertEqual(captions.sentence("ϖ by time"), "ϖ by time")

    def test_no_line_break_inside_a_number(self):
        self.assertEqual(
            html_page.rich("ϖ/Ω = 0.5 ± 0.1 at N = 48, where a = b"),
            "ϖ/Ω = 0.5\u00a0±\u00a00.1 at N\u00a0=\u00a048, where a = b",
        )

    def test_report_is_one_self_contained_page(self):
        about = {
            "command": "swirl paper",
            "version": "1",
            "build": "b",
            "quick": True,
            "seed": 1,
            "events_of_a_run": 1000,
            "runs": 2,
            "runs_of_earlier_calls": 0,
            "seconds": 100.0,
            "seconds_on_one_core": 200.0,
            "defaults": {
                "inertia": 10,
                "container_radius": 8.6,
                "amplitude": 1.892,
                "sides": 30,
                "period": 11.866071,
                "restitution": 1,
            },
            "figures": [
                {
                    "name": "5b",
                    "description": "ϖ < 0 & more",
                    "findings": ["found"],
                    "files": ["figure_5b.png"],
                }
            ],
        }
        with open(os.path.join(self.folder, "figure_5b.png"), "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII", 13, b"IHDR", 600, 200))
        blocks = report.contents(self.folder, about, report.judge(self.folder))
        page = html_page.rendered("report.html.j2", self.folder, title=report.TITLE, blocks=blocks)
        self.assertIn("data:image/png;base64,iVBORw", page)
        self.assertIn("<figure class=wide>", page)
        self.assertIn("ϖ &lt; 0 &amp; more", page)
        self.assertNotIn('src="figure', page)
        for claim in CLAIMS:
            self.assertIn(html_page.rich(claim.statement), page)
            self.assertIn(f"<td>{claim.on}</td>", page)
        # As a paper: what was found comes first, and how it was found last.
        order = [
            "<h2>Abstract",
            "<h2>Results",
            "data:image",
            f"<h2>{report.CLAIMS}",
            "<h2>Methods",
            "<h2>Contradictions",
        ]
        self.assertEqual(
            [page.index(part) for part in order], sorted(page.index(part) for part in order)
        )
        text = html_page.rendered("report.md.j2", title=report.TITLE, blocks=blocks)
        self.assertTrue(text.startswith(f"# {report.TITLE}\n\n## Abstract"))
        self.assertEqual(
            text.count("\n| "),
            len(CLAIMS) + len(captions.CONTRADICTIONS) + len(report.parameter_rows(about)) + 3,
        )

    def test_a_complete_report_is_as_long_as_a_paper(self):
        """With all figures, and for each claim the text that is stored in docs/data/claims.csv."""
        figures = [
            {
                "name": name,
                "description": description,
                "findings": ["At N = 48 it is 0.123 ± 0.004."] * 12,
                "files": [f"figure_{name}.png"],
            }
            for name, _, description, _ in catalogue.entries()
        ]
        for figure in figures:
            with open(os.path.join(self.folder, figure["files"][0]), "wb") as file:
                file.write(b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII", 13, b"IHDR", 1012, 700))
        about = {
            "command": "swirl paper",
            "version": "1",
            "build": "b",
            "quick": False,
            "seed": 1,
            "events_of_a_run": 1_000_000,
            "runs": 9000,
            "runs_of_earlier_calls": 0,
            "seconds": 100.0,
            "seconds_on_one_core": 200.0,
            "figures": figures,
            "defaults": {
                name: 1
                for name in (
                    "inertia",
                    "container_radius",
                    "amplitude",
                    "sides",
                    "period",
                    "restitution",
                )
            },
        }
        stored = read_rows(os.path.join(SOURCE, "docs", "data", "claims.csv"))
        judged = [
            Judged(claim, Judgement(row["verdict"]), row["result"], {})
            for claim, row in zip(CLAIMS, stored)
        ]
        with mock.patch.object(
            report,
            "main_results",
            lambda folder: [
                "A result of fifteen words, as it is printed in the "
                "list below the abstract of it."
            ]
            * 6,
        ):
            blocks = report.contents(self.folder, about, judged)
        text = html_page.rendered("report.md.j2", title=report.TITLE, blocks=blocks)
        self.assertLessEqual(len(text.split()), 6000)
        abstract = text.split("## Abstract")[1].split("## Results")[0]
        self.assertTrue(80 <= len(abstract.split()) <= report.ABSTRACT_WORDS, abstract)
        self.assertEqual(
            text.count("!["), len({figure for _, figure, *_ in catalogue.entries()})
        )  # one for each group
        # The names of settings and points are keys of tables, and no words.
        for key in ("no-wall", "no-disc", "Smooth friction", "smooth friction", "_N48"):
            self.assertNotIn(key, text)

    def test_the_table_of_claims_has_the_decisive_numbers(self):
        found = (
            "Smooth spheres: s is 0.58 ± 0.01 at N = 25 (over all N 0.5 to 0.9), 0.98 ± 0.01 at N "
            "= 48; by another criterion 0.61 ± "
            "0.01, and a long explanation of why they differ, which nobody reads in a table of "
            "sixty rows. For comparison: more."
        )
        self.assertEqual(headline(found), "s is 0.58 ± 0.01 at N = 25, 0.98 ± 0.01 at N = 48")
        for row in read_rows(os.path.join(SOURCE, "docs", "data", "claims.csv")):
            self.assertTrue(10 <= len(headline(row["result"])) <= 260, headline(row["result"]))


class Shown(unittest.TestCase):
    def test_the_time_left_is_not_guessed_from_the_first_runs(self):
        self.assertEqual(console.time_left(30, 0.0), "")
        self.assertEqual(console.time_left(30, 0.01), "")
        self.assertEqual(console.time_left(1, 0.5), "")
        self.assertEqual(console.time_left(30, 0.25), ", 1 min 30 s left")
        self.assertEqual(console.time_left(12_000, 0.02), ", more than a day left")

    def test_progress_names_what_is_made(self):
        def tasks(*names):
            made = []
            for name in names:
                made.append(study.Task.__new__(study.Task))
                made[-1].figures = {name}
            return made

        self.assertEqual(study.part_in_words(tasks("5b")), "figure 5b")
        self.assertEqual(study.part_in_words(tasks("4b", "3a", "4b")), "figures 3a and 4b")
        self.assertEqual(study.part_in_words(tasks("3a", "3b", "4a")), "3 figures")
        self.assertEqual(study.part_in_words([]), "")


class Call(unittest.TestCase):
    def test_a_table_that_cannot_be_made_is_a_problem_of_its_figure(self):
        class Broken:
            name, description, caption = "broken", "what", ""

            def write(self, plan, settings):
                raise KeyError("fields")

        call = command.Paper.__new__(command.Paper)
        call.settings, call.problems = None, {}
        made = call.finished(Broken(), [])
        self.assertEqual((made["problem"], made["files"]), ("KeyError: 'fields'", []))


if __name__ == "__main__":
    unittest.main()
