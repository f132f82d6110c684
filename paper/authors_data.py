"""Compares this program with the numbers that the authors of the paper published.

    ./swirl python paper authors_data AUTHORS OUT

AUTHORS is a clone of github.com/jpryan1/rotation-sim, by the paper's second author, or a folder of
the same files under the other names of FILES. The repository has no licence file, so its files are
not part of this one. OUT receives the runs, authors_data.csv, and the figure. Another call with the
same OUT makes only the missing runs.

The authors' numbers are averages by event over one run of 10^6 events without warm-up. z is their
difference from the average of three such runs, divided by its standard error. This error follows
from the scatter between runs, and for maps and profiles between blocks of 10^5 events. The latter
includes the noise of our samples, which the authors' averages over all events do not have, so z of
the maps is rather small.
"""

import csv
import io
import json
import math
import os
import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import swirl

from paper import atomic_file, optional_file, style
from paper.coarse_zero import crossing_of_curve
from paper.paper_parameters import CONTAINER_RADIUS as R, LAST_N, OMEGA

SEEDS, EVENTS, BLOCKS = 3, 10**6, 10
EVERY = 32  # events from one sample of the maps to the next
MAPS, PROFILES = (28, 38, 48), range(28, LAST_N + 1, 2)
TURN = math.radians(174)  # from this program's M-frame to that of the authors: M is at 84°
STRENGTH = {1.0: "high", 0.5: "medium", 0.1: "low"}
CURVES = (
    [(f"both {mu:g}", mu, mu, 10) for mu in STRENGTH]
    + [(f"wall {mu:g}", 0, mu, 10) for mu in STRENGTH]
    + [(f"disc {mu:g}", mu, 0, 10) for mu in STRENGTH]
    + [(f"no spin D{d}W{w}", d, w, 1e9) for d, w in ((1, 1), (1, 0), (0, 1))]
)
# The names of a file in the folder of this comparison, and its path in the authors' repository.
FILES = {
    "both": ("{0}_friction.txt", "data/wall_disc_same_friction/{0}_friction.txt"),
    "wall": (
        "no_disc_friction_{0}_wall_friction.txt",
        "data/no_disc_friction/{0}_wall_friction.txt",
    ),
    "disc": (
        "no_wall_friction_{0}_disc_friction.txt",
        "data/no_wall_friction/{0}_disc_friction.txt",
    ),
    "no": ("cannot_spin/{0}.txt", "Plots/VsN_Plots/AngVelVsNData/cannot_spin/{0}.txt"),
    "density": ("density_{0}.txt", "Plots/Histogram_Plots/HistData/stats{0}.txt"),
    "flow": ("flow_{0}.txt", "Plots/Quiver_Plots/QuiverData/quiver{0}.txt"),
    "profile": ("angular_profile_{0}.txt", "Plots/Heatmap_Plots/heatmap-data/angvel{0}.txt"),
}


def authors(folder, kind, which):
    """The rows of one of the authors' files; its first line is their command."""
    paths = [os.path.join(folder, name.format(which)) for name in FILES[kind]]
    for path in paths:
        if optional_file.exists(path):
            with open(path, encoding="ascii") as file:
                return [
                    [float(cell) for cell in line.replace(",", " ").split()]
                    for line in file.readlines()[1:]
                ]
    sys.exit(
        f"error: '{paths[0]}' does not exist.\n"
        "hint: give a clone of github.com/jpryan1/rotation-sim."
    )


def curve(folder, out, name, mu_disc, mu_wall, inertia, numbers=None):
    """The rotation rate against N: one row for each number of discs."""
    kind, _, which = name.partition(" ")
    which = which.removeprefix("spin ") if kind == "no" else STRENGTH[float(which)]
    theirs = {5 + k: row[-1] for k, row in enumerate(authors(folder, kind, which))}
    numbers = numbers or range(5, LAST_N + 1)
    runs = os.path.join(out, name.replace(" ", "_"))
    swirl.sweep(
        runs,
        discs=list(numbers),
        mu_disc=mu_disc,
        mu_wall=mu_wall,
        inertia=inertia,
        events=EVENTS,
        warmup=0,
        replicates=SEEDS,
    )
    rates = {discs: [] for discs in numbers if discs in theirs}
    for file in optional_file.names_in(os.path.join(runs, "results")):
        with open(os.path.join(runs, "results", file), encoding="utf-8") as opened:
            run = json.load(opened)
        if run["config"]["discs"] in rates:
            rates[run["config"]["discs"]].append(run["rotation"]["mean_by_event"]["mean"])
    scatter = [np.var(here, ddof=1) if len(here) > 1 else np.nan for here in rates.values()]
    rows = []
    for k, (discs, here) in enumerate(rates.items()):
        if here:
            # The standard deviation of a run, from the scatter between runs at this and
            # neighbouring N.
            of_run = math.sqrt(np.nanmean(scatter[max(k - 2, 0) : k + 3]))
            rows.append(
                {
                    "curve": name,
                    "discs": discs,
                    "theirs": theirs[discs] / OMEGA,
                    "ours": np.mean(here),
                    "error": of_run / math.sqrt(len(here)),
                    "runs": len(here),
                    "z": (theirs[discs] / OMEGA - np.mean(here))
                    / (of_run * math.sqrt(1 + 1 / len(here))),
                }
            )
    return rows


def crossing(rows, column, runs=1):
    """(N_c, error) of a column that is the mean over `runs` of our SEEDS runs; None without a
    certain change of sign."""
    return crossing_of_curve(
        [(row["discs"], row[column], row["error"] * math.sqrt(SEEDS / runs)) for row in rows]
    )


def sample(simulation, samples):
    """Positions and relative velocities in the authors' frame, just before an event, when their
    program takes them."""
    columns = []
    for _ in range(samples):
        simulation.advance(events=EVERY - 1)
        before = simulation.snapshot()
        simulation.advance(events=1)
        after = simulation.snapshot()
        columns.append(
            (
                after.position - after.container_centre,
                before.velocity - before.container_velocity,
                np.broadcast_to(after.container_centre, after.position.shape),
            )
        )
    position, velocity, centre = (np.concatenate(column) for column in zip(*columns))
    turn = np.exp(1j * (TURN - math.pi / 2)) * np.conj(centre @ (1, 1j)) / np.hypot(*centre.T)
    return turn * (position @ (1, 1j)), turn * (velocity @ (1, 1j))


def averages(discs, seed):
    """Density, flow and profile of each block of a run."""
    simulation = swirl.Simulation(discs=discs, seed=seed)
    found = {"density": [], "flow": [], "profile": []}
    for _ in range(BLOCKS):
        r, u = sample(simulation, EVENTS // BLOCKS // EVERY)

        def histogram(cells, weights=None):
            x, y = (np.floor((part + R) / (2 * R) * cells).astype(int) for part in (r.real, r.imag))
            return np.bincount(y * cells + x, weights, cells**2).reshape(cells, cells)

        with np.errstate(invalid="ignore"):
            found["density"].append(histogram(100) * EVERY)
            found["flow"].append(
                np.stack([histogram(20, u.real), histogram(20, u.imag)], -1)
                / histogram(20)[:, :, None]
            )
            slices = np.floor((np.angle(r) / math.pi + 1) * 50).astype(int) % 100
            found["profile"].append(
                np.bincount(slices, (np.conj(r) * u).imag / abs(r) ** 2, 100)
                / np.bincount(slices, minlength=100)
            )
    return {name: np.array(blocks) for name, blocks in found.items()}


def stored_averages(out, discs, seed):
    path = os.path.join(out, f"maps_{discs}_{seed}.npz")
    if not optional_file.exists(path):
        content = io.BytesIO()
        np.savez_compressed(content, **averages(discs, seed))
        atomic_file.write(path, content.getvalue())
    return dict(np.load(path))


def compare(folder, kind, discs, runs):
    """Theirs, ours and z of a map or a profile; z is NaN where a block of ours has no visit or
    theirs has none."""
    ours = np.concatenate([run[kind] for run in runs])
    cells = authors(folder, kind, discs)
    theirs = np.array(
        [cell if len(cell) == ours[0].size // len(cells) else [np.nan] * 2 for cell in cells]
    )
    theirs = theirs.reshape(ours[0].shape)
    mean = ours.mean(axis=0)
    if kind == "density":  # counts of a run
        theirs = theirs / BLOCKS
        ours = np.where(ours.min(axis=0) > 0, ours, np.nan)
    with np.errstate(divide="ignore", invalid="ignore"):
        z = (theirs - mean) / (ours.std(axis=0, ddof=1) * math.sqrt(1 / BLOCKS + 1 / len(ours)))
    return theirs, mean, z


def rms(z):
    z = np.array(z, dtype=float).ravel()
    z = z[np.isfinite(z)]
    return math.sqrt(np.mean(z**2)), z.size


def report(rows, maps):
    """A table for docs/results/paper.md. N_c of the authors has the error of one run."""

    def number(found):
        return f"{found[0]:.2f} ± {found[1]:.2f}" if found else ""

    print(
        "| quantity | values | median difference | rms of z | N_c, authors | N_c, swirl |\n"
        "|---|---|---|---|---|---|"
    )
    for name, *_ in CURVES:
        here = style.select(rows, curve=name)
        size, count = rms(style.column(here, "z"))
        middle = np.median([abs(row["theirs"] - row["ours"]) for row in here])
        print(
            f"| {name} | {count} | {middle:.4f} | {size:.2f} | {number(crossing(here, 'theirs'))} "
            f"| {number(crossing(here, 'ours', SEEDS))} |"
        )
    for (kind, discs), (_, _, z) in maps.items():
        size, count = rms(z)
        print(f"| {kind}, N = {discs} | {count} | | {size:.2f} | | |")


def draw_curves(panels, residuals, rows):
    for panel, below, kind, title in zip(
        panels,
        residuals,
        ("both", "wall", "disc"),
        (r"$\mu_d = \mu_w = \mu$", r"$\mu_d = 0,\ \mu_w = \mu$", r"$\mu_w = 0,\ \mu_d = \mu$"),
    ):
        for k, mu in enumerate(STRENGTH):
            here = style.select(rows, curve=f"{kind} {mu:g}")
            color = style.CYCLE[k]
            panel.plot(
                style.column(here, "discs"),
                style.column(here, "theirs"),
                color=color,
                linewidth=0.8,
            )
            panel.errorbar(
                style.column(here, "discs"),
                style.column(here, "ours"),
                style.column(here, "error"),
                fmt=style.MARKERS[k],
                color=color,
                markersize=2,
                elinewidth=0.6,
                label=rf"$\mu = {mu:g}$",
            )
            below.plot(
                style.column(here, "discs"),
                style.column(here, "z"),
                style.MARKERS[k],
                color=color,
                markersize=2,
            )
        panel.set_title(title)
        style.zero_line(below)
        below.set(ylim=(-4, 4), xlabel="number of discs $N$")
    style.zero_line(panels[0])
    panels[0].legend(title="lines: authors, points: swirl", title_fontsize=style.SMALLEST)
    panels[0].set_ylabel(r"rotation $\varpi/\Omega$, by event")
    residuals[0].set_ylabel("difference, $z$")


def draw_maps(panels, maps):
    """Density and flow: the left half of each circle is the authors', the right half is ours."""
    middle = np.linspace(-R, R, 20, endpoint=False) + R / 20
    to_m = np.exp(1j * (TURN - math.pi / 2))
    for (density, flow), discs in zip(panels.T, MAPS):
        theirs, ours, _ = maps["density", discs]
        both = np.hstack([theirs[:, :50], ours[:, 50:]])
        density.imshow(
            np.where(both > 0, both, np.nan),
            origin="lower",
            extent=[-R, R, -R, R],
            vmax=np.percentile(both[both > 0], 99),
        )
        for arrows, half, color in (
            (maps["flow", discs][0], slice(10), style.BLACK),
            (maps["flow", discs][1], slice(10, 20), style.BLUE),
        ):
            flow.quiver(
                middle[half],
                middle,
                *arrows[:, half].transpose(2, 0, 1),
                color=color,
                angles="xy",
                scale_units="xy",
                scale=1.6,
                pivot="mid",
                width=0.006,
                headwidth=4,
                headlength=4,
                headaxislength=4,
                minlength=0.3,
            )
        for panel in (density, flow):
            style.bare(panel)
            panel.add_patch(style.plt.Circle((0, 0), R, fill=False, linewidth=0.8))
            panel.plot([0, 0], [-R, R], color=style.GREY, linewidth=0.6)
            panel.text(
                1.09 * R * to_m.real,
                1.09 * R * to_m.imag,
                "$M$",
                color=style.PINK,
                ha="center",
                va="center",
            )
            panel.text(-0.9 * R, 0.95 * R, "authors", ha="center", fontsize=style.SMALLEST)
            panel.text(0.9 * R, 0.95 * R, "swirl", ha="center", fontsize=style.SMALLEST)
            panel.set(xlim=(-1.2 * R, 1.2 * R), ylim=(-1.05 * R, 1.2 * R))
        density.set_title(f"$N = {discs}$")


def draw(out, rows, maps):
    drawing, axes = style.figure(
        style.PAGE, 9.2, nrows=5, ncols=3, gridspec_kw={"height_ratios": (2.4, 0.9, 2.2, 2.2, 2.2)}
    )
    draw_curves(axes[0], axes[1], rows)
    draw_maps(axes[2:4], maps)
    profile, histogram, spinless = axes[4]
    theta = 3.6 * np.arange(100) + 1.8
    for k, discs in enumerate(PROFILES):
        theirs, ours, _ = maps["profile", discs]
        color = style.plt.get_cmap("viridis")(0.95 * k / (len(PROFILES) - 1))
        profile.plot(theta, theirs, color=color, linewidth=0.8)
        profile.plot(theta[::4], ours[::4], "o", color=color, markersize=1.6)
    profile.set(
        xlabel="angle + 180°, authors' frame (°)",
        ylabel=r"$\langle u_\theta/r\rangle$, $N = 28\,…\,48$",
    )
    for color, kind in zip(style.CYCLE, ("density", "flow", "profile")):
        z = np.concatenate([found[2].ravel() for (k, _), found in maps.items() if k == kind])
        histogram.hist(
            z[np.isfinite(z)],
            np.linspace(-5, 5, 41),
            density=True,
            histtype="step",
            color=color,
            label=kind,
        )
    z = np.linspace(-5, 5, 201)
    histogram.plot(
        z,
        np.exp(-(z**2) / 2) / math.sqrt(2 * math.pi),
        color=style.BLACK,
        linewidth=0.8,
        label="normal",
    )
    histogram.set_xlabel("difference, $z$")
    histogram.legend()
    for k, (name, *_) in enumerate(CURVES[9:]):
        here = style.select(rows, curve=name)
        spinless.plot(
            style.column(here, "discs"),
            style.column(here, "theirs"),
            color=style.CYCLE[k],
            linewidth=0.8,
        )
        spinless.errorbar(
            style.column(here, "discs"),
            style.column(here, "ours"),
            style.column(here, "error"),
            fmt=style.MARKERS[k],
            color=style.CYCLE[k],
            markersize=2.4,
            label=(r"$\mu_d = \mu_w = 1$", r"$\mu_w = 0$", r"$\mu_d = 0$")[k],
        )
    spinless.set(title="discs that cannot spin", xlabel="number of discs $N$")
    spinless.legend()
    style.save(drawing, os.path.join(out, "authors_data.csv"))


def main():
    if len(sys.argv) != 3 or sys.argv[1] in ("-h", "--help"):
        print(__doc__, file=sys.stderr)
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    folder, out = sys.argv[1:]
    rows = [row for entry in CURVES for row in curve(folder, out, *entry)]
    wanted = [(discs, seed) for discs in PROFILES for seed in range(1, SEEDS + 1)]
    with ProcessPoolExecutor() as pool:
        runs = dict(zip(wanted, pool.map(stored_averages, [out] * len(wanted), *zip(*wanted))))
    maps = {
        (kind, discs): compare(
            folder, kind, discs, [run for (n, _), run in runs.items() if n == discs]
        )
        for kind, numbers in (("density", MAPS), ("flow", MAPS), ("profile", PROFILES))
        for discs in numbers
    }
    text = io.StringIO()
    writer = csv.DictWriter(text, rows[0], lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    atomic_file.write_or_exit(os.path.join(out, "authors_data.csv"), text.getvalue())
    report(rows, maps)
    draw(out, rows, maps)
