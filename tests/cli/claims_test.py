"""All claims: missing tables, numbers, and the file of verdicts."""

import json
import os
import subprocess
import unittest

from claim_tables import HandMadeTables, SOURCE

import claims
from claims import rotation
from claims.wording import number
from verdicts import MISSING, UNTESTABLE, Value


class Catalogue(HandMadeTables):
    def test_missing_table_is_reported(self):
        for claim in claims.CLAIMS:
            verdict, found = claim.verdict(self.folder)
            if claim.figure:
                self.assertEqual(verdict, MISSING, claim.statement)
                self.assertIn("does not exist", found)
            else:
                self.assertEqual(verdict, UNTESTABLE)

    def test_page_about_the_paper_lists_every_claim(self):
        with open(os.path.join(SOURCE, "docs", "explanation", "paper.md"), encoding="utf-8") as file:
            section = file.read().split("## The claims")[1].split("\n## ")[0]
        rows = [row.split(" | ")[:3] for row in section.splitlines() if row[:3].strip("| ").isdigit()]
        self.assertEqual(rows, [[f"| {k}", claim.statement.replace("|", "\\|"), f"`{claim.figure}`"]
                                for k, claim in enumerate(claims.CLAIMS, 1)])

    def test_numbers_have_the_digits_of_their_errors(self):
        self.assertEqual(number(-0.03621, 0.0009), "−0.0362 ± 0.0009")
        self.assertEqual(number(36.42, 0.12), "36.42 ± 0.12")
        self.assertEqual(number(Value(36.42, 0.3)), "36.4 ± 0.3")

    def test_table_without_runs_gives_no_verdict(self):
        self.table("5b", [{"setting": "high", "discs": 5, "by_event": "", "by_event_error": "",
                           "steady_state": "failed"}])
        for claim in claims.CLAIMS:
            if claim.judge is rotation.minimum:
                self.assertEqual(claim.verdict(self.folder)[0], MISSING)

    def test_verdicts_file_lists_points_that_need_seeds(self):
        self.rotation("5b", "no-wall", [(20, 0.9), (40, 0.02)])
        done = subprocess.run(["/usr/bin/python3", "-B",
                               os.path.join(SOURCE, "figures", "judge_claims.py"), self.folder],
                              capture_output=True, text=True, timeout=150)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(self.folder, "verdicts.json"), encoding="utf-8") as file:
            found = json.load(file)
        self.assertEqual(found["points_to_decide"], ["no-wall_N40"])
        self.assertEqual(len(found["verdicts"]), len(claims.CLAIMS))


if __name__ == "__main__":
    unittest.main()
