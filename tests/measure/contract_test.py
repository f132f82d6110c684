"""A measurement class that breaks the sampling contract (src/swirl/measure/sampling.hpp) must not compile, and
the compiler's message must name the class and the function. Each case below is one wrong class."""

import os
import shutil
import subprocess
import sys
import unittest

SOURCE = os.environ.get("SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__)))))

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
    "misspelt sampling function": ("void smaple(const MFrameView&) {}", "needs a sampling function"),
    "frame instead of view": ("void sample(const Snapshot&) {}", "'sample' must be"),
    "pinned flags without view": ("void sample(PinnedFlags) {}", "'sample' must be"),
    "cells without pinned flags": (
        "void sample(const MFrameView&, const Voronoi&) {}", "'sample' must be"),
    "private function": ("private: void sample(const MFrameView&) {} public:", "'sample' must be"),
    "mutable snapshot in the lab": (RIGHT + "void sample_in_lab(Snapshot&) {}", "'sample_in_lab' must be"),
    "residences by non-const reference": (
        RIGHT + "void sample_residences(LongResidences&) {}", "'sample_residences' must be"),
    "snapshot within the period": (
        "void sample_within_period() {} void begin_tracks() {}", "'sample_within_period' must be"),
    "snapshot across periods": (
        "void sample_across_periods(int) {} void begin_tracks() {}", "'sample_across_periods' must be"),
    "tracks that never begin": ("void sample_within_period(const Snapshot&) {}", "'begin_tracks'"),
    "tracks that begin with an argument": (
        RIGHT + "void begin_tracks(int) {}", "'begin_tracks' must be"),
    "event without state": ("void sample_event(const Snapshot&) {}", "'sample_event' must be"),
    "event as a number": ("void sample_by_event(int) {}", "'sample_by_event' must be"),
    "duration missing": (RIGHT + "void close_event_block() {}", "'close_event_block' must be"),
    "energy as text": (RIGHT + "void add_energy(const char*) {}", "'add_energy' must be"),
}


def compile_class(body):
    code = f"""#include "swirl/measure/sampling.hpp"
namespace swirl {{
class Wrong {{
  public:
    {body}
    {REQUIRED}
}};
static_assert(SamplingContract<Wrong>::holds);
}}
"""
    return subprocess.run([CXX, "-std=c++20", "-fsyntax-only", f"-I{SOURCE}/src", "-x", "c++", "-"],
                          input=code, capture_output=True, text=True)


class SamplingContract(unittest.TestCase):
    def test_a_class_that_fulfils_it_compiles(self):
        done = compile_class(RIGHT)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_each_wrong_class_is_rejected_with_its_name_and_the_function(self):
        for case, (body, message) in WRONG.items():
            with self.subTest(case=case):
                done = compile_class(body)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn(message, done.stderr)
                self.assertIn("SamplingContract<swirl::Wrong>", done.stderr)


if __name__ == "__main__":
    CXX = next((path for path in map(shutil.which, (os.environ.get("CXX", "g++"), "g++", "clang++")) if path), None)
    if CXX is None:
        print("skipped: this test needs a C++ compiler")
        sys.exit(77)
    unittest.main()
