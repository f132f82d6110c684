"""The report of `swirl experiment` (report.html, one self-contained file) and its figures
(figure_*.png and .pdf), from the tables and experiment.json in a folder.

    /usr/bin/python3 paper experiment marbles
"""

import os

import numpy as np
from paper import optional_file, style
from paper.atomic_file import write_or_exit
from paper.claims.wording import known, number
from paper.html_page import described_folder, rendered

LOOK = {"rough": (style.RED, "o"), "smooth": (style.SKY, "D")}


def sides(axes, rows, quantity, surfaces=("rough", "smooth"), label="", second=False):
    """Draw a quantity against N: videos as markers with errors, simulations as a line. A second
    quantity is paler, with other markers and a dashed line. Return whether anything was drawn."""
    look = {"linestyle": "--", "alpha": 0.55} if second else {}
    drawn = False
    for surface in surfaces:
        color, marker = LOOK[surface]
        video = known(style.select(rows, source="video", surface=surface), quantity)
        run = known(style.select(rows, source="simulation", surface=surface), quantity)
        run.sort(key=lambda row: row["discs"])
        several = len({row["surface"] for row in rows}) > 1
        name = ", ".join(part for part in (surface if several else "", label) if part)
        name = f" ({name})" if name else ""
        if run:
            style.curve(
                axes,
                run,
                "discs",
                quantity,
                color=color,
                marker="." if len(run) > 1 else "_",
                markersize=3 if len(run) > 1 else 9,
                label="simulation" + name,
                **look,
            )
        if video:
            style.curve(
                axes,
                video,
                "discs",
                quantity,
                color=color,
                marker="s" if second else marker,
                elinewidth=0.9,
                markersize=3.6 if second else 4.5,
                fillstyle="none",
                label="video" + name,
                **(look | {"linestyle": "none"}),
            )
        drawn = drawn or video or run
    return bool(drawn)


def against_n(folder, name, rows, quantities, ylabel, level=None, surfaces=("rough", "smooth")):
    """Draw one figure; return its name, or None if there is nothing to draw."""
    drawing, axes = style.figure()
    drawn = False
    for k, (quantity, label) in enumerate(quantities):
        drawn = sides(axes, rows, quantity, surfaces, label, second=k > 0) or drawn
    if not drawn:
        return None
    if level is not None:
        axes.axhline(level, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
    axes.set(xlabel=r"number of discs $N$", ylabel=ylabel)
    numbers = style.column(rows, "discs")
    axes.set_xlim(min(numbers) - 1.5, max(numbers) + 1.5)
    style.legend(axes)
    style.save(drawing, os.path.join(folder, f"figure_{name}.csv"))
    return f"figure_{name}"


def profile(folder, name, rows, quantity, level, label):
    rows = [row for row in rows if row["surface"] == "rough"]
    if not rows:
        return None
    numbers = style.distinct(rows, "discs")
    drawing, axes = style.figure(height=2.6)
    colors = style.plt.get_cmap("viridis")
    span = max(numbers[-1] - numbers[0], 1)
    for discs in numbers:
        color = colors(0.95 * (discs - numbers[0]) / span)
        for source in ("simulation", "video"):
            part = style.select(rows, discs=discs, source=source)
            most = max((row["visits"] for row in part), default=0)
            part = [row for row in part if row["visits"] > max(20, 0.01 * most)]
            for video in sorted({row["video"] for row in part}, key=str):
                here = [row for row in part if str(row["video"]) == str(video)]
                look = (
                    {
                        "marker": "o",
                        "linestyle": "none",
                        "markersize": 2.4,
                        "fillstyle": "none",
                        "markeredgewidth": 0.7,
                    }
                    if source == "video"
                    else {"linewidth": 0.9}
                )
                axes.plot(
                    style.column(here, "theta"), style.column(here, quantity), color=color, **look
                )
    axes.plot([], [], "o", color=style.GREY, fillstyle="none", markersize=3, label="video")
    axes.plot([], [], color=style.GREY, label="simulation, sampled like the video")
    axes.axhline(level, color=style.GREY, linewidth=0.6, linestyle="--", zorder=0)
    axes.set(
        xlabel=r"angular position $\theta$ in the M-frame (°); M is at 270°",
        ylabel=label,
        xlim=(0, 360),
    )
    axes.set_xticks(range(0, 361, 90))
    style.legend(axes)
    if len(numbers) > 1:
        bar = drawing.colorbar(style.scale(numbers, colors), ax=axes)
        bar.set_label(r"number of discs $N$")
    else:
        axes.set_title(f"$N = {numbers[0]:.0f}$", fontsize=7, loc="right")
    style.save(drawing, os.path.join(folder, f"figure_{name}.csv"))
    return f"figure_{name}"


def coarser(rows, by):
    """Means over squares of by × by cells: a short video has few visits per cell."""
    side = round(len(rows) ** 0.5) // by
    means = {
        name: np.reshape(style.column(rows, name), (side, by, side, by)).mean(axis=(1, 3)).ravel()
        for name in ("x", "y", "density")
    }
    return [dict(zip(means, cell)) for cell in zip(*means.values())]


def maps(folder, video, amplitude):
    rows = style.read(os.path.join(folder, f"maps_{video}.csv"))
    there = [source for source in ("video", "simulation") if style.select(rows, source=source)]
    drawing, panels = style.figure(
        width=style.PAGE if len(there) == 2 else style.COLUMN,
        height=3.1,
        ncols=len(there),
        squeeze=False,
    )
    R = style.map_radius(style.select(rows, source=there[0], map="density"))
    density = {
        source: coarser(style.select(rows, source=source, map="density"), 2) for source in there
    }
    # One colour scale for both; a few rarely visited cells must not set it.
    levels = sorted(row["density"] for part in density.values() for row in part)
    top = levels[int(0.995 * (len(levels) - 1))]
    cells = style.select(rows, map="flow")
    spacing = 2 * style.COARSE * R / max(len({row["x"] for row in cells}), 1)
    flows = [
        style.often_visited(style.blocks(style.select(cells, source=source), style.COARSE), 2e-4)
        for source in there
    ]
    fastest = max((style.speed(row) for flow in flows for row in flow), default=1.0)
    for axes, source, flow in zip(panels[0], there, flows):
        shown = style.cells(axes, density[source], "density", R, top)
        if flow:
            style.arrows(axes, flow, spacing, fastest, color="white")
        style.container(axes, R, color="white", amplitude=amplitude)
        axes.set_title(f"{source}, $N = {rows[0]['discs']:.0f}$")
    bar = drawing.colorbar(shown, ax=list(panels[0]), shrink=0.85)
    bar.set_label(r"discs per unit area ($r^{-2}$)")
    style.save(drawing, os.path.join(folder, f"figure_2_{video}.csv"))
    return f"figure_2_{video}"


VIDEO_COLUMNS = [
    "video",
    "N",
    "periods",
    "frames per period",
    "disc radius, pixels",
    "R",
    "A",
    "complete frames",
    "position error, pixels",
    "ϖ/Ω by time",
    "simulated",
]


def video_row(row):
    if isinstance(row["failed"], str):
        return [row["video"], "–", row["failed"]]
    return [
        row["video"],
        f"{row['discs']:.0f}",
        f"{row['periods']:.1f}",
        f"{row['frames_per_period']:.0f}",
        f"{row['radius']:.2f}",
        f"{row['container_radius']:.3f}",
        f"{row['amplitude']:.3f}",
        f"{100 * row['complete_share']:.1f} %",
        f"{row['position_error']:.2f}",
        number(row["mean_by_time"], row["mean_by_time_error"]),
        number(row["simulated"], row["simulated_error"]),
    ]


TITLES = {
    "figure_1b": (
        "Figure 1b",
        "Rotation of the cluster against the number of discs. Dashed line: a "
        "pancake with the cluster's perimeter that rolls on the wall without slipping.",
    ),
    "figure_3a": (
        "Figure 3a",
        "Angular velocity of the discs about the centre of mass, in the "
        "M-frame; −1 for a disc that moves with the wall.",
    ),
    "figure_3b": ("Figure 3b", "The angular velocity of Figure 3a, divided by that of the wall."),
    "figure_4a": (
        "Figure 4a",
        "The slip parameter: 1 is rolling without slip. Dashed line: all "
        "discs that are pinned by the SI's criterion.",
    ),
    "figure_4b": ("Figure 4b", "Spin about the vertical of the discs at the wall, in Ω."),
    "figure_4c": ("Figure 4c", "Rotation of rough and smooth discs."),
}


def figure_row(name):
    title, text = TITLES.get(name) or (
        f"Figure 2, {name.removeprefix('figure_2_')}",
        "Density of the discs in the M-frame and their mean flow relative to "
        "the container, in the video and in a simulation of the same number of discs.",
    )
    return {
        "title": title,
        "images": [f"{name}.png"],
        "wide": name.startswith("figure_2_"),
        "caption": text,
        "command": f"{name}.pdf",
    }


def found_row(folder, video):
    found, path = video.get("found") or {}, (video.get("found") or {}).get("path")
    text = path and (
        f"{found.get('discs')} discs, {found.get('frames')} frames; centre "
        f"{path['centre'][0]:.2f}, "
        f"{path['centre'][1]:.2f}, amplitude {path['amplitude']:.2f} pixels, "
        f"{'clockwise' if path['clockwise'] else 'counter-clockwise'}."
    )
    return {
        "title": video["name"],
        "caption": text,
        "findings": video.get("remarks"),
        "remarks": [video["video"]],
        "images": [
            name
            for name in video.get("images", [])
            if optional_file.exists(os.path.join(folder, name))
        ],
    }


def contents(folder, about, videos, figures):
    runs = (
        f" Each is compared with {about['seeds']} simulations of the same number of discs in the "
        "same container. They have the same frame rate, position error and smoothing as the video."
        if about["runs"]
        else ""
    )
    return [
        (
            "text",
            f"Results from {len(videos)} video{'s' if len(videos) != 1 else ''} of a swirled "
            f"container.{runs} ± is one standard error, from the scatter between periods.",
        ),
        ("bullets", about["findings"]),
        ("section", "Videos"),
        ("table", (VIDEO_COLUMNS, [video_row(row) for row in videos])),
        ("section", "The paper’s figures"),
        ("figures", [figure_row(name) for name in figures]),
        ("section", "Each video"),
        ("figures", [found_row(folder, video) for video in about["videos"]]),
        ("section", "Made by"),
        (
            "table",
            (
                ["", ""],
                [
                    ("command", about["command"]),
                    ("version", about["version"]),
                    ("built with", about["build"]),
                ],
            ),
        ),
    ]


def main():
    folder, about = described_folder(
        "experiment.json", "swirl experiment --out", "draws the figures and writes report.html"
    )
    videos = style.read(os.path.join(folder, "videos.csv"))
    points = style.read(os.path.join(folder, "points.csv"))
    profiles = style.tables.read(os.path.join(folder, "profiles.csv"))
    rotation = r"rotation $\varpi/\Omega$, by time"
    rough = ("rough",)
    made = [
        against_n(
            folder,
            "1b",
            points,
            [("mean_by_time", ""), ("pancake", "pancake")],
            rotation,
            0,
            rough if style.select(points, surface="rough") else ("smooth",),
        )
    ]
    for row in videos:
        if optional_file.exists(os.path.join(folder, f"maps_{row['video']}.csv")):
            made.append(maps(folder, row["video"], row["amplitude"]))
    made += [
        profile(folder, "3a", profiles, "varpi_m", -1, r"$\langle\varpi_{M,i}\rangle/\Omega$"),
        profile(
            folder,
            "3b",
            profiles,
            "normalised",
            1,
            r"$\langle\varpi_{M,i}\rangle/\langle\varpi_{\rm wall}\rangle$",
        ),
        against_n(
            folder,
            "4a",
            points,
            [("slip_resident", "resident at the wall"), ("pinned_region", "pinned, SI")],
            "slip parameter $s$",
            1,
        ),
        against_n(
            folder,
            "4b",
            points,
            [("wall_spin", "")],
            r"spin at the wall $\langle|\omega_i|\rangle/\Omega$",
        ),
    ]
    if style.select(points, surface="smooth"):
        made.append(against_n(folder, "4c", points, [("mean_by_time", "")], rotation, 0))
    figures = [name for name in made if name]
    write_or_exit(
        os.path.join(folder, "report.html"),
        rendered(
            "report.html.j2",
            folder,
            title="Experiment and simulation",
            blocks=contents(folder, about, videos, figures),
        ),
    )
