"""A measurement class that breaks the sampling contract (src/swirl/measure/sampling.hpp) must not
compile, and the compiler's message must name the class and the function. Each case below is one
wrong class."""

import os
import re
import shutil
import subprocess
import sys
import unittest

SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)

# The functions that every measurement needs, without a sampling function.
REQUIRED = """
    void close_block() {}
    void merge(const Wrong&) {}
    template <class V> void fields(V&&) {}
    template <class V> void report(V&&) const {}
"""
# One line that satisfies the contract, for cases in which another function is wrong.
RIGHT = "void sample(const MFrameView&) {}"

# Name of the case: (body of the class, what the message must contain).
WRONG = {
    "no sampling function": ("", "needs a sampling function"),
    "misspelt sampling function": (
        "void smaple(const MFrameView&) {}",
        "needs a sampling function",
    ),
    "frame instead of view": ("void sample(const Snapshot&) {}", "'sample' must be"),
    "pinned flags without view": ("void sample(PinnedFlags) {}", "'sample' must be"),
    "cells without pinned flags": (
        "void sample(const MFrameView&, const Voronoi&) {}",
        "'sample' must be",
    ),
    "private function": ("private: void sample(const MFrameView&) {} public:", "'sample' must be"),
    "mutable snapshot in the lab": (
        RIGHT + "void sample_in_lab(Snapshot&) {}",
        "'sample_in_lab' must be",
    ),
    "residences by non-const reference": (
        RIGHT + "void sample_residences(LongResidences&) {}",
        "'sample_residences' must be",
    ),
    "snapshot within the period": (
        "void sample_within_period() {} void begin_tracks() {}",
        "'sample_within_period' must be",
    ),
    "snapshot across periods": (
        "void sample_across_periods(int) {} void begin_tracks() {}",
        "'sample_across_periods' must be",
    ),
    "tracks that never begin": ("void sample_within_period(const Snapshot&) {}", "'begin_tracks'"),
    "tracks that begin with an argument": (
        RIGHT + "void begin_tracks(int) {}",
        "'begin_tracks' must be",
    ),
    "event without state": ("void sample_event(const Snapshot&) {}", "'sample_event' must be"),
    "event as a number": ("void sample_by_event(int) {}", "'sample_by_event' must be"),
    "duration missing": (RIGHT + "void close_event_block() {}", "'close_event_block' must be"),
    "energy as text": (RIGHT + "void add_energy(const char*) {}", "'add_energy' must be"),
}


def compile_classes(bodies):
    """Compiles one class for each of these bodies, Wrong0 to Wrong15, in a single file."""
    code = '#include "swirl/measure/sampling.hpp"\nnamespace swirl {\n'
    for number, body in enumerate(bodies):
        name = f"Wrong{number}"
        code += f"class {name} {{\n  public:\n{body}\n{REQUIRED.replace('Wrong', name)}}};\n"
        code += f"static_assert(SamplingContract<{name}>::holds);\n"
    return subprocess.run(
        [
            CXX,
            "-std=c++20",
            "-fsyntax-only",
            f"-I{SOURCE}/src",
            "-x",
            "c++",
            "-",
            *["-ferror-limit=0"] * ("clang" in CXX),
        ],
        input=code + "}\n",
        capture_output=True,
        text=True,
    )


class SamplingContract(unittest.TestCase):
    def test_a_class_that_fulfils_it_compiles(self):
        done = compile_classes([RIGHT])
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_each_wrong_class_is_rejected_with_its_name_and_the_function(self):
        done = compile_classes(body for body, _ in WRONG.values())
        self.assertNotEqual(done.returncode, 0)
        # A message names the class before the error (gcc) or after it (clang).
        start = "In instantiation of" if "In instantiation of" in done.stderr else " error: "
        messages = re.split(f"(?m)^(?=.*{start})", done.stderr)
        for number, (case, (_, message)) in enumerate(WRONG.items()):
            with self.subTest(case=case):
                self.assertIn(
                    message,
                    "".join(
                        each
                        for each in messages
                        if f"SamplingContract<swirl::Wrong{number}>" in each
                    ),
                )


if __name__ == "__main__":
    CXX = next(
        (
            path
            for path in map(shutil.which, (os.environ.get("CXX", "g++"), "g++", "clang++"))
            if path
        ),
        None,
    )
    if CXX is None:
        print("skipped: this test needs a C++ compiler")
        sys.exit(77)
    unittest.main()
