"""The program runs only its own scripts, and the environment cannot replace their modules."""

import os
import shutil
import subprocess
import unittest

from program import HANG, SOURCE, SWIRL, InFolder, swirl, write_text

FIGURE = ["paper", "--figure", "5b", "--quick", "--events", "2000"]


class Scripts(InFolder):
    def trap(self, *names):
        """Python files that create the file `ran` if they are executed."""
        for name in names:
            os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
            write_text(self.path(name), f"open({self.path('ran')!r}, 'w')\nraise SystemExit(0)\n")

    def has_run(self):
        return os.path.exists(self.path("ran"))

    def copied(self, name):
        """A copy of the program with this name, and of its command, draws Figure 5b."""
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        shutil.copy(SWIRL, self.path(name))
        shutil.copy(SWIRL + "-paper", self.path(name + "-paper"))
        return subprocess.run(
            [self.path(name), *FIGURE, "--out", self.path("out")],
            timeout=HANG,
            capture_output=True,
            text=True,
            cwd=self.folder,
        )

    def assert_not_found(self, done):
        self.assertFalse(self.has_run())
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("set SWIRL_FIGURES", done.stderr)

    def test_copied_program_runs_no_scripts_of_parent_folders(self):
        self.trap(
            *(
                f"{parent}paper/{name}.py"
                for parent in ("", "a/", "a/b/")
                for name in ("style", "__main__", "catalogue", "console")
            )
        )
        self.assert_not_found(self.copied("a/b/swirl"))

    def test_scripts_of_another_owner_are_not_run(self):
        self.trap("share/swirl/paper/style.py", "share/swirl/paper/__main__.py")
        if os.getuid() != 0:
            self.skipTest("only root can give a file to another user")
        for path in ("share/swirl/paper", "share/swirl/paper/style.py"):
            os.chown(self.path(path), 65534, 65534)
            with self.subTest(path):
                self.assert_not_found(self.copied("bin/swirl"))
            os.chown(self.path(path), 0, 0)

    def test_installed_program_finds_its_scripts(self):
        shutil.copytree(os.path.join(SOURCE, "paper"), self.path("share/swirl/paper"))
        # Files next to the package do not replace modules.
        self.trap("share/swirl/numpy.py", "share/swirl/json.py")
        os.makedirs(self.path("bin"))
        os.symlink(
            os.path.join(os.path.dirname(SWIRL), "python"), self.path("bin/python")
        )  # the module
        done = self.copied("bin/swirl")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse(self.has_run())
        self.assertTrue(os.path.exists(self.path("out/figure_5b.pdf")))

    def test_modules_from_the_environment_are_ignored(self):
        self.trap(
            "matplotlib.py",
            "numpy.py",
            "style.py",
            "home/lib/python3.11/site-packages/usercustomize.py",
        )
        done = swirl(
            *FIGURE,
            "--out",
            self.path("out"),
            cwd=self.folder,
            environment={"PYTHONPATH": f":{self.folder}:", "PYTHONUSERBASE": self.path("home")},
        )
        self.assertFalse(self.has_run())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(os.path.exists(self.path("out/figure_5b.pdf")))


if __name__ == "__main__":
    unittest.main()
