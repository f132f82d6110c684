"""The list of figures is read from the text of their files. It has all figures that the files
define."""

import glob
import importlib
import os
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

from paper import catalogue, console


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

    def test_an_unknown_group_is_reported(self):
        with tempfile.TemporaryDirectory() as folder:
            os.mkdir(os.path.join(folder, "figures"))
            with open(os.path.join(folder, "figures", "mine.py"), "w", encoding="utf-8") as file:
                file.write('FIGURES = [Figure("mine", "nosuch", "a figure")]\n')
            with unittest.mock.patch.object(catalogue, "FOLDER", folder):
                with self.assertRaises(console.Problem) as found:
                    catalogue.entries()
        self.assertEqual(found.exception.code, 2)
        self.assertEqual(
            str(found.exception),
            "the figure 'mine' in figures/mine.py has the group 'nosuch'.\n"
            "hint: the groups are paper, beyond, rolling, chapters.",
        )


class Scripts(unittest.TestCase):
    def call(self, *words):
        return subprocess.run(
            [sys.executable, catalogue.FOLDER, *words], capture_output=True, text=True
        )

    def test_a_wrong_name_is_one_sentence(self):
        for words, says in (
            ([], "there is no script ''."),
            (["nosuch"], "there is no script 'nosuch'."),
            (["figure"], "there is no script 'figure'."),  # a module without main()
            (["../paper/draw"], "there is no script '../paper/draw'."),
            (["command", "nosuch"], "the argument is not the call of `swirl paper`, as JSON."),
        ):
            with self.subTest(words):
                done = self.call(*words)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertTrue(done.stderr.startswith(f"error: {says}\n"), done.stderr)


if __name__ == "__main__":
    unittest.main()
