"""bench/features assigns each tracked file to one feature."""

import importlib.machinery
import importlib.util
import os
import unittest

SOURCE = os.environ["SWIRL_SOURCE"]
LOADER = importlib.machinery.SourceFileLoader("features", os.path.join(SOURCE, "bench", "features"))
features = importlib.util.module_from_spec(importlib.util.spec_from_loader("features", LOADER))
LOADER.exec_module(features)


@unittest.skipUnless(os.path.exists(os.path.join(SOURCE, ".git")), "this needs the repository")
class Features(unittest.TestCase):
    def test_each_file_has_one_feature(self):
        # feature_of() raises an error if there are two.
        without = [path for path in features.tracked_files() if features.feature_of(path) is None]
        self.assertEqual(without, [], "add a pattern to FEATURES in bench/features")


if __name__ == "__main__":
    unittest.main()
