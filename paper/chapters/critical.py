"""Is the change of direction a critical phenomenon? The paper leaves it open. At each change of
direction of a dish: the slope dϖ/dφ, the fluctuations, their correlation time and the Binder
cumulant, against the size R/r of the dish. In a critical transition slope, fluctuations and
correlation time grow with powers of the size. In a transition of first order two states coexist, so
that the cumulant tends to 2/3. If it is smooth, slope and correlation time are finite in large
dishes: their growth ends. The figure has two amplitudes: the paper's A/R = 0.22, and A/R = 0.4,
where the change at the wall exists in dishes of all sizes. Where a correlation time grows, it is
compared with the times that sound and viscosity need across the dish, which grow with the size
without any criticality."""

import math

import numpy as np
from paper import style, tables
from paper.chapters.size import dishes_of_sizes
from paper.curves import CERTAIN, with_error
from paper.standard_runs import Dish, dish_points, dish_tables
from paper.figure import Figure
from paper.hard_discs import kinematic_viscosity, sound_speed
from scipy.stats import chi2
from scipy.stats import t as student

# Quantities at a change, and how sentences call them. Fluctuations do not decide: they grow with
# the size at every φ.
QUANTITIES = {"slope": "slope", "susceptibility": "N var τ", "correlation": "correlation time"}
DECISIVE = ("slope", "correlation")
# An exponent that must be excluded by two standard errors before growth is said to have ended.
GROWTH = 0.5
TWO_STATES = 1 / 3  # half of the cumulant of two equal states
LAST_SIZES = 3  # in which growth must have ended if the change is smooth
LAW = ("exponent", "exponent_error", "factor", "chi_square", "sizes")
LIMIT = ("limit", "limit_error", "chi_square_limit", "bend")
LOGARITHM = ("offset", "per_e_fold", "chi_square_logarithm")
# Probability of χ² with which a law is excluded: three standard errors of one normal variable.
RARE = 0.0027
SLOWEST = 3.8317  # first zero of the Bessel function J_1


def points(settings):
    radii = (8.6, 12.0) if settings.quick else (6.0, 8.6, 12.0, 17.2, 24.0, 34.4, 60.0)
    # Two packing fractions as far apart in every dish, on both sides of the zero.
    return dish_points(
        settings,
        dishes_of_sizes(settings)
        + [
            (Dish(radius, 0.4), fraction)
            for radius in radii
            for fraction in (
                (0.46, 0.49) if radius < 20 else (0.445, 0.475) if radius < 40 else (0.435, 0.465)
            )
        ],
    )


def usable(points):
    """(x, y, error) of the points with positive x and y and a finite error, as columns."""
    return (
        np.array([p for p in points if min(p) > 0 and math.isfinite(p[1] / p[2])]).reshape(-1, 3).T
    )


def power_law(points):
    """The fit y = a x^b to (x, y, error): b, its error, a, χ² of ln y, and the number of points.
    Least squares of the logarithms, weighted by the relative errors. If the points scatter more
    than their errors explain, the error of b grows with the scatter, and by Student's factor. Two
    points fit any law."""
    x, y, error = usable(points)
    if len(x) < 3 or len(set(x)) < 2:
        return math.nan, math.nan, math.nan, math.nan, len(x)
    w, lx, ly = y / error, np.log(x), np.log(y)
    (b, a), spread = np.polyfit(lx, ly, 1, w=w, cov="unscaled")
    chi_square, freedom = float(np.sum((w * (ly - a - b * lx)) ** 2)), len(x) - 2
    wider = math.sqrt(chi_square / freedom) * student.ppf(0.975, freedom) / student.ppf(0.975, 1e9)
    return (
        b,
        math.sqrt(spread[0, 0]) * (wider if chi_square > freedom else 1),
        math.exp(a),
        chi_square,
        len(x),
    )


def saturating_law(points):
    """The fit a tanh(x/b), which is proportional to x in small dishes and a in large ones: a, its
    error, χ², b. It needs four points, since three hardly tell it from a power law. An error of a
    quarter of the limit says that there is none."""
    x, y, error = usable(points)
    if len(x) < 4:
        return (math.nan,) * len(LIMIT)
    bends = np.geomspace(min(x) / 2, 100 * max(x), 4000)
    shapes = np.tanh(x / bends[:, None]) / error
    limits = shapes @ (y / error) / (shapes**2).sum(axis=1)  # the best a for each b
    chi_square = ((y / error - limits[:, None] * shapes) ** 2).sum(axis=1)
    best = chi_square.argmin()
    # At a fixed b, and by the values of b within one standard error.
    wrong = math.hypot(
        1 / np.linalg.norm(shapes[best]), np.ptp(limits[chi_square <= chi_square[best] + 1]) / 2
    )
    known = wrong < limits[best] / 4
    return (
        limits[best] if known else math.nan,
        wrong if known else math.nan,
        chi_square[best],
        bends[best],
    )


def logarithmic_law(points):
    """The fit y = a + b ln x, which grows without a limit, but more slowly than any power: a, b,
    and χ²."""
    x, y, error = usable(points)
    if len(x) < 4:
        return (math.nan,) * len(LOGARITHM)
    b, a = np.polyfit(np.log(x), y, 1, w=1 / error)
    return a, b, float(np.sum(((y - a - b * np.log(x)) / error) ** 2))


def laws_of(changes, law=power_law):
    return {
        name: law([(c["container_radius"], abs(c[name]), c[f"{name}_error"]) for c in changes])
        for name in QUANTITIES
    }


def verdict_on(laws, last, binder, saturated=False):
    """By the largest cumulant and by the exponents of slope and correlation time, of all sizes and
    of the largest ones. The growth of the slope has also ended if it is `saturated`: neither a
    power law nor a logarithm fits, and a limit does. A missing or uncertain exponent leaves the
    question open."""
    if binder[0] - CERTAIN * binder[1] > TWO_STATES:
        return "first order"
    exponents, final = ([each[name][:2] for name in DECISIVE] for each in (laws, last))
    if not any(map(math.isfinite, np.ravel(exponents))):
        return "too few sizes to tell"
    if all(exponent > CERTAIN * error for exponent, error in exponents + final):
        return "critical"
    ended = [
        exponent <= CERTAIN * error and exponent + 2 * error < GROWTH for exponent, error in final
    ]
    if (ended[0] or saturated) and ended[1]:
        return "smooth"
    return "undecided"


def times_of(change):
    """The correlation time next to the times of sound across the diameter and of viscosity, that of
    the slowest swirl in a circle at rest, R²/(3.832² ν), in periods; the container has the speed
    1."""
    radius, packing, temperature = (
        change[name] for name in ("container_radius", "packing_fraction", "granular")
    )
    period = 2 * math.pi * change["amplitude_ratio"] * radius
    return {
        **{
            name: change[name]
            for name in (
                "container_radius",
                "amplitude_ratio",
                "kind",
                "packing_fraction",
                "granular",
                "granular_error",
                "correlation",
                "correlation_error",
            )
        },
        "sound": 2 * radius / sound_speed(packing, temperature) / period,
        "viscosity": radius
        * radius
        / (SLOWEST**2 * kinematic_viscosity(packing, temperature))
        / period,
    }


def table(points, settings):
    found, _ = dish_tables(points, settings)
    tables, findings = scaling_tables(found["_changes"])
    return {**found, **tables}, findings


def scaling_tables(all_changes):
    transitions, rows, findings = {}, [], []
    for change in all_changes:
        transitions.setdefault((change["amplitude_ratio"], change["kind"]), []).append(change)
    for (
        amplitude,
        kind,
    ), changes in transitions.items():  # pancake line: 1 − √(φ_c/φ), with the slope 1/2φ at φ_c
        changes.sort(key=lambda change: change["container_radius"])
        laws, last = laws_of(changes), laws_of(changes[-LAST_SIZES:])
        binder = max(
            ((c["binder"], c["binder_error"]) for c in changes if math.isfinite(c["binder"])),
            default=(math.nan, math.nan),
        )
        limits, freedom = laws_of(changes, saturating_law), laws["slope"][4] - 2
        logarithms = laws_of(changes, logarithmic_law)
        unlimited = min(laws["slope"][3], logarithms["slope"][2])
        saturated = (
            chi2.sf(unlimited, freedom) < RARE and chi2.sf(limits["slope"][2], freedom) > 0.05
        )
        verdict = verdict_on(laws, last, binder, saturated)
        rows += [
            {
                "amplitude_ratio": amplitude,
                "kind": kind,
                "quantity": name,
                **dict(zip(LAW, law)),
                "exponent_last": last[name][0],
                "exponent_last_error": last[name][1],
                **dict(zip(LIMIT, limits[name])),
                **dict(zip(LOGARITHM, logarithms[name])),
                "verdict": verdict,
            }
            for name, law in laws.items()
        ]
        exponents = ", ".join(
            f"{words} {with_error(*laws[name][:2])}" for name, words in QUANTITIES.items()
        )
        findings.append(
            f"A/R = {amplitude:g}, {kind} ({len(changes)} sizes): {verdict}; exponents of R/r: "
            f"{exponents}, of the slope in the largest {min(LAST_SIZES, len(changes))} "
            f"{with_error(*last['slope'][:2])}; largest "
            f"slope {with_error(abs(changes[-1]['slope']), changes[-1]['slope_error'])}, its limit "
            f"{with_error(*limits['slope'][:2])} (χ² {limits['slope'][2]:.1f}, of the power law "
            f"{laws['slope'][3]:.1f}, of a logarithm {logarithms['slope'][2]:.1f}), pancake line "
            f"{1 / (2 * changes[-1]['packing_fraction']):.2f}; largest "
            f"Binder cumulant {with_error(*binder)}."
        )
    times = [
        times_of(change)
        for change in all_changes
        if change["kind"] == "free" and change["granular"] > 0
    ]
    return {"_scaling": rows, "_times": times}, findings


# --- Drawing ------------------------------------------------------------------------------------

LABELS = (
    ("slope", r"slope $|d(\varpi/\Omega)/d\varphi|$"),
    ("susceptibility", r"$N\,\mathrm{var}(\varpi/\Omega)\,\tau$"),
    ("correlation", r"correlation time $\tau$ (periods)"),
)
KINDS = {
    "free": "free",
    "wall": "at the wall",
    "elongated": "elongated",
    "back": "back to rotation",
}


def against_size(axes, changes, scaling, quantity, label):
    """One curve for each transition, with its laws."""
    groups = sorted({(row["amplitude_ratio"], row["kind"]) for row in changes})
    for k, (amplitude, kind) in enumerate(groups):
        here = tables.select(changes, amplitude_ratio=amplitude, kind=kind)
        x, y = (np.array(style.column(here, name)) for name in ("container_radius", quantity))
        axes.errorbar(
            x,
            abs(y),
            yerr=style.log_errors(y, style.column(here, quantity + "_error")),
            color=style.CYCLE[k],
            fmt=style.MARKERS[k],
            elinewidth=0.7,
            label=f"$A/R = {amplitude:g}$, {KINDS[kind]}",
        )
        law = tables.select(scaling, amplitude_ratio=amplitude, kind=kind, quantity=quantity)
        if law and law[0]["exponent"] == law[0]["exponent"]:
            ends = np.array([min(x), max(x)])
            axes.plot(
                ends,
                law[0]["factor"] * ends ** law[0]["exponent"],
                color=style.CYCLE[k],
                linewidth=0.7,
                linestyle="--",
            )
        if law and law[0]["limit"] == law[0]["limit"]:
            x = np.geomspace(min(x), max(x))
            axes.plot(
                x,
                law[0]["limit"] * np.tanh(x / law[0]["bend"]),
                color=style.CYCLE[k],
                linewidth=0.9,
            )
    axes.set(xscale="log", yscale="log")
    axes.set_xticks([6, 12, 24, 60], ["6", "12", "24", "60"])
    axes.xaxis.set_minor_locator(style.matplotlib.ticker.NullLocator())
    axes.set(xlabel=r"container radius $R/r$", ylabel=label)


def draw(table):
    changes, scaling = tables.companion(table, "_changes"), tables.companion(table, "_scaling")
    drawing, axes = style.figure(style.PAGE, 2.6, ncols=len(LABELS))
    for panel, (quantity, label) in zip(axes, LABELS):
        against_size(panel, changes, scaling, quantity, label)
    style.legend_of_all(drawing, axes[0], ncol=5)
    style.save(drawing, table)


FIGURES = [
    Figure(
        "critical",
        "chapters",
        "chapter: is the change of direction a critical phenomenon?",
        points,
        table,
        draw,
    )
]
