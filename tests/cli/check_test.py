"""./check with programs in place of cmake and ctest: a failure in one part does not stop the
others, and the last line is the sum of all."""

import os
import shutil
import subprocess
import unittest

from program import HANG, SOURCE, InFolder, read_text, write_text

# Writes what ctest writes with --output-junit: the tests of the preset are in the file
# tests-PRESET.
CTEST = r"""#!/bin/sh
while [ $# -gt 0 ]; do
    case $1 in
        --test-dir) preset=${2##*/} ;;
        --output-junit) junit=$2 ;;
    esac
    shift
done
echo "$preset" >>HERE/run
[ -e HERE/tests-$preset ] || exit 8
sed 's/\(.*\) \(.*\)/\t<testcase name="\1" classname="\1" time="0.1" status="\2">/' HERE/tests-$preset >"$junit"
! grep -q fail HERE/tests-$preset || exit 8
"""
CMAKE = """#!/bin/sh
case "$*" in *--preset*) echo ${2} >>HERE/configured; ! [ -e HERE/broken-$2 ] ;; esac
"""


class Check(InFolder):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path("bin"))
        os.makedirs(self.path("cmake"))
        for name in ("check", "cmake/launcher.sh"):
            shutil.copy(os.path.join(SOURCE, name), self.path(name))
        for name, text in (("ctest", CTEST), ("cmake", CMAKE)):
            write_text(self.path("bin/" + name), text.replace("HERE", self.folder))
            os.chmod(self.path("bin/" + name), 0o755)
        for name in ("packages", "CMakeLists.txt"):
            write_text(self.path(name), "")
        write_text(self.path("tests-tests"), "math.A run\nmath.B run\ncli.c notrun\n")
        write_text(self.path("tests-sanitize"), "math.A run\n")

    def check(self, *arguments):
        path = self.path("bin") + ":" + os.environ["PATH"]
        return subprocess.run(
            [self.path("check"), *arguments],
            capture_output=True,
            text=True,
            timeout=HANG,
            env=dict(os.environ, PATH=path),
        )

    def assert_ends(self, done, code, *lines):
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertEqual(done.stdout.splitlines()[-len(lines) :], list(lines))

    def test_all_pass(self):
        self.assert_ends(self.check(), 0, "skipped: cli.c (preset tests)", "3 passed, 0 failed")

    def test_a_failed_test_does_not_stop_the_sanitizers(self):
        write_text(self.path("tests-tests"), "math.A fail\nmath.B run\n")
        write_text(self.path("tests-sanitize"), "math.A run\nengine.C fail\n")
        self.assert_ends(
            self.check(),
            1,
            "failed: math.A (preset tests)",
            "failed: engine.C (preset sanitize)",
            "2 passed, 2 failed",
        )

    def test_a_failed_build_does_not_stop_the_others(self):
        write_text(self.path("broken-tests"), "")
        done = self.check()
        self.assertIn("the build failed", done.stderr)
        self.assert_ends(done, 1, "failed: the build of the preset tests", "1 passed, 1 failed")

    def test_ctest_without_tests_is_a_failure(self):
        os.remove(self.path("tests-sanitize"))
        self.assert_ends(self.check(), 1, "failed: ctest (preset sanitize)", "2 passed, 1 failed")

    def test_the_sum_of_one_suite(self):
        self.assert_ends(self.check("-R", "math"), 0, "2 passed, 0 failed")
        self.assertEqual(read_text(self.path("run")), "tests\n")

    def test_slow_runs_every_part(self):
        for preset in ("fuzz", "threads", "sanitize-wide"):
            write_text(
                self.path("tests-" + preset),
                f"{preset}.A {'fail' if preset == 'fuzz' else 'run'}\n",
            )
        self.assert_ends(
            self.check("--slow"), 1, "failed: fuzz.A (preset fuzz)", "4 passed, 1 failed"
        )
        self.assertEqual(
            read_text(self.path("configured")).split(),
            ["tests", "fuzz", "threads", "sanitize-wide"],
        )


if __name__ == "__main__":
    unittest.main()
