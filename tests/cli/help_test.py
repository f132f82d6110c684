"""Every --help has descriptions, and examples with valid options."""

import fcntl
import os
import pty
import re
import struct
import subprocess
import termios
import unittest

from program import (
    HIDDEN,
    SOURCE,
    SWIRL,
    ProgramTest,
    commands,
    described_options,
    help_of,
    option_of,
    read_text,
    result_of,
    swirl,
)


def source_folders():
    """The results of os.walk() for all source files of the program."""
    for top in ("src", "track"):
        for folder, folders, files in os.walk(os.path.join(SOURCE, top)):
            if top == "track" and folder.endswith("track"):
                folders.remove("tests")
            yield folder, folders, files


def on_terminal(columns, *arguments):
    """The output on a terminal of this width."""
    ours, its = pty.openpty()
    fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 40, columns, 0, 0))
    process = subprocess.Popen(
        [SWIRL, *arguments], stdout=its, stderr=its, stdin=subprocess.DEVNULL
    )
    os.close(its)
    output = b""
    while True:
        try:
            piece = os.read(ours, 65536)
        except OSError:  # EIO: the program has ended
            break
        if not piece:
            break
        output += piece
    os.close(ours)
    process.wait()
    return output.decode().replace("\r\n", "\n")


def examples(text):
    return re.findall(r"^  (swirl .*)$", text[text.index("Examples:") :], re.MULTILINE)


class Help(ProgramTest):
    def test_every_help_has_examples_of_itself(self):
        self.assertTrue(examples(swirl("--help").stdout))
        for name in commands():
            with self.subTest(name):
                done = self.assert_works(name, "--help")
                self.assertEqual(done.stderr, "")
                self.assertTrue(examples(done.stdout), "no examples")
                # Examples of the next step may follow.
                self.assertTrue(examples(done.stdout)[0].startswith(f"swirl {name}"))
                for example in examples(done.stdout):
                    self.assertIn(example.split()[1], commands(), example)

    def test_examples_use_only_options_that_exist(self):
        for name in commands():
            text = help_of(name)
            known = set(re.findall(r"(--[a-z0-9-]+)", text[: text.index("Examples:")]))
            for example in examples(text):
                if not example.startswith(f"swirl {name} "):
                    continue
                for option in re.findall(r"(?<=\s)(--[a-z0-9-]+)", example):
                    self.assertIn(option, known, example)

    def test_descriptions_are_short_noun_phrases(self):
        seen = 0
        for name in commands():
            for option, description in described_options(help_of(name)):
                seen += 1
                self.assertTrue(1 <= len(description) <= 60, f"{name} {option}: {description}")
                self.assertRegex(description, r"^[A-Z]", f"{name} {option}")
        self.assertGreater(seen, 250)

    def test_the_short_help_has_the_main_options_and_names_the_full_help(self):
        for name in commands():
            with self.subTest(name):
                short, full = swirl(name, "-h"), help_of(name)
                self.assertEqual((short.returncode, short.stderr), (0, ""))
                options = dict(described_options(short.stdout))
                options.pop("--help", None)  # -h,--help
                self.assertLessEqual(len(options), 15)
                self.assertLessEqual(options.items(), dict(described_options(full)).items())
                self.assertIn(f"\nUsage: swirl {name} [OPTIONS]", short.stdout)
                if name == "run":  # its topics are the full help
                    self.assertEqual(short.stdout, swirl("run", "--help").stdout)
                    self.assertEqual(examples(short.stdout), examples(full)[:2])
                    continue
                self.assertIn(f"All options: swirl {name} --help\n", short.stdout)
                self.assertEqual(examples(short.stdout), examples(full))
        self.assertEqual(swirl("-h").stdout, swirl("--help").stdout)

    def test_the_help_of_run_has_topics(self):
        text = swirl("run", "--help").stdout
        self.assertLessEqual(len(text.splitlines()), 30)
        topics = re.findall(r"^  swirl help run ([a-z-]+) +(\d+) options$", text, re.M)
        self.assertEqual(
            [name for name, _ in topics], ["particles", "container", "run", "files", "output"]
        )
        every = dict(described_options(help_of("run")))
        found = {}
        for name, count in topics:
            options = dict(described_options(swirl("help", "run", name).stdout))
            options.pop("--help")
            self.assertEqual(len(options), int(count), name)
            found |= options
        every.pop("--help")
        self.assertEqual(found, every)
        self.assert_fails(2, "help", "run", "partcles", says="the topics are all, particles")

    def test_other_commands_refer_to_the_parameters_of_a_run(self):
        of_run = set(dict(described_options(help_of("run"))))
        for name in commands():
            text, every = swirl(name, "--help").stdout, dict(described_options(help_of(name)))
            shown = dict(described_options(text))
            if "All parameters of a run apply" not in text:
                self.assertTrue(name == "run" or shown == every, name)
                continue
            excluded = re.search(r"apply except ([^:]*): swirl help run", text)
            missing = set(excluded[1].split(", ")) if excluded else set()
            self.assertLessEqual(missing & set(every), set(shown), name)  # its own --periods
            self.assertLessEqual(set(every) - set(shown), of_run, name)

    def test_the_help_fits_the_terminal(self):
        for columns in (60, 100):
            for name in ("run", "crossing", "image", "sweep"):
                for line in on_terminal(columns, "help", name, "all").splitlines():
                    if not re.match(r"  swirl |.*  --|Usage|  -\w|    ", line):
                        self.assertLessEqual(len(line), columns, line)
        self.assertNotEqual(on_terminal(60, "run", "--help"), on_terminal(100, "run", "--help"))
        self.assertEqual(on_terminal(200, "run", "--help"), swirl("run", "--help").stdout)

    def test_names_of_options_accept_both_spellings(self):
        for spelling in ("--color", "--colour"):
            self.assertIn(
                "--color is 'sped'", swirl("image", spelling, "sped", "--out", "x.png").stderr
            )
        for spelling in ("--centre", "--center"):
            self.assertNotIn(
                "there is no option", swirl("measure", "missing.csv", f"{spelling}=1,1").stderr
            )
        self.assertIn(
            "did you mean --centre?", swirl("measure", "missing.csv", "--centr=1,1").stderr
        )

    def test_a_wrong_value_gets_a_suggestion(self):
        for call, meant in (
            (["run", "--body", "spere"], "sphere"),
            (["run", "--motion", "cirle"], "circle"),
            (["run", "--measure", "dens"], "density"),
            (["run", "--inertia", "shel"], "shell"),
            (["image", "--color", "sped", "--out", "x.png"], "speed"),
            (["image", "--theme", "drak", "--out", "x.png"], "dark"),
            (["synthetic-video", "--camera", "fone", "--out", "x.mp4"], "phone"),
            (["paper", "--figure", "fricton"], "friction"),
        ):
            with self.subTest(call):
                done = self.assert_fails(2, *call)
                self.assertRegex(done.stderr, rf"\nhint: did you mean '{meant}'\?\n\Z")

    def test_an_unknown_name_gets_a_suggestion_only_if_it_is_likely(self):
        for call, hint in (
            (["run", "--out", "r.json"], "did you mean --json? See `swirl help run output`."),
            (
                ["collect", "sweep", "--out", "t.csv"],
                "did you mean --csv? See `swirl collect --help`.",
            ),
            (["run", "--friction=0.5"], "did you mean --mu? See `swirl help run particles`."),
            (["run", "--dicss", "5"], "did you mean --discs? See `swirl help run particles`."),
            # The unknown option explains why a required one is missing.
            (
                ["export", "t.h5", "--to", "xyz"],
                "did you mean --format? See `swirl export --help`.",
            ),
            (["sweep", "--dicss", "5"], "did you mean --discs? See `swirl help run particles`."),
            (["sweep", "--seeds", "5"], "did you mean --replicates? See `swirl sweep --help`."),
            (["run", "--frobnicate"], "see `swirl run --help`."),
            (["frobnicate"], "see `swirl --help`."),
        ):
            with self.subTest(call):
                done = self.assert_fails(2, *call)
                self.assertRegex(
                    done.stderr, rf"\Aerror: there is no [^\n]+\.\nhint: {re.escape(hint)}\n\Z"
                )

    def test_a_wrong_value_names_the_topic_of_its_option(self):
        for call, hint in (
            (["run", "--mu"], "see `swirl help run particles`."),
            (["run", "--quiet=1"], "see `swirl help run output`."),
            (["movie", "--mu"], "see `swirl help run particles`."),
            (["movie", "--fps", "x"], "see `swirl movie --help`."),
        ):
            with self.subTest(call):
                self.assertTrue(self.assert_fails(2, *call).stderr.endswith(f"\nhint: {hint}\n"))

    def test_the_values_in_a_form_are_accepted(self):
        seen = 0
        for option, form in re.findall(r"^  (--[a-z-]+) (\S+\|\S+)", help_of("run"), re.M):
            for value in form.split("|"):
                if re.fullmatch("[a-z][^A-Z]*", value):
                    seen += 1
                    with self.subTest(option=option, value=value):
                        self.assert_works("run", option, value, "--dry-run")
        self.assertGreater(seen, 20)

    def test_messages_name_only_options_that_exist(self):
        known = {
            name: set(re.findall(r"(--[a-z][a-z0-9-]+)", help_of(name)))
            for name in (*commands(), *HIDDEN)
        }
        everywhere = set().union(*known.values()) | {"--version", "--help"}
        seen = 0
        for folder, _, files in source_folders():
            for file in files:
                if file == "slurm.cpp":  # has options of sbatch
                    continue
                text = re.sub(r"//[^\n]*", "", read_text(os.path.join(folder, file)))
                # Adjacent literals form one text.
                for literal in re.findall(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', text):
                    sentence = re.sub(r'"\s*"', "", literal)
                    command = re.search(r"command_(\w+)\.cpp", file)
                    named = re.findall(r"swirl (" + "|".join(known) + r")\b", sentence)
                    if named:
                        allowed = set().union(*(known[name] for name in named))
                        if command:
                            allowed |= known.get(command.group(1), set())
                    elif re.fullmatch('"--[a-z0-9-]+"', sentence):
                        allowed = everywhere  # an argument of a call of another command
                    elif command and command.group(1) in known and command.group(1) != "sweep":
                        allowed = known[command.group(1)] | {"--help"}
                    else:  # command_sweep.cpp has `swirl collect`, too
                        allowed = everywhere
                    for option in re.findall(r"(?<![\w-])(--[a-z][a-z0-9-]+)", sentence):
                        seen += 1
                        self.assertIn(option, allowed, f"{file}: {sentence}")
        self.assertGreater(seen, 100)

    def test_adjacent_literals_of_a_message_are_separated(self):
        for folder, _, files in source_folders():
            for file in files:
                text = read_text(os.path.join(folder, file))
                for glued in re.finditer(r'\w"\s*\n\s*"[A-Za-z]', text):
                    before = text[text.rindex("\n", 0, glued.start()) : glued.start() + 1]
                    # A literal that ends with a line break needs no space.
                    if not before.endswith("\\n"):
                        self.fail(f"{file}: {before.strip()}")

    def test_a_parameter_has_one_name_in_tables_and_results(self):
        options = {option[2:] for option in re.findall(r"(--[a-z][a-z0-9-]+)", help_of("run"))}

        def keys(value, path=""):
            if isinstance(value, dict):
                for key, inner in value.items():
                    yield key, path
                    yield from keys(inner, path + "/" + key)

        result = result_of("--discs", 8, "--events", "2e4", "--measure", "all")
        for key, path in keys(result):
            self.assertNotIn("-", key, path)
        for key in result["config"]:
            if key != "omega":  # derived from the period
                self.assertIn(option_of(key)[2:], options)

    def test_version_is_one_line(self):
        done = self.assert_works("--version")
        self.assertRegex(done.stdout, r"^\d+\.\d+\.\d+ \(.+\)\n$")


if __name__ == "__main__":
    unittest.main()
