"""One claim of the paper."""

import os

import tables
from verdicts import MISSING, UNDECIDED, UNTESTABLE, Judgement

from . import thresholds

# On what a claim is judged. Figures 1 to 4 and the text on particles are about the experiment, whose spheres
# roll on a floor; Figure 5 and the SI are about the discs of the paper's simulation.
SPHERES, DISCS, BOTH, NOTHING = "spheres", "discs", "both", "nothing"

NAMES = {"discs": "N", "mu": "μ"}

# The verdict on a statement that no table decides.
UNTESTED = "not tested"


class Judged:
    """A claim with its judgement, what was found, and {factor: verdict} with its sizes multiplied by the factor."""

    def __init__(self, claim, judgement, found, scaled=None):
        self.claim, self.judgement, self.found, self.scaled = claim, judgement, found, scaled or {}

    @property
    def verdict(self):
        return self.judgement.verdict

    @property
    def depends_on_size(self):
        return any(verdict != self.verdict for verdict in self.scaled.values())


class Claim:
    """`judge(study)` returns (Judgement, what was found); `figure` names the figure whose runs it needs, `on` the
    particles it is judged on. `needs`: (table, {column: value of the rows}, column, values that it must have), the
    points that must have been run. Without one of them the claim is undecided: fewer data must not decide more."""

    def __init__(self, source, statement, figure, judge, on, needs=()):
        self.source, self.statement, self.figure, self.judge = source, statement, figure, judge
        self.on, self.needs = on, needs

    @property
    def command(self):
        return f"swirl paper --figure {self.figure}" if self.figure else ""

    def judged(self, study):
        """(Judgement, what was found) from the tables of the study."""
        try:
            judgement, found = self.judge(study)
            missing = self.missing_points(study)
        except FileNotFoundError as error:
            return Judgement(MISSING), f"The table {os.path.basename(error.filename)} does not exist."
        except KeyError as error:
            return Judgement(MISSING), f"Its table has no column or curve '{error.args[0]}'."
        except (IndexError, ValueError, ZeroDivisionError):
            return Judgement(MISSING), "The table has too few runs."
        if missing:
            return Judgement(UNDECIDED), f"Not decided without these points: {missing}. {found}"
        return judgement, found

    def missing_points(self, study):
        missing = []
        for table, rows, column, needed in self.needs:
            run = {row[column] for row in tables.select(study.table(table), **rows)
                   if row.get("steady_state") != "failed"}
            absent = [f"{value:g}" for value in needed if value not in run]
            if absent:
                missing.append(f"figure {table}, {', '.join(rows.values())}, {NAMES[column]} = {', '.join(absent)}")
        return "; ".join(missing)

    def judged_with_sizes(self, study):
        def verdict(factor):
            with thresholds.scaled(factor):
                return self.judged(study)[0].verdict
        return Judged(self, *self.judged(study), {factor: verdict(factor) for factor in (0.5, 2)})


def untested(reason):
    """The judge of a statement that no table decides."""
    return lambda study: (Judgement(UNTESTED), reason)


def by_construction(reason):
    """The judge of a statement that the model contains, so that no run of it could show the opposite."""
    return lambda study: (Judgement(UNTESTABLE), f"True by construction. {reason}")
