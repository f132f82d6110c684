"""Spheres that roll: rotation against their number in the experiment's container, smooth and roughened, and for both
readings of the amplitude."""

import style

FINE = 0.16  # in Ω: coarser scale above, where only small N rotate


def draw(table):
    rows = style.read(table)
    curves = [(style.select(rows, setting=name), {"label": label} | look)
              for name, (label, look) in style.LOOKS.items() if style.select(rows, setting=name)]
    style.rotation_figure(table, curves, of="spheres", width=style.PAGE, height=3.4, fine=FINE, ncol=3)
