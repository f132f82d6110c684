"""Figures with measured quantities and the rotation against the number of particles, a curve for
each setting."""

from paper.curves import at_both_ends, curve_tables, curves_by
from paper.runs import measured_point, points_of


def findings_of(points, frictions, words):
    """Sentences about the quantities {name: words}, for each curve."""
    return [
        at_both_ends(
            [p for p in points if p.cells["setting"] == friction.name],
            what,
            friction.words,
            quantity,
        )
        for friction in frictions
        for quantity, what in words.items()
    ]


def against_n(frictions, quantities="", words=(), with_crossings=False):
    """The functions `points` and `table` of a figure. `words` are {quantity: how findings call
    it}."""

    def points(settings):
        return [
            measured_point(settings, friction, discs)
            for friction, discs in points_of(settings, frictions)
        ]

    def table(points, settings):
        curves = curves_by(points, "setting")
        words = {friction.name: friction.words for friction in frictions}
        findings = [
            f"{words[curve.name]}, ϖ by time: {curve.sentence()}"
            for curve in curves
            if with_crossings
        ]
        return (
            curve_tables(points, curves, quantities.split()),
            findings + findings_of(points, frictions, dict(words)),
        )

    return points, table
