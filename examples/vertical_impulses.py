"""Vertical impulses between the spheres of a run on a floor, from its event log.

    swirl run --preset experiment --discs 36 --periods 60 --log-events events.h5
    python3 examples/vertical_impulses.py events.h5

The model is planar (docs/explanation/spheres.md): a sphere stays on the floor even if vertical
friction lifts it, and the floor presses with m g on each sphere, whatever pushes it down. This
script prints what the model neglects. It needs h5py and numpy."""

import json
import sys

import h5py
import numpy as np

PAIR, WALL = 0, 1


def union(begins, ends):
    """Total length of the union of intervals, sorted by their beginnings."""
    if len(begins) == 0:
        return 0.0
    reached = np.maximum.accumulate(ends)
    new_begins = np.maximum(begins[1:], reached[:-1])
    return ends[0] - begins[0] + np.maximum(ends[1:] - new_begins, 0.0).sum()


def impulses(path):
    """Returns (lifted, pushed, masses, g, duration). `lifted` and `pushed` hold three arrays with
    one entry per impulse: sphere, time and |J_z|."""
    with h5py.File(path) as file:
        if "floor" not in file:
            sys.exit(f"error: '{path}' has no floor.\nhint: log a run with --preset experiment.")
        events = {name: column[:] for name, column in file["events"].items()}
        mass, period = file["initial/mass"][:], file["parameters"].attrs["period"]
        gravity = json.loads(file["parameters/parameters"][()])["gravity"]
    time = events["swirls"] * period + events["clock"]
    J = events["vertical_impulse"]
    kind, i, j = events["kind"], events["i"], events["j"]
    # J_z is the impulse on j (or on the wall) along +z. The impulse on i is opposite.
    of_i = (kind == PAIR) | (kind == WALL)
    of_j = kind == PAIR
    lifted = [
        np.concatenate([x[of_i & (J < 0)], y[of_j & (J > 0)]])
        for x, y in ((i, j), (time, time), (-J, J))
    ]
    pushed = [
        np.concatenate([x[of_i & (J > 0)], y[of_j & (J < 0)]])
        for x, y in ((i, j), (time, time), (J, -J))
    ]
    return lifted, pushed, mass, gravity, time[-1] - time[0]


def main(path):
    lifted, pushed, mass, g, duration = impulses(path)
    weight = mass.sum() * g * duration
    sphere, when, J = lifted
    speed = J / mass[sphere]
    in_air = 0.0
    for k in range(len(mass)):
        order = np.argsort(when[sphere == k], kind="stable")
        begins, durations = when[sphere == k][order], (2 * speed / g)[sphere == k][order]
        in_air += union(begins, begins + durations)
    height = speed**2 / (2 * g)
    weighted = (height * speed).sum() / max(speed.sum(), 1e-300)
    for name, value in (
        ("impulses that push down / weight x time", pushed[2].sum() / weight),
        ("impulses that lift / weight x time", J.sum() / weight),
        (
            "share of the time in flight, if lifted spheres could fly",
            in_air / (duration * len(mass)),
        ),
        ("largest height of a flight, in units of length", height.max(initial=0.0)),
        ("mean height of a flight, weighted with its duration", weighted),
    ):
        print(f"{name:<56}{value:.4g}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(
            "error: vertical_impulses.py takes one event log.\nhint: "
            + __doc__.split("\n\n")[1].strip()
        )
    try:
        main(sys.argv[1])
    except (OSError, KeyError) as error:
        sys.exit(f"error: '{sys.argv[1]}' is not an event log of swirl: {error}.")
