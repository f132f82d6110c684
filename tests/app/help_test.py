"""Every --help explains itself: a description, and examples that are real calls."""

import re
import unittest

from program import swirl


def subcommands():
    """Names in the help of the program, under "Subcommands:"."""
    text = swirl("--help").stdout
    listed = text[text.index("Subcommands:"):text.index("Examples:")]
    return re.findall(r"^  (\S+)", listed, re.MULTILINE)


def examples(text):
    return re.findall(r"^  (swirl .*)$", text[text.index("Examples:"):], re.MULTILINE)


class Help(unittest.TestCase):
    def test_there_are_subcommands(self):
        self.assertIn("run", subcommands())
        self.assertIn("paper", subcommands())

    def test_every_help_has_examples_of_itself(self):
        self.assertTrue(examples(swirl("--help").stdout))
        for name in subcommands():
            with self.subTest(name):
                done = swirl(name, "--help")
                self.assertEqual(done.returncode, 0)
                self.assertEqual(done.stderr, "")
                self.assertTrue(examples(done.stdout), "no examples")
                # Others may follow: what one does next.
                self.assertTrue(examples(done.stdout)[0].startswith(f"swirl {name}"))
                for example in examples(done.stdout):
                    self.assertIn(example.split()[1], subcommands(), example)

    def test_examples_use_only_options_that_exist(self):
        for name in subcommands():
            text = swirl(name, "--help").stdout
            known = set(re.findall(r"(--[a-z0-9-]+)", text[:text.index("Examples:")]))
            for example in examples(text):
                if not example.startswith(f"swirl {name} "):
                    continue
                for option in re.findall(r"(?<=\s)(--[a-z0-9-]+)", example):
                    self.assertIn(option, known, example)

    def test_every_option_has_a_description(self):
        for name in subcommands():
            lines = swirl(name, "--help").stdout.splitlines()
            for line, following in zip(lines, lines[1:] + [""]):
                if not re.match(r"  (-\w,)?--", line):
                    continue
                described = re.search(r"\S\s{2,}\S", line) or re.match(r"\s{20,}\S", following) \
                    or len(line) > 60
                self.assertTrue(described, f"{name}: {line}")

    def test_version_is_one_line(self):
        done = swirl("--version")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"^\d+\.\d+\.\d+ \(.+\)\n$")


if __name__ == "__main__":
    unittest.main()
