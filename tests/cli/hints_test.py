"""Commands in messages work in a shell for all file names; `--` ends the options."""

import re
import shlex
import subprocess
import unittest

from program import SWIRL, InFolder, swirl

NAMES = ["plain", "with spaces", "it's", 'a "quoted" name', "a\nb", "$(touch planted)", "a; touch planted #",
         "./-dash", "./-with spaces"]
SWEEP = ["--discs", "2:3", "--events", "200"]


class Hints(InFolder):
    in_memory = True

    def call(self, *words):
        return swirl(*words, cwd=self.folder)

    def in_shell(self, command):
        """Runs the command in a shell, with the program under test as `swirl`."""
        self.assertTrue(command.startswith("swirl "), command)
        return subprocess.run(["/bin/sh", "-c", shlex.quote(SWIRL) + command[5:]], cwd=self.folder,
                              capture_output=True, text=True, timeout=100)

    def test_the_printed_collect_command_works(self):
        for name in NAMES:
            with self.subTest(name):
                done = self.call("sweep", *SWEEP, f"--out={name}")
                self.assertEqual(done.returncode, 0, done.stderr)
                table = self.in_shell(done.stdout.split("; to write the table: ", 1)[1])
                self.assertEqual(table.returncode, 0, table.stderr)
                self.assertTrue(table.stdout.endswith("(2 of 2 runs)\n"), table.stdout)
        self.assertEqual(self.left_behind(), sorted(name.removeprefix("./") for name in NAMES))

    def test_the_proposed_name_for_a_file_like_an_option_works(self):
        for name in ("-dash", "-with spaces", "--it's"):
            with self.subTest(name):
                refused = self.call("sweep", *SWEEP, f"--out={name}")
                self.assertEqual(refused.returncode, 2)
                proposed = re.search(r"\nhint: [^\n]*, write (.*)\n\Z", refused.stderr)[1]
                done = self.in_shell("swirl sweep --discs 2 --events 200 --out " + proposed)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(name, self.left_behind())

    def test_the_printed_command_continues_a_sweep(self):
        name = "a; touch planted #"
        process = subprocess.Popen([SWIRL, "sweep", "--discs", "5:40", "--events", "1e9", "--out", name],
                                   cwd=self.folder, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        first = process.stderr.read(1)  # of the progress line: the sweep is running
        process.terminate()
        said = first + process.communicate(timeout=150)[1]
        self.assertEqual(process.returncode, 130, said)
        command = re.search(r"\nhint: run `(.*)` to continue", said, re.DOTALL)[1]
        status = self.in_shell(command + " --status")
        self.assertIn("of 36 runs done", status.stdout, status.stderr)
        self.assertEqual(self.left_behind(), [name])


class EndOfOptions(InFolder):
    def setUp(self):
        super().setUp()
        with open(self.path("--my_plan.toml"), "w", encoding="utf-8") as file:
            file.write("discs = 3\nevents = 10\n")
        with open(self.path("plan.toml"), "w", encoding="utf-8") as file:
            file.write("discs = 4\nevents = 10\n")

    def call(self, *words):
        return swirl(*words, cwd=self.folder)

    def test_a_file_name_may_start_with_dashes(self):
        done = self.call("run", "--seed", "2", "--", "--my_plan.toml")
        self.assertEqual((done.returncode, done.stdout.split()[0]), (0, "3"), done.stderr)

    def test_words_after_it_are_not_options(self):
        for words in (["run", "plan.toml", "--", "--version"], ["run", "plan.toml", "--", "--help"],
                      ["run", "--", "plan.toml", "--discs", "5"], ["crossing", "--", "plan.toml", "--mu=1"],
                      ["run", "plan.toml", "--", "-h"]):
            with self.subTest(words):
                done = self.call(*words)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                extra = next(word for word in words[words.index("--") + 1:] if word.startswith("-"))
                self.assertIn(f"unexpected argument '{extra}'", done.stderr)

    def test_it_may_be_the_last_argument(self):
        self.assertEqual(self.call("run", "plan.toml", "--").stdout.split()[0], "4")


if __name__ == "__main__":
    unittest.main()
