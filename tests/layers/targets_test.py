"""`./check -R NAME` builds what the tests of that name need (tests/targets.py)."""

import os
import re
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import targets  # noqa: E402


class Targets(unittest.TestCase):
    def test_the_executable_of_every_test_is_known(self):
        found = {name: target for _, name, target in targets.tests()}
        listed = subprocess.run(
            ["ctest", "--test-dir", os.environ["SWIRL_LIBRARIES"], "-N", "-LE", "slow|soak"],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        seen = 0
        for name in re.findall(r"^ *Test +#\d+: (\S+)", listed, re.M):
            test = re.fullmatch(
                r"(\w+)\.(?:\w*/)?(\w+\.\w+)(?:/\w+)?", name
            )  # with its values: layer.Values/Suite.Test/0
            if test:
                seen += 1
                self.assertEqual(found.get(f"{test[1]}.{test[2]}"), f"test_{test[1]}", name)
        self.assertGreater(seen, 500)

    def test_a_layer_a_script_and_unknown_tests(self):
        for call, needed in (
            (["-R", "engine"], "test_engine"),
            (["-V", "-R", r"EngineEqualsReference\.InAGas"], "test_engine"),
            (["-L", "^(math|engine)$"], "test_engine test_math"),
            (["-R", "cli.run"], "python_module swirl"),
            (["-R", "layers"], "help"),
            (["-R", "no such test"], ""),
            (["-LE", "engine"], ""),
            (["-R", "engine", "-E", "Slow"], ""),
            (["-R", "package_test"], ""),
        ):
            with self.subTest(call):
                self.assertEqual(targets.needed(call), needed)


if __name__ == "__main__":
    unittest.main()
