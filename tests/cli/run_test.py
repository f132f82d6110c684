"""swirl run: its report, its JSON, and how it stops."""

import json
import math
import os
import re
import signal
import subprocess
import unittest

from program import (
    HANG,
    SWIRL,
    InFolder,
    ProgramTest,
    other_user,
    read_json,
    result_of,
    swirl,
    worked,
    write_text,
)


class Json(InFolder):
    def test_json_has_all_documented_keys(self):
        result = result_of("--discs", 12, "--events", 20000)
        for key in (
            "config",
            "events",
            "periods",
            "rotation",
            "max_overlap",
            "energy",
            "state_hash",
            "seconds",
            "events_per_second",
            "version",
            "complete",
            "warmup",
        ):
            self.assertIn(key, result)
        self.assertEqual(
            set(result["events"]),
            {"total", "disc_disc", "disc_wall", "path_vertex", "elastic_by_tc_model"},
        )
        for average in ("mean_by_event", "mean_by_time", "rigid_by_event", "rigid_by_time"):
            self.assertTrue(math.isfinite(result["rotation"][average]["mean"]))
            self.assertGreater(result["rotation"][average]["error"], 0)

    def test_event_counts_add_up_to_the_requested_length(self):
        events = result_of("--discs", 20, "--events", 12345)["events"]
        self.assertEqual(events["total"], 12345)
        self.assertEqual(events["disc_disc"] + events["disc_wall"] + events["path_vertex"], 12345)
        result = result_of("--discs", 20, "--periods", 30)
        self.assertEqual(result["periods"], 30)
        self.assertEqual(result["events"]["path_vertex"], 900)

    def test_file_and_stdout_hold_the_same_json(self):
        file = self.path("result.json")
        done = self.assert_works("run", "--discs", 8, "--events", 5000, "--json", file)
        self.assertIn("8 discs", done.stdout)
        from_file = read_json(file)
        from_stdout = result_of("--discs", 8, "--events", 5000)
        for changing_key in ("seconds", "events_per_second", "command"):
            del from_file[changing_key], from_stdout[changing_key]
        self.assertEqual(from_file, from_stdout)
        self.assertEqual(self.left_behind(), ["result.json"])

    def test_json_is_written_through_a_link_and_to_a_device(self):
        os.symlink(self.path("real.json"), self.path("link.json"))
        open(self.path("real.json"), "w").close()
        swirl("run", "--events", 10, "--json", self.path("link.json"))
        self.assertTrue(os.path.islink(self.path("link.json")))
        read_json(self.path("real.json"))
        done = swirl("run", "--events", 10, "--quiet", "--json", "/dev/stdout")
        self.assertEqual(json.loads(done.stdout)["events"]["total"], 10)

    def test_json_is_written_to_a_pipe_and_through_a_link_from_a_folder_that_is_locked(self):
        user = other_user(SWIRL)
        locked, open_folder = self.path("locked"), self.path("open")
        os.mkdir(locked)
        os.mkdir(open_folder)
        os.mkfifo(os.path.join(locked, "pipe"))
        write_text(os.path.join(open_folder, "result.json"), "")
        os.chmod(os.path.join(open_folder, "result.json"), 0o666)
        os.symlink(os.path.join(open_folder, "result.json"), os.path.join(locked, "link.json"))
        os.chmod(self.folder, 0o755)
        os.chmod(os.path.join(locked, "pipe"), 0o666)
        os.chmod(open_folder, 0o777)
        os.chmod(locked, 0o555)
        self.addCleanup(os.chmod, locked, 0o755)
        reader = subprocess.Popen(
            ["cat", os.path.join(locked, "pipe")], stdout=subprocess.PIPE, text=True
        )
        done = swirl(
            "run", "--events", 10, "--quiet", "--json", os.path.join(locked, "pipe"), **user
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(reader.communicate(timeout=HANG)[0])["events"]["total"], 10)
        done = swirl("run", "--events", 10, "--json", os.path.join(locked, "link.json"), **user)
        self.assertEqual(done.returncode, 0, done.stderr)
        read_json(os.path.join(open_folder, "result.json"))
        self.assert_fails(
            1,
            "run",
            "--events",
            10,
            "--json",
            os.path.join(locked, "new.json"),
            says="cannot be written: Permission denied",
            **user,
        )

    def test_json_to_stdout_moves_the_report_to_stderr(self):
        done = swirl("run", "--events", 1000, "--json", "-")
        json.loads(done.stdout)
        self.assertIn("48 discs", done.stderr)


class Trajectory(unittest.TestCase):
    def test_the_warmup_does_not_change_the_trajectory(self):
        hashes = {
            result_of("--periods", 8, "--warmup", warmup)["state_hash"] for warmup in (0, 1, 7)
        }
        self.assertEqual(len(hashes), 1)

    def test_warmup_zero_counts_from_the_first_event(self):
        result = result_of("--periods", 6, "--warmup", 0)
        self.assertEqual(result["warmup"], {"periods": 0, "events": 0})
        self.assertEqual(result["rotation"]["mean_by_event"]["blocks"], 6)

    def test_default_warmup_is_twenty_periods_or_a_fifth(self):
        self.assertEqual(result_of("--discs", 5, "--periods", 200)["warmup"]["periods"], 20)
        self.assertEqual(result_of("--discs", 5, "--periods", 50)["warmup"]["periods"], 10)


class InitialState(InFolder):
    def test_a_run_from_a_file_is_verified_without_it(self):
        start = self.path("start.csv")
        write_text(start, "x,y,vx,vy,spin\n2,0,0,1,0\n2,3,0,0,-1\n")
        for output in (
            ["--json", self.path("r.json"), "--trajectory", self.path("t.h5")],
            ["--checkpoint", self.path("c"), "--keep-checkpoint"],
        ):
            self.assert_works(
                "run", "--initial", start, "--periods", 20, "--warmup", 2, "--quiet", *output
            )
        write_text(self.path("a.toml"), f'initial = "{start}"\nperiods = 20\nwarmup = 2\n')
        by_file = result_of(self.path("a.toml"))
        os.unlink(start)
        for name in ("r.json", "t.h5"):
            self.assertIn("bitwise identical", swirl("verify", self.path(name)).stdout)
        self.assertEqual(read_json(self.path("r.json"))["state_hash"], by_file["state_hash"])
        longer = swirl(
            "run",
            "--checkpoint",
            self.path("c"),
            "--resume",
            "--periods",
            30,
            "--json",
            "-",
            "--quiet",
        )
        self.assertEqual(json.loads(longer.stdout)["config"]["discs"], 2, longer.stderr)


class Report(ProgramTest):
    def test_headline_gives_the_direction_of_rotation(self):
        self.assertIn(
            "28 discs rotate with the swirl: ϖ/Ω = 0.0",
            swirl("run", "--discs", 28, "--events", 1e5).stdout,
        )
        self.assertIn(
            "48 discs rotate against the swirl (counterrotation): ϖ/Ω = −0.0",
            swirl("run", "--discs", 48, "--events", 1e5).stdout,
        )

    def test_one_disc_has_no_rotation(self):
        done = self.assert_works("run", "--discs", 1, "--events", 1000)
        self.assertIn("no rotation about its own centre", done.stdout)

    def test_without_a_whole_period_there_are_no_averages(self):
        done = swirl("run", "--events", 300)
        self.assertIn("48 discs completed no whole period, so there are no averages.", done.stdout)
        self.assertIn("hint: use more --events", done.stderr)
        self.assertNotIn("ϖ/Ω", done.stdout)
        result = result_of("--events", 300, "--measure", "slip")
        for estimator in result["rotation"].values():
            self.assertEqual(
                (estimator["mean"], estimator["error"], estimator["blocks"]), (None, None, 0)
            )
        self.assertIsNone(result["measured"]["slip"]["cluster"]["mean"])
        self.assertIn("averages are over whole periods", " ".join(result["warnings"]))

    def test_energy_growth_on_the_frictionless_polygon_is_a_warning(self):
        arguments = ("--mu", 0, "--discs", 12, "--periods", 40)
        errors = swirl("run", *arguments).stderr
        self.assertIn("grows without bound on the polygon", errors)
        result = result_of(*arguments)
        self.assertGreater(result["energy"], 5 * result["energy_at_start"])
        self.assertIn(f"{result['energy']:.4g}", errors)

    def test_the_report_has_four_lines_and_more_with_verbose(self):
        call = ("run", "--discs", 48, "--events", 20000)
        short, full = (
            swirl(*call).stdout.splitlines(),
            swirl(*call, "--verbose").stdout.splitlines(),
        )
        self.assertEqual([line.split()[0] for line in short], ["48", "average", "steady", "repeat"])
        self.assertEqual(
            [line.split()[0] for line in full if line not in short],
            ["by", "by", "errors", "events", "periods", "energy", "overlap", "time"],
        )

    def test_the_report_has_one_rate_and_another_only_if_it_differs(self):
        # Near N_c the rates differ by 0.004; the errors of 1200 periods are 0.0005.
        for discs, periods, expected in ((48, 100, 1), (38, 1200, 2)):
            out = swirl("run", "--discs", discs, "--periods", periods).stdout
            self.assertEqual(out.count("ϖ/Ω"), expected, out)
        self.assertRegex(
            out,
            r"(?m)^  rigid body  ϖ/Ω = −0\.\d+ ± 0\.\d+, another rate than the mean over the discs "
            r"above$",
        )

    def test_errors_of_few_periods_are_those_of_the_json(self):
        done = swirl(
            "run", "--discs", 28, "--periods", 9, "--warmup", 5, "--measure", "slip", "--json", "-"
        )
        result = json.loads(done.stdout)
        for name, estimate in (
            ("ϖ/Ω =", result["rotation"]["mean_by_time"]),
            ("slip.cluster", result["measured"]["slip"]["cluster"]),
        ):
            self.assertEqual(estimate["blocks"], 4)
            printed = float(re.search(rf"{name}[^±]+± ([\d.]+)", done.stderr)[1])
            # The report rounds to one digit: 0.0195 to 0.025 are 0.02.
            self.assertAlmostEqual(printed / estimate["error"], 1.0, delta=0.25)
        self.assertNotIn("±", swirl("run", "--discs", 28, "--periods", 8, "--warmup", 5).stdout)

    def test_numbers_and_nouns_agree(self):
        self.assertIn(
            "  4 periods after a warm-up of 1\n",
            swirl("run", "--discs", 5, "--periods", 5, "--warmup", 1).stdout,
        )
        self.assertIn(
            "1 period, no warm-up\n",
            swirl("run", "--discs", 5, "--periods", 1, "--warmup", 0).stdout,
        )

    def test_a_measurement_without_values_is_one_line(self):
        out = swirl(
            "run", "--discs", 5, "--events", 20000, "--measure", "rolling,slip,centre,collisions"
        ).stdout
        self.assertRegex(out, r"(?m)^  rolling +n/a$")
        self.assertNotIn("rolling.", out)
        self.assertIn("slip.cluster", out)
        self.assertNotIn("n/a ", out)

    def test_quiet_prints_one_line_and_all_warnings(self):
        done = swirl("run", "--events", 1000, "--quiet")
        self.assertEqual(done.stdout.count("\n"), 1)
        self.assertRegex(
            done.stderr, r"\Awarning: the run covers 0\.25 periods[^\n]+\nhint: [^\n]+\n\Z"
        )
        self.assertIn(
            "warning: without friction, the energy grows without bound",
            swirl("run", "--mu", 0, "--events", 100000, "--quiet").stderr,
        )
        self.assertEqual(swirl("run", "--discs", 28, "--periods", 120, "--quiet").stderr, "")

    def test_a_log_file_gets_no_progress_bar(self):
        quiet = swirl("run", "--events", 50000, "--json", "-", "--quiet").stderr
        self.assertRegex(quiet, r"\Awarning: steady state not verified[^\n]+\n\Z")
        self.assertNotIn("\r", swirl("run", "--events", 50000).stderr)


class Stopping(InFolder):
    def start(self, *arguments):
        process = subprocess.Popen(
            [SWIRL, "run", "--events", "1e14", *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.assertTrue(worked(process, 0.5))
        return process

    def test_a_signal_ends_the_run_with_a_partial_result(self):
        for how in (signal.SIGINT, signal.SIGTERM):
            process = self.start("--json", self.path(how.name))
            process.send_signal(how)
            _, errors = process.communicate(timeout=HANG)
            self.assertEqual(process.returncode, 130)
            self.assertIn("warning: incomplete", errors)
            self.assertIn("error: stopped before the end", errors)
            result = read_json(self.path(how.name))
            self.assertFalse(result["complete"])
            self.assertGreater(result["events"]["total"], 0)
            self.assertLessEqual({how.name, how.name + ".checkpoint"}, set(self.left_behind()))
        self.assertEqual(len(self.left_behind()), 4)


if __name__ == "__main__":
    unittest.main()
