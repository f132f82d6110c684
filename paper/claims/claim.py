"""One claim of the paper."""

import math
import os

from paper import tables
from paper.verdicts import MISSING, UNDECIDED, UNTESTABLE, Judgement

from paper.claims import thresholds

# On what a claim is judged. Figures 1 to 4 and the text on particles are about the experiment,
# whose spheres roll on a floor; Figure 5 and the SI are about the discs of the paper's simulation.
SPHERES, DISCS, BOTH, NOTHING = "spheres", "discs", "both", "nothing"

NAMES = {"discs": "N", "mu": "μ"}

# The verdict on a statement that no table decides.
UNTESTED = "not tested"


class Judged:
    """A claim with its judgement, what was found, and {factor: verdict} with its sizes multiplied
    by the factor."""

    def __init__(self, claim, judgement, found, scaled=None):
        self.claim, self.judgement, self.found, self.scaled = claim, judgement, found, scaled or {}

    @property
    def verdict(self):
        return self.judgement.verdict

    @property
    def depends_on_size(self):
        return any(verdict != self.verdict for verdict in self.scaled.values())


class Claim:
    """`judge(study)` returns (Judgement, what was found); `figure` names the figure whose runs it
    needs, `on` the particles it is judged on. `needs`: (table, {column: value of the rows}, column,
    values that it must have), the points that must have been run. Without one of them, or if its
    runs are shorter than thresholds.LEAST_PERIODS or `least_events`, the claim is undecided: fewer
    data must not decide more."""

    def __init__(self, source, statement, figure, judge, on, needs=(), least_events=0):
        self.source, self.statement, self.figure, self.judge = source, statement, figure, judge
        self.on, self.needs, self.least_events = on, needs, least_events

    @property
    def command(self):
        return f"swirl paper --figure {self.figure}" if self.figure else ""

    def judged(self, study):
        """(Judgement, what was found) from the tables of the study."""
        try:
            judgement, found = self.judge(study)
            problem = self.why_undecided(study)
        except FileNotFoundError as error:
            return (
                Judgement(MISSING),
                f"The table {os.path.basename(error.filename)} does not exist.",
            )
        except KeyError as error:
            return Judgement(MISSING), f"Its table has no column or curve '{error.args[0]}'."
        except (IndexError, ValueError, ZeroDivisionError):
            return Judgement(MISSING), "The table has too few runs."
        if problem:
            return Judgement(UNDECIDED), f"{problem}. {found}"
        return judgement, found

    def why_undecided(self, study):
        """What the data lack to decide the claim; empty if they suffice."""
        return self.missing_points(study) or self.short_runs(study)

    def needed_rows(self, study):
        """(table, columns of the rows, the needed rows that did not fail, column, values) of each
        entry of `needs`."""
        for table, of_rows, column, needed in self.needs:
            rows = [
                row
                for row in tables.select(study.table(table), **of_rows)
                if row.get("steady_state") != "failed"
            ]
            yield table, of_rows, [row for row in rows if row[column] in needed], column, needed

    def missing_points(self, study):
        missing = []
        for table, of_rows, rows, column, needed in self.needed_rows(study):
            absent = [
                f"{value:g}" for value in needed if value not in {row[column] for row in rows}
            ]
            if absent:
                missing.append(
                    f"figure {table}, {', '.join(of_rows.values())}, {NAMES[column]} = "
                    f"{', '.join(absent)}"
                )
        return f"Not decided without these points: {'; '.join(missing)}" if missing else ""

    def short_runs(self, study):
        """Why the shortest of the needed runs decides nothing; empty if it is long enough."""
        rows = [row for _, _, rows, _, _ in self.needed_rows(study) for row in rows]
        averaged = least(
            row.get("periods", math.inf) - row.get("warmup_periods", 0) for row in rows
        )
        events = least(row.get("events", math.inf) for row in rows)
        # The mean over a whole run, from its first event on, contains the transient by definition.
        if not self.least_events and averaged < thresholds.LEAST_PERIODS:
            return (
                f"Not decided by runs that average over {averaged:.0f} periods; "
                f"{thresholds.LEAST_PERIODS:.0f} are "
                "needed, because they still contain the memory of the initial state"
            )
        if events < self.least_events:
            return (
                f"Not decided by runs of {events:,.0f} events, which cover less of the transient "
                f"than the paper's of {self.least_events:,.0f}"
            )
        return ""

    def judged_with_sizes(self, study):
        def verdict(factor):
            with thresholds.scaled(factor):
                return self.judged(study)[0].verdict

        return Judged(self, *self.judged(study), {factor: verdict(factor) for factor in (0.5, 2)})


def least(numbers):
    """The smallest of the known ones; infinity if none is known."""
    return min((number for number in numbers if not math.isnan(number)), default=math.inf)


def untested(reason):
    """The judge of a statement that no table decides."""
    return lambda study: (Judgement(UNTESTED), reason)


def by_construction(reason):
    """The judge of a statement that the model contains, so that no run of it could show the
    opposite."""
    return lambda study: (Judgement(UNTESTABLE), f"True by construction. {reason}")
