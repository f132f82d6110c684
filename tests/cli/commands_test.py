"""cmake/help.txt holds the help of the program and of its scripts, which `./swirl` prints before it
has built the program, and docs/reference/commands.md lists the commands. This command rewrites the
help:

    SWIRL_WRITE_DOCS=1 SWIRL=build/tests/swirl python3 -B tests/cli/commands_test.py
"""

import os
import re
import subprocess
import unittest

from program import HANG, SOURCE, read_text, swirl, write_text

PAGE = os.path.join(SOURCE, "docs", "reference", "commands.md")
HELP = os.path.join(SOURCE, "cmake", "help.txt")
HANDWRITTEN = "swirl python"  # its --help is that of Python


def subcommands(text):
    listed = text[text.index("Subcommands:") : text.index("Examples:")]
    return re.findall(r"^  (\S+)", listed, re.MULTILINE)


def help_of_script(name):
    done = subprocess.run(
        [os.path.join(SOURCE, "web", name + ".sh"), "--help"],
        capture_output=True,
        text=True,
        check=True,
        timeout=HANG,
        stdin=subprocess.DEVNULL,
    )
    return done.stdout


def all_helps(**more):
    """Section title and help text, in the order of the page."""
    top = swirl("--help", **more).stdout
    yield "swirl", top
    for name in subcommands(top):
        yield f"swirl {name}", swirl(name, "--help", **more).stdout
    for name in ("lab", "site"):
        yield f"swirl {name}", help_of_script(name)


def text_of(file):
    return read_text(file)


class Commands(unittest.TestCase):
    def test_the_stored_help_is_that_of_every_command(self):
        stored = text_of(HELP)
        made = "".join(f"## {title}\n{help_text}" for title, help_text in all_helps())
        made += stored[stored.index(f"## {HANDWRITTEN}\n") :]
        if os.environ.get("SWIRL_WRITE_DOCS"):
            write_text(HELP, made)
            return
        self.assertEqual(stored, made, "rewrite the help with the command at the top of this file")

    def test_the_page_lists_every_command(self):
        listed = re.findall(r"^\| `swirl ([a-z-]+)` \|", text_of(PAGE), re.MULTILINE)
        commands = re.findall(r"^## swirl ([a-z-]+)$", text_of(HELP), re.MULTILINE)
        self.assertEqual(sorted(listed), sorted(commands))

    def test_help_does_not_depend_on_the_terminal_or_the_locale(self):
        usual = dict(all_helps())
        for environment in (
            {"COLUMNS": "40", "TERM": "dumb", "LC_ALL": "C", "LANG": "C"},
            {"COLUMNS": "250", "TERM": "xterm-256color", "SWIRL_SIMD": "sse2"},
        ):
            for title, help_text in all_helps(environment=environment):
                with self.subTest(title, **environment):
                    self.assertEqual(help_text, usual[title])

    def test_help_names_no_folder_of_this_machine(self):
        for title, help_text in all_helps():
            with self.subTest(title):
                self.assertNotIn(SOURCE, help_text)
                self.assertNotIn(os.path.expanduser("~") + "/", help_text)


if __name__ == "__main__":
    unittest.main()
