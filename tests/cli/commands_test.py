"""docs/reference/commands.md holds the help of the program and of its scripts. This command rewrites
the page:

    SWIRL_WRITE_DOCS=1 SWIRL=build/tests/swirl python3 -B tests/cli/commands_test.py
"""

import os
import re
import subprocess
import unittest

from program import SOURCE, swirl

PAGE = os.path.join(SOURCE, "docs", "reference", "commands.md")
SECTION = re.compile(r"^## (swirl[a-z -]*)\n\n```text\n(.*?)^```$", re.MULTILINE | re.DOTALL)
HANDWRITTEN = ["swirl python"]  # its --help is that of Python


def subcommands(text):
    listed = text[text.index("Subcommands:"):text.index("Examples:")]
    return re.findall(r"^  (\S+)", listed, re.MULTILINE)


def help_of_script(name):
    done = subprocess.run([os.path.join(SOURCE, "web", name + ".sh"), "--help"], capture_output=True,
                          text=True, check=True, timeout=100, stdin=subprocess.DEVNULL)
    return done.stdout


def entries_of(help_text):
    """The lines of a help text, each option with the lines that continue it."""
    entries = []
    for line in help_text.splitlines(keepends=True):
        if entries and re.match(r" {20}", line) and entries[-1].startswith("  --"):
            entries[-1] += line
        else:
            entries.append(line)
    return entries


def without_repetitions(helps):
    """The helps, in which an option with the same text in an earlier section refers to that section."""
    first = {}
    for title, text in helps:
        shown, group = [], []
        for entry in entries_of(text):
            section = first.setdefault(entry, title) if entry.startswith("  --") else title
            entry = entry if section == title else f"  {'…':<30}  as for {section}\n"
            if entry.startswith("  …") and entry in group:
                continue
            group = [] if entry == "\n" else [*group, entry]
            shown.append(entry)
        yield title, "".join(shown)


def all_helps(**more):
    """Section title and help text, in the order of the page."""
    top = swirl("--help", **more).stdout
    yield "swirl", top
    for name in subcommands(top):
        yield f"swirl {name}", swirl(name, "--help", **more).stdout
    for name in ("lab", "site"):
        yield f"swirl {name}", help_of_script(name)


def page():
    with open(PAGE, encoding="utf-8") as file:
        return file.read()


class Commands(unittest.TestCase):
    def test_the_page_holds_the_help_of_every_command(self):
        helps = list(without_repetitions(all_helps()))
        text = page()
        if os.environ.get("SWIRL_WRITE_DOCS"):
            head = text[:text.index("\n## swirl\n")]
            handwritten = text[text.index(f"\n## {HANDWRITTEN[0]}\n"):]
            with open(PAGE, "w", encoding="utf-8") as file:
                file.write(head + "".join(f"\n## {title}\n\n```text\n{help_text}```\n"
                                          for title, help_text in helps) + handwritten)
            return
        sections = SECTION.findall(text)
        self.assertEqual([title for title, _ in sections],
                         [title for title, _ in helps] + HANDWRITTEN)
        found = dict(sections)
        for title, help_text in helps:
            with self.subTest(title):
                self.assertEqual(found[title], help_text,
                                 "rewrite the page with the command at the top of this file")

    def test_the_page_describes_each_run_parameter_once(self):
        for option in ("--restitution 0..1", "--vertical-disc 0..1", "--mu-wall NUMBER", "--floor-friction NUMBER"):
            self.assertEqual(page().count(f"  {option} "), 1, option)

    def test_help_does_not_depend_on_the_terminal_or_the_locale(self):
        usual = dict(all_helps())
        for environment in ({"COLUMNS": "40", "TERM": "dumb", "LC_ALL": "C", "LANG": "C"},
                            {"COLUMNS": "250", "TERM": "xterm-256color", "SWIRL_SIMD": "sse2"}):
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
