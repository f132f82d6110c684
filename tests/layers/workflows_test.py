"""The workflows (.github/workflows) trust as little as possible: actions are pinned by commit, a
job that runs scripts of others has no token that can write, and no token stays in the clone."""

import glob
import os
import re
import unittest

SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)
# A command that runs scripts of other projects: of npm's packages, of an installer or of a build.
RUNS_SCRIPTS = re.compile(
    r"\./swirl|\./check|\bnpm\b|\bpip|\bapt-get\b|\bbrew\b|\bcmake\b|packaging/"
)


def workflows():
    for path in sorted(glob.glob(os.path.join(SOURCE, ".github/workflows/*.yml"))):
        with open(path, encoding="utf-8") as file:
            yield os.path.basename(path), re.sub(r"(^|\s)#[^\n]*", r"\1", file.read())


def jobs_of(text):
    """The text of each job, by its name."""
    parts = re.split(r"(?m)^  ([\w-]+):\n", text.split("\njobs:\n")[1])
    return dict(zip(parts[1::2], parts[2::2]))


class Workflows(unittest.TestCase):
    def test_actions_are_pinned_by_commit(self):
        for name, text in workflows():
            used = re.findall(r"uses: *(\S+)", text)
            for action in used:
                with self.subTest(workflow=name, action=action):
                    self.assertRegex(action, r"@[0-9a-f]{40}$")

    def test_no_token_stays_in_a_clone(self):
        for name, text in workflows():
            with self.subTest(workflow=name):
                self.assertEqual(
                    len(re.findall("uses: actions/checkout@", text)),
                    len(re.findall("persist-credentials: false", text)),
                )

    def test_the_token_of_a_workflow_can_only_read(self):
        for name, text in workflows():
            with self.subTest(workflow=name):
                self.assertRegex(text, r"(?m)^permissions:\n  contents: read\n(?! )")

    def test_a_job_that_can_write_runs_no_scripts_of_others(self):
        writing = 0
        for name, text in workflows():
            for job, steps in jobs_of(text).items():
                if not re.search(r"(?m)^ +[\w-]+: write$", steps):
                    continue
                writing += 1
                with self.subTest(workflow=name, job=job):
                    self.assertNotRegex(steps, RUNS_SCRIPTS)
                    self.assertNotIn("container:", steps)
        self.assertEqual(writing, 2)  # the pages and the draft of a release

    def test_npm_runs_no_install_scripts(self):
        with open(os.path.join(SOURCE, "web/lab.sh"), encoding="utf-8") as file:
            calls = re.findall(r"(?m)^[^#\n]*\bnpm (?:install|ci)\b[^\n]*", file.read())
        self.assertTrue(calls)
        for call in calls:
            self.assertIn("--ignore-scripts", call)


if __name__ == "__main__":
    unittest.main()
