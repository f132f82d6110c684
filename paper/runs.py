"""The runs that the figures share: one number of discs with one pair of friction coefficients, at
the paper's parameters. Several figures need the same point; it is run once."""

import dataclasses

from paper.paper_parameters import COUNTERROTATING_N, EXPERIMENT_N, LAST_N, ROTATING_N
from paper.study import Point, events_per_period


@dataclasses.dataclass(frozen=True)
class Friction:
    """Friction coefficients between discs and at the wall. With a preset: spheres of the
    experiment, whose floor has the same coefficient."""

    name: str  # in tables
    words: str  # in sentences
    mu_disc: float
    mu_wall: float
    preset: str = ""

    @property
    def cells(self):
        return {"setting": self.name, "mu_disc": self.mu_disc, "mu_wall": self.mu_wall}


# Figure 5b. Caption: "When one friction is completely turned off, the other is set to 1.0."
HIGH = Friction("high", "high friction", 1, 1)
MEDIUM = Friction("medium", "medium friction", 0.5, 0.5)
LOW = Friction("low", "low friction", 0.1, 0.1)
NO_WALL = Friction("no-wall", "no wall friction", 1, 0)
NO_DISC = Friction("no-disc", "no disc friction", 0, 1)
FRICTION_OF_5B = (HIGH, MEDIUM, LOW, NO_WALL, NO_DISC)

# The experiment of Figures 1 to 4: smooth spheres; roughened ones (Figure 4c); and smooth ones with
# 1.15 cm as the diameter of the container's path instead of its radius.
SMOOTH = Friction("smooth", "smooth spheres", 0.33, 0.33, "experiment")
ROUGH = Friction("rough", "roughened spheres", 0.69, 0.69, "experiment-rough")
HALF = Friction("half", "smooth spheres at half the amplitude", 0.33, 0.33, "experiment-half")

FIRST_N = 5  # SI: "for each N between 5 and 48"
# Not in the paper: more discs. 59 discs can be placed, but from 56 on runs end in a frictional
# collapse.
DENSEST_N = 55


def text(value):
    """A number in the name of a point."""
    return f"{value:g}"


# --- Numbers of discs -----------------------------------------------------------------------------


def numbers_of_discs(settings):
    """The curves with equal friction coefficients cross where the quick list has no gaps, so that
    their N_c is known and not only bracketed."""
    if settings.quick:
        return [5, 8, 12, 16, 20, 24, 28, 32, 34, 36, 37, 38, 39, 40, 42, 43, 44, 45, 46, 48]
    return list(range(FIRST_N, LAST_N + 1))


def sparse_numbers(settings):
    """Fewer of them, for figures beyond the paper."""
    if settings.quick:
        return [8, 20, 28, 36, 42, 48]
    return [5, 8, 12, 16, 20, 24, 26, 28, 30, 32, 34, 36, 38, 40, 42, 44, 46, 48]


def numbers_beyond(settings):
    """More discs than in the paper."""
    return [52, 55] if settings.quick else list(range(LAST_N + 1, DENSEST_N + 1))


def numbers_of_spheres(settings):
    """57 spheres fit, but with 56 and 57 the initial packing decides, not friction, and some runs
    collapse."""
    if settings.quick:
        return [24, 28, 32, 36, 40, 44, 48, 52, 55]
    return [24, 25, 26, 28, 30, 32, 34, 35, 36, 37, 38, 40, 42, 44, 46, 48, 50, 52, 54, 55]


def numbers_of_the_experiment(settings):
    return [n for n in numbers_of_discs(settings) if n >= EXPERIMENT_N[0]]


def points_of(settings, frictions):
    """(friction, N): discs at the numbers of the experiment, spheres at numbers_of_spheres()."""
    return [
        (f, n)
        for f in frictions
        for n in (numbers_of_spheres if f.preset else numbers_of_the_experiment)(settings)
    ]


# --- Parameters of a run --------------------------------------------------------------------------


def paper_run(settings, friction, discs):
    """The paper's events; all else has its default. Spheres get a length in periods: a few dozen
    lose the memory of their initial state in about 50 periods."""
    if not friction.preset:
        return {
            "discs": discs,
            "mu_disc": friction.mu_disc,
            "mu_wall": friction.mu_wall,
            "events": settings.events_of_a_run,
        }
    dense = discs >= 50
    return {
        "discs": discs,
        "preset": friction.preset,
        **(lengths(settings, (25, 1), (50, 3)) if dense else lengths(settings, (50, 1), (150, 3))),
    }


def lengths(settings, warmup, averaged):
    """Warm-up and averaged periods, each (by default, at least), as parameters of a run."""
    warmup = settings.periods(*warmup)
    return {"warmup": warmup, "periods": warmup + settings.periods(*averaged)}


def with_periods(parameters, length):
    """Parameters whose length is `length` (see lengths()) instead of a number of events."""
    return {name: value for name, value in parameters.items() if name != "events"} | length


def dense_length(settings):
    """For more discs than in the paper, where states last longer and a period has more events."""
    return lengths(settings, (40, 1), (200, 3))


def sides(number):
    """A path with this many sides; 0: the circle."""
    return {"sides": number} if number else {"path": "circle"}


def length_of(parameters):
    """ "20of80periods": warm-up and length of a run, for names."""
    if "periods" in parameters:
        return f"{parameters['warmup']}of{parameters['periods']}periods"
    return f"{parameters['events']}events"


# --- Points ---------------------------------------------------------------------------------------


def measurements_of_the_paper(friction, discs):
    """All that the figures, or readers of the tables, need. Only the two numbers of discs of
    Figures 2 and 5 have maps, which are large."""
    names = [
        "profile",
        "pinned",
        "residence",
        "centre",
        "slip",
        "frustration",
        "order",
        "collisions",
        "temperature",
    ]
    if discs in (ROTATING_N, COUNTERROTATING_N):
        names += ["density", "flow"]
    return names + (["rolling"] if friction.preset else [])


def cells_of(friction, discs):
    return {**friction.cells, "discs": discs}


def point(settings, friction, discs, measure=(), run=None, prefix=""):
    """Rotation only, unless there are measurements; `run` are parameters other than those of the
    paper."""
    return Point(
        settings,
        f"{prefix}{friction.name}_N{discs}",
        settings.seeds,
        run or paper_run(settings, friction, discs),
        measure,
        cells=cells_of(friction, discs),
    )


def measured_point(settings, friction, discs):
    """The same runs, with all measurements that the figures need."""
    return point(settings, friction, discs, measurements_of_the_paper(friction, discs))


def dense_point(settings, friction, discs):
    return point(
        settings,
        friction,
        discs,
        run=with_periods(paper_run(settings, friction, discs), dense_length(settings)),
    )


def settled_run(settings, friction, discs):
    """The steady state of discs, which the paper does not show: averages over periods after a long
    warm-up. With μ_d = 0 only the wall changes a disc's spin, which takes about 100 periods."""
    parameters = paper_run(settings, friction, discs)
    averaged = max(200, int(1e6 / events_per_period(parameters)))
    return with_periods(
        parameters, lengths(settings, (100 if friction.mu_disc else 300, 2), (averaged, 3))
    )


def settled_point(settings, friction, discs):
    return point(
        settings,
        friction,
        discs,
        measurements_of_the_paper(friction, discs),
        settled_run(settings, friction, discs),
        "settled_",
    )
