"""The paper's claims, and how the tables of `swirl paper` judge them.

How a claim is judged:

1. catalogue.py lists every claim: its source, its statement, the figure whose table is used, a
   function that judges it, and on what: the spheres of the experiment (settings.py), the discs of
   the paper's simulation, or both. It also names the points that must have been run.
2. That function (rotation.py, profiles.py, residence.py, contacts.py, motion.py, spheres.py) reads
   the tables (study.py) and compares the measured values with bounds. Each bound is a named
   constant with a reason: the paper's numbers are in ../paper_parameters.py, all others in
   thresholds.py.
3. ../verdicts.py turns each comparison into "holds", "does not hold" or "undecided". It has one
   threshold: the probability of three standard deviations, by Student's t.
4. The function returns the judgement and a sentence with the numbers behind it (wording.py).
5. The claim is judged again with all sizes of thresholds.py halved and doubled. A verdict that
   changes depends on our reading of the paper's words, and is marked.

The experiment's two friction coefficients are fitted to its N_c, 36 for smooth and 28 for roughened
spheres. Restitution, floor friction and amplitude are assumptions; ../sensitivity.py has what
depends on them. A statement that no table decides is listed as "not tested", with the reason.
"""

import json
import os

from paper import atomic_file

from paper.claims.catalogue import CLAIMS
from paper.claims.quotes import QUOTES  # noqa: F401
from paper.claims.study import Study


def all_judged(folder):
    """[Judged] of all claims, in the order of the catalogue."""
    study = Study(folder)
    return [claim.judged_with_sizes(study) for claim in CLAIMS]


def claim_stating(statement):
    """The claim with this statement; there is exactly one."""
    (found,) = (claim for claim in CLAIMS if claim.statement == statement)
    return found


def points_to_decide(judged):
    """The names of the points that need more seeds (command.py adds them)."""
    return sorted(set().union(*(j.judgement.points for j in judged)))


def write_verdicts(folder):
    """Writes verdicts.json: every verdict, and the points that need more seeds."""
    judged = all_judged(folder)
    verdicts = {
        "verdicts": [
            {
                "statement": j.claim.statement,
                "judged_on": j.claim.on,
                "verdict": j.verdict,
                "at_half_the_sizes": j.scaled[0.5],
                "at_twice_the_sizes": j.scaled[2],
                "depends_on_size": j.depends_on_size,
                "found": j.found,
                "points": sorted(j.judgement.points),
            }
            for j in judged
        ],
        "points_to_decide": points_to_decide(judged),
    }
    atomic_file.write(
        os.path.join(folder, "verdicts.json"),
        json.dumps(verdicts, indent=1, ensure_ascii=False) + "\n",
    )
