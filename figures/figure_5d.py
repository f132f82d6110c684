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
    spacing = 2 * R / len({row["x"] for row in rows})
    flows = [style.often_visited(style.select(rows, discs=discs), 1e-4) for discs in numbers]
    # One scale, so that the dishes can be compared.
    fastest = max((style.speed(row) for flow in flows for row in flow), default=1.0)
    for place, discs, flow in zip(axes[0], numbers, flows):
        style.dish(place, R)
        if flow:
            style.arrows(place, flow, spacing, fastest, color=style.BLUE)
        place.set_title(f"$N = {discs:.0f}$")
    style.note_not_steady(drawing, rows)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
