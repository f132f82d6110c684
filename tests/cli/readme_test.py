"""The README is correct: its commands run, its output is printed, its links have targets."""

import os
import re
import shlex
import unittest

from program import SOURCE, InFolder, swirl

with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as file:
    README = file.read()

# Lines that differ between machines and calls.
TIMING = re.compile(r"^  time |^\d+ runs|^wrote ")


def blocks(kind):
    return re.findall(rf"^```{kind}\n(.*?)^```$", README, re.M | re.S)


class Readme(InFolder):
    def run_shortened(self, line):
        """Runs the command of the line, with fewer events if the line does not give the length."""
        words = shlex.split(line, comments=True)[1:]
        if words[0] == "run" and "--events" not in words and "--periods" not in words \
                and "--help" not in words and not any(w.endswith(".toml") for w in words):
            words += ["--events", "2000"]
        if words[0] == "paper" and "--figure" in words:
            words += ["--quick", "--events", "3000"]
        return swirl(*words, cwd=self.folder)

    def test_commands_work(self):
        lines = [line for block in blocks("sh") for line in block.splitlines()]
        self.assertGreater(len(lines), 3)
        for line in lines:
            known = re.match(r"\./swirl (run|paper --figure)", line)
            if not known:
                continue
            with self.subTest(line):
                done = self.run_shortened(line)
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_shown_output_of_a_run_is_printed(self):
        shown = {}
        for block in blocks("console"):
            for part in block.split("$ ")[1:]:
                command, _, output = part.partition("\n")
                shown[command] = output.splitlines()
        compared = 0
        for command, lines in shown.items():
            words = shlex.split(command)
            if words[:2] != ["./swirl", "run"]:
                continue
            printed = swirl(*words[1:], cwd=self.folder).stdout.splitlines()
            for line in lines:
                if line.strip() != "…" and not TIMING.match(line):
                    self.assertIn(line, printed)
                    compared += 1
        self.assertGreater(compared, 3)

    def test_links_have_targets(self):
        for name in ("README.md", "CONTRIBUTING.md", "docs/explanation/physics.md", "docs/explanation/architecture.md"):
            with open(os.path.join(SOURCE, name), encoding="utf-8") as file:
                text = file.read()
            for link in re.findall(r"\]\(([^)#]+)[^)]*\)", text):
                if link.startswith("http"):
                    continue
                target = os.path.join(SOURCE, os.path.dirname(name), link)
                self.assertTrue(os.path.exists(target), f"{name} links to {link}")


if __name__ == "__main__":
    unittest.main()
