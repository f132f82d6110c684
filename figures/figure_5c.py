"""Figure 5c: density of the discs in the M-frame, rotating and counterrotating.

    /usr/bin/python3 figures/figure_5c.py out/figure_5c.csv
"""

import style


def main():
    table = style.table_from_arguments("figure_5c")
    rows = style.read(table)
    numbers = sorted({row["discs"] for row in rows})
    drawing, axes = style.figure(height=2.3, ncols=len(numbers), squeeze=False)
    R = max(row["x"] for row in rows) * 100 / 99
    for place, discs in zip(axes[0], numbers):
        here = style.select(rows, discs=discs)
        # Counts by event, as the paper's; each map with its own scale, from nothing to most.
        shown = style.cells(place, here, "by_event", R)
        style.dish(place, R, color="white")
        place.set_title(f"$N = {discs:.0f}$")
        bar = drawing.colorbar(shown, ax=place, orientation="horizontal", shrink=0.8)
        bar.set_label(r"discs per unit area ($r^{-2}$)")
    style.note_not_steady(drawing, rows)
    style.save(drawing, table)


if __name__ == "__main__":
    main()
