"""Figures drawn by paper/figures from synthetic tables as large as those of a complete study.
Letters must be legible, legends must not cover data, points must be inside their axes, and arrows
must not touch."""

import csv
import glob
import itertools
import math
import os
import re
import sys
import tempfile
import unittest
from unittest import mock

from program import SOURCE, read_text

from paper import captions, catalogue, draw, style, tables
from paper.figures.figure_3 import sliding
from matplotlib.collections import LineCollection
from matplotlib.quiver import Quiver
from matplotlib.text import Text

MIN_FONT_SIZE = 7.0  # points, at the original size of the figure
R = 8.6
ONE_POINT = 300 / 72  # in pixels


def rotation(numbers, high=0.2, low=-0.05, **more):
    """Rows of one curve; some runs are drifting."""
    numbers = list(numbers)
    for k, discs in enumerate(numbers):
        level = high + (low - high) * k / max(len(numbers) - 1, 1)
        yield {
            "discs": discs,
            "mean_by_time": level,
            "mean_by_time_error": 0.01,
            "mean_by_event": level + 0.02,
            "mean_by_event_error": 0.02,
            "steady_state": "drifting" if k % 3 else "steady",
            **more,
        }


def curves(column, values, numbers=range(5, 56, 3), **more):
    return [
        row
        for k, value in enumerate(values)
        for row in rotation(numbers, high=1.0 / (k + 1), **{column: value}, **more)
    ]


def with_errors(row, **values):
    row.update({name: value for name, value in values.items()})
    row.update({name + "_error": 0.01 for name in values})
    return row


def cells(side, **more):
    for j, i in itertools.product(range(side), repeat=2):
        x, y = ((2 * k + 1 - side) * R / side for k in (i, j))
        inside = math.hypot(x, y) < 0.95 * R
        yield {
            "x": x,
            "y": y,
            "density": 0.4 * inside,
            "by_event": 0.4 * inside,
            "by_time": 0.4,
            "visits": 100 * inside,
            "u_x": 0.5 + 0.1 * x,
            "u_y": -2.2,
            **more,
        }


def state():
    """48 discs around C, which is right of and above S."""
    for k in range(48):
        x, y = 2.1 * (k % 7) - 6.3, 2.1 * (k // 7) - 6.3
        yield {
            "x": x,
            "y": y,
            "angle": k,
            "u_x": 1.0,
            "u_y": -2.0,
            "pinned": k % 2,
            "centre_x": 1.338,
            "centre_y": 1.338,
            "lab_x": x + 1.338,
            "lab_y": y + 1.338,
            "lab_angle": k,
        }


def profile():
    for setting, discs, theta in itertools.product(
        ("high", "smooth", "half"), (24, 36, 48), range(5, 360, 10)
    ):
        yield with_errors(
            {
                "setting": setting,
                "discs": discs,
                "theta": theta,
                "visits": 1000,
                "residence_begin": 200.0,
                "residence_end": 90.0,
                "steady_state": "drifting",
                "wall": -1.0,
            },
            varpi_m=-1 + 0.1 * math.sin(theta / 57),
            normalised=1.2,
        )


FRICTIONS = ("no-wall", "no-disc", "low", "medium", "high")
STEPS = (0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1)
SPHERES = ("smooth", "rough", "half")

INGREDIENTS = (
    "all",
    "no-damping",
    "shell",
    "no-vertical-wall",
    "no-vertical-disc",
    "no-vertical",
    "no-floor",
)

TABLES = {
    "1b": [
        with_errors(row, pancake=-0.1, pinned_region=0.9)
        for row in curves("setting", ("high", *SPHERES), range(24, 49))
    ],
    "2b": [
        cell
        for setting in ("high", "smooth")
        for cell in (
            *cells(100, setting=setting, map="density", discs=48, steady_state="drifting"),
            *cells(20, setting=setting, map="flow", discs=48, steady_state="drifting"),
        )
    ],
    **dict.fromkeys(("1c", "2a", "5a"), list(state())),
    "3a": list(profile()),
    "3b": list(profile()),
    "4a": [
        with_errors(row, slip_resident=0.9, pinned_region=0.95, cluster=0.5)
        for row in curves("setting", ("low", "high", *SPHERES), range(24, 49))
    ],
    "pinning": [
        {"setting": "smooth", "discs": n, "theta": 10 * k + 5, "steady_state": "drifting"}
        | {
            name + end: value
            for name in ("si_pinning", "si_depinning", "residence_begin", "residence_end")
            for end, value in (("", k / 630), ("_mean", 359.0), ("_resultant", 0.9))
        }
        for n in (28, 48)
        for k in range(36)
    ],
    "4b": [
        with_errors(
            row, resident_spin=0.4, triangles=0.3, triangle_correlation=-0.1, chain_correlation=-0.3
        )
        for row in curves("setting", ("high", *SPHERES), range(24, 49))
    ],
    "4c": curves("setting", ("low", "high", *SPHERES), range(24, 49)),
    "5b": curves("setting", FRICTIONS) + list(rotation(range(40, 56), low=-0.4, setting="high")),
    "5c": [row for n in (28, 48) for row in cells(100, discs=n, steady_state="drifting")],
    "5d": [row for n in (28, 48) for row in cells(20, discs=n, steady_state="drifting")],
    "averages": curves("setting", FRICTIONS),
    "ball": [
        {
            "ball_radius": r,
            "mu": mu,
            "restitution": e,
            "gamma": 1 + mu,
            "gamma_error": 0.4,
            "gamma_no_slip": R / r,
        }
        for r in (4.3, 5, 7)
        for mu in STEPS
        for e in (0.5, 1)
    ],
    "condensation": [
        with_errors(
            {"discs": n, "condensed": n > 16, "shortest": n, "longest": 3 * n},
            waiting=2 * n,
            before_granular=1.0,
            after_granular=0.05,
        )
        for n in range(16, 49, 4)
    ],
    "energy": [
        {"sides": m, "seed": seed, "period": k, "energy": 10.0 + k * m}
        for m in (6, 30, 300, 0)
        for seed in (1, 2)
        for k in range(1, 100)
    ],
    "friction": [
        {
            "mu": mu,
            "crosses": float(mu > 0.1),
            "crossing": 50 - 10 * mu,
            "crossing_error": 0.5,
            "steady_state": "drifting",
        }
        for mu in (0.05, 0.1, 0.5, 2)
    ],
    "inertia": curves("inertia", (0.5, 1, 3, 10, 100, 1e4)),
    "map": [
        row
        for a in STEPS
        for b in STEPS
        for row in rotation([48], high=b - a, mu_disc=a, mu_wall=b)
    ],
    "polygon": [row for m in (6, 10, 30, 300, 0) for row in rotation((28, 48), sides=m)],
    "restitution": curves("restitution", (1, 0.99, 0.9)),
    "spheres": curves("setting", SPHERES, range(8, 56, 4)),
    "spheres_ingredients": curves("curve", INGREDIENTS),
    "spheres_ingredients_rough": curves("curve", [f"{name}-rough" for name in INGREDIENTS]),
    "spheres_friction": [
        {
            "curve": name,
            "amplitude_mm": 5.75,
            "restitution": 0.8,
            "floor_friction": 0.15,
            "rolling_resistance": 0.01,
            "mu": mu,
            "crosses": 1.0,
            "crossing": 44 - 20 * mu,
            "crossing_error": 0.3,
        }
        for name in (
            "experiment",
            "A5.75",
            "A7.5",
            "A9.5",
            "A10.5",
            "e0.7",
            "e0.8",
            "e1",
            "f0.15",
            "f0.3",
            "f0.6",
            "r0.01",
            "r0.03",
        )
        for mu in (0.2, 0.4, 0.7, 1.0)
    ],
    "settling": [
        with_errors(
            {"setting": setting, "discs": n},
            rigid_resident=0.08,
            rigid_loose=0.2,
            encounters=6,
            two_encounters=0.9,
            rolling_single_file=0.45,
            rolling_side_by_side=0.6,
        )
        for setting in ("smooth", "rough")
        for n in (24, 36, 48)
    ],
    "states": [
        with_errors(row, coriolis=5.0, granular=0.5)
        for row in curves("setting", ("high", "no-wall", "no-disc"), (28, 48))
    ],
    "tangential": curves("tangential_restitution", (0, 0.5, 1)),
    "transient": [
        {"discs": n, "period": k, "varpi": k / 200, "spin": -k / 50, "events": 1e4 * k}
        for n in (40, 43, 46, 48)
        for k in range(200)
    ],
}


# The chapters are drawn from the tables of quick runs, four of them by figures_test.py.
CHAPTERS = {
    "amplitude",
    "cause",
    "closure",
    "coexistence",
    "contacts",
    "cooling",
    "critical",
    "fields",
    "gear_order",
    "gears",
    "hysteresis",
    "lifetimes",
    "material_friction",
    "material_inertia",
    "material_tangential",
    "scherer",
    "size",
    "torque",
    "turns",
}


def lines_of(drawing):
    return [line for axes in drawing.axes for line in axes.lines]


def dashed(drawing):
    steps = [patch for axes in drawing.axes for patch in axes.patches]
    return any(shape.get_linestyle() in ("--", "dashed") for shape in lines_of(drawing) + steps)


def shaded(drawing):
    return any(
        patch.get_fill() and patch.get_alpha() != 0
        for axes in drawing.axes
        for patch in axes.patches
    )


def marked(*markers):
    return lambda drawing: any(
        line.get_marker() in markers and len(line.get_xdata()) for line in lines_of(drawing)
    )


DOCUMENTATION = "\n".join(
    read_text(file)
    for file in glob.glob(os.path.join(SOURCE, "docs", "**", "*.md"), recursive=True)
    + [os.path.join(SOURCE, "README.md")]
)
# What a word of a caption promises: a pattern, and whether the drawing has it.
PROMISES = (
    (r"[Dd]ashed", dashed),
    (r"[Ss]haded", shaded),
    (r"[Ss]tars?\b", marked("*")),
    (r"[Tt]riangles (?:are|mark)|Triangles:", marked("^", "v", "<", ">")),
)


def unkept(caption, drawing):
    """The promises of a caption that the drawing does not keep."""
    return [
        pattern
        for pattern, is_drawn in PROMISES
        if re.search(pattern, caption) and not is_drawn(drawing)
    ]


class Drawings(unittest.TestCase):
    def drawn(self, name, rows):
        """The figure of the script before it is saved."""
        with tempfile.TemporaryDirectory() as folder:
            table = os.path.join(folder, f"figure_{name}.csv")
            with open(table, "w", newline="", encoding="utf-8") as file:
                columns = list(dict.fromkeys(column for row in rows for column in row))
                out = csv.DictWriter(file, columns)
                out.writeheader()
                out.writerows(rows)
            made = []
            with mock.patch.object(style, "save", lambda drawing, table: made.append(drawing)):
                catalogue.drawing(name)(table)
        style.plt.close(made[0])  # removes it from pyplot's list; the object remains
        made[0].canvas.draw()
        return made[0]

    def test_every_figure_has_a_table(self):
        names = {figure.name for figure in catalogue.named(["all"]) if figure.draw}
        self.assertEqual(
            names,
            set(TABLES) | CHAPTERS | {"2c", "5b-start", "5b-steady"},
            "a figure needs a small table in TABLES, which tests its drawing; a chapter, its name "
            "in CHAPTERS",
        )

    def test_figures_with_the_same_columns_share_a_drawing(self):
        for name, other in (("2c", "2b"), ("5b-start", "5b"), ("5b-steady", "5b")):
            self.assertIs(catalogue.drawing(name), catalogue.drawing(other))

    def test_layout_of_every_figure(self):
        for name, rows in TABLES.items():
            with self.subTest(figure=name):
                drawing = self.drawn(name, rows)
                self.check_letters(drawing)
                self.check_size(drawing)
                self.check_legends(drawing)
                self.check_points(drawing)
                self.check_captions(name, drawing)

    def check_captions(self, name, drawing):
        """What a caption names is drawn: in the report and below the pictures of the
        documentation."""
        if (
            name == "5b"
        ):  # its dashed lines come from a table of their own (test_figure_5b_marks_the_crossings)
            return
        below = re.findall(rf"images/figure_{re.escape(name)}\.png\)\n+\*([^*]+)\*", DOCUMENTATION)
        for text in (captions.CAPTIONS.get(name, ""), *below):
            self.assertEqual(unkept(text, drawing), [], text)

    def test_a_caption_that_names_nothing_drawn_is_found(self):
        drawing = style.plt.figure()
        axes = drawing.add_subplot()
        text = "Dashed: a limit. Shaded: a range. Stars: the paper. Triangles are bounds."
        axes.plot([0, 1], [0, 1])
        self.assertEqual(len(unkept(text, drawing)), 4)
        axes.plot([0, 1], [0, 1], "*--")
        axes.plot([0, 1], [0, 1], "^")
        axes.axvspan(0, 1)
        self.assertEqual(unkept(text, drawing), [])
        style.plt.close(drawing)

    def check_letters(self, drawing):
        for text in drawing.findobj(Text):
            if text.get_visible() and text.get_text().strip():
                self.assertGreaterEqual(text.get_fontsize(), MIN_FONT_SIZE, text.get_text())

    def check_size(self, drawing):
        box = drawing.get_tightbbox(drawing.canvas.get_renderer())
        width, height = drawing.get_size_inches()
        self.assertGreaterEqual(min(box.x0, box.y0), -0.01)
        self.assertLessEqual(box.x1, width + 0.01)
        self.assertLessEqual(box.y1, height + 0.01)
        self.assertIn(
            round(width, 3), (style.COLUMN, style.PAGE)
        )  # the widths that the report shows

    def check_legends(self, drawing):
        found = drawing.legends + [a.get_legend() for a in drawing.axes if a.get_legend()]
        for legend in found:
            box = legend.get_window_extent()
            self.assertGreaterEqual(box.x0, -1)
            self.assertLessEqual(box.x1, drawing.bbox.x1 + 1)
            for axes in drawing.axes:
                inside = axes.get_window_extent()
                self.assertFalse(
                    box.x0 < inside.x1 - 1
                    and inside.x0 < box.x1 - 1
                    and box.y0 < inside.y1 - 1
                    and inside.y0 < box.y1 - 1
                )

    def check_points(self, drawing):
        for axes in drawing.axes:
            inside = axes.get_window_extent().padded(0.5 * ONE_POINT)
            shown = [
                line.get_xydata() for line in axes.lines if line.get_transform() == axes.transData
            ]
            for bars in axes.collections:
                if isinstance(bars, LineCollection):
                    shown += bars.get_segments()
            for point in (point for points in shown for point in points):
                if not any(math.isnan(float(number)) for number in point):
                    x, y = axes.transData.transform(point)
                    self.assertTrue(inside.contains(x, y), (axes.get_ylabel(), point))

    def test_arrows_do_not_touch(self):
        for name, side in (("2b", 10), ("5d", 20)):
            drawing = self.drawn(name, TABLES[name])
            quivers = [
                (axes, q)
                for axes in drawing.axes
                for q in axes.collections
                if isinstance(q, Quiver)
            ]
            self.assertEqual(len(quivers), 2)
            for _, quiver in quivers:
                longest = max(math.hypot(u, v) for u, v in zip(quiver.U, quiver.V)) / quiver.scale
                self.assertLessEqual(longest, 2 * R / side * 1.001)
                self.assertGreater(longest, 1.5 * R / side)
            scales = {quiver.scale for _, quiver in quivers}
            self.assertEqual(len(scales), 1)

    def test_blocks_of_a_flow_weight_all_visits_equally(self):
        rows = [
            {"x": x, "y": y, "visits": 1 + 2 * x, "u_x": 1.0 * x, "u_y": 2.0}
            for y in (0, 1)
            for x in (0, 1)
        ]
        self.assertEqual(
            style.blocks(rows, 2), [{"x": 0.5, "y": 0.5, "visits": 8, "u_x": 0.75, "u_y": 2.0}]
        )
        empty = [row | {"visits": 0, "u_x": math.nan} for row in rows]
        self.assertEqual(style.blocks(empty, 2), [])

    def test_runs_without_averages_are_omitted(self):
        none = {
            name: math.nan
            for name in (
                "mean_by_time",
                "mean_by_time_error",
                "mean_by_event",
                "mean_by_event_error",
            )
        }
        for name in ("5b", "spheres"):
            drawing = self.drawn(name, [row | none for row in TABLES[name]])
            self.assertTrue(drawing.axes[0].get_legend() or drawing.legends, name)

    def test_open_symbols_alone_mark_unverified_states(self):
        drawing = self.drawn("5b", TABLES["5b"])
        open_points = [
            line for line in drawing.axes[0].lines if line.get_markerfacecolor() == "white"
        ]
        self.assertEqual(len(open_points), len(FRICTIONS))
        drifting = sum(row["steady_state"] == "drifting" for row in TABLES["5b"])
        self.assertEqual(sum(len(line.get_xdata()) for line in open_points), drifting)
        self.assertIn("open: steady state not verified", drawing.notes)
        steady = self.drawn("5b", [row | {"steady_state": "steady"} for row in TABLES["5b"]])
        self.assertFalse(
            [line for line in steady.axes[0].lines if line.get_markerfacecolor() == "white"]
        )

    def test_figure_5b_marks_the_crossings(self):
        with mock.patch.object(
            tables,
            "companion",
            lambda table, ending: [
                {"curve": "high", "crossing": 38.24},
                {"curve": "low", "crossing": math.nan},
            ],
        ):
            drawing = self.drawn("5b", TABLES["5b"])
        labels = [text.get_text() for text in drawing.axes[0].get_legend().get_texts()]
        self.assertEqual(
            [label for label in labels if "N_c" in label], [r"high ($\mu = 1$), dashed: $N_c$"]
        )
        self.assertTrue(any(set(line.get_xdata()) == {38.24} for line in drawing.axes[1].lines))

    def test_figure_5b_shows_the_crossings_enlarged(self):
        rows = [row for row in TABLES["5b"] if row["setting"] != "high"]
        rows += list(
            rotation(range(24, 49), low=-0.07, setting="high")
        )  # the averages by event reach −0.05
        drawing = self.drawn("5b", rows)
        whole, near = drawing.axes
        bottom, top = near.get_ylim()
        self.assertEqual(top, 0.1)
        drawn = [y for line in near.lines if len(line.get_xdata()) > 5 for y in line.get_ydata()]
        self.assertLess(min(drawn), -0.04)
        self.assertTrue(-0.1 <= bottom < min(drawn), bottom)  # the axis ends below the lowest point
        self.assertGreater(max(drawn), 0.07)
        self.assertGreater(whole.get_ylim()[1], 1.0)

    def test_sliding_slices_weight_all_visits_equally(self):
        rows = [
            {
                "theta": 2.5 + 5 * k,
                "visits": 100 + k,
                "varpi_m": -1.0 - k,
                "wall": -2.0,
                "normalised": 0,
            }
            for k in range(72)
        ]
        one = sliding(rows, 5)
        self.assertEqual([row["varpi_m"] for row in one], [row["varpi_m"] for row in rows])
        three = sliding(rows, 15)
        self.assertAlmostEqual(three[10]["varpi_m"], -(109 * 10 + 110 * 11 + 111 * 12) / 330)
        self.assertAlmostEqual(three[10]["normalised"], (109 * 10 + 110 * 11 + 111 * 12) / 660)
        self.assertEqual(three[10]["visits"], 330)
        # A slice that contains θ = 0.
        self.assertAlmostEqual(three[0]["varpi_m"], -(171 * 72 + 100 + 101 * 2) / 372)
        empty = sliding([row | {"visits": 0} for row in rows], 15)
        self.assertEqual(empty, [])

    def test_second_argument_is_the_width_of_slices(self):
        def curve(*more):
            with mock.patch("paper.optional_file.exists", lambda file: True), mock.patch.object(
                style, "read", lambda table: TABLES["3a"]
            ), mock.patch.object(
                style, "save", lambda drawing, table: made.append(drawing)
            ), mock.patch.object(
                sys, "argv", ["draw.py", "figure_3a.csv", *more]
            ):
                made = []
                draw.main()
            style.plt.close(made[0])
            return made[0].axes[0].lines[0].get_ydata()

        plain, wide = curve(), curve("90")
        self.assertEqual(len(plain), len(wide))
        self.assertLess(max(wide) - min(wide), 0.95 * (max(plain) - min(plain)))

    def test_spheres_near_zero_have_a_linear_scale(self):
        near = curves("setting", SPHERES, range(8, 56, 4))
        near = [row | {"mean_by_time": -0.05} for row in near]
        self.assertEqual(self.drawn("spheres", near).axes[0].get_yscale(), "linear")
        axes = self.drawn("spheres", TABLES["spheres"]).axes[0]
        self.assertEqual(axes.get_yscale(), "symlog")
        shown = [axes.yaxis.get_major_formatter()(tick, None) for tick in axes.get_yticks()]
        self.assertEqual(shown.count("0"), 1)
        self.assertNotIn("−0", shown)


if __name__ == "__main__":
    unittest.main()
