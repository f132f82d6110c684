"""The list of commands in `swirl --help` is that of docs/reference/commands.md, each command has
its help, and `swirl` reports a command that it does not have."""

import glob
import os
import re
import shutil
import subprocess
import sys
import unittest

from program import HANG, HIDDEN, SOURCE, SWIRL, InFolder, commands, read_text, swirl

sys.path.insert(0, os.path.join(SOURCE, "tests", "layers"))
from prose_test import REJECTED  # noqa: E402

PAGE = os.path.join(SOURCE, "docs", "reference", "commands.md")
SCRIPTS = ("lab", "site", "python")  # of the source folder


def help_of_script(name):
    done = subprocess.run(
        [os.path.join(SOURCE, "swirl"), name, "--help"],
        capture_output=True,
        text=True,
        check=True,
        timeout=HANG,
        stdin=subprocess.DEVNULL,
    )
    return done.stdout


def all_helps(**more):
    """Command and help text."""
    yield "swirl", swirl("--help", **more).stdout
    for name in commands():
        yield f"swirl {name}", swirl("help", name, "all", **more).stdout
    for name in SCRIPTS:
        yield f"swirl {name}", help_of_script(name)


class Commands(unittest.TestCase):
    def test_hidden_commands_work_but_are_in_no_list(self):
        for name in HIDDEN:
            self.assertEqual(swirl(name, "--help").returncode, 0)
            self.assertNotIn(name, swirl("--help").stdout)
            # A typing error is not led there.
            self.assertNotIn(name, swirl(name + "s").stderr.partition("hint:")[2])

    def test_the_page_lists_every_command(self):
        listed = re.findall(r"^\| `swirl ([a-z-]+)` \|", read_text(PAGE), re.MULTILINE)
        self.assertEqual(
            sorted(listed),
            sorted([*commands(), *SCRIPTS]),
            "each row of src/swirl/cli/command_list.hpp needs one in docs/reference/commands.md",
        )

    def test_every_command_in_a_file_has_a_row(self):
        """A file without a row is in no program, and no compiler reports it."""
        files = [
            file
            for folder in ("src/swirl/cli", "track/cli")
            for file in glob.glob(os.path.join(SOURCE, folder, "command_*.cpp"))
        ]
        registered = re.findall(
            r'^const Command \w+\(\s*"([a-z-]+)"', "\n".join(map(read_text, files)), re.MULTILINE
        )
        self.assertEqual(
            sorted(registered),
            sorted([*commands(), *HIDDEN]),
            "each command needs a row in src/swirl/cli/command_list.hpp",
        )

    def test_help_uses_the_words_of_the_glossary(self):
        for title, help_text in all_helps():
            for pattern, better in REJECTED.items():
                with self.subTest(title):
                    self.assertNotRegex(help_text.lower(), pattern, better)

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

    def test_the_command_help_prints_the_list_or_the_help_of_a_command(self):
        self.assertEqual(swirl("help").stdout, swirl("--help").stdout)
        self.assertEqual(swirl("help", "verify").stdout, swirl("verify", "--help").stdout)

    def test_swirl_starts_without_the_libraries_of_its_commands(self):
        if shutil.which("ldd") is None:
            self.skipTest("this test needs ldd")
        listed = subprocess.run(["ldd", SWIRL], capture_output=True, text=True).stdout
        self.assertLessEqual(len(listed.splitlines()), 10, listed)


class MissingCommands(InFolder):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path("bin"))
        shutil.copy(SWIRL, self.path("bin/swirl"))

    def copied(self, *arguments):
        return subprocess.run(
            [self.path("bin/swirl"), *arguments], capture_output=True, text=True, timeout=HANG
        )

    def install(self, program, where):
        os.makedirs(os.path.dirname(self.path(where)), exist_ok=True)
        shutil.copy(f"{SWIRL}-{program}", self.path(where))

    def test_a_program_that_is_not_there_is_named(self):
        done = self.copied("run")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("the program of `swirl run`, swirl-run, is not installed.", done.stderr)
        self.assertIn("./swirl run builds it", done.stderr)

    def test_scripts_of_the_source_folder_are_named(self):
        done = self.copied("lab")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("hint: run ./swirl lab there", done.stderr)

    def test_commands_are_found_next_to_swirl_or_in_libexec(self):
        call = ("run", "--discs", "5", "--events", "500", "--json", "-", "--quiet")
        expected = re.search("state_hash.*", swirl(*call).stdout)[0]
        for program, where in (
            ("run", "bin/swirl-run"),
            ("commands", "libexec/swirl/swirl-commands"),
        ):
            with self.subTest(where):
                self.install(program, where)
                done = self.copied(*call)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(expected, done.stdout)
                self.assertIn('"command": "swirl run --discs 5', done.stdout)
                os.remove(self.path(where))

    def test_without_cairo_and_opencv_the_build_says_what_it_lacks(self):
        """`swirl` is built then; it names the libraries."""
        configured = subprocess.run(
            [
                *("cmake", "-G", "Ninja", "-S", SOURCE, "-B", self.path("build")),
                *("-DSWIRL_TESTS=OFF", "-DCMAKE_IGNORE_PATH=/usr/include/opencv4"),
            ],
            capture_output=True,
            text=True,
            env=dict(os.environ, PKG_CONFIG_LIBDIR=self.folder),
        )
        self.assertEqual(configured.returncode, 0, configured.stderr)
        for library in ("cairo", "OpenCV"):
            self.assertIn(f"-- {library} was not found", configured.stdout)
        targets = ("swirl", "swirl-image", "swirl-movie", "swirl-synthetic-video", "swirl-track")
        done = subprocess.run(
            ["ninja", "-C", self.path("build"), *targets], capture_output=True, text=True
        )
        self.assertEqual(done.returncode, 0, done.stdout)
        # `swirl experiment` takes tracks, too, and calls `swirl track` for videos.
        needed = subprocess.run(
            ["ninja", "-C", self.path("build"), "-t", "commands", "swirl-experiment"],
            capture_output=True,
            text=True,
        )
        self.assertIn("command_experiment.cpp", needed.stdout)
        for name, missing, package in (
            ("movie", "this build cannot draw (cairo was not found).", "libcairo2-dev"),
            (
                "track",
                "this build has no camera support (OpenCV was not found).",
                "libopencv-core-dev",
            ),
        ):
            done = subprocess.run(
                [self.path("build/swirl"), name, "--out", "x"], capture_output=True, text=True
            )
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertIn(f"error: {missing}\nhint: install {package}", done.stderr)

    def test_programs_of_another_owner_are_not_run(self):
        if os.getuid() != 0:
            self.skipTest("only root can give a file to another user")
        self.install("run", "bin/swirl-run")
        os.chown(self.path("bin/swirl-run"), 65534, 65534)
        self.assertIn("is not installed", self.copied("run").stderr)

    def test_a_command_has_the_same_process_and_signals(self):
        self.install("run", "bin/swirl-run")
        call = [self.path("bin/swirl"), "run", "--events", "1e12", "--quiet"]
        with subprocess.Popen(call, stderr=subprocess.PIPE, text=True) as process:
            process.terminate()
            process.communicate(timeout=HANG)
        self.assertIn(process.returncode, (130, -15))


if __name__ == "__main__":
    unittest.main()
