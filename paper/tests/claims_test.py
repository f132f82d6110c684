"""All claims: missing tables and points, required sizes, numbers, and the file of verdicts."""

import csv
import io
import os
import re
import unittest
from types import SimpleNamespace

from claim_tables import HandMadeTables, SOURCE
from program import read_json, read_rows, read_text

from paper import claims, claims_page, command, study
from paper.claims import rotation, thresholds
from paper.claims.claim import BOTH, DISCS, NOTHING, SPHERES, UNTESTED, Claim
from paper.claims.wording import number
from paper.verdicts import FAILS, HOLDS, IN_PART, MISSING, UNDECIDED, UNTESTABLE, Value, above


def claim_that(words):
    return next(claim for claim in claims.CLAIMS if words in claim.statement)


class Catalogue(HandMadeTables):
    def test_missing_table_is_reported(self):
        for claim in claims.CLAIMS:
            judgement, found = claim.judged(self.study)
            if claim.figure:
                self.assertEqual(judgement, MISSING, claim.statement)
                self.assertIn("does not exist", found)
            else:
                self.assertIn(judgement.verdict, (UNTESTED, UNTESTABLE))
                self.assertEqual(claim.on, NOTHING)

    def test_every_claim_names_what_it_is_judged_on_and_is_listed_once(self):
        self.assertLessEqual({claim.on for claim in claims.CLAIMS}, {SPHERES, DISCS, BOTH, NOTHING})
        statements = [claim.statement for claim in claims.CLAIMS]
        self.assertEqual(len(statements), len(set(statements)))
        # Figures 1 to 4 are about the experiment, Figure 5 is about the simulation.
        for claim in claims.CLAIMS:
            if any(f"Fig. {n}" in claim.source for n in (1, 2, 3, 4)):
                self.assertEqual(claim.on, SPHERES, claim.statement)
            if "Fig. 5b" in claim.source or claim.source == "SI":
                self.assertEqual(claim.on, DISCS, claim.statement)

    def test_stored_results_list_every_claim(self):
        with open(
            os.path.join(SOURCE, "docs", "data", "claims.csv"), encoding="utf-8", newline=""
        ) as file:
            rows = [list(row.values())[:4] for row in csv.DictReader(file)]
        self.assertEqual(
            rows,
            [
                [str(k), claim.statement, claim.on, claim.figure or ""]
                for k, claim in enumerate(claims.CLAIMS, 1)
            ],
        )

    def test_page_and_stored_results_have_the_same_verdicts(self):
        with open(os.path.join(SOURCE, "docs", "results", "paper.md"), encoding="utf-8") as file:
            rows = re.findall(r"^\| ([a-z ]+) \| (\d+) \| ([\d, ]+) \|$", file.read(), re.M)
        page = {
            int(number): verdict for verdict, _, numbers in rows for number in numbers.split(", ")
        }
        self.assertEqual(
            [int(count) for _, count, _ in rows],
            [len(numbers.split(", ")) for _, _, numbers in rows],
        )
        stored = read_rows(os.path.join(SOURCE, "docs", "data", "claims.csv"))
        self.assertEqual({int(row["claim"]): row["verdict"] for row in stored}, page)

    def test_the_readme_has_the_same_counts(self):
        verdicts = [
            row["verdict"] for row in read_rows(os.path.join(SOURCE, "docs", "data", "claims.csv"))
        ]
        holds, in_part, fails = (verdicts.count(verdict) for verdict in (HOLDS, IN_PART, FAILS))
        text = " ".join(read_text(os.path.join(SOURCE, "README.md")).split())
        self.assertIn(
            f"Of {len(verdicts)} statements of the paper {holds} hold, {in_part} hold in part, and "
            f"{fails} do not; "
            f"{len(verdicts) - holds - in_part - fails} are undecided, not tested or not testable",
            text,
        )

    def test_page_gets_its_tables_from_the_verdicts(self):
        page = read_text(os.path.join(SOURCE, "docs", "results", "paper.md"))
        self.rotation(
            "5b-steady", "no-wall", [(n, -0.2) for n in (8, 16, 24, 28, 32, 36, 40, 44, 48)]
        )
        rows = [
            claims_page.row_of(k, judged)
            for k, judged in enumerate(claims.all_judged(self.folder), 1)
        ]
        found = claims_page.written(page, rows)
        at = claims.CLAIMS.index(claim_that("Without wall friction there is never")) + 1
        self.assertIn(f"| does not hold | 1 | {at} |", found)
        self.assertEqual(claims_page.written(found, rows), found)
        stored = list(csv.DictReader(io.StringIO(claims_page.csv_of(rows))))
        self.assertEqual(
            [row["statement"] for row in stored], [claim.statement for claim in claims.CLAIMS]
        )
        self.assertEqual(stored[at - 1]["verdict"], "does not hold")
        self.assertIn("ϖ/Ω is certainly not below", stored[at - 1]["result"])
        # Only tables change.
        self.assertEqual(
            [line for line in page.splitlines() if line[:1] != "|"],
            [line for line in found.splitlines() if line[:1] != "|"],
        )

    def test_every_claim_has_the_sentence_of_the_paper_on_its_page(self):
        self.assertEqual(len(claims.QUOTES), len(claims.CLAIMS))
        page = read_text(os.path.join(SOURCE, "docs", "results", "claims.md"))
        rows = read_rows(os.path.join(SOURCE, "docs", "data", "claims.csv"))
        self.assertEqual(claims_page.page_of(rows), page)
        lines = [line for line in page.splitlines() if re.match(r"\| \d", line)]
        self.assertEqual(
            [int(line.split("|")[1]) for line in lines], list(range(1, len(claims.CLAIMS) + 1))
        )
        for line, quote, row in zip(lines, claims.QUOTES, rows):
            cells = re.split(r"(?<!\\)\|", line)
            self.assertEqual(len(cells), 7, line)
            self.assertIn(quote.replace("|", "\\|"), cells[2])
            self.assertEqual(cells[3].strip(), row["verdict"])
            self.assertTrue(cells[4].strip(), line)

    def test_other_claims_keep_what_is_stored(self):
        file = os.path.join(SOURCE, "docs", "data", "claims.csv")
        stored = list(csv.DictReader(io.StringIO(read_text(file))))
        at = claims.CLAIMS.index(claim_that("Without wall friction there is never")) + 1
        self.rotation(
            "5b-steady", "no-wall", [(n, -0.2) for n in (8, 16, 24, 28, 32, 36, 40, 44, 48)]
        )
        rows = claims_page.rows_from(self.folder, file, {at})
        self.assertEqual([k for k, (a, b) in enumerate(zip(rows, stored), 1) if a != b], [at])
        self.assertEqual(claims_page.rows_from("-", file, set()), stored)

    def test_numbers_have_the_digits_of_their_errors(self):
        self.assertEqual(number(-0.03621, 0.0009), "−0.0362 ± 0.0009")
        self.assertEqual(number(36.42, 0.12), "36.42 ± 0.12")
        self.assertEqual(number(Value(36.42, 0.3)), "36.4 ± 0.3")

    def test_table_without_runs_gives_no_verdict(self):
        self.table(
            "5b-start",
            [
                {
                    "setting": "no-wall",
                    "discs": 5,
                    "mean_by_event": "",
                    "mean_by_event_error": "",
                    "steady_state": "failed",
                }
            ],
        )
        for claim in claims.CLAIMS:
            if claim.judge is rotation.no_wall_at_omega:
                self.assertEqual(claim.judged(self.study)[0], MISSING)

    def test_claim_without_a_point_that_it_needs_is_undecided(self):
        def judged(numbers, failed=None):
            self.table(
                "5b-start",
                [
                    {
                        "setting": "no-wall",
                        "discs": n,
                        "mean_by_event": 1.0,
                        "mean_by_event_error": 0.001,
                        "steady_state": "failed" if n == failed else "steady",
                    }
                    for n in numbers
                ],
            )
            return claim_that("with the frequency of the swirl at every N").judged(self.study)

        needed = (8, 16, 24, 28, 32, 36, 40, 44, 48)
        self.assertEqual(judged(needed)[0], HOLDS)
        verdict, found = judged(needed[:-2])
        self.assertEqual(verdict, UNDECIDED)
        self.assertEqual(verdict.points, frozenset())  # more seeds elsewhere would not decide
        self.assertIn("without these points: figure 5b-start, no-wall, N = 44, 48.", found)
        self.assertEqual(judged(needed, failed=48)[0], UNDECIDED)

    def test_friction_coefficients_that_are_missing_leave_a_claim_undecided(self):
        def judged(*coefficients):
            self.table(
                "spheres_friction",
                [
                    {
                        "curve": "experiment",
                        "mu": mu,
                        "crosses": 1,
                        "crossing": 43 - 22 * mu,
                        "crossing_error": 0.1,
                    }
                    for mu in coefficients
                ],
            )
            return claim_that("The rougher the particles").judged(self.study)

        self.assertEqual(judged(0.3, 0.4, 0.6, 0.7)[0], HOLDS)
        verdict, found = judged(0.3, 0.6, 0.7)
        self.assertEqual(verdict, UNDECIDED)
        self.assertIn("figure spheres_friction, experiment, μ = 0.4.", found)

    def one_point_is_undecided(self):
        self.rotation(
            "5b-steady",
            "no-wall",
            [(n, 0.022 if n == 40 else 0.9) for n in (8, 16, 24, 28, 32, 36, 40, 44, 48)],
        )

    def test_only_an_undecided_point_gets_more_seeds_until_its_budget_is_spent(self):
        self.one_point_is_undecided()
        settings = study.Settings(out=self.folder)

        def point(n):
            name = f"no-wall_N{n}"
            seeds = max(settings.seeds, settings.seeds_of_point.get(name, 0))
            return SimpleNamespace(name=name, tasks=range(seeds))

        def plans():
            return [[point(36), point(40)]]

        for seeds in (8, 16, 32):
            self.assertEqual(command.add_seeds_to_undecided(settings, plans()), (True, 0))
            self.assertEqual([len(point.tasks) for point in plans()[0]], [4, seeds])
        self.assertEqual(command.add_seeds_to_undecided(settings, plans()), (False, 1))
        # A figure without this point has nothing to add.
        self.assertEqual(command.add_seeds_to_undecided(settings, [plans()[0][:1]]), (False, 0))

    def test_verdicts_file_lists_points_that_need_seeds(self):
        self.one_point_is_undecided()
        claims.write_verdicts(self.folder)
        found = read_json(os.path.join(self.folder, "verdicts.json"))
        self.assertEqual(found["points_to_decide"], ["no-wall_N40"])
        self.assertEqual(len(found["verdicts"]), len(claims.CLAIMS))
        never = found["verdicts"][
            claims.CLAIMS.index(claim_that("Without wall friction there is never"))
        ]
        self.assertEqual(never["judged_on"], "discs")
        self.assertEqual(
            [never[name] for name in ("verdict", "at_half_the_sizes", "at_twice_the_sizes")],
            [UNDECIDED, UNDECIDED, HOLDS],
        )
        self.assertTrue(never["depends_on_size"])


class Sizes(HandMadeTables):
    def test_verdict_at_half_and_twice_the_size(self):
        def judged(value):
            claim = Claim(
                "",
                "",
                "",
                lambda study: (above(Value(value, 0.0001), thresholds.LEAST_ROTATION), ""),
                DISCS,
            )
            return claim.judged_with_sizes(self.study)

        large, middle, little = judged(0.02), judged(0.007), judged(0.003)
        self.assertEqual(
            [(j.verdict, j.scaled, j.depends_on_size) for j in (large, middle, little)],
            [
                (HOLDS, {0.5: HOLDS, 2: HOLDS}, False),
                (HOLDS, {0.5: HOLDS, 2: FAILS}, True),
                (FAILS, {0.5: HOLDS, 2: FAILS}, True),
            ],
        )

    def test_sizes_that_are_shares_or_distances(self):
        before = {name: getattr(thresholds, name) for name in thresholds.SIZES}
        for factor, expected in (
            (0.5, (1 / 3, 0.95, 0.525, 1.0, -1 / 12)),
            (2, (2 / 3, 0.8, 0.6, 4.0, -1 / 3)),
        ):
            with thresholds.scaled(factor):
                found = [
                    getattr(thresholds, name)
                    for name in (
                        "MAJORITY",
                        "NEARLY_ONE",
                        "LEFT_SHARE",
                        "ROUGHLY",
                        "ANTIFERROMAGNETIC",
                    )
                ]
            for a, b in zip(found, expected):
                self.assertAlmostEqual(a, b)
        self.assertEqual(before, {name: getattr(thresholds, name) for name in thresholds.SIZES})

    def test_sizes_are_read_when_a_claim_is_judged(self):
        """`from .thresholds import SIZE` would keep the value of its import."""
        folder = os.path.join(SOURCE, "paper", "claims")
        for name in os.listdir(folder):
            if name.endswith(".py"):
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    imported = [line for line in file if line.startswith("from .thresholds import")]
                for size in thresholds.SIZES:
                    self.assertNotIn(size, " ".join(imported).replace(",", " ").split(), name)


if __name__ == "__main__":
    unittest.main()
