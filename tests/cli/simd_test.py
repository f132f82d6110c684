"""All vector widths, selected by SWIRL_SIMD, give bitwise identical results."""

import json
import os
import unittest

from program import InFolder, all_scenes, options, swirl

FLAGS = {"sse2": "sse2", "avx2": "avx2", "avx512": "avx512f"}


def widths():
    """The widths that this processor supports."""
    with open("/proc/cpuinfo", encoding="ascii") as file:
        flags = next(line for line in file if line.startswith("flags")).split()
    return [name for name, flag in FLAGS.items() if flag in flags]


@unittest.skipUnless(os.uname().machine == "x86_64", "these are widths of x86-64")
class Simd(InFolder):
    def result(self, width, *arguments):
        done = self.assert_works(
            "run", *arguments, "--json", "-", "--quiet", environment={"SWIRL_SIMD": width}
        )
        result = json.loads(done.stdout)
        for key in ("seconds", "events_per_second", "command"):
            del result[key]
        return result

    def test_every_width_gives_the_same_result(self):
        # Five discs use scalar code, 48 all pairs, 300 lists and averages over groups of eight with
        # a remainder. Spheres on a floor are accelerated.
        scenes = [scene for scene in all_scenes() if "warmup" not in scene]
        self.assertGreaterEqual(len(widths()), 1)
        for scene in scenes:
            with self.subTest(scene=scene):
                results = []
                for width in widths():
                    result = self.result(
                        width,
                        *options(scene),
                        "--periods",
                        6,
                        "--warmup",
                        1,
                        "--measure",
                        "slip,energy",
                    )
                    self.assertEqual(result.pop("simd"), width)
                    self.assertGreater(result["rotation"]["mean_by_event"]["blocks"], 0)
                    results.append(result)
                for result in results[1:]:
                    self.assertEqual(result, results[0])

    def test_the_default_is_the_widest(self):
        for nothing in ("", "auto"):
            self.assertEqual(
                self.result(nothing, "--discs", 5, "--events", 1000)["simd"], widths()[-1]
            )

    def test_the_report_names_the_width(self):
        for width in widths():
            done = swirl(
                "run",
                "--discs",
                5,
                "--events",
                1000,
                "--verbose",
                environment={"SWIRL_SIMD": width},
            )
            self.assertRegex(done.stdout, rf"time .* million events/s, {width}\n")

    def test_a_run_continues_with_another_width(self):
        first, last = widths()[0], widths()[-1]
        whole = self.result(last, "--discs", 48, "--periods", 30)
        checkpoint = self.path("run.checkpoint")
        self.result(
            first,
            "--discs",
            48,
            "--periods",
            12,
            "--checkpoint",
            checkpoint,
            "--warmup",
            5,
            "--keep-checkpoint",
        )
        resumed = self.result(last, "--checkpoint", checkpoint, "--resume", "--periods", 30)
        self.assertEqual(resumed["state_hash"], whole["state_hash"])

    def test_unknown_and_unsupported_widths_are_rejected_by_every_command(self):
        for command in (
            ("run", "--discs", 5, "--events", 1000),
            ("sweep", "--out", self.path("s")),
            ("verify", self.path("none.json")),
        ):
            self.assert_fails(
                2, *command, environment={"SWIRL_SIMD": "mmx"}, says="SWIRL_SIMD is 'mmx'"
            )
        self.assertEqual(self.left_behind(), [])
        for lacking in set(FLAGS) - set(widths()):
            self.assert_fails(
                2,
                "run",
                "--discs",
                5,
                environment={"SWIRL_SIMD": lacking},
                says=f"SWIRL_SIMD is '{lacking}', but this processor supports only",
            )


if __name__ == "__main__":
    unittest.main()
