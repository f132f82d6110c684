"""Commands in messages work in a shell for all file names; `--` ends the options."""

import json
import os
import re
import shlex
import subprocess
import unittest

from program import HANG, SWIRL, InFolder, commands, read_text, swirl, write_text

NAMES = [
    "plain",
    "with spaces",
    "it's",
    'a "quoted" name',
    "a\nb",
    "$(touch planted)",
    "a; touch planted #",
    "./-dash",
    "./-with spaces",
]
SWEEP = ["--discs", "2:3", "--events", "200"]


class Hints(InFolder):
    def call(self, *words):
        return swirl(*words, cwd=self.folder)

    def in_shell(self, command):
        """Runs the command in a shell, with the program under test as `swirl`."""
        self.assertTrue(command.startswith("swirl "), command)
        return subprocess.run(
            ["/bin/sh", "-c", shlex.quote(SWIRL) + command[5:]],
            cwd=self.folder,
            capture_output=True,
            text=True,
            timeout=HANG,
        )

    def test_the_printed_collect_command_works(self):
        for name in NAMES:
            with self.subTest(name):
                done = self.call("sweep", *SWEEP, f"--out={name}")
                self.assertEqual(done.returncode, 0, done.stderr)
                table = self.in_shell(done.stdout.split("\n  table       ", 1)[1])
                self.assertEqual(table.returncode, 0, table.stderr)
                self.assertTrue(table.stdout.endswith("(2 of 2 runs)\n"), table.stdout)
        self.assertEqual(self.left_behind(), sorted(name.removeprefix("./") for name in NAMES))

    def test_the_proposed_name_for_a_file_like_an_option_works(self):
        for name in ("-dash", "-with spaces", "--it's"):
            with self.subTest(name):
                refused = self.call("sweep", *SWEEP, f"--out={name}")
                self.assertEqual(refused.returncode, 2)
                proposed = re.search(r"\nhint: [^\n]*, write (.*)\n\Z", refused.stderr)[1]
                done = self.in_shell("swirl sweep --discs 2 --events 200 --out " + proposed)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(name, self.left_behind())

    def test_the_printed_command_continues_a_sweep(self):
        name = "a; touch planted #"
        process = subprocess.Popen(
            [SWIRL, "sweep", "--discs", "5:40", "--events", "1e9", "--out", name],
            cwd=self.folder,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.addCleanup(process.kill)
        first = process.stderr.read(1)  # of the progress line: the sweep is running
        process.terminate()
        said = first + process.communicate(timeout=HANG)[1]
        self.assertEqual(process.returncode, 130, said)
        command = re.search(r"\nhint: run `(.*)` to continue", said, re.DOTALL)[1]
        status = self.in_shell(command + " --status")
        self.assertIn("of 36 runs done", status.stdout, status.stderr)
        self.assertEqual(self.left_behind(), [name])


class EndOfOptions(InFolder):
    def setUp(self):
        super().setUp()
        write_text(self.path("--my_plan.toml"), "discs = 3\nevents = 10\n")
        write_text(self.path("plan.toml"), "discs = 4\nevents = 10\n")

    def call(self, *words):
        return swirl(*words, cwd=self.folder)

    def test_a_file_name_may_start_with_dashes(self):
        done = self.call("run", "--seed", "2", "--", "--my_plan.toml")
        self.assertEqual((done.returncode, done.stdout.split()[0]), (0, "3"), done.stderr)

    def test_words_after_it_are_not_options(self):
        for words in (
            ["run", "plan.toml", "--", "--version"],
            ["run", "plan.toml", "--", "--help"],
            ["run", "--", "plan.toml", "--discs", "5"],
            ["crossing", "--", "plan.toml", "--mu=1"],
            ["run", "plan.toml", "--", "-h"],
        ):
            with self.subTest(words):
                done = self.call(*words)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                extra = next(
                    word for word in words[words.index("--") + 1 :] if word.startswith("-")
                )
                self.assertIn(f"unexpected argument '{extra}'", done.stderr)

    def test_it_may_be_the_last_argument(self):
        self.assertEqual(self.call("run", "plan.toml", "--").stdout.split()[0], "4")


# Every option that had another name: the commands, the former and the present name.
RENAMED = (
    ("movie image", "--frame", "--view"),
    ("run sweep crossing map dish movie image", "--path", "--motion"),
    ("run sweep crossing map dish movie image", "--path-phase", "--start-angle"),
    ("track", "--path-out", "--motion-out"),
    ("track", "--path", "--motion-out"),
    ("track", "--from", "--first-frame"),
    ("track", "--to", "--last-frame"),
    ("track", "--skip", "--ignore-frames"),
    ("run measure crossing track paper", "--omit-paths", "--portable"),
    ("run sweep", "--frames", "--frames-per-period"),
    ("sweep map dish experiment paper", "--seeds", "--replicates"),
    ("sweep map crossing", "--nodes", "--tasks"),
    ("sweep map crossing", "--cpus", "--cores"),
    ("experiment", "--smooth", "--smooth-discs"),
    ("synthetic-video", "--length", "--periods"),
    ("synthetic-video", "--max-frames", "--frame-count"),
    ("synthetic-video", "--path", "--motion"),
    ("movie", "--frames", "--frame-files"),
    ("measure", "--skip", "--warmup"),
    ("export", "--to", "--format"),
    ("map", "--of", "--quantity"),
    ("sweep", "--rest", "--finish-others"),
)

# The present keys of a configuration file, and the former ones, which are still read.
FORMER_KEYS = (
    ("run", "motion", "path", "ellipse:0.5"),
    ("run", "start_angle", "path_phase", "90"),
    ("run", "trajectory = 'a.h5'\nframes_per_period", "trajectory = 'a.h5'\nframes", "12"),
)


class FormerNames(InFolder):
    def test_a_former_name_gets_the_present_one(self):
        known = commands()
        for command, former, present in (
            (command, former, present)
            for those, former, present in RENAMED
            for command in those.split()
            if command in known
        ):
            with self.subTest(command=command, former=former):
                required = {
                    "export": ["a.h5", "--format", "xyz"],
                    "map": ["--out", "m"],
                    "sweep": ["--out", "s"],
                    "experiment": ["a.mp4"],
                }
                self.assert_fails(
                    2,
                    command,
                    *required.get(command, []),
                    former,
                    "1",
                    cwd=self.folder,
                    says=f"error: there is no option {former}.\nhint: did you mean {present}?",
                )

    def test_a_former_rate_gets_the_present_one(self):
        self.assert_fails(
            2,
            "crossing",
            "--rate",
            "by_event",
            cwd=self.folder,
            says="did you mean 'mean_by_event'?",
        )

    def test_a_file_may_have_the_former_keys(self):
        for command, present, former, value in FORMER_KEYS:
            with self.subTest(former):
                made = []
                for key in (present, former):
                    write_text(self.path("a.toml"), f"discs = 3\nevents = 10\n{key} = '{value}'\n")
                    call = [command, "a.toml", "--dry-run"]
                    made.append(self.assert_works(*call, cwd=self.folder).stdout)
                self.assertEqual(made[0], made[1])
                self.assertIn(present.split()[-1] + " = ", made[0])
        write_text(self.path("a.toml"), "path = 'line'\nmotion = 'line'\n")
        self.assert_fails(2, "run", "a.toml", cwd=self.folder, says="motion is given twice")

    def test_results_keep_the_keys_of_the_motion(self):
        call = ["run", "--discs", 3, "--events", 10, "--json", "-", "--quiet"]
        done = self.assert_works(*call, "--motion", "line", "--start-angle", 90, cwd=self.folder)
        config = json.loads(done.stdout)["config"]
        self.assertEqual((config["path"], config["path_phase"]), ("line", 90.0))

    def test_a_table_of_points_may_have_the_former_columns(self):
        plans = []
        for header in ("discs,motion,replicates", "discs,path,seeds"):
            write_text(self.path("points.csv"), header + "\n3,line,2\n4,circle,1\n")
            call = ["sweep", "--points", "points.csv", "--out", header, "--events", 10, "--quiet"]
            self.assert_works(*call, cwd=self.folder)
            plans.append(json.loads(read_text(os.path.join(self.path(header), "plan.json"))))
        self.assertEqual(plans[0], plans[1])

    def test_a_former_view_gets_the_present_one(self):
        self.assert_fails(
            2,
            "image",
            "--view",
            "lab",
            "--out",
            "a.png",
            cwd=self.folder,
            says="--view is 'lab', but it must be laboratory, m or both.\nhint: did you mean "
            "'laboratory'?",
        )

    def test_a_former_key_of_a_file_gets_the_present_one(self):
        write_text(self.path("a.toml"), "bare = true\n")
        self.assert_fails(
            2,
            "image",
            "a.toml",
            "--out",
            "a.png",
            cwd=self.folder,
            says="did you mean 'no_annotations'?",
        )


class Values(InFolder):
    def assert_rejected(self, *words, says):
        self.assertEqual(self.assert_fails(2, *words, says=says, cwd=self.folder).stdout, "")
        self.assertEqual(self.left_behind(), [])

    def test_a_list_or_a_comma_in_a_number(self):
        self.assert_rejected(
            "run", "--mu", "0,5", says=["hint: use a decimal point, 0.5; `swirl sweep` takes lists"]
        )
        for text in ("0.1,0.5", "0:0.25:1", "0.1,0.5,1"):
            self.assert_rejected(
                "run",
                "--mu",
                text,
                says=[f"--mu is '{text}'", "`swirl sweep` takes lists and ranges."],
            )
        self.assert_rejected(
            "run", "--discs", "5:48", says=["`swirl sweep` takes lists and ranges."]
        )

    def test_ranges_without_a_step_and_in_another_order(self):
        sweep = ["sweep", "--out", "s", "--periods", "5"]
        self.assert_rejected(
            *sweep,
            "--mu",
            "0:1",
            says=["--mu is '0:1', a range without a step", "give the step, 0:0.25:1"],
        )
        self.assert_rejected(
            *sweep,
            "--mu",
            "0:1:0.25",
            says=["the step is in the middle: FROM:STEP:TO.", "hint: write 0:0.25:1."],
        )
        self.assert_works(*sweep, "--discs", "5:8", "--dry-run", cwd=self.folder)

    def test_parameters_of_the_floor_without_a_floor(self):
        for name, values in (
            ("--gravity", ("6.382", "9")),
            ("--floor-friction", ("0.3", "0.4")),
            ("--rolling-resistance", ("0",)),
        ):
            for value in values:
                self.assert_rejected(
                    "run", name, value, says=[f"{name} is {value}, but there is no floor."]
                )

    def test_names_of_recordings(self):
        for option in ("--trajectory", "--log-events"):
            self.assert_rejected(
                "run", option, "a.txt", says=[f"{option} is 'a.txt', but its name must end in .h5."]
            )

    def test_a_ramp_is_reported_with_its_own_value(self):
        for text in (";", "mu=0:1@1..2;"):
            self.assert_rejected(
                "run",
                "--ramp",
                text,
                "--quiet",
                says=[f"--ramp is '{text}', but a part of it is empty."],
            )

    def test_the_status_of_a_map_or_sweep_in_an_empty_folder(self):
        said = {
            swirl(command, "--out", ".", "--status", cwd=self.folder).stderr
            for command in ("map", "sweep")
        }
        self.assertEqual(
            said, {"error: '.' is not the folder of a sweep or map: it holds no plan.json.\n"}
        )


if __name__ == "__main__":
    unittest.main()
