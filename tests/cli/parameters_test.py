"""Every parameter of a run in every place that accepts it, and which place takes precedence. The
list of parameters is the table in docs/reference/parameters.md."""

import functools
import os
import re
import shutil
import signal
import subprocess
import unittest

from program import (
    HANG,
    OPTION_OF_KEY,
    SOURCE,
    SWIRL,
    InFolder,
    help_of,
    read_json,
    read_text,
    result_of,
    swirl,
    worked,
    write_text,
)

# Name, default, and the lower end of the range.
ROW = re.compile(r"^\| `(\w+)` \|[^|]*\| ([^|]*) \| (\S*)", re.MULTILINE)

# Other values for parameters that are no real numbers, and for those without a default.
OTHER = {
    "mu": "0.5",
    "mu_disc": "0.5",
    "mu_wall": "0.5",
    "inertia": "ring",
    "mixture": "2:1.2",
    "speed": "2",
    "motion": "circle",
    "direction": "clockwise",
    "frictionless": "bulk",
    "sizes": "uniform:0.9:1.1",
    "initial": "states 2:0:1:0:0",
    "ramp": "mu=0.5:0.7@2..9",
    "periods": "50",
    "warmup": "2",
    "seed": "7",
    "discs": "12",
    "sides": "12",
    "events": "1e13",
    "preset": "experiment",
    "body": "sphere",
    "floor": "sliding",
    "container_radius": "9",
    "events_per_sample": "7",
    "length_unit": "3mm",
    "time_unit": "22ms",
}
# They only set others, or follow from others.
NOT_WRITTEN = {"mu", "preset", "speed"}


def settings_in(toml):
    """Name to text."""
    return dict(line.split(" = ") for line in toml.splitlines())


ROWS = ROW.findall(read_text(os.path.join(SOURCE, "docs", "reference", "parameters.md")))
DEFAULTS = {name: (default, lowest) for name, default, lowest in ROWS}
# Omega is only written.
GIVEN = {name: "--" + name.replace("_", "-") for name in DEFAULTS if name != "omega"}
PAPER = settings_in(swirl("run", "--dry-run").stdout)


def another(name):
    if name in OTHER:
        return OTHER[name]
    value, lowest = map(float, DEFAULTS[name])
    return repr(lowest + 0.01 if value == lowest else 0.9 * value)


@functools.cache
def needed_by(name):
    """The options without which the parameter is rejected, as the hints tell."""
    if name in ("length_unit", "time_unit"):
        return {"length_unit": ["--time-unit", "22ms"], "time_unit": ["--length-unit", "3mm"]}[name]
    needed = []
    while len(needed) < 6:
        done = swirl("run", GIVEN[name], another(name), *needed, "--dry-run", check=False)
        hint = re.search(r"hint: add (--\S+) (\S+)\.", done.stderr)
        if not hint:
            return needed
        needed += hint.groups()
    raise AssertionError(f"the hints for {GIVEN[name]} do not help: {needed}")


class Everywhere(InFolder):
    def test_the_docs_list_all_parameters(self):
        self.assertGreater(len(GIVEN), 15)
        keys = result_of("--events", 10)["config"]
        self.assertLessEqual({OPTION_OF_KEY.get(key, key) for key in keys}, set(DEFAULTS))

    def test_help(self):
        text = help_of("run")
        for name, option in GIVEN.items():
            self.assertRegex(text, rf"(?m)^  {option} ", name)

    def test_option_file_and_dry_run(self):
        for name, option in GIVEN.items():
            with self.subTest(name):
                by_option = self.assert_works(
                    "run", option, another(name), *needed_by(name), "--dry-run"
                )
                self.assertNotEqual(settings_in(by_option.stdout), PAPER)
                if name not in NOT_WRITTEN:
                    self.assertIn(name, settings_in(by_option.stdout))
                for spelling in (name, name.replace("_", "-")):
                    write_text(self.path("a.toml"), f'{spelling} = "{another(name)}"\n')
                    by_file = swirl("run", self.path("a.toml"), *needed_by(name), "--dry-run")
                    self.assertEqual(by_file.stdout, by_option.stdout, by_file.stderr)
                # The printed configuration gives the same run.
                write_text(self.path("a.toml"), by_option.stdout)
                again = swirl("run", self.path("a.toml"), "--dry-run")
                self.assertEqual(again.stdout, by_option.stdout, again.stderr)
        self.assertEqual(
            swirl("run", "--mu_disc", "0.5", "--dry-run").stdout,
            swirl("run", "--mu-disc=0.5", "--dry-run").stdout,
        )

    def test_identity_of_a_resumed_run(self):
        call = [SWIRL, "run", "--events", "1e14", "--quiet", "--checkpoint", self.path("kept")]
        process = subprocess.Popen(call, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.assertTrue(worked(process, 0.3))
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=HANG), 130)
        for name, option in GIVEN.items():
            with self.subTest(name):
                shutil.copy(self.path("kept"), self.path("copy"))
                # Only the length may differ, and it must not be shorter than the finished part.
                length = name in ("events", "periods")
                value, says = (
                    ((1000 if name == "events" else 1), "to another length")
                    if length
                    else (another(name), "belongs to another run")
                )
                self.assert_fails(
                    2,
                    "run",
                    *([] if length else ["--events", "1e14"]),
                    option,
                    value,
                    *needed_by(name),
                    "--checkpoint",
                    self.path("copy"),
                    "--resume",
                    says=says,
                )


class Precedence(InFolder):
    def on_top_of(self, file, *by_hand):
        """The settings from these options and a file with all parameters."""
        write_text(self.path("a.toml"), swirl("run", *file, "--dry-run").stdout)
        done = self.assert_works("run", self.path("a.toml"), *by_hand, "--dry-run")
        return settings_in(done.stdout)

    def test_an_option_overrides_the_frame_times_of_the_file(self):
        recorded = ["--trajectory", self.path("a.h5"), "--frames-per-period", "8"]
        settings = self.on_top_of(recorded, "--frame-interval", "0.5")
        self.assertEqual(settings["frame_interval"], "0.5")
        self.assertNotIn("frames_per_period", settings)

    def test_a_list_overrides_the_value_of_the_file(self):
        write_text(
            self.path("a.toml"), swirl("run", "--discs", 8, "--events", 2000, "--dry-run").stdout
        )
        self.assert_works(
            "sweep", self.path("a.toml"), "--mu", "0.1,0.5", "--out", self.path("s"), "--quiet"
        )
        table = swirl("collect", self.path("s"), "--csv", "-").stdout.splitlines()
        self.assertEqual(len(table), 3)
        self.assertNotEqual(table[1].split(",")[-1], table[2].split(",")[-1])

    def test_an_axis_without_effect_is_rejected(self):
        self.assert_fails(
            2,
            "sweep",
            "--mu",
            "0.1,0.5",
            "--mu-disc",
            "1",
            "--mu-wall",
            "1",
            "--out",
            self.path("s"),
            says="--mu 0.1 and --mu 0.5 are the same run",
        )
        self.assertEqual(self.left_behind(), [])

    def test_sweep_tables_and_json_have_the_same_names(self):
        self.assert_works(
            "sweep",
            "--mu-disc",
            "0.5",
            "--discs",
            5,
            "--events",
            100,
            "--out",
            self.path("s"),
            "--quiet",
        )
        heads = swirl("collect", self.path("s"), "--csv", "-").stdout.splitlines()[0].split(",")
        self.assertIn("mu_disc", heads)
        self.assertIn("mu_disc", read_json(self.path("s/results/000000.json"))["config"])


if __name__ == "__main__":
    unittest.main()
