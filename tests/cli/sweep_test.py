"""Sweeps: complete whatever happens to them, and the same table whoever did the work."""

import json
import os
import random
import resource
import shutil
import subprocess
import time
import unittest

from program import SWIRL, InFolder, swirl

PLAN = ["sweep", "--discs", "5:12", "--mu", "0.5,1", "--seeds", "3", "--events", "20000", "--quiet"]
POINTS = 48


class Sweep(InFolder):
    in_memory = True

    def table(self, folder):
        done = swirl("collect", folder, "--csv", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def whole(self):
        done = swirl(*PLAN, "--out", self.path("whole"))
        self.assertEqual(done.returncode, 0, done.stderr)
        table = self.table(self.path("whole"))
        self.assertEqual(len(table.splitlines()), 17)
        self.assertEqual(len(os.listdir(self.path("whole/results"))), POINTS)
        return table

    def test_threads_parts_and_order_do_not_show_in_the_table(self):
        table = self.whole()
        self.assertEqual(swirl(*PLAN, "--out", self.path("a"), "--threads", 1).returncode, 0)
        self.assertEqual(self.table(self.path("a")), table)
        for part in (3, 1, 2):
            done = swirl(*PLAN, "--out", self.path("b"), "--part", f"{part}/3")
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.table(self.path("b")), table)

    def test_a_plan_says_the_same_as_options(self):
        table = self.whole()
        with open(self.path("plan.toml"), "w") as plan:
            plan.write('discs = "5:12"\nmu = [0.5, 1]\nseeds = 3\nevents = 20000\n')
        self.assertEqual(swirl("sweep", self.path("plan.toml"), "--out", self.path("a"),
                               "--quiet").returncode, 0)
        self.assertEqual(self.table(self.path("a")), table)

    def test_killed_at_fifty_random_moments_and_started_again_it_does_what_is_missing(self):
        begin = time.monotonic()
        table = self.whole()
        # From before it has begun to when it is nearly done, however fast the machine is.
        longest = 0.5 * (time.monotonic() - begin)
        choose = random.Random(5)
        hits, folders = 0, []
        while hits < 50:
            folder = self.path(f"killed{len(folders)}")
            folders.append(folder)
            for _ in range(1000):
                process = subprocess.Popen([SWIRL, *PLAN, "--out", folder],
                                           stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                try:
                    complaint = process.communicate(
                        timeout=choose.uniform(0.001, longest) if hits < 50 else 100)[1]
                    break
                except subprocess.TimeoutExpired:
                    process.kill()
                    process.communicate()
                    hits += 1
                if os.path.isdir(folder + "/results"):
                    for name in os.listdir(folder + "/results"):
                        if name.endswith(".json"):
                            with open(f"{folder}/results/{name}") as result:
                                json.load(result)
            self.assertEqual(process.returncode, 0, complaint)
            self.assertEqual(len(os.listdir(folder + "/results")), POINTS)  # no leftovers
            self.assertEqual([n for n in os.listdir(folder) if n.endswith(".partial")], [])
            self.assertEqual(self.table(folder), table)

    def test_what_a_kill_left_of_the_plan_is_removed(self):
        folder = self.path("killed")
        os.mkdir(folder)
        left = folder + "/plan.json.0123456789abcdef.partial"
        with open(left, "w") as opened:
            opened.write("{")
        self.assertEqual(swirl(*PLAN, "--out", folder).returncode, 0)
        self.assertFalse(os.path.exists(left))

    def test_measurements_and_recordings_come_along(self):
        plan = ["sweep", "--discs", "8,20", "--seeds", "2", "--events", "20000", "--measure",
                "slip,radial", "--frames", "4", "--quiet", "--out", self.path("a")]
        self.assertEqual(swirl(*plan).returncode, 0)
        with open(self.path("a/results/000003.json")) as opened:
            result = json.load(opened)
        self.assertEqual(result["generator"], "SplitMix64")
        # The command in a result is that of the result.
        alone = swirl(*result["command"].split()[1:], "--json", "-", "--quiet")
        self.assertEqual(alone.returncode, 0, alone.stderr)
        alone = json.loads(alone.stdout)
        for part in ("state_hash", "rotation", "measured", "config"):
            self.assertEqual(alone[part], result[part])
        rows = [line.split(",") for line in self.table(self.path("a")).splitlines()]
        column = rows[0].index("slip.cluster")
        self.assertEqual(rows[0][column + 1], "slip.cluster_error")
        slips = []
        for point in (2, 3):
            with open(self.path(f"a/results/{point:06}.json")) as opened:
                slips.append(json.load(opened)["measured"]["slip"]["cluster"])
        means, errors = ([slip[name] for slip in slips] for name in ("mean", "error"))
        self.assertAlmostEqual(float(rows[2][column]), sum(means) / 2, delta=1e-12)
        # Never less than the blocks of the runs say, nor than the runs do between them; Student's
        # factor for the few blocks that there are is below 2 as long as the two agree.
        least = max(abs(means[0] - means[1]) / 2, (errors[0]**2 + errors[1]**2)**0.5 / 2)
        self.assertGreaterEqual(float(rows[2][column + 1]), least)
        self.assertLess(float(rows[2][column + 1]), 2 * least)
        self.assertIn(rows[2][rows[0].index("steady_state")],
                      ("steady", "drifting", "too short to tell"))
        float(rows[2][rows[0].index("scatter")])
        self.assertEqual(sorted(os.listdir(self.path("a/trajectories"))),
                         [f"{point:06}.h5" for point in range(4)])
        done = swirl("verify", self.path("a/trajectories/000003.h5"))
        self.assertEqual(done.returncode, 0, done.stderr)
        # The folder knows what its plan asks for.
        os.remove(self.path("a/results/000003.json"))
        self.assertEqual(swirl("sweep", "--out", self.path("a"), "--quiet").returncode, 0)
        self.assertEqual([line.split(",") for line in self.table(self.path("a")).splitlines()], rows)
        done = swirl(*[word.replace("slip,radial", "slip") for word in plan])
        self.assertEqual(done.returncode, 1)
        self.assertIn("holds another sweep", done.stderr)

    def test_two_at_once_on_one_folder(self):
        table = self.whole()
        both = [subprocess.Popen([SWIRL, *PLAN, "--out", self.path("a")],
                                 stderr=subprocess.PIPE, text=True) for _ in range(2)]
        for process in both:
            complaint = process.communicate(timeout=100)[1]
            self.assertEqual(process.returncode, 0, complaint)
        self.assertEqual(self.table(self.path("a")), table)

    def test_what_runs_is_seen_left_alone_by_others_and_free_after_a_kill(self):
        def status():
            return swirl("sweep", "--out", self.path("a"), "--status").stdout

        process = subprocess.Popen([SWIRL, "sweep", "--discs", "5:8", "--events", "1e12", "--threads",
                                    "3", "--quiet", "--out", self.path("a")])
        try:
            for _ in range(1000):
                if os.path.exists(self.path("a/plan.json")) and "3 running" in status():
                    break
                time.sleep(0.01)
            self.assertEqual(status(), "0 of 4 runs done, 3 running, 0 failed, 1 to do\n")
            # Somebody else takes what is free, and nothing else.
            other = subprocess.Popen([SWIRL, "sweep", "--quiet", "--out", self.path("a")])
            for _ in range(1000):
                if "4 running" in status():
                    break
                time.sleep(0.01)
            self.assertIn("4 running", status())
            other.kill()
            other.wait()
            self.assertIn("3 running", status())
        finally:
            process.kill()
            process.wait()
        self.assertEqual(status(), "0 of 4 runs done, 0 running, 0 failed, 4 to do\n")

    def test_a_run_that_fails_does_not_stop_the_rest(self):
        done = swirl("sweep", "--discs", "5,60,6", "--events", 1000, "--out", self.path("a"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("point 1: 60 discs", done.stderr)
        self.assertIn("2 of 3 runs done, 0 running, 1 failed",
                      swirl("sweep", "--out", self.path("a"), "--status").stdout)
        self.assertEqual(len(self.table(self.path("a")).splitlines()), 3)

    def test_a_run_without_a_whole_swirl_has_an_empty_row(self):
        done = swirl("sweep", "--discs", "5,48", "--events", 2000, "--measure", "slip", "--out",
                     self.path("a"), "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        collected = swirl("collect", self.path("a"), "--csv", "-")
        self.assertIn("1 of the runs made no whole swirl", collected.stderr)
        header, five, many = [line.split(",") for line in collected.stdout.splitlines()]
        for name in ("by_event", "by_event_error", "by_time", "rigid_by_time", "slip.cluster"):
            self.assertNotEqual(five[header.index(name)], "")
            self.assertEqual(many[header.index(name)], "")
        self.assertNotEqual(many[header.index("energy")], "")

    def test_no_two_columns_have_one_name(self):
        for length, others in ((("--events", 2000), ["mu", "events"]), (("--periods", 3), ["mu", "periods"])):
            folder = self.path(length[0][2:])
            self.assertEqual(swirl("sweep", "--discs", "5,6", "--mu", 1, *length, "--measure", "slip", "--out",
                                   folder, "--quiet").returncode, 0)
            header, *rows = [line.split(",") for line in self.table(folder).splitlines()]
            self.assertEqual(len(set(header)), len(header), header)
            self.assertEqual(header[1:3], others)
            for row in rows:
                self.assertEqual(len(row), len(header))
                self.assertGreaterEqual(float(row[header.index("periods")]), 3)

    def test_a_sweep_grows_and_keeps_what_is_done(self):
        table = self.whole()
        small = ["sweep", "--discs", "5,7:9", "--mu", "1", "--seeds", "1", "--events", "20000",
                 "--quiet", "--out", self.path("a")]
        self.assertEqual(swirl(*small).returncode, 0)
        refused = swirl("sweep", "--discs", "5:12", "--out", self.path("a"))
        self.assertEqual(refused.returncode, 1)
        self.assertIn("--grow", refused.stderr)

        def results():
            folder = self.path("a/results")
            return {name: os.stat(os.path.join(folder, name)).st_mtime_ns
                    for name in os.listdir(folder)}

        def grow(*more):
            before = results()
            done = swirl("sweep", "--out", self.path("a"), "--grow", *more, "--quiet")
            self.assertEqual(done.returncode, 0, done.stderr)
            after = results()
            # Nothing that was done is touched.
            self.assertEqual({name: after[name] for name in before}, before)
            return len(after) - len(before)

        self.assertEqual(grow("--discs", "6"), 1)
        self.assertEqual(grow("--discs", "6"), 0)
        self.assertEqual(grow("--mu", "0.5", "--seeds", 2), 15)
        self.assertEqual(grow("--discs", "10:12", "--seeds", 3), 28)
        # The same table, byte for byte, as if it had been asked for at once.
        self.assertEqual(self.table(self.path("a")), table)
        # A call without anything but the folder goes on with the grown one.
        os.remove(self.path("a/results/000040.json"))
        self.assertEqual(swirl("sweep", "--out", self.path("a"), "--quiet").returncode, 0)
        self.assertEqual(self.table(self.path("a")), table)
        for wrong, says in ((["--restitution", "0.9"], "no parameter of this sweep"),
                            (["--seeds", 1], "can only grow"), (["--frames", 3], "--frames"),
                            (["--discs", "5.0"], "the same run"), (["--sieze", "3"], "--sieze")):
            done = swirl("sweep", "--out", self.path("a"), "--grow", *wrong)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(says, done.stderr)
        self.assertEqual(self.table(self.path("a")), table)

    def test_further_measurements_are_made_in_runs_of_the_same_bits(self):
        plan = ["sweep", "--discs", "8,20", "--events", "20000", "--quiet", "--out", self.path("a")]
        self.assertEqual(swirl(*plan, "--measure", "slip").returncode, 0)
        before = [line.split(",") for line in self.table(self.path("a")).splitlines()]
        done = swirl("sweep", "--out", self.path("a"), "--grow", "--measure", "radial,temperature",
                     "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        after = [line.split(",") for line in self.table(self.path("a")).splitlines()]
        self.assertIn("temperature.granular", after[0])
        for old, new in zip(before, after, strict=True):
            for name, value in zip(before[0], old):
                self.assertEqual(new[after[0].index(name)], value)
        self.assertEqual(sorted(os.listdir(self.path("a/results"))), ["000000.json", "000001.json"])
        # And on to more discs, with all of it.
        self.assertEqual(swirl("sweep", "--out", self.path("a"), "--grow", "--discs", 12,
                               "--quiet").returncode, 0)
        grown = self.table(self.path("a")).splitlines()
        self.assertEqual([grown[1], grown[3]], [",".join(row) for row in after[1:]])

    def test_a_plan_that_shrank_is_damaged(self):
        self.assertEqual(swirl("sweep", "--discs", "5", "--events", 3000, "--out", self.path("a"),
                               "--quiet").returncode, 0)
        self.assertEqual(swirl("sweep", "--out", self.path("a"), "--grow", "--discs", 6,
                               "--quiet").returncode, 0)
        with open(self.path("a/plan.json")) as opened:
            plan = json.load(opened)
        for before in ([{"values": [3, 1], "replicas": 1}], [{"values": [1, 1], "replicas": 2}],
                       [{"values": [1], "replicas": 1}], [{"values": [0, 1], "replicas": 1}]):
            with open(self.path("a/plan.json"), "w") as opened:
                json.dump({**plan, "before": before}, opened)
            done = swirl("collect", self.path("a"))
            self.assertEqual(done.returncode, 1)
            self.assertIn("before it grew", done.stderr)

    def test_crossings_of_a_collected_sweep(self):
        # Long runs cross between 37 and 39 at mu = 1, and nowhere without friction at the wall.
        done = swirl("sweep", "--discs", "30:2:46", "--mu-wall", "0,1", "--mu-disc", 1, "--events",
                     "1e5", "--seeds", 2, "--out", self.path("a"), "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = swirl("collect", self.path("a"), "--crossings", self.path("N_c.csv"))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("N_c.csv")) as opened:
            header, smooth, rough = [line.rstrip("\n").split(",") for line in opened]
        self.assertEqual(header[:3], ["mu_disc", "mu_wall", "events"])
        self.assertEqual(smooth[header.index("verdict")], "always rotates")
        self.assertEqual(smooth[header.index("N_c")], "")
        self.assertEqual(rough[header.index("verdict")], "crosses")
        self.assertEqual(rough[header.index("points")], "9")
        # Between even numbers there is a bracket, not an estimate.
        self.assertEqual(rough[header.index("N_c")], "")
        lower, upper = (float(rough[header.index(name)]) for name in ("N_c_lower", "N_c_upper"))
        self.assertEqual((lower % 2, upper % 2), (0, 0))
        self.assertTrue(34 <= lower < upper <= 42, (lower, upper))
        done = swirl("sweep", "--out", self.path("a"), "--grow", "--discs", "35:2:41", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = swirl("collect", self.path("a"), "--crossings", self.path("N_c.csv"))
        with open(self.path("N_c.csv")) as opened:
            header, _, rough = [line.rstrip("\n").split(",") for line in opened]
        numbers = {name: float(rough[header.index(name)])
                   for name in ("N_c", "N_c_by_event", "N_c_by_time", "N_c_rigid_by_event", "N_c_rigid_by_time")}
        self.assertEqual(rough[header.index("rate")], "by_time")
        self.assertEqual(numbers["N_c"], numbers["N_c_by_time"])
        for name, value in numbers.items():
            # The rigid body crosses about one disc earlier.
            self.assertAlmostEqual(value, 37.0 if "rigid" in name else 38.0, delta=2.0, msg=name)
        self.assertEqual(swirl("sweep", "--mu", "0.5,1", "--events", 3000, "--discs", 5, "--out",
                               self.path("b"), "--quiet").returncode, 0)
        os.remove(self.path("N_c.csv"))
        self.assertEqual(swirl("collect", self.path("b"), "--crossings", "-", "--csv", "-").returncode,
                         2)

    def at_once(self, calls):
        """Exit codes and complaints of calls that wait for each other before they begin."""
        gate, opened = os.pipe()
        running = [subprocess.Popen(["sh", "-c", 'read go; exec "$0" "$@"', SWIRL, *call], stdin=gate,
                                    stderr=subprocess.PIPE, text=True) for call in calls]
        os.close(gate)
        time.sleep(0.1)
        os.close(opened)
        errors = [process.communicate(timeout=100)[1] for process in running]
        return [process.returncode for process in running], errors

    def test_of_two_plans_at_once_in_one_new_folder_one_is_refused(self):
        for k in range(8):
            folder = self.path(str(k))
            codes, errors = self.at_once([["sweep", "--discs", discs, "--events", "1000", "--out", folder, "--quiet"]
                                          for discs in ("5", "6")])
            self.assertEqual(sorted(codes), [0, 1], errors)
            self.assertIn("holds another sweep", "".join(errors))
            kept = "56"[codes.index(0)]
            self.assertIn(f"\n{kept},", self.table(folder))

    def test_of_two_calls_that_let_a_sweep_grow_at_once_both_do_or_one_is_told(self):
        self.assertEqual(swirl("sweep", "--discs", "5,6", "--events", "1000", "--out", self.path("first"),
                               "--quiet").returncode, 0)
        for k in range(8):
            folder = shutil.copytree(self.path("first"), self.path(str(k)))
            calls = [["sweep", "--out", folder, "--grow", "--discs", discs, "--quiet"] for discs in ("7", "8")]
            for call, code, error in zip(calls, *self.at_once(calls), strict=True):
                if code:
                    self.assertIn("let the sweep", error)
                    self.assertEqual(swirl(*call).returncode, 0)
            self.assertEqual([row.split(",")[0] for row in self.table(folder).splitlines()[1:]],
                             ["5", "6", "7", "8"])

    def test_another_plan_in_the_same_folder_is_refused(self):
        self.whole()
        done = swirl("sweep", "--discs", "5", "--out", self.path("whole"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("holds another sweep", done.stderr)

    def test_a_result_of_an_older_version_or_damaged_is_named(self):
        self.whole()
        file = self.path("whole/results/000007.json")
        with open(file) as opened:
            result = json.load(opened)
        result["format"] = 0
        with open(file, "w") as opened:
            json.dump(result, opened)
        done = swirl("collect", self.path("whole"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("000007.json' is in format 0", done.stderr)
        with open(file, "w") as opened:
            opened.write('{"format": 1, "rot')
        done = swirl("collect", self.path("whole"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("000007.json' is damaged", done.stderr)

    def test_a_result_of_another_point_and_a_text_for_a_number_are_named(self):
        self.whole()
        results = self.path("whole/results/")

        def refused(says):
            done = swirl("collect", self.path("whole"))
            self.assertEqual(done.returncode, 1)
            self.assertIn(says, done.stderr)

        with open(results + "000007.json") as opened:
            result = json.load(opened)
        shutil.copy(results + "000006.json", results + "000007.json")
        refused("000007.json' is the result of another run than point 7")
        for change, says in (({"point": 7, "config": dict(result["config"], seed=1)}, "another run"),
                             ({"energy": "0.5"}, "a text where a number belongs"),
                             ({"rotation": dict(result["rotation"], by_time="fast")}, "a text where")):
            with open(results + "000007.json", "w") as opened:
                json.dump({**result, **change}, opened)
            refused(says)

    def test_twenty_thousand_short_runs_are_done_counted_and_collected_in_seconds(self):
        # More of them wait for the disk than a process may have files open.
        done = swirl("sweep", "--discs", 2, "--events", 5, "--seeds", 20000, "--out", self.path("a"),
                     "--quiet", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE,
                                                                      (256, 256)))
        self.assertEqual(done.returncode, 0, done.stderr)
        spent = []
        for call in (["sweep", "--out", self.path("a"), "--status"], ["collect", self.path("a")]):
            before = os.times()
            done = swirl(*call)
            after = os.times()
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("20000 of 20000 runs", done.stdout)
            spent.append(after.children_user + after.children_system
                         - before.children_user - before.children_system)
        # Processor time: what else the machine does is not the program's fault. Collecting takes
        # all cores; two of them would share it. Nine tenths of it is reading JSON, 2 kB a result:
        # a tenth of a millisecond each, and half as much again for a slower machine.
        self.assertLess(spent[0], 1)
        self.assertLess(spent[1] / 2, 1.5)


if __name__ == "__main__":
    unittest.main()
