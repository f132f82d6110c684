"""Means over seeds, their errors, and zeros of curves are computed by the tested functions
(CONTRIBUTING.md, Scope). No other script has its own scatter of a mean, its own quantiles of
Student's t, or its own search for a zero, except where listed here."""

import json
import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ.get("SWIRL_SOURCE", pathlib.Path(__file__).parents[2]))
OWN = {
    "scatter": re.compile(
        r"\bddof\b|\.(?:std|var)\(|\bnp\.(?:std|var|nanstd|nanvar)\(|\bstatistics\.(?:p?stdev|p?variance)\("
        r"|\bscipy\.stats\.sem\b"
    ),
    "student": re.compile(
        r"\bstudent(?:95)?[.(]|\bstats\.t\b|\bstats import t\b|STUDENT_T|\bstudent\d* = \d"
    ),
    "zero": re.compile(r"\bbrentq\b|\bbisect\(|\broot_scalar\b|\bfsolve\b"),
}
ALLOWED = {
    ("paper/coarse_zero.py", "zero"): "the zero of a curve with gaps in N",
    ("paper/verdicts.py", "student"): "the margin of a verdict, three standard deviations",
    (
        "paper/authors_data.py",
        "scatter",
    ): "one run of the authors is compared with three of ours: the scatter of single runs",
    ("bench/other_scenes.py", "scatter"): "scales noise, and estimates no error",
    ("paper/cluster_axis.py", "scatter"): "how much an angle varies, which is no error of a mean",
    (
        "paper/chapters/critical.py",
        "student",
    ): "the error of an exponent, from a fit with few points",
    (
        "examples/custom_measurement.ipynb",
        "scatter",
    ): "shows that the scatter of runs agrees with their errors",
    (
        "web/src/engine/estimates.ts",
        "student",
    ): "the factor for four quarters of the run on display",
}


def code_of(file):
    """The statements of a file; comments may name what they explain."""
    text = file.read_text(encoding="utf-8")
    if file.suffix == ".ipynb":
        return "\n".join(
            "".join(cell["source"])
            for cell in json.loads(text)["cells"]
            if cell["cell_type"] == "code"
        )
    if file.suffix == ".ts":
        return re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)
    return re.sub(r'""".*?"""|#[^\n]*', "", text, flags=re.S)


def estimators():
    """{(file, kind)} of the scripts that compute such a number themselves."""
    files = [
        file
        for folder, pattern in (
            ("paper", "*.py"),
            ("examples", "*.py"),
            ("examples", "*.ipynb"),
            ("bench", "*.py"),
            ("docs", "*.ipynb"),
            ("web/src", "*.ts"),
        )
        for file in (SOURCE / folder).rglob(pattern)
        if "tests" not in file.parts[len(SOURCE.parts) :]
    ]
    return {
        (file.relative_to(SOURCE).as_posix(), kind)
        for file in files
        for kind, own in OWN.items()
        if own.search(code_of(file))
    }


class Estimators(unittest.TestCase):
    def test_no_script_has_an_estimator_of_its_own(self):
        self.assertEqual(estimators(), set(ALLOWED))

    def test_own_estimators_are_found(self):
        for kind, code in (
            ("scatter", "error = np.std(rates, ddof=1) / np.sqrt(len(rates))"),
            ("scatter", "rates.std()"),
            ("student", "const student = 3.18 / 1.96, error = student * scatter"),
            ("zero", "brentq(curve, 5, 48)"),
        ):
            self.assertTrue(OWN[kind].search(code), code)


if __name__ == "__main__":
    unittest.main()
