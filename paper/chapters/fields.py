"""Is a cluster of discs a micropolar fluid? The paper's outlook asks for continuum equations that
couple the spins to the vorticity of the flow. Maps of density, flow and spin in a large dish, and
the torque of the stress against the relation of a micropolar fluid (micropolar.py). The fields have
the kernel of four radii in the M-frame (measure/field_grid.hpp)."""

import math

import numpy as np

from paper import look, style
from paper.combine import at, number
from paper.curves import with_error
from paper.standard_runs import Dish, dish_run
from paper.engine import result_of, swirl
from paper.figure import Figure
from paper.micropolar import RELATIONS, fit_relation
from paper.runs import length_of, lengths
from paper.study import Point

AMPLITUDE = 0.22  # A/R, the paper's
RANGES = [(0.2 + 0.1 * k, 0.2 + 0.1 * (k + 1)) for k in range(7)]  # of the packing fraction
LEAST_POINTS = 10
# A kernel of four radii is out of reach of the wall's contacts, which extend inwards to the centres
# of the discs.
WALL = 1 + 4
RESIDUALS = ("mass_residual", "momentum_residual", "spin_residual")


# --- Runs -----------------------------------------------------------------------------------------


def fields_run(parameters):
    """The means of all columns, and the largest residual of the three balances."""
    fields = at(result_of(parameters, ["fields"]), "measured", "fields")
    return {
        "fields": {
            name: column
            for name, column in fields["m_frame_4"].items()
            if not name.endswith("_error")
        },
        "residual": max(number(fields[name]) for name in RESIDUALS),
    }


def dish_points(settings, dishes):
    points = []
    for radius, fraction, *amplitude in dishes:
        dish = Dish(radius, *(amplitude or (AMPLITUDE,)))
        run = dish_run(dish, dish.discs(fraction)) | lengths(settings, (10, 2), (30, 5))
        # The jackknife needs four seeds.
        points.append(
            Point(
                settings,
                f"fields_R{radius}_A{dish.amplitude}_N{run['discs']}_{length_of(run)}",
                4 if settings.quick else 8,
                run,
                work=fields_run,
                cells={
                    "container_radius": radius,
                    "amplitude_ratio": dish.amplitude,
                    "discs": run["discs"],
                },
            )
        )
    return points


def fields_points(settings):
    return dish_points(settings, [(17.2, 0.45) if settings.quick else (34.4, 0.42)])


def seeds_of(point):
    return [
        {
            name: np.array([number(value) for value in column])
            for name, column in run["fields"].items()
        }
        for run in point.runs
    ]


# --- Maps -----------------------------------------------------------------------------------------

MAPPED = ("packing", "u_x", "u_y", "spin", "vorticity", "torque")


def fields_table(points, settings):
    (point,), seeds, radius = points, seeds_of(points[0]), points[0].cells["container_radius"]
    columns = [
        "x",
        "y",
        *(f"{name}{end}" for name in (*MAPPED, "relation") for end in ("", "_error")),
    ]
    if not seeds:
        return {"": ([], columns)}, []
    x, y = seeds[0]["x"], seeds[0]["y"]
    inside, viscosity, words = x * x + y * y < radius * radius, np.full(len(x), math.nan), []

    def mean(arrays):
        return swirl.mean(np.array(arrays).T)[:2]

    maps = {name: mean([f[name] for f in seeds]) for name in MAPPED}
    packing = maps["packing"][0]
    for low, high in RANGES:
        fit = fit_relation(seeds, RELATIONS[0], low, high, radius - WALL)
        if fit.points >= LEAST_POINTS:
            here = (packing >= low) & (packing < high) & (x * x + y * y < (radius - WALL) ** 2)
            viscosity[here] = fit.coefficient[0]
            words.append(f"{with_error(*fit.explained)} at {low:.1f}–{high:.1f}")
    maps["relation"] = mean([viscosity * RELATIONS[0].terms[0](f)[0] for f in seeds])
    values = np.array([x, y, *(column for pair in maps.values() for column in pair)])[:, inside].T
    residual = max(run["residual"] for run in point.runs)
    return {"": ([dict(zip(columns, row)) for row in values.tolist()], columns)}, [
        f"R/r = {radius}, N = {point.cells['discs']}, {len(seeds)} seeds: Γ(curl u − 2ω) explains "
        "this share of the torque "
        f"of the stress, by packing fraction: {'; '.join(words)}. Largest residual of the balances "
        f"of mass, momentum and spin, relative to rounding errors: {residual:.1g}."
    ]


def panel(drawing, axes, rows, name, label, unit, colors, symmetric, limit=None):
    x, y, image = style.grid(rows, "x", "y", name)
    step = x[1] - x[0]
    extent = [x[0] - step / 2, x[-1] + step / 2, y[0] - step / 2, y[-1] + step / 2]
    limit = limit or symmetric and np.nanquantile(np.abs(image), 0.98)
    shown = axes.imshow(
        image,
        origin="lower",
        extent=extent,
        cmap=colors,
        vmin=-limit if symmetric else 0,
        vmax=limit or None,
    )
    radius = extent[1]
    shown.set_clip_path(style.plt.Circle((0, 0), radius, transform=axes.transData))
    axes.add_patch(style.plt.Circle((0, 0), radius, fill=False, linewidth=0.8))
    axes.set_axis_off()
    axes.set(
        aspect="equal", xlim=(-1.03 * radius, 1.03 * radius), ylim=(-1.03 * radius, 1.03 * radius)
    )
    axes.set_title(label, loc="left")
    drawing.colorbar(shown, ax=axes, shrink=0.7, pad=0.1, label=unit)
    return limit


def about_the_mean(rows):
    """The flow less its mean, with the packing fraction as weight: the whole cluster moves relative
    to the container."""
    total = sum(row["packing"] for row in rows)
    mean = {
        name: sum(row["packing"] * row[name] for row in rows) / total for name in ("u_x", "u_y")
    }
    return [row | {name: row[name] - mean[name] for name in mean} for row in rows]


def draw_fields(table):
    rows = style.read(table)
    drawing, axes = style.figure(style.PAGE, 4.3, ncols=3, nrows=2)
    dense = [row for row in rows if row["packing"] > 0.05]
    panel(
        drawing,
        axes[0][0],
        rows,
        "packing",
        "(a) packing and flow",
        r"packing fraction $\varphi$",
        "Greys",
        False,
    )
    flow = about_the_mean(dense)
    step = style.distinct(rows, "x")
    style.arrows(
        axes[0][0],
        flow,
        step[1] - step[0],
        max(map(style.speed, flow), default=1.0) or 1.0,
        look.ACCENT,
        key=(0.3, -0.06),
    )
    panel(
        drawing,
        axes[0][1],
        dense,
        "spin",
        r"(b) spin $\omega$",
        r"$\omega$ ($v/r$)",
        style.directions(),
        True,
    )
    half = [row | {"half": 0.5 * row["vorticity"]} for row in dense]
    panel(
        drawing,
        axes[0][2],
        half,
        "half",
        r"(c) half of the vorticity",
        r"$\frac{1}{2}$ curl $u$ ($v/r$)",
        style.directions(),
        True,
    )
    known = [row for row in rows if row["relation"] == row["relation"]]
    limit = panel(
        drawing,
        axes[1][0],
        known or rows,
        "torque",
        "(d) torque of the stress",
        "torque ($m v^2/r^2$)",
        style.directions(),
        True,
    )
    panel(
        drawing,
        axes[1][1],
        known or rows,
        "relation",
        r"(e) $\Gamma\sqrt{mT}\,(\mathrm{curl}\,u - 2\omega)$",
        "torque ($m v^2/r^2$)",
        style.directions(),
        True,
        limit,
    )
    last = axes[1][2]
    style.zero_line(last)
    if known:
        shown = last.scatter(
            style.column(known, "relation"),
            style.column(known, "torque"),
            s=9,
            c=style.column(known, "packing"),
            cmap="viridis",
            zorder=3,
        )
        last.errorbar(
            style.column(known, "relation"),
            style.column(known, "torque"),
            xerr=style.column(known, "relation_error"),
            yerr=style.column(known, "torque_error"),
            fmt="none",
            ecolor="0.6",
            elinewidth=0.5,
        )
        ends = np.array(
            [min(style.column(known, "relation")), max(style.column(known, "relation"))]
        )
        last.plot(ends, ends, color=style.BLACK, linewidth=0.8, label="micropolar fluid")
        drawing.colorbar(shown, ax=last, label=r"$\varphi$", pad=0.02)
        style.legend(last, ncol=1)
    last.set_xlabel(r"$\Gamma\sqrt{mT}\,(\mathrm{curl}\,u - 2\omega)$, $m v^2/r^2$")
    last.set_ylabel(r"torque of the stress, $m v^2/r^2$")
    last.locator_params(axis="x", nbins=3)
    last.set_title("(f) point by point", loc="left", pad=18)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "fields",
        "chapters",
        "chapter: density, flow, spin and torque in a large dish",
        fields_points,
        fields_table,
        draw_fields,
    )
]
