"""Spheres that roll: rotation with each ingredient of the model switched off alone."""

import style

CURVES = [
    ("all", "all ingredients", style.BLACK, "o"),
    ("no-damping", r"no damping ($e = 1$)", style.SKY, "D"),
    ("shell", r"hollow ($I = \frac{2}{3}$)", style.BLUE, "s"),
    ("no-floor", "no floor", style.GREEN, "X"),
    ("no-vertical", "no vertical friction", style.RED, "v"),
    ("no-vertical-wall", "… at the wall only", style.PINK, "P"),
    ("no-vertical-disc", "… between spheres only", style.ORANGE, "^"),
]


def draw(table, ending=""):
    """`ending` ends the names of the curves."""
    rows = style.read(table)
    curves = [(style.select(rows, curve=name + ending), {"label": label, "color": color, "marker": marker})
              for name, label, color, marker in CURVES]
    style.rotation_figure(table, curves, of="spheres", height=3.2)
