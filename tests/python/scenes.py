"""Shared by tests of the Python module: scenes, and calls of the command line."""

import json
import os
import subprocess

SWIRL = os.environ.get("SWIRL", "build/tests/swirl")
SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)

SCENES = [
    dict(discs=1),
    dict(discs=2, seed=5),
    dict(discs=5, mu=0.1),
    dict(discs=28),
    dict(discs=48),
    dict(discs=48, mu_disc=0, mu_wall=1),
    dict(discs=40, mu_disc=1, mu_wall=0),
    dict(discs=28, path="circle"),
    dict(discs=40, mixture=(20, 0.6)),
    dict(discs=40, mixture="12:1.3:2"),
    dict(discs=48, restitution=0.9),
    dict(discs=28, inertia="solid", tangential_restitution=0.5),
    dict(discs=28, inertia=3.5, mass=2),
    dict(discs=300, radius=0.3, sides=7),
    dict(discs=48, amplitude=3, container_radius=9),
    dict(discs=20, amplitude=0, mu=0),
    dict(discs=45, period=7.5, seed=18446744073709551615),
    dict(discs=30, warmup=3),
    dict(discs=30, warmup="auto"),
    dict(discs=24, preset="experiment"),
    dict(discs=48, speed=0.5, seed=12),
]


def options(scene):
    """Command-line options of a scene."""
    words = []
    for name, value in scene.items():
        text = ":".join(map(str, value)) if isinstance(value, tuple) else str(value)
        words += ["--" + name.replace("_", "-"), text]
    return words


def command(*words, **more):
    return subprocess.run(
        [SWIRL, *map(str, words)], capture_output=True, text=True, stdin=subprocess.DEVNULL, **more
    )


def result_of(scene, *words):
    done = command("run", *options(scene), *words, "--json", "-", "--quiet")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def without_time(result):
    """The result without times and command."""
    return {
        name: value
        for name, value in result.items()
        if name not in ("seconds", "events_per_second", "command")
    }
