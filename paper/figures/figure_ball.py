"""The simulated minimal model: spin of one large disc in a swirled container against the friction coefficient
of the wall, for three radii. Bounces are elastic, or inelastic so that the disc stays at the wall."""

import itertools

import style

BOUNCES = ((0.5, "full", "-"), (1.0, "none", ":"))


def draw(table):
    rows = style.read(table)
    drawing, axes = style.figure(height=3.0)
    steps = sorted({row["mu"] for row in rows})
    handles = []
    styles = ((style.BLUE, "o"), (style.GREEN, "s"), (style.RED, "^"))
    for (color, marker), radius in zip(styles, sorted({row["ball_radius"] for row in rows})):
        for restitution, fill, line in BOUNCES:
            curve = sorted(style.select(rows, ball_radius=radius, restitution=restitution),
                           key=lambda row: row["mu"])
            axes.errorbar([steps.index(row["mu"]) for row in curve], style.column(curve, "gamma"),
                          yerr=style.column(curve, "gamma_error"), color=color, marker=marker,
                          fillstyle=fill, linestyle=line, elinewidth=0.7)
        handles.append(axes.plot([], [], color=color, marker=marker, label=f"radius {radius:g}")[0])
        axes.axhline(curve[0]["gamma_no_slip"], color=color, linewidth=0.6, linestyle="--",
                     zorder=0)
    axes.axhline(1, color=style.GREY, linewidth=0.6, zorder=0)
    axes.set_xticks(range(len(steps)), [f"{mu:g}" for mu in steps])
    axes.set_xlabel(r"friction coefficient of the wall $\mu$")
    axes.set_ylabel(r"$\gamma = |\varpi_M|/\Omega$")
    bounces = [axes.plot([], [], color=style.GREY, marker="o", fillstyle=fill, linestyle=line,
                         label=f"$e = {restitution:g}$")[0] for restitution, fill, line in BOUNCES]
    # By columns: the radii first, below them the restitutions.
    style.legend(axes, ncol=len(handles), handles=[
        mark for pair in itertools.zip_longest(handles, bounces) for mark in pair if mark])
    style.note(drawing, r"dashed: $\gamma_c = R_{\rm container}/R_{\rm ball}$; above 1 it "
               "counterrotates")
    style.save(drawing, table)
