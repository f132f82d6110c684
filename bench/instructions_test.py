"""Instructions per event, counted by callgrind. Unlike a time, the count does not depend on the
load of the machine. A change that makes the loop longer must raise the allowance here and give the
reason.

The count is the difference of a long and a short run, so that start-up does not contribute. The
allowance is the count when it was recorded plus a tenth, because other compilers generate other
code."""

import json
import os
import re
import shutil
import subprocess
import sys
import unittest

PROGRAM = os.environ["SWIRL_COUNT_INSTRUCTIONS"]

# Scene: events of the shorter and of the longer run, instructions per event allowed (g++ 12, -O3).
ALLOWED = {
    "container": (20000, 40000, 2460),  # N = 48, mu = 1, vertices included
    "few": (20000, 40000, 3670),  # N = 28, all pairs
    "circle": (20000, 40000, 2660),  # N = 48 on the exact circle
    "few, circle": (20000, 40000, 3910),  # N = 28
    "gas": (10000, 20000, 2860),  # N = 1000, packing 0.7
    "dilute": (10000, 20000, 5550),  # N = 1000, packing 0.2, cells
}


def instructions(scene, events):
    done = subprocess.run(
        [
            "valgrind",
            "--tool=callgrind",
            "--callgrind-out-file=/dev/null",
            PROGRAM,
            scene,
            str(events),
        ],
        check=True,
        capture_output=True,
        encoding="utf-8",
    )
    return int(re.search(r"Collected : (\d+)", done.stderr).group(1))


def per_event(scene):
    short, long, _ = ALLOWED[scene]
    return (instructions(scene, long) - instructions(scene, short)) / (long - short)


class Instructions(unittest.TestCase):
    def test_per_event_stay_within_the_allowance(self):
        for scene, (_, _, allowed) in ALLOWED.items():
            with self.subTest(scene=scene):
                found = per_event(scene)
                print(f"{scene}: {found:.0f} instructions per event, {allowed} allowed")
                self.assertLess(found, allowed)


if __name__ == "__main__":
    if not shutil.which("valgrind"):
        print("skipped: this test needs valgrind (Debian package valgrind)")
        sys.exit(77)
    if sys.argv[1:] == ["--json"]:  # for compare.sh
        json.dump({scene: per_event(scene) for scene in ALLOWED}, sys.stdout)
    else:
        unittest.main()
