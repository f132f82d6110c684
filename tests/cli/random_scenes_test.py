"""For every random choice of parameters from their whole range, with fixed seeds, a run of a
thousand events either ends or is rejected with one error message.

With --all: hundreds of choices, with --soak thousands, up to hundreds of thousands of discs and ten
thousand spheres."""

import json
import math
import os
import random
import re
import resource
import subprocess
import sys
import unittest

from program import ONE_ERROR, SWIRL, InFolder

HANG = 100  # seconds of processor time; a run takes a few at most
ADDRESS_SPACE = 3 << 30


def log_uniform(draw, low, high):
    return float(f"{math.exp(draw.uniform(math.log(low), math.log(high))):.3g}")


def usual_or(draw, usual, low, high, share=0.4):
    """The usual value, an extreme, or a random value in between."""
    choice = draw.random()
    if choice < share:
        return usual
    if choice < share + 0.05:
        return low
    return high if choice < share + 0.1 else log_uniform(draw, low, high)


def drawn(draw, max_discs):
    radius = usual_or(draw, 1, 1e-6, 1e6, 0.7)
    # Mostly a container into which the discs fit, from dense to extremely dilute.
    discs = int(usual_or(draw, 48, 1, max_discs, 0.2))
    packing = log_uniform(draw, 1e-9, 0.85) if draw.random() < 0.4 else draw.uniform(0.1, 0.75)
    container = min(max(radius * math.sqrt(discs / packing), 1.02 * radius), 1e6)
    options = {
        "discs": discs,
        "radius": radius,
        "container-radius": float(f"{container:.4g}")
        if draw.random() < 0.9
        else usual_or(draw, 8.6, 1e-6, 1e6),
        "seed": draw.randrange(1 << 32),
        "events": 1000,
        "warmup": 0,
    }
    if draw.random() < 0.3:
        small = log_uniform(draw, 1e-3, 1) * radius
        options["mixture"] = f"{draw.randint(1, discs)}:{small:.3g}"
        if draw.random() < 0.3:
            options["mixture"] += f":{log_uniform(draw, 1e-6, 1e6)}"
    for name, usual, low, high in (
        ("mu", 1, 1e-6, 1e6),
        ("mass", 1, 1e-6, 1e6),
        ("inertia", "paper", 1e-12, 1e18),
        ("amplitude", 1.892, 1e-6, 1e6),
        ("period", 11.87, 1e-6, 1e6),
    ):
        if draw.random() < 0.4:
            options[name] = usual_or(draw, usual, low, high, 0.2)
    if draw.random() < 0.2:
        options["amplitude"] = 0
    if draw.random() < 0.2:
        options["motion"] = "circle"
    elif draw.random() < 0.2:
        options["sides"] = draw.choice([3, 4, 1000, 1000000])
    if draw.random() < 0.3:
        options["restitution"] = draw.choice([0, 0.5, 0.9, 0.999])
        options["tangential-restitution"] = draw.choice([0, 0.5, 1])
        options["contact-duration"] = usual_or(draw, 0, 1e-9, options.get("period", 11.87), 0.2)
    if draw.random() < 0.4 and discs <= 10_000:
        options.update(on_a_floor(draw, options))
    if draw.random() < 0.2:
        options["cannot-spin"] = draw.choice([0.5, 1])
    if draw.random() < 0.1:
        options["measure"] = "all"
    return [text for name, value in options.items() for text in (f"--{name}", str(value))]


def on_a_floor(draw, options):
    """Options of spheres or coins; spheres get the inertia of a sphere or a shell instead of
    `paper`."""
    more = {
        "body": draw.choice(["sphere", "sphere", "disc"]),
        "floor": draw.choice(["none", "sliding", "sliding"]),
    }
    if more["body"] == "sphere":
        if options.get("inertia") == "paper":
            more["inertia"] = draw.choice(["sphere", "shell"])
        for name in ("vertical-disc", "vertical-wall"):
            if draw.random() < 0.2:
                more[name] = draw.choice([0, 0.5, 1])
    if more["floor"] == "sliding":
        more["floor-friction"] = usual_or(draw, 0.3, 1e-6, 1e6)
        more["gravity"] = usual_or(draw, 6.382, 1e-6, 1e6)
        if more["body"] == "sphere" and draw.random() < 0.3:
            more["rolling-resistance"] = (
                draw.choice([1.0, 0.1, 0.01, 1e-6]) * more["floor-friction"]
            )
    return more


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (HANG, HANG + 5))
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))


class RandomScenes(InFolder):
    def run_or_rejected(self, options):
        """True if the run ended, False if it was rejected."""
        done = subprocess.run(
            [SWIRL, "run", *options, "--json", "-", "--quiet"],
            capture_output=True,
            text=True,
            stdin=subprocess.DEVNULL,
            cwd=self.folder,
            preexec_fn=limit,
            env=dict(os.environ, NO_COLOR="1"),
        )
        call = "swirl run " + " ".join(options)
        if done.returncode in (1, 2):
            self.assertRegex(done.stderr, ONE_ERROR, call)
            return False
        self.assertEqual(done.returncode, 0, f"{call}\n{done.stderr}")
        result = json.loads(done.stdout)
        self.assertTrue(result["complete"], call)
        self.assertGreaterEqual(result["events"]["total"], 1000, call)
        return True

    def test_a_container_with_too_large_rounding_errors_is_rejected(self):
        # A is 10^11 radii, and a double has a relative precision of 10^-16.
        scene = ["--radius", "1e-5", "--container-radius", "8.6e-5", "--discs", "5"]
        self.assertTrue(self.run_or_rejected([*scene, "--amplitude", "1e-4", "--events", "10000"]))
        self.assertFalse(self.run_or_rejected([*scene, "--amplitude", "1e6", "--events", "10000"]))

    def test_random_parameters_run_or_are_rejected(self):
        cases, max_discs = (
            (3000, 3e5)
            if "--soak" in sys.argv
            else (500, 3e5)
            if "--all" in sys.argv
            else (80, 3000)
        )
        run = 0
        for case in range(cases):
            options = drawn(random.Random(f"scene {case}"), max_discs)
            with self.subTest(case=case, options=" ".join(options)):
                run += self.run_or_rejected(options)
        self.assertGreater(run, cases / 3)
        print(f"{run} of {cases} were run, the others rejected")


if __name__ == "__main__":
    unittest.main(argv=[a for a in sys.argv if a not in ("--all", "--soak")])
