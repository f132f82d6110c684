"""The coefficients of a micropolar fluid (micropolar.py), and the share of the stresses that they
explain, by packing fraction, in several dishes."""

from paper import style
from paper.chapters.fields import LEAST_POINTS, RANGES, WALL, dish_points, seeds_of
from paper.curves import CERTAIN
from paper.figure import Figure
from paper.micropolar import RELATIONS, fit_relation

PANELS = (
    ("rotational_viscosity", r"rotational viscosity $\Gamma$"),
    ("shear_viscosity", r"shear viscosity $\eta$"),
    ("spin_diffusion", "spin diffusion $D$"),
    ("angle", r"angle of the stress $\alpha$ (°)"),
)
DISH = ("container_radius", "amplitude_ratio", "discs")


def closure_points(settings):
    return dish_points(
        settings,
        [(17.2, 0.45)]
        if settings.quick
        else [
            (34.4, 0.42),
            (34.4, 0.26),
            (34.4, 0.55),
            (17.2, 0.45),
            (17.2, 0.45, 0.15),
            (17.2, 0.45, 0.33),
        ],
    )


def closure_table(points, settings):
    rows, findings = [], []
    dishes = [(point, seeds_of(point)) for point in points]
    for relation in RELATIONS:
        fits, certain = 0, []
        for point, seeds in dishes:
            for low, high in RANGES:
                fit = fit_relation(
                    seeds, relation, low, high, point.cells["container_radius"] - WALL
                )
                if fit.points < LEAST_POINTS:
                    continue
                rows.append(
                    {
                        **point.cells,
                        "relation": relation.name,
                        "packing_low": low,
                        "packing_high": high,
                        "coefficient": fit.coefficient[0],
                        "coefficient_error": fit.coefficient[1],
                        "explained": fit.explained[0],
                        "explained_error": fit.explained[1],
                        "points": fit.points,
                        "seeds": len(seeds),
                    }
                )
                fits += 1
                if fit.coefficient[0] > CERTAIN * fit.coefficient[1]:
                    certain.append(fit.explained[0])
        explained = (
            certain
            and f", where it explains {min(certain):.2f} to {max(certain):.2f} of the "
            f"{relation.explains}"
        )
        findings.append(
            f"The {relation.words} is certainly positive in {len(certain)} of {fits} ranges of the "
            f"packing fraction{explained or ''}."
        )
    return {"": rows}, findings


def draw_closure(table):
    rows = style.read(table)
    panels = [panel for panel in PANELS if style.select(rows, relation=panel[0])]
    drawing, axes = style.figure(style.PAGE, 4.2, ncols=len(panels), nrows=2, sharex=True)
    dishes = sorted({tuple(row[name] for name in DISH) for row in rows})
    for column, (relation, words) in enumerate(panels):
        upper, lower = axes[0][column], axes[1][column]
        style.zero_line(upper)
        for k, dish in enumerate(dishes):
            radius, ratio, discs = dish
            here = [
                row
                | {"packing": 0.5 * (row["packing_low"] + row["packing_high"]) + 0.008 * (k - 1.5)}
                for row in style.select(rows, relation=relation, **dict(zip(DISH, dish)))
            ]
            look = {
                "color": style.CYCLE[k],
                "marker": style.MARKERS[k],
                "linestyle": "-",
                "linewidth": 0.6,
                "elinewidth": 0.7,
            }
            for panel, name in ((upper, "coefficient"), (lower, "explained")):
                panel.errorbar(
                    style.column(here, "packing"),
                    style.column(here, name),
                    yerr=style.column(here, name + "_error"),
                    **look,
                    label=f"$R/r$ = {radius:g}, $A/R$ = {ratio:g}, $N$ = {discs:.0f}",
                )
        known = style.select(rows, relation=relation)
        style.fine_near_zero(
            upper,
            [
                row["coefficient"] + sign * row["coefficient_error"]
                for row in known
                for sign in (-1, 0, 1)
            ],
            linear=1,
        )
        upper.set_title(words)
        lower.set_ylim(bottom=min(0, lower.get_ylim()[0]), top=max(1.05, lower.get_ylim()[1]))
        lower.set_xlabel(r"packing fraction $\varphi$")
    axes[0][0].set_ylabel(r"coefficient/$\sqrt{mT}$")
    axes[1][0].set_ylabel("share explained")
    if any(row["coefficient"] < 0 for row in rows):
        style.note(
            drawing, "negative coefficients: torque or force against the sign of the relation"
        )
    style.legend_of_all(drawing, axes[0][0], ncol=3)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "closure",
        "chapters",
        "chapter: the coefficients of a micropolar fluid",
        closure_points,
        closure_table,
        draw_closure,
    )
]
