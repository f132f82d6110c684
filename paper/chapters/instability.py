"""Zhao and Pöschel (arXiv 2008.12902 and 2107.14440) report that a uniform layer becomes unstable beyond a threshold of the
amplitude: a dense region forms and travels around the dish. In denser layers a solid core rotates against the swirl, with
a fluid layer at the wall."""

import math

import style
from coarse_zero import changes_of_sign, middle_zero, zero_of_curve
from combine import means
from curves import with_error
from dishes import SPHERES_OF_CHAPTERS, resolved
from figure import Figure
from runs import length_of, lengths, text
from study import Point
from swirled_state import swirled_run

LAYERS = (0.3, 0.45, 0.65)  # φ
MORE_LAYERS = (0.2, 0.375, 0.55, 0.75)  # for the threshold only
AMPLITUDES = (0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0)  # A/r
RADIUS = 17.0
QUANTITIES = ("distance", "steady", "advance", "core", "layer", "rotation")
# A layer is unstable if its distance exceeds that of random points by this factor.
UNSTABLE = 2


def layers(settings):
    return LAYERS if settings.quick else sorted(LAYERS + MORE_LAYERS)


def layer_point(settings, name, fraction, amplitude, work):
    run = {**SPHERES_OF_CHAPTERS, "discs": int(fraction * RADIUS * RADIUS + 0.5), "container_radius": RADIUS,
           "amplitude": amplitude, "period": resolved(SPHERES_OF_CHAPTERS)["period"], **lengths(settings, (20, 2), (24, 8))}
    return Point(settings, f"{name}_N{run['discs']}_A{text(amplitude)}_{length_of(run)}", settings.chapter_seeds, run,
                 work=work, cells={"packing_fraction": fraction, "discs": run["discs"], "amplitude": amplitude})


def points(settings):
    return [layer_point(settings, "instability", fraction, amplitude, swirled_run) for fraction in layers(settings)
            for amplitude in ((0.25, 1.0, 2.0) if settings.quick else AMPLITUDES if fraction in LAYERS else
                              AMPLITUDES[-3:])]


def distance_of_random_points(discs):
    """The mean distance of the centre of mass from the middle of the dish, in R, of N independent points in the circle
    that centres can reach. Each coordinate has the variance (R − r)²/4N."""
    return (1 - 1 / RADIUS) * math.sqrt(math.pi / (8 * discs))


def threshold_of(excess):
    """The amplitude above which the layer is unstable, as a CurveZero; None if none is certain."""
    for change in reversed(changes_of_sign(excess)):
        if not change["to_counterrotation"]:  # rises above
            return zero_of_curve(excess, middle_zero(excess, change))
    return None


def table(points, settings):
    rows, thresholds, findings = [], [], []
    for fraction in layers(settings):
        excess = []
        for point in (p for p in points if p.cells["packing_fraction"] == fraction):
            row = {**point.cells, **means(point.runs, QUANTITIES), "seeds": len(point.runs)}
            rows.append(row)
            random = distance_of_random_points(row["discs"])
            excess.append((row["amplitude"], row["distance"] / random - UNSTABLE, row["distance_error"] / random))
        found = threshold_of(excess)
        value, error = (found.discs, found.error) if found else (math.nan, math.nan)
        thresholds.append({"packing_fraction": fraction, "discs": row["discs"], "random_distance": random,
                           "threshold": value, "threshold_error": error})
        findings.append(f"φ = {fraction}: the centre of mass is farther from the middle than {UNSTABLE} times the distance "
                        f"of random points "
                        f"{f'from A/r = {with_error(value, error)} on' if found else 'at no certain amplitude'}.")
    return {"": rows, "_thresholds": thresholds}, findings


PANELS = (("distance", r"distance of the centre of mass $\langle|q|\rangle/R$"),
          ("steady", r"part that turns with the swirl"),
          ("core", r"rotation of the core ($\Omega$)"),
          ("layer", r"rotation of the wall layer ($\Omega$)"))


def draw_instability(table):
    rows = style.read(table)
    drawing, panels = style.figure(style.PAGE, 5.2, ncols=2, nrows=2)
    for axes, (quantity, words) in zip(panels.flat, PANELS):
        style.zero_line(axes)
        for layer, here, look in style.groups(rows, "packing_fraction"):
            style.curve(axes, here, "amplitude", quantity, **look,
                        label=rf"$\varphi = {layer:g}$, $N = {here[0]['discs']:g}$")
        axes.set(ylabel=words, xlabel="amplitude $A/r$")
    style.legend_of_all(drawing, panels[0, 0], ncol=3)
    style.save(drawing, table)


FIGURES = [Figure("instability", "chapters", "chapter: from which amplitude on is a layer of spheres unstable?", points,
                  table, draw_instability)]
