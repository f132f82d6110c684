"""Figure 5d: how the discs move against the container, in the M-frame.

    /usr/bin/python3 figures/figure_5d.py out/figure_5d.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_5d")
    rows = style.read(table)
    numbers = sorted({row["discs"] for row in rows})
    drawing, axes = style.figure(width=style.PAGE, height=3.6, ncols=len(numbers), squeeze=False)
    R = max(row["x"] for row in rows) * 20 / 19
    for place, discs in zip(axes[0], numbers):
        here = [row for row in style.select(rows, discs=discs) if row["visits"] > 0]
        style.dish(place, R)
        style.arrows(place, here, R, color=style.BLUE,
                     least=1e-4 * sum(r["visits"] for r in here))
        place.set_title(f"$N = {discs:.0f}$")
    style.note_not_steady(drawing, rows)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
