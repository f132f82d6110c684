"""Invalid input gives an error on stderr that quotes the value, perhaps with a hint on a second
line, and exit code 2 (usage error) or 1 (failure). No output file is published."""

import json
import os
import resource
import subprocess
import tempfile
import tomllib
import unittest

from program import (
    HANG,
    ONE_ERROR,
    SWIRL,
    InFolder,
    ProgramTest,
    read_json,
    read_text,
    swirl,
    write_text,
)

# Options, exit code, words that the error must contain.
CALLS = [
    ("--discs 0", 2, ["--discs is 0", "from 1"]),
    ("--discs 2.5", 2, ["--discs is '2.5'", "whole number"]),
    ("--discs many", 2, ["--discs is 'many'", "whole number"]),
    ("--discs 1e30", 2, ["--discs is '1e30'"]),
    ("--discs 60", 2, ["60 discs", "8.6", "no known arrangement holds more than 59"]),
    ("--discs 250 --radius 0.5", 2, ["250 discs", "8.6", "overlap", "more than 264"]),
    (
        "--discs 5000",
        2,
        ["5000 discs do not fit", "8.6", "no known arrangement holds more than 59"],
    ),
    ("--mu -1", 2, ["--mu is '-1'", "0 or more"]),
    ("--mu nan", 2, ["--mu is 'nan'", "finite number"]),
    ("--restitution 1.5", 2, ["--restitution is 1.5", "from 0 to 1"]),
    ("--inertia hollow", 2, ["--inertia is 'hollow'", "ring", "solid", "paper"]),
    ("--body cube", 2, ["--body is 'cube'", "disc or sphere"]),
    ("--preset marbles", 2, ["--preset is 'marbles'", "experiment"]),
    (
        "--preset experiment --floor rough",
        2,
        ["--floor is 'rough'", "none or sliding", "--floor-friction"],
    ),
    ("--vertical-wall 0.5", 2, ["--vertical-wall is 0.5", "--body sphere"]),
    ("--preset experiment --motion circle", 2, ["--motion is circle", "--motion polygon"]),
    ("--preset experiment --discs 60", 2, ["60 spheres", "8.5"]),
    (
        "--period 1e-6 --restitution 0.9",
        2,
        ["period is 1e-06", "default contact duration, 0.001", "from 0 to 1e-06"],
    ),
    ("--period 1e-6 --contact-duration 2e-6", 2, ["--contact-duration is 2e-06", "to 1e-06"]),
    ("--radius 8.6 --discs 1", 2, ["8.6", "--container-radius must be larger"]),
    ("--amplitude 1 --speed 1 --period 3", 2, ["--speed is 1", "--amplitude 1", "--period 3"]),
    ("--amplitude 0 --speed 1", 2, ["--speed is 1", "--amplitude 0", "is at rest"]),
    ("--speed -1", 2, ["--speed is '-1'"]),
    ("--speed 1e-300", 2, ["--period is"]),
    ("--sides 1e17", 2, ["--sides is", "from 3"]),
    ("--sides 30 --motion circle", 2, ["--sides is 30", "circle"]),
    ("--motion square", 2, ["--motion is 'square'", "polygon, circle, line"]),
    ("--events 1e30", 2, ["--events is '1e30'"]),
    ("--events 10 --periods 10", 2, ["--events 10", "--periods 10", "omit one"]),
    ("--warmup soon", 2, ["--warmup is 'soon'", "auto"]),
    ("--warmup 20 --periods 20", 2, ["--warmup is 20", "--periods 20", "shorter"]),
    ("--warmup 500 --events 1000", 2, ["--warmup is 500", "--events 1000", "shorter"]),
    ("--warmup 20 --events 5000", 1, ["--warmup 20", "shorter"]),
    ("--seed -1", 2, ["--seed is '-1'"]),
    ("--seed 99999999999999999999", 2, ["--seed is '99999999999999999999'"]),
    ("--sizes 12", 2, ["--sizes is '12'", "uniform:MIN:MAX"]),
    ("--sizes unifrm:1:2", 2, ["did you mean 'uniform'?"]),
    ("--sizes uniform:1", 2, ["uniform:MIN:MAX, in finite numbers"]),
    ("--sizes uniform:0:1", 2, ["a radius in --sizes is 0"]),
    ("--sizes uniform:-1:1", 2, ["a radius in --sizes is -1"]),
    ("--sizes uniform:1:0.5", 2, ["the largest radius in --sizes is 0.5"]),
    ("--sizes uniform:1:9", 2, ["9", "the largest radius in --sizes"]),
    ("--sizes uniform:nan:1", 2, ["in finite numbers"]),
    ("--sizes normal:1:0.4", 2, ["3 standard deviations below the mean"]),
    ("--sizes normal:1:-0.1", 2, ["3 standard deviations below the mean"]),
    ("--sizes lognormal:1:2", 2, ["the standard deviation in --sizes is 2"]),
    ("--sizes power:30:1:2", 2, ["the exponent in --sizes is 30"]),
    ("--sizes uniform:1:2 --mixture 3:1.2", 2, ["--sizes and --mixture"]),
    ("--sizes uniform:1.4:1.6 --discs 55", 2, ["do not fit", "%"]),
    ("--sizes file:nothing.csv", 2, ["'nothing.csv'", "no such file"]),
    ("--sizes file:/", 2, ["not a regular file"]),
    ("--sizes file:/dev/zero", 2, ["not a regular file"]),
    ("--initial nothing.csv", 2, ["'nothing.csv'", "no such file"]),
    ("--initial /dev/zero", 2, ["not a regular file"]),
    ("--motion spiral", 2, ["--motion is 'spiral'", "a file"]),
    ("--motion elipse:0.5", 2, ["did you mean 'ellipse'?"]),
    ("--motion ellipse", 2, ["--motion is 'ellipse'", "ratio"]),
    ("--motion ellipse:-1", 2, ["--motion is 'ellipse:-1'", "ratio"]),
    ("--motion ellipse:nan", 2, ["--motion is 'ellipse:nan'", "ratio"]),
    ("--motion lissajous:2", 2, ["--motion is 'lissajous:2'", "lissajous:2:3"]),
    ("--motion lissajous:0:1", 2, ["whole numbers from 1 to 1000"]),
    ("--motion lissajous:2:3 --sides 11", 2, ["--sides is 11", "at least 12"]),
    ("--motion nothing.csv", 2, ["--motion is 'nothing.csv'", "no such file"]),
    ("--motion .", 2, ["--motion is '.'", "not a regular file"]),
    ("--motion /dev/zero", 2, ["not a regular file"]),
    ("--direction left", 2, ["--direction is 'left'", "clockwise"]),
    ("--motion line --measure slip", 2, ["'slip'", "M-frame", "segregation"]),
    ("--mixture 12", 2, ["--mixture is '12'", "COUNT:RADIUS"]),
    ("--mixture 0:1.2", 2, ["--mixture is 0"]),
    ("--mixture 60:1.2", 2, ["--mixture is 60", "to 48"]),
    ("--mixture 5:-1", 2, ["--mixture is -1"]),
    ("--mixture 5:1.2:0", 2, ["--mixture is 0"]),
    ("--mixture 5:1.2:x", 2, ["--mixture is '5:1.2:x'"]),
    ("--mixture 5:9", 2, ["9", "--container-radius must be larger"]),
    ("--container-radius 1e6", 2, ["radius 1000000", "50000 times", "--container-radius"]),
    ("--radius 1e-6", 2, ["50000 times", "radius 1e-06"]),
    ("--discs 5 --discs 6", 2, ["--discs may be given only once"]),
    ("--discs", 2, ["--discs needs a value"]),
    ("--frobnicate", 2, ["no option --frobnicate"]),
    ("--quiet=3", 2, ["--quiet is a switch and takes no value"]),
    ("--measure density,all", 2, ["--measure is 'density,all'", "'all' cannot be combined"]),
    ("--measure density,,flow", 2, ["--measure is 'density,,flow'", "a name in the list is empty"]),
    ("--disc 5", 2, ["no option --disc", "did you mean --discs"]),
    ("48", 2, ["configuration file '48' does not exist", "--discs 48"]),
    ("--json", 2, ["--json needs a value"]),
    ("--json --quiet", 2, ["'--quiet' looks like an option"]),
    ("--json /no/such/folder/x.json", 1, ["/no/such/folder"]),
    ("--json /", 1, ["is a folder"]),
    # Collapses: infinitely many collisions in a finite time.
    (
        "--restitution 0.9 --contact-duration 0 --periods 20 --quiet",
        1,
        [
            "took no measurable time (collapse after",
            "restitution 0.9",
            "--contact-duration longer than 0",
        ],
    ),
    (
        "--mu-disc 0.5 --mu-wall 0 --periods 300 --quiet",
        1,
        ["collapse after", "friction", "no state after it"],
    ),
]


class BadCalls(ProgramTest):
    def test_a_file_name_that_is_not_utf8_is_rejected_before_the_run(self):
        with tempfile.TemporaryDirectory() as folder:
            for option in (b"--json", b"--trajectory", b"--checkpoint"):
                done = subprocess.run(
                    [SWIRL, "run", "--discs", "5", "--events", "1e4", option, b"r\xe9sum\xe9.h5"],
                    cwd=folder,
                    capture_output=True,
                    timeout=HANG,
                )
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(b"'r\\xe9sum\\xe9.h5' is not UTF-8 text", done.stderr)
                self.assertRegex(done.stderr.decode(), ONE_ERROR)
                self.assertEqual(os.listdir(folder), [])
            done = subprocess.run(
                [
                    SWIRL,
                    "run",
                    "--discs",
                    "5",
                    "--events",
                    "1e4",
                    "--quiet",
                    "--json",
                    "r\u00e9sum\u00e9 \U0001f300.json",
                ],
                cwd=folder,
                capture_output=True,
                timeout=HANG,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(os.listdir(folder), ["r\u00e9sum\u00e9 \U0001f300.json"])

    def test_each_call_gives_an_error_that_quotes_the_value(self):
        for call, code, words in CALLS:
            with self.subTest(call):
                done = swirl("run", *call.split(), timeout=HANG)
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertEqual(done.stdout, "")
                self.assertRegex(done.stderr, ONE_ERROR)
                for word in words:
                    self.assertIn(word, done.stderr)

    def test_empty_call_and_unknown_commands(self):
        done = swirl()
        self.assertEqual(done.returncode, 2)
        self.assertIn("Usage", done.stderr)
        self.assert_fails(2, "rnu", says="did you mean run")
        self.assert_fails(2, "paper", "--figure", "9z", says=["--figure is '9z'", "5b"])

    def test_help_to_a_full_device(self):
        for call in (["--help"], ["run", "--help"], ["--version"]):
            with open("/dev/full", "w") as full:
                done = subprocess.run(
                    [SWIRL, *call], stdout=full, stderr=subprocess.PIPE, text=True, timeout=HANG
                )
            self.assertEqual(done.returncode, 1)
            self.assertIn("No space left", done.stderr)

    def test_damaged_sweep_plans(self):
        with tempfile.TemporaryDirectory() as folder:
            for text, word in (
                ('{"format": 2, "axes": {"mu": []}, "replicates": 1}', "no values"),
                ('{"format": 2, "axes": {}, "replicates": 1152921504606846976}', "1.15e+18 runs"),
                ('{"format": 2, "axes"', "is not the plan of a sweep"),
                ('{"format": 2, "axes": 7, "replicates": 1}', "is not the plan of a sweep"),
            ):
                write_text(os.path.join(folder, "plan.json"), text)
                done = self.assert_fails(1, "sweep", "--out", folder, "--status", says=word)
                self.assertNotIn("json.exception", done.stderr)

    def test_damaged_results(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "a.json")
            config = json.loads(swirl("run", "--events", 10, "--json", "-", "--quiet").stdout)
            config["config"]["mixture"] = {"count": 2}
            for text in (
                "{",
                '{"config": 7, "state_hash": 7, "complete": true}',
                '{"config": {}, "state_hash": 7, "complete": "yes"}',
                '{"config": {"mu": [1]}, "state_hash": "7", "complete": true}',
                json.dumps(config),
            ):
                write_text(file, text)
                done = self.assert_fails(1, "verify", file, says="a.json")
                self.assertNotIn("json.exception", done.stderr)

    def test_arguments_that_are_not_utf8(self):
        done = subprocess.run(
            [SWIRL.encode(), b"run", b"--discs", b"\xff\xfe"], capture_output=True, timeout=HANG
        )
        self.assertEqual(done.returncode, 2)

    def test_an_option_is_not_the_value_of_the_one_before_it(self):
        self.assert_fails(2, "run", "--discs", 5, "--ramp", ";", "--quiet", says="--ramp is ';'")
        done = swirl(
            "run",
            "--discs",
            5,
            "--ramp",
            "mu=0.1:1@1..3",
            "--ramp",
            "restitution=1:0.9@1..3",
            "--dry-run",
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("mu=0.1:1@1..3;restitution=1:0.9@1..3", done.stdout)

    def test_very_long_values(self):
        long = "9" * 100000
        for call in (
            ["run", "--discs", long],
            ["run", "--" + long, 1],
            ["run", "--mu", long + "x"],
            [long],
            ["run", "--discs", 5, "--measure", long],
            ["run", "--motion", "points " + "0:1:0 " * 9999 + "x"],
            ["sweep", "--discs", "1:" + long + "x", "--out", "s"],
            ["verify", long],
        ):
            done = swirl(*call)
            self.assertIn(done.returncode, (1, 2), call[:1])
            self.assertLess(len(done.stderr), 1000, done.stderr[:200])
        self.assert_works("run", "--mu", "0." + "3" * 100000, "--events", 10)


class UsageErrors(InFolder):
    """Usage errors of commands other than run."""

    def test_a_misspelled_command_is_the_error_and_not_its_options(self):
        for options in (["--discs", 4], ["--out", "a"], ["a.json", "--frobnicate"], []):
            self.assert_fails(
                2, "runn", *options, says=("error: there is no command 'runn'", "did you mean run?")
            )
        self.assert_fails(2, "--discs", 4, says="there is no option --discs")

    def test_invalid_slurm_options_create_no_folder(self):
        call = ["sweep", "--discs", 5, "--slurm", "--out"]
        self.assert_fails(2, *call, self.path("s"), "--time", "2 hours", says="--time is '2 hours'")
        self.assert_fails(2, *call, self.path('a"b'), says="must not contain quotation marks")
        self.assertEqual(self.left_behind(), [])

    def test_a_folder_instead_of_a_file(self):
        self.assert_fails(
            2,
            "measure",
            self.folder,
            says="is a folder, but FILE must be a recording.\nhint: give a trajectory",
        )
        for call in (["verify"], ["export", "--format", "xyz"], ["movie"], ["run"]):
            done = self.assert_fails(1, call[0], self.folder, *call[1:])
            self.assertEqual(
                done.stderr, f"error: '{self.folder}' is a folder, but a file is needed.\n"
            )

    def test_a_file_instead_of_a_folder(self):
        with open(self.path("file"), "w"):
            pass
        for call in (
            ["sweep", "--discs", "2:3"],
            ["map", "--x", "mu=0:1"],
            ["paper", "--figure", "1c"],
        ):
            done = self.assert_fails(1, *call, "--out", self.path("file"))
            self.assertEqual(
                done.stderr, f"error: '{self.path('file')}' is a file, but it must be a folder.\n"
            )

    def test_a_missing_recording(self):
        for call in (["measure"], ["export", "--format", "xyz"], ["movie", "--out", "x.mp4"]):
            done = self.assert_fails(1, call[0], self.path("missing.h5"), *call[1:])
            self.assertEqual(done.stderr, f"error: '{self.path('missing.h5')}' does not exist.\n")

    def test_another_kind_of_file_is_not_asked_for_its_calibration(self):
        write_text(self.path("notes.txt"), "hello\n")
        for call in (["measure"], ["movie", "--out", "x.mp4"]):
            self.assert_fails(
                1,
                call[0],
                self.path("notes.txt"),
                *call[1:],
                says="the header must name the columns frame, particle, x and y",
            )

    def test_options_of_tracks_are_rejected_for_a_trajectory(self):
        recording = self.path("t.h5")
        self.assert_works("run", "--events", 500, "--trajectory", recording, "--quiet")
        for name, value in (
            ("scale", 3),
            ("container-radius", 3),
            ("centre", "1,2"),
            ("max-invalid", 0.1),
        ):
            self.assert_fails(
                2,
                "measure",
                recording,
                f"--{name}",
                value,
                says=f"--{name} applies to a camera's tracks, but '{recording}' is a trajectory",
            )

    def test_a_configuration_that_does_not_exist(self):
        for command, example in (
            ("paper", "--figure 5b"),
            ("crossing", "--mu 0.5"),
            ("sweep", "--discs 48"),
        ):
            done = self.assert_fails(
                2, command, "5b", *(["--out", self.path("s")] if command == "sweep" else [])
            )
            self.assertEqual(
                done.stderr,
                "error: the configuration file '5b' does not exist.\n"
                f"hint: options begin with --, as in {example}.\n",
            )

    def test_maps_and_sweeps_do_not_mix(self):
        self.assert_works(
            "sweep", "--discs", "2:3", "--events", 100, "--out", self.path("s"), "--quiet"
        )
        self.assert_fails(
            1,
            "map",
            "--x",
            "mu=0:1",
            "--out",
            self.path("s"),
            says="holds a sweep (see its plan.json).\nhint: choose another folder.\n",
        )

    def test_every_error_ends_with_a_full_stop(self):
        done = self.assert_fails(1, "track", self.path("nowhere.mp4"), "--out", self.path("t.csv"))
        self.assertRegex(done.stderr, r"\Aerror: there is no video '[^\n]*'\.\n\Z")

    def test_tracks_truncated_within_a_number(self):
        for name, whole in (
            ("a.csv", "frame,particle,x,y\n0,0,1,2.5\n1,0,1,2.75\n"),
            (
                "a.dump",
                "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id x y\n0 1 2.75\n",
            ),
        ):
            for cut in (1, 2):
                write_text(self.path(name), whole[:-cut])
                self.assert_fails(
                    1,
                    "measure",
                    self.path(name),
                    "--omega",
                    1,
                    "--container-radius",
                    10,
                    says="the file may be truncated here",
                )

    def test_a_seed_too_large_for_a_toml_integer(self):
        seed = "18446744073709551615"
        plan = swirl("run", "--events", 100, "--seed", seed, "--dry-run")
        self.assertIn(f'seed = "{seed}"', plan.stdout)
        write_text(self.path("a.toml"), plan.stdout)
        done = self.assert_works("run", self.path("a.toml"), "--json", "-", "--quiet")
        self.assertEqual(json.loads(done.stdout)["config"]["seed"], int(seed))

    def test_dry_run_prints_file_names_that_read_back(self):
        names = [
            "a\nb.json",
            'a"b\\c.json',
            "a\x01\x1f\x7f\tb\r.json",
            "ä '#= [].json",
            "007",
            "1e5",
            "0x10",
            ".5",
            "+5",
            "inf",
            "nan",
            "1_0",
            "true",
            "5",
        ]
        for name in names:
            with self.subTest(name):
                plan = swirl(
                    "run",
                    "--json",
                    name,
                    "--trajectory",
                    f"t-{name}.h5",
                    "--dry-run",
                    cwd=self.folder,
                )
                self.assertEqual(plan.returncode, 0, plan.stderr)
                found = tomllib.loads(plan.stdout)
                self.assertEqual((str(found["json"]), found["trajectory"]), (name, f"t-{name}.h5"))
                write_text(self.path("a.toml"), plan.stdout)
                self.assertEqual(
                    swirl("run", "a.toml", "--dry-run", cwd=self.folder).stdout, plan.stdout
                )

    def test_runs_of_different_versions_are_reported(self):
        self.assert_works(
            "sweep", "--discs", "2,3", "--events", 2000, "--out", self.path("s"), "--quiet"
        )
        self.assertNotIn("versions", swirl("collect", self.path("s")).stderr)
        result = self.path("s/results/000000.json")
        changed = read_json(result)
        changed["version"] = "0.0.1"
        write_text(result, json.dumps(changed))
        self.assertIn(
            "made by different versions of swirl (0.0.1, ", swirl("collect", self.path("s")).stderr
        )

    def test_export_of_missing_frames(self):
        recording = self.path("t.h5")
        self.assert_works(
            "run", "--events", 500, "--trajectory", recording, "--frame-events", 50, "--quiet"
        )
        call = ["export", recording, "--format", "xyz"]
        for text in ("10:", "12:15", "3:10", ":99"):
            self.assert_fails(
                2,
                *call,
                "--range",
                text,
                says=f"--range is '{text}', but the last frame of '{recording}' is 9",
            )
        for text in ("3", "x:5", "1:-2", "1.5:"):
            self.assert_fails(
                2, *call, "--range", text, says=f"--range is '{text}', but it must be FIRST:LAST"
            )
        self.assert_fails(
            2, *call, "--stride", "0", says="--stride is '0', but it must be a whole number"
        )
        self.assertEqual(self.left_behind(), ["t.h5"])
        for text, frames in (("3:9", 7), ("9:", 1), (":", 10)):
            self.assertIn(
                f"{frames} frame{'' if frames == 1 else 's'} of",
                swirl(*call, "--range", text).stdout,
            )


class UnwritableOutput(InFolder):
    def test_a_folder_without_permission(self):
        if os.geteuid() == 0:
            folder = "/proc"
        else:
            os.chmod(self.folder, 0o500)
            folder = self.folder
        self.assert_fails(1, "run", "--events", 10, "--json", folder + "/x.json", says="x.json")

    def test_full_disk_for_stdout(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run(
                [SWIRL, "run", "--events", "100"],
                stdout=full,
                stderr=subprocess.PIPE,
                text=True,
                timeout=HANG,
            )
        self.assertEqual(done.returncode, 1)
        self.assertIn("No space left", done.stderr)

    def test_a_closed_stdout(self):
        for call in (
            ["run", "--events", "100", "--quiet", "--json", "-"],
            ["run", "--events", "100"],
            ["--version"],
            ["run", "--help"],
        ):
            done = subprocess.run(
                ["sh", "-c", 'exec "$0" "$@" >&-', SWIRL, *call],
                capture_output=True,
                text=True,
                timeout=HANG,
            )
            self.assertEqual(done.returncode, 1, call)
            self.assertRegex(done.stderr, r"error: writing to standard output failed: [^\n]+\.\n\Z")

    def test_a_file_that_may_not_grow(self):
        def tiny_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (200, 200))

        write_text(self.path("x.json"), "what was there before")
        self.assert_fails(
            1,
            "run",
            "--events",
            10,
            "--json",
            self.path("x.json"),
            preexec_fn=tiny_files,
            says="x.json",
        )
        self.assertEqual(self.left_behind(), ["x.json"])
        self.assertEqual(read_text(self.path("x.json")), "what was there before")

    def test_a_full_disk(self):
        script = (
            'mount -t tmpfs -o size=4k swirl "$1" && cd "$1" && '
            'head -c 4096 /dev/zero >filled; "$2" run --events 10 --quiet --json x.json; '
            'echo "code $?"; ls'
        )
        done = subprocess.run(
            [
                "unshare",
                "--map-root-user",
                "--mount",
                "sh",
                "-c",
                script,
                "sh",
                self.folder,
                os.path.abspath(SWIRL),
            ],
            capture_output=True,
            text=True,
            timeout=HANG,
        )
        if "code" not in done.stdout:
            self.skipTest("no small disk can be mounted here: " + done.stderr)
        self.assertIn("code 1", done.stdout)
        self.assertIn("No space left", done.stderr)
        self.assertNotIn("x.json", done.stdout)


if __name__ == "__main__":
    unittest.main()
