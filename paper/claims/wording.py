"""Texts about numbers and curves."""

import math
import re

from paper.verdicts import HOLDS, Value, largest_reversal, measured, rises

from paper.claims import thresholds as size

# The found text of a claim has the value that is judged first, then, after this, those of other
# settings.
ALSO = " For comparison: "
SHORTEST, LONGEST = 40, 150  # characters of a headline


def number(mean, error=math.nan):
    """1.234 ± 0.012, with as many digits as the error supports; n/a if the mean is unknown.

    This is swirl.with_error() for claims, which are judged without the module;
    paper/tests/stored_runs_test.py compares them."""
    if isinstance(mean, Value):
        mean, error = mean.mean, mean.error
    if mean is None or not math.isfinite(mean):
        return "n/a"
    if error is None or not 1e-14 * abs(mean) < error < math.inf:
        text = f"{mean:.3g}"
    elif error < 1e-9:
        text = f"{mean:.2g} ± {error:.1g}"
    else:
        magnitude = math.floor(math.log10(error))
        # An error that starts with 1 has two digits, others have one.
        digits = min(12, max(0, (1 if error / 10.0**magnitude < 1.95 else 0) - magnitude))
        text = f"{mean:.{digits}f} ± {error:.{digits}f}"
    return f"−{text[1:]}" if text.startswith("-") else text


def known(rows, name):
    """Rows that have this number."""
    return [row for row in rows if row[name] == row[name]]


def values(rows, name):
    return [measured(row, name) for row in rows]


def value_at(row, name):
    return f"{number(measured(row, name))} at N = {row['discs']:.0f}"


def ends(rows, name):
    """The first and the last number of a curve."""
    rows = known(rows, name)
    return f"{value_at(rows[0], name)}, {value_at(rows[-1], name)}"


def lowest_to_highest(rows, name):
    found = sorted(values(known(rows, name), name), key=lambda v: v.mean)
    return f"{number(found[0])} to {number(found[-1])}"


def monotonic(rows, name, falling=False, least=None):
    """Judges if a curve rises (or falls) with N by `least`, by default size.LEAST_CHANGE of its
    first value. Returns the judgement and a text on the largest reversal."""
    rows = known(rows, name)
    found = values(rows, name)
    rising = [-v for v in found] if falling else found
    if least is None:
        least = size.LEAST_CHANGE * abs(found[0].mean)
    judgement, reversal = rises(rising, least), largest_reversal(rising)
    if reversal is None or judgement.verdict == HOLDS:
        return judgement, ""
    first, last = (rows[k] for k in reversal)
    return judgement, (
        f", but it {'rises' if falling else 'falls'} from {value_at(first, name)} to "
        f"{value_at(last, name)}"
    )


def count(judgements, verdict=HOLDS):
    return sum(judgement.verdict == verdict for judgement in judgements)


def headline(found):
    """The decisive numbers of what was found: the beginning, up to whole clauses of about LONGEST
    characters."""
    text = re.sub(r"^(?:Smooth spheres|Discs with μ = 1)[:,] ", "", found.split(ALSO)[0])
    text = re.sub(
        r" \((?:over all N|required|more than|rotating|rotation|nearer|opposite|no "
        r"order|loose|quickly|little|prevented|"
        r"to the left|similar|near|5% of|by more|earlier|the same|often|slower|a couple|a rise|as "
        r"fast|no spinning|around|"
        r"it blows|cannot|rigid|several|qualitatively|layers|top left|within \d)[^()]*\)",
        "",
        text,
    )
    clauses = re.split(r"(?<=; )|(?<=\. )(?=[A-Z])", text)
    kept = clauses[0]
    for clause in clauses[1:]:
        if len(kept) >= SHORTEST and len(kept) + len(clause) > LONGEST:
            break
        kept += clause
    if len(kept) > LONGEST + SHORTEST:  # a long clause ends at its last comma within the length
        cut = re.match(rf"(.{{{SHORTEST},{LONGEST}}}), (?!\d|and \d)", kept, re.S)
        kept = cut[1] if cut and re.search(r"\d\.\d", cut[1]) else kept
    return kept.strip().rstrip(";.,:")
