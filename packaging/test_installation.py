"""Checks an installation: known scenes give their known state hashes.

    python packaging/test_installation.py            the Python package: module and command
    python packaging/test_installation.py PROGRAM    a program
"""

import json
import subprocess
import sys

# Options and state hash (docs/explanation/determinism.md).
SCENES = (
    (dict(discs=48, events=1_000_000), "280b7c9750862b84"),
    (dict(discs=28, motion="circle", events=200_000), "ce3442c03e0f14d2"),
    (dict(discs=300, radius=0.3, events=200_000), "1e45f8c5f23973e4"),
)


def hash_of_program(command, scene):
    options = [word for name, value in scene.items() for word in (f"--{name}", str(value))]
    done = subprocess.run(
        [*command, "run", *options, "--quiet", "--json", "-"],
        check=True,
        stdout=subprocess.PIPE,
        text=True,
    )
    return json.loads(done.stdout)["state_hash"]


def hash_of_module(scene):
    import swirl

    return swirl.run(**scene).state_hash


def main():
    command = sys.argv[1:] or [sys.executable, "-m", "swirl"]
    for scene, expected in SCENES:
        found = {"program": hash_of_program(command, scene)}
        if not sys.argv[1:]:
            found["module"] = hash_of_module(scene)
        for what, state_hash in found.items():
            if state_hash != expected:
                sys.exit(
                    f"error: the {what} gives state hash {state_hash} for {scene}; expected "
                    f"{expected}."
                )
    print(f"{len(SCENES)} scenes have the expected state hashes.")


if __name__ == "__main__":
    main()
