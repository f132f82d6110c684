"""The paper's claims, and how the tables of `swirl paper` judge them.

How a claim is judged:

1. catalogue.py lists every claim: its source, its statement, the figure whose table is used, and a
   function that judges it.
2. That function (rotation.py, profiles.py, residence.py, contacts.py, motion.py, spheres.py) reads the
   tables (study.py) and compares the measured values with bounds. Each bound is a named constant with a
   reason: the paper's numbers are in ../paper_parameters.py, all others in thresholds.py.
3. ../verdicts.py turns each comparison into "holds", "does not hold" or "undecided". It has one threshold:
   the probability of three standard deviations, by Student's t.
4. The function returns the judgement and a sentence with the numbers behind it (wording.py).

Claims not made by the paper are not judged. A fact of the experiment is not judged by the simulated discs,
since the friction of the real particles is unknown. Spheres that roll on a floor are that experiment,
except for their friction. A claim about them must hold for at least one of the friction coefficients that
were run, and all parts of it for the same one. Only a claim about several friction coefficients must hold
for all of them.
"""

from .catalogue import CLAIMS


def all_verdicts(folder):
    """The content of verdicts.json: every verdict, and the points that need more seeds (`swirl paper`
    reads these)."""
    judged = [(claim, *claim.judged(folder)) for claim in CLAIMS]
    return {"verdicts": [{"statement": claim.statement, "verdict": judgement.verdict, "found": found,
                          "points": sorted(judgement.points)} for claim, judgement, found in judged],
            "points_to_decide": sorted(set().union(*(judgement.points for _, judgement, _ in judged)))}
