"""Material: how the number N_c at which the direction changes depends on two properties of the
discs."""

from paper import chapter_drawings
from paper.coarse_zero import last_zero
from paper.curves import Curve, highest_of, lowest_of, rows_of, with_error
from paper.figure import Figure
from paper.runs import HIGH, length_of, lengths, paper_run, text, with_periods
from paper.study import Point

# For each figure: the two parameters with their symbols and values, and the values of --quick.
MAPS = {
    "material_inertia": (
        ("inertia", "I", (0.5, 1.0, 3.0, 10.0), (0.5, 10.0)),
        ("restitution", "e", (1.0, 0.97, 0.9), (1.0, 0.9)),
    ),
    "material_friction": (
        ("mu_disc", "μ_d", (0.1, 0.3, 1.0, 3.0), (0.3, 1.0)),
        ("mu_wall", "μ_w", (0.1, 0.3, 1.0, 3.0), (0.3, 1.0)),
    ),
    "material_tangential": (
        ("tangential_restitution", "β", (0.0, 0.25, 0.5, 1.0), (0.0, 0.5)),
        ("inertia", "I", (0.5, 10.0), (0.5, 10.0)),
    ),
}


def points_of(name):
    def points(settings):
        (x_name, _, *xs), (y_name, _, *ys) = MAPS[name]
        # Dense clusters have states of their own at each N, so that no curve through N = 48, 51 and
        # 54 is smooth.
        numbers = (
            [28, 36, 44, 52] if settings.quick else [28, 32, 36, 40, 44, 48, 50, 51, 52, 53, 54]
        )
        made = []
        for x in xs[settings.quick]:
            for y in ys[settings.quick]:
                for discs in numbers:
                    material = {x_name: x, y_name: y}
                    run = with_periods(
                        {**paper_run(settings, HIGH, discs), **material},
                        lengths(settings, (20, 2), (80, 4)),
                    )
                    made.append(
                        Point(
                            settings,
                            f"{name}_x{text(x)}_y{text(y)}_N{discs}_{length_of(run)}",
                            settings.chapter_seeds,
                            run,
                            cells={**material, "discs": discs},
                        )
                    )
        return made

    return points


def table_of(name):
    (x_name, x_symbol, *_), (y_name, y_symbol, *_) = MAPS[name]

    def table(points, settings):
        rows, known = [], []
        for x, y in dict.fromkeys((point.cells[x_name], point.cells[y_name]) for point in points):
            curve = Curve(
                "",
                [point for point in points if (point.cells[x_name], point.cells[y_name]) == (x, y)],
            ).points
            zero, falls = last_zero(curve)
            crossing = (zero.discs, zero.error) if falls else (None, None)
            lowest, highest = (found(curve) or (None,) * 3 for found in (lowest_of, highest_of))
            rows.append(
                {
                    x_name: x,
                    y_name: y,
                    **dict(
                        zip(
                            (
                                "crossing",
                                "crossing_error",
                                "lowest",
                                "lowest_error",
                                "lowest_discs",
                                "highest",
                                "highest_error",
                            ),
                            (*crossing, *lowest[1:], lowest[0], *highest[1:]),
                        )
                    ),
                }
            )
            if falls:
                known.append(
                    (
                        zero.discs,
                        f"{with_error(*crossing)} at {x_symbol} = {text(x)}, {y_symbol} = "
                        f"{text(y)}",
                    )
                )
        # The first of equal ones.
        least, most = (
            found(known, key=lambda one: one[0], default=(0, "none"))[1] for found in (min, max)
        )
        return {"": rows, "_points": rows_of(points)}, [
            f"N_c is lowest, {least}, and highest, {most}; at {len(rows) - len(known)} of "
            f"{len(rows)} settings the "
            f"direction does not certainly change up to N = {points[-1].cells['discs']}."
        ]

    return table


def draw_as(x, y, x_label, y_label):
    return lambda table: chapter_drawings.crossing_map(table, x, y, x_label, y_label)


INERTIA = r"moment of inertia $I/mr^2$"
FIGURES = [
    Figure(
        "material_inertia",
        "chapters",
        "chapter: N_c against inertia and restitution",
        points_of("material_inertia"),
        table_of("material_inertia"),
        draw_as("inertia", "restitution", INERTIA, r"restitution $e$"),
    ),
    Figure(
        "material_friction",
        "chapters",
        "chapter: N_c against both friction coefficients",
        points_of("material_friction"),
        table_of("material_friction"),
        draw_as("mu_disc", "mu_wall", r"disc friction $\mu_d$", r"wall friction $\mu_w$"),
    ),
    Figure(
        "material_tangential",
        "chapters",
        "chapter: N_c against tangential restitution and inertia",
        points_of("material_tangential"),
        table_of("material_tangential"),
        draw_as("tangential_restitution", "inertia", r"tangential restitution $\beta$", INERTIA),
    ),
]
