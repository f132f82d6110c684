"""The quantities that published experiments with swirled spheres report: kinetic energy, rings,
paths of single particles, and rotation. All are averages over the samples of one run after its
warm-up.

Paths. A rigid cluster whose centre orbits the container's centre C with the swirl's Ω, and that
rotates with ϖ about its own centre, moves each of its discs along p(t) = D e^{iΩt} + ρ e^{iϖt}
relative to C, as complex numbers. With ϖ < 0 this is a hypotrochoid. A cluster of radius R_c in a
container of radius R has |D| = R − R_c. If it rolls without slip, ϖ = Ω (1 − R/R_c); then a disc at
its rim, |ρ| = R_c, follows a hypocycloid with its cusps at the wall. D and ρ are free for each
disc, ϖ is one number for all discs. For a given ϖ, with the means over the samples a = ⟨p
e^{−iΩt}⟩, b = ⟨p e^{−iϖt}⟩ and g = ⟨e^{i(ϖ−Ω)t}⟩, least squares leave

    ⟨|p|²⟩ − (|a|² + |b|² − 2 Re(a* g b)) / (1 − |g|²)

for each disc. ϖ is that of least residual on a grid from −0.5 to 0.8 Ω, because the two terms
cannot be separated near Ω.
"""

import numpy as np

from paper.engine import swirl

PER_PERIOD = 60  # samples
PERIODS_OF_A_PATH = 4
RINGS_PER_RADIUS = 5
RATES = -0.5 + 0.005 * np.arange(261)  # of the fit, ϖ/Ω


def mean_with(paths, rate):
    """⟨p e^{−i rate t}⟩ of each path [sample, disc]."""
    times = 2 * np.pi * np.arange(len(paths)) / PER_PERIOD
    return np.exp(-1j * rate * times) @ paths / len(paths)


def fit_hypotrochoids(paths):
    """(ϖ/Ω, root mean square distance of the discs from their paths); `paths` [sample, disc] are
    complex."""
    power, a, ones = (
        np.sum(np.abs(paths) ** 2) / len(paths),
        mean_with(paths, 1),
        np.ones((len(paths), 1)),
    )

    def residual(rate):
        g, b = mean_with(ones, 1 - rate)[0], mean_with(paths, rate)
        return power - np.sum(np.abs(a) ** 2 + np.abs(b) ** 2 - 2 * (a.conj() * g * b).real) / (
            1 - abs(g) ** 2
        )

    def search(numbers):
        return min((residual(RATES[k]), k) for k in numbers)

    # The residual varies over 1/4 Ω in four periods, so a coarse search finds the valley.
    near = search(range(0, len(RATES), 10))[1]
    least, best = search(range(max(near - 9, 0), min(near + 10, len(RATES))))
    return RATES[best], np.sqrt(max(0, least) / paths.shape[1])


class Samples:
    """Keeps what the averages need of each period."""

    name, samples_per_period = "swirled_state", PER_PERIOD

    def __init__(self):
        self.columns = {}

    def block(self, frames):
        snapshots = [frames[k] for k in range(len(frames))]
        rolling = [
            0 if s.rolling_spin is None else np.sum(s.rolling_spin**2, axis=1) for s in snapshots
        ]
        here = {
            "position": frames.position - frames.container_centre[:, None],
            "velocity": frames.velocity,
            "carrier": frames.container_velocity,
            "spins": frames.inertia
            / frames.mass
            * (frames.spin**2 + np.array(rolling).reshape(len(snapshots), -1)),
        }
        for name, column in here.items():
            self.columns.setdefault(name, []).append(column)
        self.radius = frames.container_radius
        return {"samples": float(len(frames))}


def dot(a, b):
    return a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1]


def densities(distance):
    """Particles per area in rings, a mean over the samples."""
    index = np.floor(distance * RINGS_PER_RADIUS).astype(int)
    inner, width = np.arange(index.max() + 1) / RINGS_PER_RADIUS, 1 / RINGS_PER_RADIUS
    return np.bincount(index.ravel()) / (len(distance) * np.pi * width * (2 * inner + width))


def swirled_run(parameters):
    """The averages over a run, as numbers, and the densities in rings about the cluster's and the
    container's centre."""
    samples = Samples()
    run = swirl.run(measure=samples, **parameters)
    s = {name: np.concatenate(blocks) for name, blocks in samples.columns.items()}
    p = s["position"]
    r = p - p.mean(axis=1)[:, None]
    length = PERIODS_OF_A_PATH * PER_PERIOD
    fits = np.array(
        [
            fit_hypotrochoids(p[k : k + length] @ [1, 1j])
            for k in range(0, len(p) - length + 1, length)
        ]
    )
    bins = int(2 * samples.radius * RINGS_PER_RADIUS) + 1
    rings = {
        name: np.pad(values, (0, bins - len(values))).tolist()
        for name, values in (
            ("about_centre_of_mass", densities(np.sqrt(dot(r, r)))),
            ("about_container", densities(np.sqrt(dot(p, p)))),
        )
    }
    return {
        "speed_square": float(dot(s["carrier"], s["carrier"])[0]),
        "square": float(dot(s["velocity"], s["velocity"]).mean()),
        "spin_square": float(s["spins"].mean()),
        "path_rotation": float(fits[:, 0].mean()),
        "path_distance": float(np.sqrt((fits[:, 1] ** 2).mean())),
        "rotation": run.rotation.mean_by_time.mean,
        **rings,
    }
