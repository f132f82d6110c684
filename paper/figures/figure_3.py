"""Figures 3a and 3b: angular velocity of the discs about the centre of mass against the angle, also
relative to that of the wall."""

from paper import style
from paper.combine import at, failed, number, steadiness
from paper.curves import measured_cells, with_error
from paper.figure import Figure
from paper.runs import HALF, HIGH, SMOOTH, measured_point, points_of

FRICTIONS = (HIGH, SMOOTH, HALF)
WORDS = {friction.name: friction.words for friction in FRICTIONS}
FIRST = ("setting", "discs", "point", "averaged_runs", "steady_state")
PROFILE = (
    "theta",
    "visits",
    "varpi_m",
    "varpi_m_error",
    "wall",
    "normalised",
    "normalised_error",
    "distance",
    "distance_error",
    "speed",
    "speed_error",
)
# Angles by the SI's criterion, by collisions, and by residences in the wall layer.
ANGLES = """pinned.pinning pinned.depinning pinned.pinning_by_collisions pinned.depinning_by_collisions pinned.share
    residence.pinning=residence_begin residence.depinning=residence_end residence.share=residence_share
    residence.length=residence_length""".split()
LEAST_VISITS = 200  # a slice of θ with fewer visits is not drawn
ENDS = (
    ("residence_begin", "v", "residences at the wall begin"),
    ("residence_end", "o", "residences end"),
)
EDGE = {"markeredgecolor": style.BLACK, "markeredgewidth": 0.4}


def points(settings):
    return [
        measured_point(settings, friction, discs)
        for friction, discs in points_of(settings, FRICTIONS)
    ]


def first_cells(point):
    """The cells by which every row of a profile begins."""
    return dict(
        zip(
            FIRST,
            (
                point.cells["setting"],
                point.cells["discs"],
                point.name,
                at(point.result, "seeds", "averaged"),
                steadiness(point.result),
            ),
        )
    )


def sensitivity(points):
    """The residences in the wall layer for other thresholds."""
    rows = []
    for point in points:
        found = at(point.result, "measured", "residence", "sensitivity") or {}
        rows += [
            {
                "setting": point.cells["setting"],
                "discs": point.cells["discs"],
                **dict(zip(found, values)),
            }
            for values in zip(*found.values())
        ]
    return rows, None if rows else ["setting", "discs"]


def pinning_findings(point):
    """The positions at which discs pin and depin at one N, by residences and by the SI's
    criterion."""
    where = f"{WORDS[point.cells['setting']]}, N = {point.cells['discs']}"

    def words(criterion):
        found = point.result["measured"][criterion]
        return [with_error(found[name]) for name in ("pinning", "depinning", "share")] + [
            number(found["depinning"].get("concentration"))
        ]

    begin, end, share, resultant = words("residence")
    pin, depin, pinned, little = words("pinned")
    return [
        f"{where}, residences in the wall layer: they begin at θ = {begin}° and end at {end}° "
        f"(resultant {resultant:.2f}); {share} of the discs reside there.",
        f"{where}, the SI's criterion: they pin at θ = {pin}° and depin at {depin}° (resultant "
        f"{little:.2f}: the mean "
        f"of directions that nearly cancel has little meaning); {pinned} of the discs are pinned.",
    ]


def table_of(name):
    def table(points, settings):
        rows, findings = [], []
        columns = [
            *FIRST,
            *PROFILE,
            *measured_cells(None, ANGLES),
            "depinning_resultant",
            "residence_end_resultant",
        ]
        for k, point in enumerate(points):
            if failed(point.result):
                continue
            profile = point.result["measured"]["profile"]
            ends = [
                number(at(point.result, "measured", criterion, "depinning", "concentration"))
                for criterion in ("pinned", "residence")
            ]
            last = [*measured_cells(point.result, ANGLES).values(), *ends]
            rows += [
                dict(zip(columns, (*first_cells(point).values(), *cells, *last)))
                for cells in zip(*(profile[column] for column in PROFILE))
            ]
            neighbours = [p.cells["setting"] for p in points[max(k - 1, 0) : k + 2]]
            if (
                len(neighbours) < 3 or len(set(neighbours)) > 1
            ):  # the first or last N of its setting
                findings += pinning_findings(point)
        return {
            "": (rows, columns),
            **({"_sensitivity": sensitivity(points)} if name == "3a" else {}),
        }, findings

    return table


# --- Drawing --------------------------------------------------------------------------------------


def sliding(rows, width):
    """The profile of one number of discs in slices of `width` degrees that slide by one slice of
    the table, like the paper's "angular slice slides around the entire container". All visits have
    the same weight; the normalised angular velocity is the ratio of the two means."""
    result = []
    for row in rows:
        here = [
            other
            for other in rows
            if abs((other["theta"] - row["theta"] + 180) % 360 - 180) < width / 2
        ]
        visits = sum(other["visits"] for other in here)

        def mean(name):
            return sum(other["visits"] * other[name] for other in here if other["visits"]) / visits

        if visits:
            result.append(
                row
                | {
                    "visits": visits,
                    "varpi_m": mean("varpi_m"),
                    "wall": mean("wall"),
                    "normalised": mean("varpi_m") / mean("wall"),
                }
            )
    return result


def drawn(quantity, level, label):
    """A curve for each number of discs, and the mean angles where residences at the wall begin and
    end."""

    def draw(table, slice_width=0.0):
        rows = style.read(table)
        numbers = style.distinct(rows, "discs")
        settings = [name for name in style.LOOKS if style.select(rows, setting=name)]
        drawing, panels = style.figure(
            width=style.PAGE,
            height=2.7,
            ncols=len(settings),
            sharex=True,
            sharey=True,
            squeeze=False,
        )
        colors = style.plt.get_cmap("viridis")
        span = max(numbers[-1] - numbers[0], 1)
        for axes, setting in zip(panels[0], settings):
            axes.set_title(style.LOOKS[setting][0])
            for discs in style.distinct(style.select(rows, setting=setting), "discs"):
                here = style.select(rows, setting=setting, discs=discs)
                draw_profile(
                    axes,
                    sliding(here, slice_width) if slice_width else here,
                    quantity,
                    colors(0.95 * (discs - numbers[0]) / span),
                )
            axes.axhline(level, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
            axes.set_xlim(0, 360)
            axes.set_xticks(range(0, 361, 90))
        handles = [
            panels[0][0].plot(
                [], [], marker, color=style.GREY, **EDGE, markersize=3.5, label=words
            )[0]
            for _, marker, words in ENDS
        ]
        panels[0][len(settings) // 2].set_xlabel(
            r"angular position $\theta$ in the M-frame (°); M is at 270°"
        )
        panels[0][0].set_ylabel(label)
        style.legend_of_all(drawing, handles, ncol=2)
        drawing.colorbar(style.scale(numbers, colors), ax=panels).set_label(
            r"number of particles $N$"
        )
        style.note_not_steady(drawing, rows)
        style.save(drawing, table)

    return draw


def draw_profile(axes, rows, quantity, color):
    shown = [row for row in rows if row["visits"] > LEAST_VISITS]
    axes.plot(
        style.column(shown, "theta"),
        style.column(shown, quantity),
        color=color,
        linewidth=0.8,
        linestyle=":" if style.not_steady(shown) else "-",
    )
    for angle, marker, _ in ENDS:
        here = [row for row in shown if row[angle] == row[angle]]
        if here:
            nearest = min(here, key=lambda row: abs((row["theta"] - row[angle] + 180) % 360 - 180))
            axes.plot(
                nearest[angle],
                nearest[quantity],
                marker,
                color=color,
                markersize=3.2,
                **EDGE,
                zorder=3,
            )


FIGURES = [
    Figure(
        "3a",
        "paper",
        "angular velocity against the angular position",
        points,
        table_of("3a"),
        drawn("varpi_m", -1, r"$\langle\varpi_{M,i}\rangle/\Omega$"),
    ),
    Figure(
        "3b",
        "paper",
        "angular velocity relative to that of the wall",
        points,
        table_of("3b"),
        drawn("normalised", 1, r"$\langle\varpi_{M,i}\rangle/\langle\varpi_{\rm wall}\rangle$"),
    ),
]
