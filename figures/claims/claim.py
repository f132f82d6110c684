"""One claim of the paper."""

import os

from verdicts import MISSING, Judgement

from .study import Study


class Claim:
    """`judge(study)` returns (Judgement, what was found); `figure` names the figure whose runs it needs."""

    def __init__(self, source, statement, figure, judge):
        self.source, self.statement, self.figure, self.judge = source, statement, figure, judge

    @property
    def command(self):
        return f"swirl paper --figure {self.figure}" if self.figure else ""

    def judged(self, folder):
        """(Judgement, what was found) from the tables in `folder`."""
        try:
            return self.judge(Study(folder))
        except FileNotFoundError as missing:
            return Judgement(MISSING), f"The table {os.path.basename(missing.filename)} does not exist."
        except KeyError as missing:
            return Judgement(MISSING), f"Its table has no column or curve '{missing.args[0]}'."
        except (IndexError, ValueError, ZeroDivisionError):
            return Judgement(MISSING), "The table has too few runs."

    def verdict(self, folder):
        """(verdict, what was found)"""
        judgement, found = self.judged(folder)
        return judgement.verdict, found
