"""Figures 1c, 2a and 5a: single states. The M-frame and its forces; pinned and loose discs; the
simulated discs."""

import math

import numpy as np
from paper import look, style
from paper.engine import swirl
from paper.figure import Figure
from paper.paper_parameters import AMPLITUDE, CONTAINER_RADIUS, COUNTERROTATING_N, ROTATING_N
from paper.study import Point

R, A = CONTAINER_RADIUS, AMPLITUDE
PER_PERIOD = 1000  # frames
FORCES_AT, SHOWN_AT = 20.13, 50.3  # periods
ARROW = {"arrowstyle": "-|>", "shrinkA": 0, "shrinkB": 0, "mutation_scale": 7}
COLUMNS = (
    "lab_x",
    "lab_y",
    "lab_angle",
    "centre_x",
    "centre_y",
    "x",
    "y",
    "u_x",
    "u_y",
    "angle",
    "pinned",
)


def instant(parameters):
    """The discs at one instant in the lab frame, and in the M-frame, where C is the origin."""
    simulation = swirl.Simulation(discs=parameters["discs"], seed=parameters["seed"])
    share, whole = math.modf(parameters["at"])
    simulation.advance(
        periods=int(whole) - 1
    )  # whether a disc is pinned takes the frames before and after
    frames, k = simulation.sample(3, PER_PERIOD), PER_PERIOD + round(share * PER_PERIOD)
    lab, m = frames[k], frames.m_frame()[k]
    cells = (
        *lab.position.T,
        lab.angle,
        *np.outer(lab.container_centre, np.ones(len(lab))),
        *m.position.T,
        *m.velocity.T,
        m.angle,
        frames.pinned[k],
    )
    return {name: column.tolist() for name, column in zip(COLUMNS, cells)}


def points_at(discs, at):
    return lambda settings: [
        Point(
            settings,
            f"state_N{discs}_{at}periods",
            1,
            {"discs": discs, "at": at, "periods": at},
            work=instant,
        )
    ]


def table_saying(words):
    def table(points, settings):
        rows = [
            {"disc": k, **dict(zip(COLUMNS, cells))}
            for run in points[0].runs[:1]
            for k, cells in enumerate(zip(*(run[name] for name in COLUMNS)))
        ]
        return {"": (rows, ["disc", *COLUMNS])}, [words]

    return table


# --- Drawing --------------------------------------------------------------------------------------


def disc(axes, x, y, angle, color):
    axes.add_patch(
        style.plt.Circle((x, y), 1, facecolor=color, edgecolor=style.BLACK, linewidth=0.5)
    )
    axes.plot(
        [x, x + 0.8 * math.cos(angle)],
        [y, y + 0.8 * math.sin(angle)],
        color=style.BLACK,
        linewidth=1.0,
    )


def arrow(axes, begin, end, color, **more):
    axes.add_patch(
        style.matplotlib.patches.FancyArrowPatch(
            begin, end, color=color, **{**ARROW, "linewidth": 0.8, **more}
        )
    )


def turning_arrow(axes, centre, radius, begin, turn, color):
    """Along a circle, from the angle `begin` on."""
    ends = [
        (centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle))
        for angle in (begin, begin + turn)
    ]
    arrow(axes, *ends, color, connectionstyle=f"arc3,rad={math.tan(turn / 2) / 2}", linewidth=1.2)


def lab_container(axes, centre, reach):
    """The wall, the path of C around S, and M."""
    style.bare(axes)
    direction = np.array(centre) / np.hypot(*centre)
    axes.add_patch(style.plt.Circle(centre, R, fill=False, color=style.BLACK, linewidth=0.8))
    axes.add_patch(
        style.plt.Circle((0, 0), A, fill=False, color=style.GREY, linewidth=0.6, zorder=4)
    )
    for name, at, marker in (
        ("S", (0, 0), "+"),
        ("C", centre, "."),
        ("M", centre + R * direction, "o"),
    ):
        axes.plot(
            *at, marker, color=style.PINK if name == "M" else style.BLACK, markersize=4, zorder=5
        )
        axes.annotate(
            f"${name}$",
            at,
            (2, 2),
            textcoords="offset points",
            fontsize=style.SMALLEST + 1,
            zorder=5,
        )
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach))


def draw_frames(table):
    rows = style.read(table)
    shown = min(
        rows, key=lambda row: math.hypot(row["x"] - 5.4, row["y"] + 2.2)
    )  # its arrows have space there
    drawing, (lab, m, forces) = style.figure(style.PAGE, 2.7, ncols=3)
    centre = np.array([shown["centre_x"], shown["centre_y"]])
    lab_container(lab, centre, 1.1 * (R + A))
    lab.add_patch(style.plt.Circle((0, 0), R + A, fill=False, color=style.GREY, linestyle=":"))
    ahead = math.atan2(centre[1], centre[0]) + math.pi / 4
    turning_arrow(lab, (0, 0), R + A, ahead, 2 * math.pi / 9, style.GREY)
    turning_arrow(lab, (0, 0), A, ahead, math.pi / 2, style.BLACK)
    for axes in (m, forces):
        style.container(axes, R)
        axes.plot(0, 0, ".", color=style.BLACK, markersize=4)
        axes.annotate(
            "$C$", (0, 0), (2, 2), textcoords="offset points", fontsize=style.SMALLEST + 1
        )
    for k in range(3):
        turning_arrow(
            m, (0, 0), 0.9 * R, 2 * math.pi * (k / 3 + 1 / 12), -math.pi / 3.25, style.BLACK
        )
    at, u = np.array([shown["x"], shown["y"]]), np.array([shown["u_x"], shown["u_y"]])
    spacing = R / 3.6
    for row in range(-4, 5):
        for column in range(-4, 5):
            p = np.array([(column + row % 2 / 2) * spacing, 0.87 * row * spacing])
            if np.hypot(*p) < 0.85 * R and np.hypot(*(p - at)) > 0.3 * R:
                arrow(
                    forces,
                    p,
                    p + 1.5 * spacing / (R + A) * (p - (0, A)),
                    look.CENTRIFUGAL,
                    mutation_scale=4,
                )
    forces.add_patch(style.plt.Circle(at, 1, color=style.GREEN))
    u *= 2.9 / max(np.hypot(*u), 1e-300)
    force = 0.85 * np.array([u[1], -u[0]])  # 2 Ω |v|, to the right of v
    for arm, color, name in ((u, style.BLACK, "$v$"), (force, look.CORIOLIS, r"$F_{\rm Cor}$")):
        arrow(forces, at, at + arm, color, zorder=5)
        forces.annotate(
            name,
            at + 1.25 * arm,
            color=color,
            fontsize=style.SMALLEST + 1,
            ha="center",
            va="center",
        )
    forces.text(
        0.72 * R, -1.02 * R, r"$F_{\rm cent}$", color=look.CENTRIFUGAL, fontsize=style.SMALLEST + 1
    )
    for axes, title in (
        (lab, "lab frame: $C$ circles $S$,\nthe container does not rotate"),
        (m, "M-frame: the wall turns\nclockwise, with $-\\Omega$"),
        (
            forces,
            "forces in the M-frame: $F_{\\rm cent}$ away\nfrom $S$, "
            "$F_{\\rm Cor}$ to the right of $v$",
        ),
    ):
        axes.set_title(title, fontsize=style.SMALLEST + 1)
    style.save(drawing, table)


def draw_pinned(table):
    drawing, axes = style.figure(height=style.COLUMN)
    for row in style.read(table):
        disc(axes, row["x"], row["y"], row["angle"], look.PINNED if row["pinned"] else look.LOOSE)
    style.container(axes, R)
    for color, words in ((look.PINNED, "pinned"), (look.LOOSE, "loose")):
        axes.plot([], [], "o", color=color, markersize=5, label=words)
    style.legend(axes)
    style.save(drawing, table)


def draw_discs(table):
    rows = style.read(table)
    drawing, axes = style.figure(height=style.COLUMN)
    for row in rows:
        disc(axes, row["lab_x"], row["lab_y"], row["lab_angle"], style.SKY)
    lab_container(axes, np.array([rows[0]["centre_x"], rows[0]["centre_y"]]), R + A)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "1c",
        "paper",
        "the M-frame and its forces",
        points_at(ROTATING_N, FORCES_AT),
        table_saying(
            f"Figure 1c: drawn; the forces on one of {ROTATING_N} discs at period {FORCES_AT}."
        ),
        draw_frames,
    ),
    Figure(
        "2a",
        "paper",
        "discs pinned and loose, in the M-frame",
        points_at(COUNTERROTATING_N, SHOWN_AT),
        table_saying(
            f"Figure 2a: {COUNTERROTATING_N} discs in the M-frame at period {SHOWN_AT}, pinned and "
            "loose."
        ),
        draw_pinned,
    ),
    Figure(
        "5a",
        "paper",
        "the simulated discs",
        points_at(COUNTERROTATING_N, SHOWN_AT),
        table_saying(
            f"Figure 5a: {COUNTERROTATING_N} discs in the lab frame at period {SHOWN_AT}."
        ),
        draw_discs,
    ),
]
