"""An object of each public class, for tests that ask all classes the same."""

import numpy as np

import swirl

SCENE = {"discs": 16, "periods": 12, "warmup": 2}
MEASURE = ["density", "flow", "profile", "slip", "wall"]
COLUMNS = {
    "frame": [0, 0, 1, 1],
    "particle": [0, 1, 0, 1],
    "x": [0.0, 3.0, 0.0, 3.0],
    "y": [0.0, 0.0, 0.1, 0.1],
}
DISH = {"omega": 1.0, "container_radius": 8.0}


def speeds(snapshot):
    return np.hypot(*snapshot.velocity[:2].T)


def public_classes():
    """Without exceptions, which are like those of Python."""
    kinds = [getattr(swirl, name) for name in swirl.__all__]
    return [
        kind for kind in kinds if isinstance(kind, type) and not issubclass(kind, BaseException)
    ]


def instances(folder):
    """{class: object}; `folder` is for a recording. A new public class needs an object here."""
    sim = swirl.Simulation(discs=16)
    frames = sim.sample(periods=3, per_period=100)
    file = folder / "a.h5"
    swirl.run(discs=3, periods=2, trajectory=file)
    result = swirl.run(**SCENE, measure=[*MEASURE, speeds], series=True)
    tracks = swirl.Tracks(COLUMNS, **DISH)
    video, recording = (kind.__new__(kind) for kind in (swirl.VideoTracks, swirl.Recording))
    video._frames = recording._frames = tracks._frames
    video.quality = {"discs": 2}
    points = [{"discs": discs, "events": 2000} for discs in (8, 12)]
    table = swirl.sweep(folder / "sweep", points=points)
    sweep = swirl.SweepFolder(folder / "sweep")
    objects = [
        sim,
        sim.snapshot(),
        next(sim.events(1)),
        frames,
        result,
        result.rotation,
        result.rotation.mean_by_time,
        result.measured["slip"],
        result.measured["density"].table,
        result.series,
        result.events,
        swirl.crossing(min_discs=34, max_discs=42, tolerance=5, events=2000),
        swirl.analyse(frames, ["density"]),
        result.measured["speeds"]["value"],
        swirl.parameters()[0],
        swirl.EventKind.disc_disc,
        swirl.Lab("<html></html>", 100),
        swirl.Trajectory(file),
        tracks,
        recording,
        video,
        swirl.mean([0.1, 0.2]),
        sweep,
        sweep.run(),
        sweep.files(points)[0][0],
        swirl.compare_points([(8, 4.4, 20), (12, 4.0, 20)], table),
    ]
    found = {type(one): one for one in objects}
    missing = [kind.__name__ for kind in public_classes() if kind not in found]
    assert not missing, f"add an object of {', '.join(missing)}"
    return found
