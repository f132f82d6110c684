"""Every claim that runs decide has a table, in one of the tests of claims, with which it does not
hold, and one with which it holds at least in part. A claim that no table could refute would not be
tested."""

import collections
import glob
import inspect
import os
import sys
import unittest

import claim_tables  # noqa: F401  (finds the folder paper/)

from paper import claims
from paper.claims.claim import NOTHING
from paper.verdicts import FAILS, HOLDS, IN_PART

HERE = os.path.dirname(os.path.abspath(__file__))
TESTS = sorted(
    os.path.basename(file).removesuffix(".py")
    for file in glob.glob(os.path.join(HERE, "claims_*_test.py"))
    if file != os.path.abspath(__file__)
)


def code_of(judge):
    """The code that judges; on_spheres() wraps it in a function for several settings."""
    return getattr(inspect.getclosurevars(judge).nonlocals.get("judge"), "__code__", judge.__code__)


def verdicts_in_tests(codes):
    """{code: {verdict}} of what these functions return while the tests of claims run."""
    found = collections.defaultdict(set)

    def watch(frame, event, returned):
        if event == "return" and frame.f_code in codes and returned is not None:
            found[frame.f_code].add(returned[0].verdict)

    suite = unittest.defaultTestLoader.loadTestsFromNames(TESTS)
    before = sys.getprofile()
    sys.setprofile(watch)
    try:
        result = suite.run(unittest.TestResult())
    finally:
        sys.setprofile(before)
    return found, result


class EveryClaim(unittest.TestCase):
    def test_fails_with_one_table_and_holds_with_another(self):
        judged = {
            claim.statement: code_of(claim.judge) for claim in claims.CLAIMS if claim.on != NOTHING
        }
        found, result = verdicts_in_tests(set(judged.values()))
        self.assertTrue(result.wasSuccessful(), result.errors + result.failures)
        self.assertGreater(len(set(judged.values())), 45)
        for statement, code in judged.items():
            with self.subTest(claim=statement):
                self.assertIn(FAILS, found[code])
                # A part of the claim on crashes is about another program.
                self.assertTrue({HOLDS, IN_PART} & found[code], found[code])


if __name__ == "__main__":
    unittest.main()
