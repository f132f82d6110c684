"""The README and the pages show what the program prints; links of all pages have targets."""

import functools
import glob
import os
import re
import shlex
import unittest

from program import ALL, SOURCE, commands, help_of, main, read_text, swirl

README = read_text(os.path.join(SOURCE, "README.md"))

# Lines that differ between machines and calls.
TIMING = re.compile(r"^  time |^\d+ runs|^wrote ")


def blocks(kind, text=README):
    return re.findall(rf"^```{kind}\n(.*?)^```$", text, re.M | re.S)


def pages():
    """Every page of docs/, relative to the root of the sources."""
    return sorted(
        os.path.relpath(path, SOURCE)
        for path in glob.glob(os.path.join(SOURCE, "docs", "**", "*.md"), recursive=True)
    )


@functools.cache
def output_of(*words):
    """The lines that a command prints that writes no files."""
    done = swirl(*words)
    return (done.stdout + done.stderr).splitlines()


class Readme(unittest.TestCase):
    def compare_shown_output(self, text):
        """Runs each command that the text shows with output, and returns the number of compared
        lines."""
        compared = 0
        for block in blocks("console", text):
            for part in re.split(r"^\$ ", block, flags=re.M)[1:]:
                command, _, shown = part.partition("\n")
                words = shlex.split(command)
                if words == ["./swirl", "python"]:  # tests/python/documents_test.py
                    continue
                self.assertIn(words[0], ("./swirl", "swirl"))
                self.assertIn(words[1], ("run", "crossing"))
                if words[1] == "crossing" and not ALL:
                    continue  # a complete search: 21 seconds of processor time
                printed = output_of(*words[1:])
                for line in shown.splitlines():
                    if line.strip() != "…" and not TIMING.match(line):
                        self.assertIn(line, printed, command)
                        compared += 1
        return compared

    def test_shown_output_is_printed(self):
        self.assertGreater(self.compare_shown_output(README), 3)

    def test_output_shown_by_the_pages_is_printed(self):
        compared = 0
        for page in pages():
            with open(os.path.join(SOURCE, page), encoding="utf-8") as file, self.subTest(page):
                compared += self.compare_shown_output(file.read())
        self.assertGreater(compared, 25)

    def test_options_in_the_documents_exist(self):
        """Every option of a command, on a line of its own or in backquotes, is in the help of the
        command."""
        helps, options, names = {}, 0, commands()
        for name in ["README.md", *pages()]:
            text = read_text(os.path.join(SOURCE, name)).replace("\\\n", " ")
            for start, call in re.findall(
                r"(^|^\./|`|`\./|&& \./)swirl ([a-z][^`\n]*)", text, re.M
            ):
                if start == "" and call.split()[0] not in names:  # a sentence
                    continue
                words = shlex.split(call.replace("…", ""), comments=True)
                words = words[: words.index("&&")] if "&&" in words else words
                if not words or words[0] in ("help", "lab", "site", "python"):  # no program
                    continue
                if words[0] not in helps:
                    helps[words[0]] = help_of(words[0])
                    self.assertIn(f"Usage: swirl {words[0]} ", helps[words[0]], f"{name}: {call}")
                for word in words[1:]:
                    if word.startswith("--"):
                        option = word.split("=")[0]
                        self.assertRegex(
                            helps[words[0]], rf"(?<![\w-]){option}(?![\w-])", f"{name}: {call}"
                        )
                        options += 1
        self.assertGreater(options, 100)

    def test_index_links_to_every_page(self):
        linked = re.findall(r"\]\(([^)#]+\.md)", read_text(os.path.join(SOURCE, "docs/index.md")))
        self.assertEqual(
            set(pages()) - {os.path.normpath(os.path.join("docs", link)) for link in linked},
            {"docs/index.md"},
        )

    def test_links_have_targets(self):
        for name in ["README.md", "CONTRIBUTING.md", "SECURITY.md", "CHANGELOG.md", *pages()]:
            text = read_text(os.path.join(SOURCE, name))
            for link in re.findall(r"\]\(([^)#]+)[^)]*\)", text):
                if link.startswith("http"):
                    continue
                target = os.path.join(SOURCE, os.path.dirname(name), link)
                self.assertTrue(os.path.exists(target), f"{name} links to {link}")


if __name__ == "__main__":
    main()
