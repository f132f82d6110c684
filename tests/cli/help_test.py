"""Every --help has descriptions, and examples with valid options."""

import os
import re
import unittest

from program import SOURCE, result_of, swirl


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
                # Examples of the next step may follow.
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

    def test_messages_name_only_options_that_exist(self):
        known = {name: set(re.findall(r"(--[a-z][a-z0-9-]+)", swirl(name, "--help").stdout))
                 for name in subcommands()}
        everywhere = set().union(*known.values()) | {"--version", "--help"}
        root = os.path.join(SOURCE, "src")
        seen = 0
        for folder, _, files in os.walk(root):
            for file in files:
                if file == "slurm.cpp":  # has options of sbatch
                    continue
                with open(os.path.join(folder, file), encoding="utf-8") as opened:
                    text = re.sub(r"//[^\n]*", "", opened.read())
                # Adjacent literals form one text.
                for literal in re.findall(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', text):
                    sentence = re.sub(r'"\s*"', "", literal)
                    command = re.search(r"command_(\w+)\.cpp", file)
                    named = re.findall(r"swirl (" + "|".join(known) + r")\b", sentence)
                    if named:
                        allowed = set().union(*(known[name] for name in named))
                        if command:
                            allowed |= known.get(command.group(1), set())
                    elif command and command.group(1) in known and command.group(1) != "sweep":
                        allowed = known[command.group(1)] | {"--help"}
                    else:  # command_sweep.cpp has `swirl collect`, too
                        allowed = everywhere
                    for option in re.findall(r"(?<![\w-])(--[a-z][a-z0-9-]+)", sentence):
                        seen += 1
                        self.assertIn(option, allowed, f"{file}: {sentence}")
        self.assertGreater(seen, 100)

    def test_adjacent_literals_of_a_message_are_separated(self):
        for folder, _, files in os.walk(os.path.join(SOURCE, "src")):
            for file in files:
                with open(os.path.join(folder, file), encoding="utf-8") as opened:
                    text = opened.read()
                for glued in re.finditer(r'\w"\s*\n\s*"[A-Za-z]', text):
                    before = text[text.rindex("\n", 0, glued.start()):glued.start() + 1]
                    # A literal that ends with a line break needs no space.
                    if not before.endswith("\\n"):
                        self.fail(f"{file}: {before.strip()}")

    def test_a_parameter_has_one_name_in_tables_and_results(self):
        options = {option[2:] for option in
                   re.findall(r"(--[a-z][a-z0-9-]+)", swirl("run", "--help").stdout)}

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
                self.assertIn(key.replace("_", "-"), options)

    def test_version_is_one_line(self):
        done = swirl("--version")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"^\d+\.\d+\.\d+ \(.+\)\n$")


if __name__ == "__main__":
    unittest.main()
