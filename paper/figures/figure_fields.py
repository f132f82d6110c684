"""Beyond the paper: maps of density, flow and spin in a large dish, and the torque of the stress against that of a
micropolar fluid."""

import numpy as np

import style


def square(rows, name):
    """The values as an image with the points of the grid as pixels; points without a row are NaN."""
    x, y = (sorted({row[axis] for row in rows}) for axis in ("x", "y"))
    image = np.full((len(y), len(x)), np.nan)
    for row in rows:
        image[y.index(row["y"]), x.index(row["x"])] = row[name]
    step = x[1] - x[0]
    return image, [x[0] - step / 2, x[-1] + step / 2, y[0] - step / 2, y[-1] + step / 2]


def panel(drawing, axes, rows, name, label, colors, symmetric, limit=None):
    image, extent = square(rows, name)
    if symmetric:
        limit = limit or np.nanquantile(np.abs(image), 0.98)
        shown = axes.imshow(image, origin="lower", extent=extent, cmap=colors, vmin=-limit, vmax=limit)
    else:
        shown = axes.imshow(image, origin="lower", extent=extent, cmap=colors, vmin=0)
    radius = extent[1]
    shown.set_clip_path(style.plt.Circle((0, 0), radius, transform=axes.transData))
    axes.add_patch(style.plt.Circle((0, 0), radius, fill=False, linewidth=0.8))
    axes.set_axis_off()
    axes.set_aspect("equal")
    axes.set_xlim(-1.03 * radius, 1.03 * radius)
    axes.set_ylim(-1.03 * radius, 1.03 * radius)
    axes.set_title(label)
    drawing.colorbar(shown, ax=axes, shrink=0.7, pad=0.1)
    return limit


def about_the_mean(rows):
    """The flow less its mean, with the packing fraction as weight: the whole cluster moves relative to the container."""
    total = sum(row["packing"] for row in rows)
    mean = {name: sum(row["packing"] * row[name] for row in rows) / total for name in ("u_x", "u_y")}
    return [row | {name: row[name] - mean[name] for name in mean} for row in rows]


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure(style.PAGE, 4.3, ncols=3, nrows=2)
    dense = [row for row in rows if row["packing"] > 0.05]
    panel(drawing, axes[0][0], rows, "packing", r"(a) packing and flow", "Blues", False)
    flow = about_the_mean(dense)
    step = sorted({row["x"] for row in rows})
    style.arrows(axes[0][0], flow, step[1] - step[0], max(map(style.speed, flow), default=1.0) or 1.0, style.RED,
                 key=(0.5, -0.07))
    panel(drawing, axes[0][1], dense, "spin", r"(b) spin $\omega$", "PuOr_r", True)
    half = [row | {"half": 0.5 * row["vorticity"]} for row in dense]
    panel(drawing, axes[0][2], half, "half", r"(c) half of the vorticity, $\frac{1}{2}$ curl $u$", "PuOr_r", True)
    known = [row for row in rows if row["relation"] == row["relation"]]
    limit = panel(drawing, axes[1][0], known or rows, "torque", r"(d) torque of the stress", "PuOr_r", True)
    panel(drawing, axes[1][1], known or rows, "relation",
          r"(e) $\Gamma\sqrt{mT}\,(\mathrm{curl}\,u - 2\omega)$", "PuOr_r", True, limit)
    last = axes[1][2]
    style.zero_line(last)
    if known:
        shown = last.scatter(style.column(known, "relation"), style.column(known, "torque"), s=9,
                             c=style.column(known, "packing"), cmap="viridis", zorder=3)
        last.errorbar(style.column(known, "relation"), style.column(known, "torque"),
                      xerr=style.column(known, "relation_error"), yerr=style.column(known, "torque_error"),
                      fmt="none", ecolor="0.6", elinewidth=0.5)
        ends = np.array([min(style.column(known, "relation")), max(style.column(known, "relation"))])
        last.plot(ends, ends, color=style.BLACK, linewidth=0.8, label="micropolar fluid")
        drawing.colorbar(shown, ax=last, label=r"$\varphi$", pad=0.02)
        style.legend(last, ncol=1)
    last.set_xlabel(r"$\Gamma\sqrt{mT}\,(\mathrm{curl}\,u - 2\omega)$, $m v^2/r^2$")
    last.set_ylabel(r"torque of the stress, $m v^2/r^2$")
    last.locator_params(axis="x", nbins=3)
    last.set_title("(f) point by point", pad=18)
    style.save(drawing, table)
