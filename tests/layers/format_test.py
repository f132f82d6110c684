"""C++ is formatted by clang-format, Python by black and the page's sources by prettier (lab_test.py), in
the versions of Debian 12 and of web/package.json. Other versions differ in details.

    format_test.py          without black, which needs half a minute
    format_test.py --all    with black
"""

import os
import re
import subprocess
import sys
import tokenize
import unittest

SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)
CLANG_FORMAT, BLACK = "14", "23"
WIDTH = 100
COMPLETE = "--all" in sys.argv
TOPS = (
    "src",
    "track",
    "bindings",
    "tests",
    "bench",
    "examples",
    "paper",
    "packaging",
    "web",
    "docs",
)


def version(tool):
    """Main version of a tool of Debian, or None."""
    path = os.path.join("/usr/bin", tool)
    if not os.path.exists(path):
        return None
    done = subprocess.run([path, "--version"], capture_output=True, text=True)
    return re.search(r"\b(\d+)\.", done.stdout)[1]


def files(*ends):
    for top in TOPS:
        for folder, folders, names in os.walk(os.path.join(SOURCE, top)):
            if "node_modules" in folders:
                folders.remove("node_modules")
            for name in names:
                if name.endswith(ends):
                    yield os.path.join(folder, name)


def long_lines(file):
    """Numbers of the lines that are too wide. A literal that no space divides may be."""
    with open(file, encoding="utf-8") as opened:
        wide = {k for k, line in enumerate(opened, 1) if len(line.rstrip("\n")) > WIDTH}
    if not wide:
        return wide
    with open(file, "rb") as opened:
        for token in tokenize.tokenize(opened.readline):
            # From Python 3.12 on, a literal with values has tokens for its parts.
            if token.type in (tokenize.STRING, getattr(tokenize, "FSTRING_MIDDLE", None)):
                wide -= set(range(token.start[0], token.end[0] + 1))
    return wide


class Format(unittest.TestCase):
    @unittest.skipUnless(version("clang-format") == CLANG_FORMAT, f"no clang-format {CLANG_FORMAT}")
    def test_every_file_is_formatted(self):
        names = sorted(files(".hpp", ".cpp"))
        self.assertTrue(names)
        done = subprocess.run(
            ["/usr/bin/clang-format", "--dry-run", "-Werror", *names],
            capture_output=True,
            text=True,
        )
        wrong = sorted(
            {
                line.split(":")[0]
                for line in done.stderr.splitlines()
                if "code should be clang-formatted" in line
            }
        )
        self.assertEqual(
            done.returncode,
            0,
            "clang-format -i " + " ".join(os.path.relpath(f, SOURCE) for f in wrong),
        )


class Width(unittest.TestCase):
    def test_no_line_of_cpp_is_wider_than_the_limit(self):
        wide = []
        for file in sorted(files(".hpp", ".cpp")):
            with open(file, encoding="utf-8") as opened:
                for k, line in enumerate(opened, 1):
                    # clang-format breaks code, but neither comments nor texts.
                    if len(line.rstrip("\n")) > WIDTH and '"' not in line:
                        wide.append(f"{os.path.relpath(file, SOURCE)}:{k}")
        self.assertEqual(wide, [])


class Python(unittest.TestCase):
    def test_no_line_is_wider_than_the_limit(self):
        names = sorted(files(".py"))
        self.assertTrue(names)
        wide = [f"{os.path.relpath(f, SOURCE)}:{k}" for f in names for k in sorted(long_lines(f))]
        self.assertEqual(wide, [])

    @unittest.skipUnless(COMPLETE, "only with --all")
    @unittest.skipUnless(version("black") == BLACK, f"no black {BLACK}")
    def test_every_file_is_formatted(self):
        done = subprocess.run(
            ["/usr/bin/black", "--quiet", "--check", *sorted(files(".py"))],
            capture_output=True,
            text=True,
            cwd=SOURCE,
        )
        self.assertEqual(done.returncode, 0, "black .")


if __name__ == "__main__":
    unittest.main(argv=[argument for argument in sys.argv if argument != "--all"])
