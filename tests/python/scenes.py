"""Shared by tests of the Python module: scenes, and calls of the command line."""

import json
import os
import subprocess

SWIRL = os.environ.get("SWIRL", "build/tests/swirl")
SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)

with open(os.path.join(SOURCE, "tests", "scenes.json"), encoding="utf-8") as table:
    SCENES = [
        {name: tuple(value) if isinstance(value, list) else value for name, value in scene.items()}
        for scene in json.load(table)
    ]


def options(scene):
    """Command-line options of a scene."""
    words = []
    for name, value in scene.items():
        text = ":".join(map(str, value)) if isinstance(value, tuple) else str(value)
        option = {"path": "motion"}.get(name, name)
        words += ["--" + option.replace("_", "-"), text]
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
