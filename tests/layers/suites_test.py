"""Every test is in exactly one of the suites default, slow and soak, and no limit of a test depends
on the clock."""

import os
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(os.environ["SWIRL_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests"))
import targets  # noqa: E402

# As in ./check.
SUITES = {"default": ["-LE", "slow|soak"], "slow": ["-L", "slow"], "soak": ["-L", "soak"]}
# The builds of the sanitizers have these tests.
ONLY_WITH_INTERNAL_CHECKS = "engine.InvariantViolation."
# A limit in seconds or a moment in the future. A test in another program's language has its own
# words.
BY_THE_CLOCK = {
    "CMakeLists.txt": r"TIMEOUT \d",
    "*.py": r"timeout=\d|\btime\(\) ?[+<]|\bmonotonic\(\) ?[+<]|wait\(\d",
    "*.mjs": r"timeout: ?\d|DefaultTimeout\(\d|\}, \d+_000\)",
    "*.cpp": r"usleep\(1'?000'?000|sleep_for\(std::chrono::seconds",
}
FOLDERS = ("tests/**", "track/tests/**", "paper/tests/**", "web", "web/test")
# The tests of waiting itself, and of what happens meanwhile.
ALLOWED = {
    "tests/cli/launcher_test.py": "time.time() + 7200",
    "tests/cli/series_test.py": "started.wait(0.15)",
}


def listed(*options):
    """The names of ctest, with all values of a parameter under one name: layer.Suite.Test."""
    done = subprocess.run(
        ["ctest", "--test-dir", os.environ["SWIRL_LIBRARIES"], "-N", *options],
        capture_output=True,
        text=True,
        check=True,
    )
    names = re.findall(r"^ *Test +#\d+: (\S+)", done.stdout, re.M)
    return {re.sub(r"^(\w+)\.(?:\w+/)?(\w+\.\w+?)(/.*)?$", r"\1.\2", name) for name in names}


class Suites(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.suites = {name: listed(*options) for name, options in SUITES.items()}

    def suite_of(self, name):
        found = [suite for suite, names in self.suites.items() if name in names]
        self.assertEqual(len(found), 1, f"{name} is in {found or 'no suite'}")
        return found[0]

    def test_each_test_is_in_one_suite(self):
        for name in listed():
            with self.subTest(name):
                self.suite_of(name)

    def test_the_name_of_a_test_in_cpp_gives_its_suite(self):
        seen = 0
        for _, name, program in targets.tests():
            if name.count(".") != 2 or name.startswith(ONLY_WITH_INTERNAL_CHECKS):
                continue
            if program.startswith("test_") and f"{program}_NOT_BUILT" not in self.suites["default"]:
                seen += 1
                with self.subTest(name):
                    prefix = re.search(r"\.(Slow|Soak)_\w+$", name)
                    self.assertEqual(
                        self.suite_of(name), prefix[1].lower() if prefix else "default"
                    )
        self.assertGreater(seen, 100)

    def test_each_script_is_a_test_and_runs_complete_in_the_slow_suite(self):
        for script in [*SOURCE.glob("tests/*/*_test.py"), *SOURCE.glob("*/tests/*_test.py")]:
            parent = script.parent
            folder = parent.parent.name if parent.name == "tests" else parent.name
            if folder == "threads":
                continue  # under the thread sanitizer only (preset threads)
            name = f"{folder}.{script.stem}"
            complete = f"{name.removesuffix('_test')}_slow"
            with self.subTest(name):
                self.suite_of(
                    complete
                    if complete in self.suites["slow"] and folder not in ("cli", "faults")
                    else name
                )
                if folder in ("cli", "track") and re.search(
                    r"^from program import .*\b(slow|some|ALL)\b",
                    script.read_text(encoding="utf-8"),
                    re.M,
                ):
                    whole = f"cli.{script.stem.removesuffix('_test')}_all_slow"
                    self.assertTrue(
                        {whole, complete} & self.suites["slow"], "no slow test calls it with --all"
                    )

    def test_a_test_without_end_is_stopped_by_its_processor_time(self):
        limited = ["sh", SOURCE / "tests/limited.sh", "1"]
        done = subprocess.run(
            [*limited, sys.executable, "-c", "while True: pass"], capture_output=True, text=True
        )
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("more than 1 seconds of processor time", done.stdout)
        self.assertEqual(subprocess.run([*limited, "sh", "-c", "exit 77"]).returncode, 77)

    def test_no_limit_depends_on_the_clock(self):
        for pattern, limit in BY_THE_CLOCK.items():
            for file in [file for folder in FOLDERS for file in SOURCE.glob(f"{folder}/{pattern}")]:
                name = str(file.relative_to(SOURCE))
                if file == pathlib.Path(__file__).resolve():
                    continue
                text = file.read_text(encoding="utf-8").replace(ALLOWED.get(name, "\0"), "")
                with self.subTest(name):
                    self.assertIsNone(
                        re.search(limit, text),
                        "wait for the event (program.wait_until), or for HANG",
                    )


if __name__ == "__main__":
    unittest.main()
