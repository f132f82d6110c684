"""Every "a ± b" of the README and the documentation has a source: a table in docs/data with this
value and this error, the result of a claim in docs/data/claims.csv, the output of a command that
the same page shows, or a row of docs/data/numbers.csv, which has the command. And one quantity has
one value on all pages."""

import csv
import math
import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ.get("SWIRL_SOURCE", pathlib.Path(__file__).parents[2]))
DATA = SOURCE / "docs" / "data"
PAGES = [SOURCE / "README.md", *sorted((SOURCE / "docs").rglob("*.md"))]
NUMBER = re.compile(r"(?<![\d.])([−-]?\d+(?:\.\d+)?) ± (\d+(?:\.\d+)?)(?!\d|\.\d)")
# The number of discs at which ϖ, the mean over the discs by time, changes its sign: μ = 1, the
# paper's dish.
N_C = "38.49 ± 0.06"


def pairs_of(folder):
    """{(value, error)} of all tables whose columns have errors."""
    found = set()
    for file in folder.glob("figure_*.csv"):
        with open(file, encoding="utf-8", newline="") as opened:
            for row in csv.DictReader(opened):
                for name, value in row.items():
                    error = row.get(f"{name}_error")
                    if (
                        value
                        and error
                        and re.fullmatch(r"[-+.\deE]+", value)
                        and re.fullmatch(r"[-+.\deE]+", error)
                    ):
                        found.add((float(value), float(error)))
    return found


def decimals(text):
    return len(text.partition(".")[2])


def rounds_to(pair, value, error):
    """Numbers in per cent, and those of which the page has the opposite, count, too."""
    return any(
        f"{sign * factor * pair[0]:.{decimals(value)}f}" == value
        and f"{factor * pair[1]:.{decimals(error)}f}" == error
        for factor in (1, 100)
        for sign in (1, -1)
    )


def without_source(text, pairs, listed):
    """The numbers of a page that have no source."""
    shown = " ".join(re.findall(r"```.*?```", text, re.S))
    missing = []
    for found in NUMBER.finditer(text):
        value, error = found[1].replace("−", "-"), found[2]
        if (
            found[0] not in listed
            and found[0] not in shown
            and not any(rounds_to(pair, value, error) for pair in pairs)
        ):
            missing.append(found[0])
    return missing


def rows_of(name):
    with open(DATA / name, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class Numbers(unittest.TestCase):
    def test_every_number_with_an_error_has_a_source(self):
        listed = {row["number"] for row in rows_of("numbers.csv")}
        pairs = pairs_of(DATA) | {
            tuple(float(part.replace("−", "-")) for part in found.groups())
            for row in rows_of("claims.csv")
            for found in NUMBER.finditer(row["result"])
        }
        count = 0
        for page in PAGES:
            text = page.read_text(encoding="utf-8")
            count += len(NUMBER.findall(text))
            with self.subTest(page=page.relative_to(SOURCE).as_posix()):
                self.assertEqual(without_source(text, pairs, listed), [])
        self.assertGreater(count, 150)

    def test_listed_numbers_have_a_command_and_are_used(self):
        texts = "\n".join(page.read_text(encoding="utf-8") for page in PAGES)
        used = {found[0] for found in NUMBER.finditer(texts)}
        rows = rows_of("numbers.csv")
        self.assertEqual([row["number"] for row in rows if row["number"] not in used], [])
        self.assertEqual(
            [
                row["number"]
                for row in rows
                if "swirl" not in row["command"] and "bench/" not in row["command"]
            ],
            [],
        )
        self.assertEqual(len({(row["number"], row["command"]) for row in rows}), len(rows))

    def test_a_number_without_a_source_is_found(self):
        pairs = {(0.12345, 0.0067), (-0.02, 0.001)}
        self.assertEqual(
            without_source("0.123 ± 0.007, 12.3 ± 0.7 %, 0.020 ± 0.001", pairs, {}), []
        )
        self.assertEqual(
            without_source("0.124 ± 0.007 and 0.123 ± 0.006", pairs, {}),
            ["0.124 ± 0.007", "0.123 ± 0.006"],
        )
        self.assertEqual(without_source("5.0 ± 0.1\n```\nϖ = 5.0 ± 0.1\n```\n", pairs, {}), [])
        self.assertEqual(without_source("5.0 ± 0.1", pairs, {"5.0 ± 0.1"}), [])

    def test_discs_have_one_n_c(self):
        """By event, N_c is another number; its table is in docs/results/paper.md. The output of a
        shorter search, which a page shows, is its own."""

        def others(text):
            return [
                found
                for found in re.findall(r"(?<!^)N_c = ([\d.]+ ± [\d.]+)", text, re.M)
                if found != N_C and math.isclose(float(found.split()[0]), 38.4, abs_tol=0.5)
            ]

        text = f"With N_c = {N_C}, N_c = 38.4 ± 0.2, N_c = 43.7 ± 0.1\nN_c = 38.5 ± 0.3: fewer"
        self.assertEqual(others(text), ["38.4 ± 0.2"])
        for page in (*PAGES, DATA / "claims.csv"):
            with self.subTest(page=page.name):
                self.assertEqual(others(page.read_text(encoding="utf-8")), [])
        for name in (
            "README.md",
            "docs/results/paper.md",
            "docs/tutorials/first_simulation.md",
            "docs/how-to/teach.md",
            "web/src/panels/lesson.ts",
        ):
            self.assertIn(N_C, (SOURCE / name).read_text(encoding="utf-8"), name)


if __name__ == "__main__":
    unittest.main()
