"""The runs that the chapters share: discs in dishes of any size."""

import dataclasses
import json
import math

from paper.coarse_zero import changes_of_sign, middle_zero, zero_of_curve
from paper.combine import at, number
from paper.curves import CERTAIN, direction_of, rate_of, rows_of, with_error
from paper.engine import swirl
from paper.runs import length_of, lengths
from paper.study import Point


@dataclasses.dataclass(frozen=True)
class Dish:
    """A dish and its swirl, in units of the disc radius r."""

    radius: float  # R/r
    amplitude: float  # A/R

    def discs(self, packing_fraction):
        """The number of discs with this packing fraction φ = N r²/R²."""
        return max(2, int(packing_fraction * self.radius * self.radius + 0.5))


def dish_run(dish, discs):
    """The container has the speed 1 in every dish."""
    return {
        "discs": discs,
        "container_radius": dish.radius,
        "amplitude": dish.amplitude * dish.radius,
        "speed": 1,
    }


def resolved(parameters):
    """All parameters of a run."""
    return swirl.resolve(**parameters)


def period_of(parameters):
    """The period of the swirl."""
    return resolved(parameters)["period"]


# --- Runs with fluctuations ---------------------------------------------------------------------

MEASURED = ("slip", "contact_network", "centre", "temperature")
QUANTITIES = """slip.cluster_perimeter slip.cluster=slip contact_network.wall contact_network.coordination
    contact_network.largest centre.distance centre.theta centre.elongation temperature.granular fluctuations.variance
    fluctuations.correlation fluctuations.susceptibility fluctuations.binder""".split()


def fluctuating_run(parameters):
    """A run with the fluctuations of ϖ from period to period: their variance, correlation time τ in
    periods, Binder cumulant (0 for one normal state, 2/3 for two equal ones), and N · variance · τ,
    which does not depend on the length of the means."""
    result = json.loads(swirl.run(measure=list(MEASURED), series=True, **parameters).to_json())
    found = result["series"]["averages"]["rigid_by_time"]["fluctuations"]
    variance, time = (number(found[name]["mean"]) for name in ("n_variance", "correlation_time"))
    result["measured"]["fluctuations"] = {
        "correlation": found["correlation_time"],
        "binder": found["binder"],
        "variance": {"mean": variance / parameters["discs"], "error": None},
        "susceptibility": {"mean": variance * time, "error": None},
    }
    return result


fluctuating_run.stored_as = "dishes.fluctuating_run"


def dish_points(settings, dishes):
    """A point for each pair of a dish and a packing fraction, and each number of discs once. In a
    large dish a period has many events, and the rotation varies less."""
    made = []
    for dish, discs in dict.fromkeys((dish, dish.discs(fraction)) for dish, fraction in dishes):
        R = dish.radius
        run = {
            **dish_run(dish, discs),
            **lengths(
                settings,
                (50 if R < 20 else 20, 2),
                (300 if R < 10 else 200 if R < 20 else 80 if R < 40 else 60, 5),
            ),
        }
        made.append(
            Point(
                settings,
                f"dish_R{R:g}_A{dish.amplitude:g}_N{discs}_{length_of(run)}",
                settings.chapter_seeds,
                run,
                work=fluctuating_run,
                cells={
                    "container_radius": R,
                    "amplitude_ratio": dish.amplitude,
                    "packing_fraction": discs / (R * R),
                    "discs": discs,
                },
            )
        )
    return made


def shares_of_the_states(point):
    """Where the seeds disagree, the shares of the seeds that certainly rotate and counterrotate:
    the mean over them is that of no state."""
    runs = (
        [at(run, "rotation", "rigid_by_time") for run in point.runs]
        if at(point.result, "seeds", "disagree")
        else []
    )
    return {
        f"share_{name}": sum(
            sign * number(rate["mean"]) > CERTAIN * number(rate["error"]) for rate in runs
        )
        / len(runs)
        if runs
        else None
        for name, sign in (("rotating", 1), ("counterrotating", -1))
    }


# --- Changes of direction -----------------------------------------------------------------------


def kind_of(change):
    """The geometry of a change to counterrotation: "wall" if discs occupy a tenth of the wall or
    more, otherwise "elongated" if the elongation of the cluster is above 1.2, otherwise "free". A
    change back to rotation: "back"."""
    if change["direction"] == "rotation":
        return "back"
    return (
        "wall"
        if change["occupied"] >= 0.1
        else "elongated"
        if change["elongation"] > 1.2
        else "free"
    )


def change_at(points, curve, found, radius, amplitude):
    """The row of a change between two N with certain and opposite signs, at its zero; the middle
    one of several."""
    k, area = middle_zero(curve, found), radius * radius
    zero = zero_of_curve(curve, k)
    (a, mean_a, error_a), (b, mean_b, error_b) = curve[k : k + 2]
    f, step = zero.fraction, b - a

    def ends(*path):
        return (number(at(point.result, "measured", *path)) for point in points[k : k + 2])

    def between(*path):
        left, right = ends(*path, "mean")
        return (1 - f) * left + f * right

    def error(*path):
        left, right = ends(*path, "error")
        return math.hypot((1 - f) * left, f * right)

    wall, fraction = between("contact_network", "wall"), zero.discs / area
    change = {
        "container_radius": radius,
        "amplitude_ratio": amplitude,
        "direction": direction_of(found),
        "kind": "",
        "packing_fraction": fraction,
        "packing_fraction_error": zero.error / area,
        "interpolation_error": zero.interpolation / area,
        "slope": (mean_b - mean_a) / step * area,
        "slope_error": math.hypot(error_a, error_b) / step * area,
        "before": found["before"] / area,
        "after": found["after"] / area,
        "largest": between("contact_network", "largest"),
        "wall": wall,
        # A full layer has π/arcsin(r/(R − r)) discs, or nearly π(R − r)/r.
        "occupied": wall * fraction * area / (math.pi * (radius - 1)),
        "elongation": between("centre", "elongation"),
        # (radius of the hull + distance of its centre from C) / R
        "reach": (
            between("slip", "cluster_perimeter") / (2 * math.pi) + between("centre", "distance")
        )
        / radius,
    }
    change["kind"] = kind_of(change)
    for family, name in (
        *(("fluctuations", name) for name in ("susceptibility", "correlation", "binder")),
        ("temperature", "granular"),
    ):
        change[name], change[f"{name}_error"] = between(family, name), error(family, name)
    for end, point in zip(("before", "after"), points[k : k + 2]):
        change[f"share_rotating_{end}"] = shares_of_the_states(point)["share_rotating"]
    return change


def direction_changes(points):
    """The changes of each dish, {(R/r, A/R): rows}, by the rate rigid_by_time."""
    changes = {}
    for dish in dict.fromkeys(
        (p.cells["container_radius"], p.cells["amplitude_ratio"]) for p in points
    ):
        here = [
            p for p in points if (p.cells["container_radius"], p.cells["amplitude_ratio"]) == dish
        ]
        curve = [rate_of(point, "rigid_by_time") for point in here]
        changes[dish] = [change_at(here, curve, found, *dish) for found in changes_of_sign(curve)]
    return changes


def words_of(change):
    return (
        f"to {change['direction']} at φ = "
        f"{with_error(change['packing_fraction'], change['packing_fraction_error'])} "
        f"({100 * change['occupied']:.1f} % of the wall occupied, largest group "
        f"{100 * change['largest']:.0f} %, "
        f"elongation {change['elongation']:.2f})"
    )


def dish_tables(points, settings):
    """The rows of the points, and the changes of direction."""
    changes = direction_changes(points)
    rows = [
        {**row, **shares_of_the_states(point)}
        for row, point in zip(rows_of(points, QUANTITIES), points)
    ]
    return (
        {"": rows, "_changes": [row for all in changes.values() for row in all]},
        [
            f"R/r = {radius:g}, A/R = {amplitude:g}: "
            f"{'; '.join(map(words_of, all)) or 'no certain change of direction'}."
            for (radius, amplitude), all in changes.items()
        ],
    )
