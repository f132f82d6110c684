"""Figures 3a and 3b: angular velocity of the discs about the centre of mass against the angle, also relative to that of
the wall."""

import style
from combine import at, failed, number, steadiness
from curves import measured_cells, with_error
from figure import Figure
from runs import HALF, HIGH, SMOOTH, measured_point, points_of

FRICTIONS = (HIGH, SMOOTH, HALF)
WORDS = {friction.name: friction.words for friction in FRICTIONS}
FIRST = ("setting", "discs", "point", "averaged_runs", "steady_state")
PROFILE = ("theta", "visits", "varpi_m", "varpi_m_error", "wall", "normalised", "normalised_error", "distance",
           "distance_error", "speed", "speed_error")
# Angles by the SI's criterion, by collisions, and by residences in the wall layer.
ANGLES = """pinned.pinning pinned.depinning pinned.pinning_by_collisions pinned.depinning_by_collisions pinned.share
    residence.pinning=residence_begin residence.depinning=residence_end residence.share=residence_share
    residence.length=residence_length""".split()


def points(settings):
    return [measured_point(settings, friction, discs) for friction, discs in points_of(settings, FRICTIONS)]


def first_cells(point):
    """The cells by which every row of a profile begins."""
    return dict(zip(FIRST, (point.cells["setting"], point.cells["discs"], point.name,
                            at(point.result, "seeds", "averaged"), steadiness(point.result))))


def sensitivity(points):
    """The residences in the wall layer for other thresholds."""
    rows = []
    for point in points:
        found = at(point.result, "measured", "residence", "sensitivity") or {}
        rows += [{"setting": point.cells["setting"], "discs": point.cells["discs"], **dict(zip(found, values))}
                 for values in zip(*found.values())]
    return rows, None if rows else ["setting", "discs"]


def pinning_findings(point):
    """The positions at which discs pin and depin at one N, by residences and by the SI's criterion."""
    where = f"{WORDS[point.cells['setting']]}, N = {point.cells['discs']}"

    def words(criterion):
        found = point.result["measured"][criterion]
        return ([with_error(found[name]) for name in ("pinning", "depinning", "share")] +
                [number(found["depinning"].get("concentration"))])
    begin, end, share, resultant = words("residence")
    pin, depin, pinned, little = words("pinned")
    return [f"{where}, residences in the wall layer: they begin at θ = {begin}° and end at {end}° (resultant "
            f"{resultant:.2f}); {share} of the discs reside there.",
            f"{where}, the SI's criterion: they pin at θ = {pin}° and depin at {depin}° (resultant {little:.2f}: the mean "
            f"of directions that nearly cancel has little meaning); {pinned} of the discs are pinned."]


def table_of(name):
    def table(points, settings):
        rows, findings = [], []
        columns = [*FIRST, *PROFILE, *measured_cells(None, ANGLES), "depinning_resultant", "residence_end_resultant"]
        for k, point in enumerate(points):
            if failed(point.result):
                continue
            profile = point.result["measured"]["profile"]
            ends = [number(at(point.result, "measured", criterion, "depinning", "concentration"))
                    for criterion in ("pinned", "residence")]
            last = [*measured_cells(point.result, ANGLES).values(), *ends]
            rows += [dict(zip(columns, (*first_cells(point).values(), *cells, *last)))
                     for cells in zip(*(profile[column] for column in PROFILE))]
            neighbours = [p.cells["setting"] for p in points[max(k - 1, 0):k + 2]]
            if len(neighbours) < 3 or len(set(neighbours)) > 1:  # the first or last N of its setting
                findings += pinning_findings(point)
        return {"": (rows, columns), **({"_sensitivity": sensitivity(points)} if name == "3a" else {})}, findings
    return table


def draw_3a(table, slice_width=0.0):
    style.profiles(table, slice_width, "varpi_m", -1, r"$\langle\varpi_{M,i}\rangle/\Omega$")


def draw_3b(table, slice_width=0.0):
    style.profiles(table, slice_width, "normalised", 1, r"$\langle\varpi_{M,i}\rangle/\langle\varpi_{\rm wall}\rangle$")


FIGURES = [Figure("3a", "paper", "angular velocity against the angular position", points, table_of("3a"), draw_3a),
           Figure("3b", "paper", "angular velocity relative to that of the wall", points, table_of("3b"), draw_3b)]
