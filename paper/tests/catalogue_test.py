"""The list of figures is read from the text of their files. It has all figures that the files
define."""

import glob
import importlib
import os
import unittest

from paper import catalogue


class Catalogue(unittest.TestCase):
    def modules(self):
        for folder in ("figures", "chapters"):
            for file in sorted(glob.glob(os.path.join(catalogue.FOLDER, folder, "*.py"))):
                name = os.path.basename(file)[: -len(".py")]
                yield f"{folder}.{name}", importlib.import_module(f"paper.{folder}.{name}")

    def test_groups_are_known(self):
        for name, module in self.modules():
            for figure in getattr(module, "FIGURES", []):
                self.assertIn(
                    figure.group, catalogue.GROUPS, f"{name}: the group is not in catalogue.GROUPS"
                )

    def test_the_list_has_all_figures(self):
        listed = [(entry[3], *entry[:3]) for entry in catalogue.entries()]
        for name, module in self.modules():
            for figure in getattr(module, "FIGURES", []):
                self.assertTrue(
                    (name, figure.name, figure.group, figure.description) in listed,
                    f"figure '{figure.name}' is not listed: its name, group and description must "
                    "be three literal strings without keywords (catalogue.ENTRY reads them)",
                )


if __name__ == "__main__":
    unittest.main()
