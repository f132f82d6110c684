"""Who turns whom: one instant of runs of 8, 24 and 48 spheres, and of 48 without friction between
them, in the M-frame. The table has the positions and spins, and the normal forces that neighbours
and the wall exerted during the last part of a period. All panels have the same scales."""

import math

import numpy as np

from paper import look, style
from paper.combine import at
from paper.engine import swirl
from paper.figure import Figure
from paper.study import Point

# Name in the table: title, words, parameters.
CASES = {
    "8": ("8 spheres", "a bearing", {"discs": 8}),
    "24": ("24 spheres", "crowded", {"discs": 24}),
    "48": ("48 spheres", "one body", {"discs": 48}),
    "48, smooth": (
        "48 spheres without friction between them",
        "a bearing again",
        {"discs": 48, "mu_disc": 0},
    ),
}
AT, WINDOW = (
    30.25,
    0.12,
)  # periods: the instant, and the time before it in which impulses are summed


def instant(parameters):
    run = {name: value for name, value in parameters.items() if name != "periods"}
    simulation = swirl.Simulation(preset="experiment", **run)
    simulation.advance(periods=AT - WINDOW)
    n, pairs, wall = run["discs"], {}, {}
    while simulation.time < AT * simulation.period:
        left = AT - simulation.time / simulation.period
        event = simulation.step(1) if left < 1e-3 else simulation.step(max(1, int(20 * n * left)))
        for row in event[(event["kind"] <= 1) & (event["time"] <= AT * simulation.period)]:
            where = wall if row["kind"] == 1 else pairs
            key = (int(row["i"]), int(row["j"]))
            where[key] = where.get(key, 0.0) + float(row["normal_impulse"])
    now = simulation.snapshot().m_frame()
    omega, duration = 2 * math.pi / now.period, WINDOW * now.period
    radius = now.container_radius
    rows = [
        {
            "kind": "sphere",
            "x": p[0],
            "y": p[1],
            "x2": math.nan,
            "y2": math.nan,
            "value": spin / omega,
        }
        for p, spin in zip(now.position.tolist(), now.spin.tolist())
    ]
    for (i, j), impulse in sorted(pairs.items()):
        a, b = now.position[i], now.position[j]
        if np.hypot(*(a - b)) < 2.5:
            rows.append(
                {
                    "kind": "neighbours",
                    "x": a[0],
                    "y": a[1],
                    "x2": b[0],
                    "y2": b[1],
                    "value": impulse / duration,
                }
            )
    for (i, _), impulse in sorted(wall.items()):
        p = now.position[i]
        reach = float(np.hypot(*p))
        if reach > radius - 1.5:
            rows.append(
                {
                    "kind": "wall",
                    "x": p[0],
                    "y": p[1],
                    "x2": p[0] * radius / reach,
                    "y2": p[1] * radius / reach,
                    "value": impulse / duration,
                }
            )
    return {
        "rows": [
            {name: float(value) if name != "kind" else value for name, value in row.items()}
            for row in rows
        ]
    }


def points(settings):
    return [
        Point(
            settings,
            f"turns_{name.replace(', ', '-')}",
            1,
            run | {"periods": 1},
            work=instant,
            cells={"case": name},
        )
        for name, (_, _, run) in CASES.items()
    ]


def table(points, settings):
    rows = [
        {"case": p.cells["case"], **row}
        for p in points
        if at(p.result, "runs")
        for row in p.runs[0]["rows"]
    ]
    largest = max((row["value"] for row in rows if row["kind"] != "sphere"), default=math.nan)
    return {"": rows}, [
        f"The largest force of the picture is {largest:.3g} (sphere mass × speed² / radius)."
    ]


RADIUS, CENTRE_SPIN = 8.5, 7.5  # of the experiment's dish; spin of a free bearing


def draw_spin(panel, x, y, spin):
    """A round arrow whose length is the spin, 300° for a free bearing."""
    turn = 300 * min(1, abs(spin) / CENTRE_SPIN) * (1 if spin > 0 else -1)
    if abs(turn) < 8:
        panel.plot(x, y, "o", markersize=1, color=style.BLACK, zorder=4)
        return
    angle = np.radians(np.linspace(90, 90 + turn, 30))
    across, up = x + 0.6 * np.cos(angle), y + 0.6 * np.sin(angle)
    panel.plot(across, up, color=style.BLACK, linewidth=0.7, zorder=4)
    panel.annotate(
        "",
        (across[-1], up[-1]),
        (across[-2], up[-2]),
        zorder=4,
        arrowprops={
            "arrowstyle": "-|>",
            "color": style.BLACK,
            "linewidth": 0.5,
            "mutation_scale": 4,
            "shrinkA": 0,
            "shrinkB": 0,
        },
    )


def draw(table_file):
    rows = style.read(table_file)
    drawing, axes = style.figure(style.PAGE, 2.25, ncols=4)
    circle = style.plt.Circle
    largest = max(row["value"] for row in rows if row["kind"] != "sphere")
    for panel, (name, (title, words, _)) in zip(axes, CASES.items()):
        here = [
            row
            for row in rows
            if str(row["case"]) == name
            or row["case"] == float(name.split(",")[0])
            and "," not in name
        ]
        panel.add_patch(
            circle((0, 0), RADIUS, facecolor="#f6f4ef", edgecolor=style.GREY, linewidth=1.5)
        )
        for angle in np.arange(15, 360, 60):  # the wall runs clockwise
            a, b = np.radians(angle), np.radians(angle - 14)
            panel.annotate(
                "",
                ((RADIUS + 0.6) * np.cos(b), (RADIUS + 0.6) * np.sin(b)),
                ((RADIUS + 0.6) * np.cos(a), (RADIUS + 0.6) * np.sin(a)),
                arrowprops={
                    "arrowstyle": "-|>",
                    "color": look.ACCENT,
                    "linewidth": 0.8,
                    "mutation_scale": 6,
                },
            )
        for row in here:
            if row["kind"] == "sphere":
                panel.add_patch(
                    circle(
                        (row["x"], row["y"]),
                        1,
                        facecolor="white",
                        edgecolor="0.7",
                        linewidth=0.5,
                        zorder=1,
                    )
                )
            else:
                panel.plot(
                    (row["x"], row["x2"]),
                    (row["y"], row["y2"]),
                    linewidth=5 * row["value"] / largest,
                    zorder=3,
                    color=style.GREY if row["kind"] == "neighbours" else look.ACCENT,
                    solid_capstyle="butt",
                )
        for row in here:
            if row["kind"] == "sphere":
                draw_spin(panel, row["x"], row["y"], row["value"])
        panel.text(0, -RADIUS - 1.0, "M", ha="center", va="top", fontsize=style.SMALLEST)
        panel.set(xlim=(-9.8, 9.8), ylim=(-10.8, 9.8), aspect="equal")
        panel.set_title(
            f"{title.replace(' without', chr(10) + 'without')}\n{words}", fontsize=style.SMALLEST
        )
        panel.axis("off")
    style.save(drawing, table_file)


FIGURES = [
    Figure(
        "turns",
        "chapters",
        "chapter: who turns whom, forces and spins of 8, 24 and 48 spheres",
        points,
        table,
        draw,
        caption="Spheres of the experiment in the M-frame. Magenta: normal force of the wall. Grey: "
        "normal "
        "forces between neighbours. Line widths are forces, averaged over 0.12 periods. Round "
        "arrows: spins; a free bearing (7.5 Ω) has 300°. All panels have the same scales.",
    )
]
