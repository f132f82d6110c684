"""Beyond the paper: rotation of 48 discs against both friction coefficients."""

import style


def draw(table):
    rows = style.read(table)
    steps = sorted({row["mu_wall"] for row in rows})
    # The nine steps of the full study need the width of a page.
    large = len(steps) > 6
    drawing, axes = style.figure(width=style.PAGE if large else style.COLUMN,
                                 height=5.6 if large else 2.9)
    style.rotation_map(drawing, axes, rows, ("mu_disc", "mu_wall"), fontsize=8 if large else style.SMALLEST,
                       label=r"$\varpi/\Omega$ at $N = 48$")
    axes.set_xlabel(r"disc friction $\mu_d$")
    axes.set_ylabel(r"wall friction $\mu_w$")
    style.save(drawing, table)
