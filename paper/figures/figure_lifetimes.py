"""Beyond the paper: the mean lifetimes of states that coexist at the same parameters."""

import style


def draw(table):
    rows = [row for row in style.read(table) if row["periods"] > 0]
    drawing, axes = style.figure(height=0.5 + 0.4 * len(rows))
    for k, row in enumerate(rows):
        color = style.CYCLE[0 if row["exits"] else 1]
        if row["exits"]:
            axes.errorbar(row["lifetime"], k, xerr=row["lifetime_error"], fmt="o", color=color, elinewidth=0.9)
        else:
            axes.plot(row["lifetime"], k, ">", color=color, markersize=5)
    axes.plot([], [], "o", color=style.CYCLE[0], label="mean lifetime")
    axes.plot([], [], ">", color=style.CYCLE[1], label="no exit: lower bound, 95 %")
    axes.set_xscale("log")
    axes.set_yticks(range(len(rows)), [f"{row['point']}:\n{row['state']}" for row in rows])
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_xlabel("lifetime (periods)")
    style.legend(axes, ncol=1)
    style.save(drawing, table)
