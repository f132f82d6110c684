"""Whatever parameters are accepted, a thousand events are run within seconds, or the call is refused in
one sentence: parameters drawn at random, each from all over its range, with fixed seeds.

With --all thousands of them, discs by the hundred thousand and spheres by the ten thousand."""

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

PROCESSOR_SECONDS = 10
ADDRESS_SPACE = 3 << 30


def log_uniform(draw, low, high):
    return float(f"{math.exp(draw.uniform(math.log(low), math.log(high))):.3g}")


def usual_or(draw, usual, low, high, share=0.4):
    """The usual value, an extreme, or anything between."""
    fate = draw.random()
    if fate < share:
        return usual
    return low if fate < share + 0.05 else high if fate < share + 0.1 else log_uniform(draw, low,
                                                                                       high)


def drawn(draw, most_discs):
    radius = usual_or(draw, 1, 1e-6, 1e6, 0.7)
    # Mostly a dish that the discs fit into, from the full one to the all but empty one.
    discs = int(usual_or(draw, 48, 1, most_discs, 0.2))
    packing = log_uniform(draw, 1e-9, 0.85) if draw.random() < 0.4 else draw.uniform(0.1, 0.75)
    dish = min(max(radius * math.sqrt(discs / packing), 1.02 * radius), 1e6)
    options = {"discs": discs, "radius": radius,
               "container-radius": float(f"{dish:.4g}") if draw.random() < 0.9
               else usual_or(draw, 8.6, 1e-6, 1e6),
               "seed": draw.randrange(1 << 32), "events": 1000, "warmup": 0}
    if draw.random() < 0.3:
        small = log_uniform(draw, 1e-3, 1) * radius
        options["mixture"] = f"{draw.randint(1, discs)}:{small:.3g}"
        if draw.random() < 0.3:
            options["mixture"] += f":{log_uniform(draw, 1e-6, 1e6)}"
    for name, usual, low, high in (("mu", 1, 1e-6, 1e6), ("mass", 1, 1e-6, 1e6),
                                   ("inertia", "paper", 1e-12, 1e18),
                                   ("amplitude", 1.892, 1e-6, 1e6), ("period", 11.87, 1e-6, 1e6)):
        if draw.random() < 0.4:
            options[name] = usual_or(draw, usual, low, high, 0.2)
    if draw.random() < 0.2:
        options["amplitude"] = 0
    if draw.random() < 0.2:
        options["path"] = "circle"
    elif draw.random() < 0.2:
        options["sides"] = draw.choice([3, 4, 1000, 1000000])
    if draw.random() < 0.3:
        options["restitution"] = draw.choice([0, 0.5, 0.9, 0.999])
        options["tangential-restitution"] = draw.choice([0, 0.5, 1])
        options["contact-duration"] = usual_or(draw, 0, 1e-9, options.get("period", 11.87), 0.2)
    if draw.random() < 0.4 and discs <= 10_000:
        options.update(on_a_floor(draw, options))
    if draw.random() < 0.1:
        options["measure"] = "all"
    return [text for name, value in options.items() for text in (f"--{name}", str(value))]


def on_a_floor(draw, options):
    """Spheres or coins; the first are as heavy to move as any inertia makes them."""
    more = {"body": draw.choice(["sphere", "sphere", "disc"]),
            "floor": draw.choice(["none", "sliding", "sliding"])}
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
            more["rolling-resistance"] = draw.choice([1.0, 0.1, 0.01, 1e-6]) * more["floor-friction"]
    return more


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR_SECONDS, PROCESSOR_SECONDS + 5))
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_SPACE, ADDRESS_SPACE))


class RandomScenes(InFolder):
    def run_or_refused(self, options):
        """True if it was run."""
        done = subprocess.run([SWIRL, "run", *options, "--json", "-", "--quiet"],
                              capture_output=True, text=True, stdin=subprocess.DEVNULL,
                              cwd=self.folder, preexec_fn=limit, env=dict(os.environ, NO_COLOR="1"))
        call = "swirl run " + " ".join(options)
        if done.returncode in (1, 2):
            self.assertRegex(done.stderr, ONE_ERROR, call)
            return False
        self.assertEqual(done.returncode, 0, f"{call}\n{done.stderr}")
        result = json.loads(done.stdout)
        self.assertTrue(result["complete"], call)
        self.assertGreaterEqual(result["events"]["total"], 1000, call)
        return True

    def test_a_dish_so_fast_that_rounding_errors_are_no_longer_small_is_refused(self):
        # A is 10^11 radii, and a double knows 10^16 of anything.
        scene = ["--radius", "1e-5", "--container-radius", "8.6e-5", "--discs", "5"]
        self.assertTrue(self.run_or_refused([*scene, "--amplitude", "1e-4", "--events", "10000"]))
        self.assertFalse(self.run_or_refused([*scene, "--amplitude", "1e6", "--events", "10000"]))

    def test_are_run_or_refused_in_a_sentence(self):
        cases, most_discs = (3000, 3e5) if "--all" in sys.argv else (80, 3000)
        run = 0
        for case in range(cases):
            options = drawn(random.Random(f"scene {case}"), most_discs)
            with self.subTest(case=case, options=" ".join(options)):
                run += self.run_or_refused(options)
        self.assertGreater(run, cases / 3)
        print(f"{run} of {cases} were run, the others refused")


if __name__ == "__main__":
    unittest.main(argv=[a for a in sys.argv if a != "--all"])
