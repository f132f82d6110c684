"""The runs that the chapters share: discs or spheres in dishes of any size."""

import dataclasses
import json

from engine import swirl

SPHERES_OF_CHAPTERS = {"preset": "experiment-half", "mu": 0.2, "floor_friction": 0.3}


@dataclasses.dataclass(frozen=True)
class Dish:
    """A dish and its swirl, in units of the disc radius r."""

    radius: float  # R/r
    amplitude: float  # A/R
    spheres: bool = False  # that roll on the floor of the experiment, with μ = 0.2; else discs with μ = 1

    def discs(self, packing_fraction):
        """The number of discs with this packing fraction φ = N r²/R²."""
        return max(2, int(packing_fraction * self.radius * self.radius + 0.5))


def dish_run(dish, discs):
    """The container has the speed 1 in every dish."""
    return {**(SPHERES_OF_CHAPTERS if dish.spheres else {}), "discs": discs, "container_radius": dish.radius,
            "amplitude": dish.amplitude * dish.radius, "speed": 1}


def resolved(parameters):
    """All parameters of a run."""
    return json.loads(swirl._engine.resolve(parameters))


def period_of(parameters):
    """The period of the swirl."""
    return resolved(parameters)["period"]
