"""Manual pages and completions contain every option of every command, and their readers accept
them."""

import gzip
import os
import re
import shutil
import subprocess
import unittest

from program import ProgramTest, commands, described_options, help_of, read_text

FOLDER = os.path.join(os.environ["SWIRL_LIBRARIES"], "documents")


def path(name):
    return os.path.join(FOLDER, name)


def page(command):
    """The source of a manual page."""
    with gzip.open(path(f"{command}.1.gz"), "rt", encoding="utf-8") as file:
        return file.read()


def plain(roff):
    """Text of a manual page without escapes."""
    for escape, character in (
        (r"\&", ""),
        (r"\-", "-"),
        (r"\(aq", "'"),
        (r"\(ga", "`"),
        (r"\(ha", "^"),
        (r"\(ti", "~"),
        (r"\e", "\\"),
    ):
        roff = roff.replace(escape, character)
    return roff


def items(command):
    """Name and description of each item of a list in a manual page."""
    found = re.findall(r"^\.TP\n\\fB(.+?)\\fP.*\n(.*)$", page(command), re.M)
    return {plain(name): plain(description) for name, description in found}


def forms(command):
    """The form of the value of each option in a manual page: "disc|sphere"."""
    found = re.findall(r"^\.TP\n\\fB(.+?)\\fP \\fI(.+)\\fP$", page(command), re.M)
    return {plain(name): plain(form) for name, form in found}


def listed_values():
    """(command, option, values, whether there are others) for forms that list values."""
    for command in commands():
        for option, form in forms(f"swirl-{command}").items():
            words = form.removesuffix(" (required)").split("|")
            values = [
                word for word in words if len(words) > 1 and re.fullmatch("[a-z][^A-Z]*", word)
            ]
            if values:
                yield command, option, values, len(values) < len(words)


def output_of(*words):
    return subprocess.run(words, capture_output=True, text=True)


def bash_completes(*words):
    """What bash offers for the last of these words."""
    script = (
        'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); '
        '_swirl; printf "%s\\n" "${COMPREPLY[@]}"'
    )
    done = output_of("bash", "-c", script, "bash", path("swirl.bash"), *words)
    assert (done.returncode, done.stderr) == (0, ""), done
    return done.stdout.split()


def fish_completes(line):
    done = output_of("fish", "-N", "-c", 'source $argv[1]; complete -C "$argv[2]"', FISH, line)
    assert (done.returncode, done.stderr) == (0, ""), done
    return [offer.partition("\t")[0] for offer in done.stdout.splitlines()]


FISH = path("swirl.fish")


class Documents(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.options = {name: dict(described_options(help_of(name))) for name in commands()}
        assert sum(map(len, cls.options.values())) > 250

    def test_every_command_has_a_page(self):
        pages = {name for name in os.listdir(FOLDER) if name.endswith(".1.gz")}
        expected = {"swirl.1.gz", *(f"swirl-{name}.1.gz" for name in commands())}
        self.assertEqual(pages, expected)
        self.assertEqual(list(items("swirl")), commands())

    def test_a_page_has_the_options_of_its_command_with_their_descriptions(self):
        for name, options in self.options.items():
            with self.subTest(name):
                found = items(f"swirl-{name}")
                named = {o: text for o, text in found.items() if o.startswith("--")}
                self.assertEqual(named, options)
                self.assertIn("-h", found)

    def test_a_page_has_the_examples_of_the_help(self):
        for name in commands():
            examples = help_of(name).partition("Examples:\n")[2].rstrip()
            self.assertIn(examples, plain(page(f"swirl-{name}")))

    @unittest.skipUnless(shutil.which("man"), "this test needs man-db")
    def test_man_shows_the_pages_without_warnings(self):
        for name in ("swirl", *(f"swirl-{command}" for command in commands())):
            with self.subTest(name):
                file = path(f"{name}.1.gz")
                done = output_of("man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", file)
                self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_bash_completes_commands_and_options(self):
        self.assertEqual(bash_completes("swirl", "cro"), ["crossing"])
        self.assertEqual(bash_completes("swirl", "help", "cro"), ["crossing"])
        self.assertEqual(bash_completes("swirl", "run", "--dis"), ["--discs"])
        self.assertEqual(bash_completes("swirl", "run", "--seed", "4"), [])
        self.assertLessEqual(set(commands()), set(bash_completes("swirl", "")))
        for name, options in self.options.items():
            self.assertEqual(set(bash_completes("swirl", name, "--")), set(options), name)

    def test_bash_completes_the_values_of_options(self):
        seen = 0
        for command, option, values, _ in listed_values():
            seen += 1
            with self.subTest(command=command, option=option):
                self.assertEqual(bash_completes("swirl", command, option, ""), values)
        self.assertGreater(seen, 50)
        self.assertEqual(bash_completes("swirl", "run", "--body", "=", "s"), ["sphere"])
        self.assertEqual(bash_completes("swirl", "run", "--body", "="), ["disc", "sphere"])
        self.assertEqual(bash_completes("swirl", "run", "--measure", "dens"), ["density"])
        self.assertEqual(bash_completes("swirl", "sweep", "--chain", "amp"), ["amplitude"])
        self.assertEqual(bash_completes("swirl", "run", "--mu", ""), [])

    def test_zsh_and_fish_have_the_values_of_options(self):
        zsh, fish = read_text(path("_swirl")), read_text(FISH)
        for command, option, values, has_others in listed_values():
            with self.subTest(command=command, option=option):
                part = re.search(rf"^ *{command}\) _arguments(.*?);;$", zsh, re.M | re.S)[1]
                words = " ".join(values)
                action = f"{{compadd {words}; _files}}" if has_others else f"({words})"
                line = re.search(rf"^ *'\*?{option}\[.+\]:.*:(.*)' \\$", part, re.M)
                self.assertEqual(line[1], action)
                self.assertRegex(
                    fish,
                    f"_from {command}' -l {option[2:]} {'-r' if has_others else '-x'} "
                    f"-a '{re.escape(words)}' ",
                )

    def test_zsh_has_every_option(self):
        text = read_text(path("_swirl"))
        for name, options in self.options.items():
            part = re.search(rf"^ *{name}\) _arguments(.*?);;$", text, re.M | re.S)[1]
            found = re.findall(r"^ *'\*?(--[\w-]+)\[.+\]", part, re.M)
            self.assertEqual(set(found), set(options), name)
            self.assertEqual(len(found), len(set(found)), name)

    def test_fish_has_every_option(self):
        for name, options in self.options.items():
            found = re.findall(
                rf"^complete -c swirl -n '__fish_seen_subcommand_from {name}' -l ([\w-]+)",
                read_text(FISH),
                re.M,
            )
            self.assertEqual({f"--{option}" for option in found}, set(options), name)

    @unittest.skipUnless(shutil.which("zsh"), "this test needs zsh")
    def test_zsh_reads_its_file(self):
        done = output_of("zsh", "-n", path("_swirl"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    @unittest.skipUnless(shutil.which("fish"), "this test needs fish")
    def test_fish_completes_commands_and_options(self):
        self.assertEqual(fish_completes("swirl cro"), ["crossing"])
        self.assertEqual(fish_completes("swirl run --dis"), ["--discs"])
        self.assertEqual(fish_completes("swirl run --body "), ["disc", "sphere"])


if __name__ == "__main__":
    unittest.main()
