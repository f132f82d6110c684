"""Tracks with a known result: a simulated container, sampled as by a camera, and measured."""

import json
import math
import unittest

from program import ONE_ERROR, InFolder, read_json, read_rows, read_text, swirl

DISCS, SWIRLS, FRAMES, SKIP = 24, 40, 511, 10
SCALE, CENTRE = 20.0, (300.0, 280.0)  # pixels
AMPLITUDE, RADIUS, OMEGA = 1.892, 8.6, 11.81
FPS = FRAMES * OMEGA / (2.0 * math.pi)  # of the camera, in 1/s
LIST = "slip,pinned,temperature,flow"


class MeasureTest(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.table = None

    def test_help_needs_no_file(self):
        done = swirl("measure", "--measure", "help")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, swirl("run", "--measure", "help").stdout)
        self.assert_fails(2, "measure", "--measure", "slip", says="missing required argument FILE")

    def answer(self):
        """Results from the engine's own frames, and the positions in disc radii: {frame: {disc: (x,
        y)}}."""
        if MeasureTest.table is None:
            recording = self.path("t.h5")
            self.assert_works(
                "run",
                "--discs",
                DISCS,
                "--periods",
                SWIRLS,
                "--frames-per-period",
                FRAMES,
                "--trajectory",
                recording,
                "--quiet",
            )
            exact = self.assert_works(
                "measure",
                recording,
                "--measure",
                LIST,
                "--warmup",
                SKIP,
                "--json",
                "-",
                "--quiet",
                "--tables",
                self.path("exact"),
            )
            flow = read_text(self.path("exact/flow.csv"))
            said = swirl(
                "export", recording, "--format", "csv", "--scale", 1, "--out", self.path("t.csv")
            ).stdout
            middle = float(said.split("pixel ")[1].split(",")[0])
            table = {}
            with open(self.path("t.csv"), encoding="utf-8") as opened:
                next(opened)
                for line in opened:
                    frame, disc, x, y = line.split(",")
                    table.setdefault(int(frame), {})[int(disc)] = (
                        float(x) - middle,
                        middle - float(y),
                    )
            MeasureTest.table = (json.loads(exact.stdout), flow, table)
        return MeasureTest.table

    def write(self, discs, mirrored=False):
        with open(self.path("tracks.csv"), "w", encoding="utf-8") as opened:
            opened.write("frame,particle,x,y\n")
            for frame, places in discs.items():
                for disc, (x, y) in places.items():
                    px = CENTRE[0] + (-1 if mirrored else 1) * SCALE * x
                    opened.write(f"{frame},{disc},{px!r},{CENTRE[1] - SCALE * y!r}\n")

    def call(self, *more, **changed):
        options = {
            "camera-fps": FPS,
            "scale": SCALE,
            "omega": OMEGA,
            "centre": "%g,%g" % CENTRE,
            "phase": 0,
            "amplitude": AMPLITUDE,
            "container-radius": RADIUS,
            "warmup": SKIP,
            "measure": LIST,
        }
        options.update({name.replace("_", "-"): value for name, value in changed.items()})
        arguments = [word for name, value in options.items() for word in ("--" + name, value)]
        return swirl(
            "measure", self.path("tracks.csv"), *arguments, "--json", "-", "--quiet", *more
        )

    def measured(self, *more, **changed):
        done = self.call(*more, **changed)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def assert_like_the_exact(self, found, tolerance=0.01):
        """The same motion, with velocities from differences of positions: no statistical error."""
        exact = self.answer()[0]
        for name in ("mean_by_time", "rigid_by_time"):
            self.assertAlmostEqual(
                found["rotation"][name]["mean"], exact["rotation"][name]["mean"], delta=tolerance
            )
        for name in ("cluster", "pinned_region", "cluster_perimeter"):
            self.assertAlmostEqual(
                found["measured"]["slip"][name]["mean"] / exact["measured"]["slip"][name]["mean"],
                1.0,
                delta=tolerance,
            )
        for name, delta in (("pinning", 3.0), ("depinning", 3.0)):
            self.assertAlmostEqual(
                found["measured"]["pinned"][name]["mean"],
                exact["measured"]["pinned"][name]["mean"],
                delta=delta,
            )
        # A collision between two frames is averaged: some energy is always lost, never gained.
        share = (
            found["measured"]["temperature"]["granular"]["mean"]
            / exact["measured"]["temperature"]["granular"]["mean"]
        )
        self.assertTrue(0.85 < share < 1.0, share)
        return found

    def test_results_equal_those_of_the_run(self):
        _, flow, table = self.answer()
        self.write(table)
        found = self.assert_like_the_exact(self.measured("--tables", self.path("tables")))
        self.assertEqual(found["camera"]["breaks"], 0)
        self.assertTrue(abs(math.remainder(found["camera"]["fitting_phase"], 360.0)) < 3.0)
        seen = read_text(self.path("tables/flow.csv")).splitlines()
        squares = differences = 0.0
        for line, exact in zip(seen[1:], flow.splitlines()[1:], strict=True):
            if float(exact.split(",")[2]) > 1000:
                for a, b in zip(line.split(",")[3:5], exact.split(",")[3:5]):
                    squares += float(b) ** 2
                    differences += (float(a) - float(b)) ** 2
        self.assertLess(differences, 0.01**2 * squares)

    def test_mirrored_tracks_give_the_same_results(self):
        self.write(self.answer()[2], mirrored=True)
        # In the mirror the container begins left of the swirl centre and moves clockwise.
        found = self.assert_like_the_exact(self.measured("--clockwise", phase=180))
        self.assertAlmostEqual(found["camera"]["fitting_phase"], 180.0, delta=3.0)

    def test_frames_with_negative_numbers_count_like_others(self):
        table = {k: f for k, f in self.answer()[2].items() if k < 6 * FRAMES}
        found = []
        for shift in (0, 3 * FRAMES):  # whole periods
            self.write({k - shift: f for k, f in table.items()})
            found.append(self.measured(measure="density", warmup=1))
        self.assertEqual(found[1]["frames"], 5 * FRAMES)
        self.assertEqual(found[1]["frames"], found[0]["frames"])
        # The clock of a frame is a rounded difference.
        ratio = (
            found[1]["rotation"]["mean_by_time"]["mean"]
            / found[0]["rotation"]["mean_by_time"]["mean"]
        )
        self.assertAlmostEqual(ratio, 1.0, delta=1e-9)

    def rejected(self, *words, options=(), **changed):
        done = self.call(*options, **changed)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, ONE_ERROR)
        self.assertEqual(done.stdout, "")
        for word in words:
            self.assertIn(word, done.stderr)
        return done.stderr

    def test_wrong_parameters_of_the_container_are_rejected_with_a_hint(self):
        self.write({k: f for k, f in self.answer()[2].items() if k < 3 * FRAMES})
        good = {"warmup": 0, "measure": "density"}
        self.assertIn("camera", self.measured(**good))
        wrong = lambda *words, **changed: self.rejected(*words, **{**good, **changed})
        fitting = wrong("protrude", "--phase", phase=75).split("best is --phase ")[1].split(".")[0]
        self.assertLess(abs(math.remainder(float(fitting), 360.0)), 4.0)
        wrong("protrude", "--phase", phase=180)
        wrong("protrude", "without --clockwise", options=["--clockwise"], phase=180)
        wrong("protrude", "they would touch", scale=0.9 * SCALE)
        touch = wrong("overlap", "--scale", scale=2 * SCALE)
        self.assertAlmostEqual(
            float(touch.split("hint: with --scale ")[1].split(" ")[0]), SCALE, delta=0.5
        )
        wrong("protrude", "all the way round; --container-radius", container_radius=8)
        wrong("hardly ever come near the wall", "--container-radius 10", container_radius=10)
        wrong(
            "hardly ever come near the wall",
            scale=0.5 * SCALE,
            container_radius=2 * RADIUS,
            amplitude=2 * AMPLITUDE,
        )
        wrong("protrude", "--amplitude", amplitude=0)
        wrong("protrude", "--omega", omega=0.9 * OMEGA)
        wrong("protrude", "it is the --centre", centre="330,280")
        # --max-invalid 1 accepts everything.
        self.measured(max_invalid=1, phase=75, **good)
        report = swirl(
            "measure",
            self.path("tracks.csv"),
            "--camera-fps",
            FPS,
            "--scale",
            SCALE,
            "--omega",
            OMEGA,
            "--centre",
            "%g,%g" % CENTRE,
            "--amplitude",
            AMPLITUDE,
            "--container-radius",
            RADIUS,
            "--phase",
            6,
        )
        self.assertIn("fit the container better with --phase", report.stdout)

    def test_dropped_frames_and_swapped_ids_are_repaired(self):
        table = {k: dict(f) for k, f in self.answer()[2].items()}
        for k in list(table):
            if k > 3000:
                table[k] = dict(table[k])
                table[k][100] = table[k].pop(7)  # found again with another ID
                table[k][3], table[k][4] = table[k][4], table[k][3]  # identity swap
        for k in (900, 5000, 5001, 5002, 9000):
            del table[k]  # dropped frames
        for k in range(7000, 7004):
            del table[k][9]  # a disc missing in four frames
        table[8000][77] = (0.0, 0.0)  # a spurious detection
        self.write(table)
        found = self.assert_like_the_exact(self.measured())
        camera = found["camera"]
        self.assertEqual(
            (
                camera["relabelled"],
                camera["filled_positions"],
                camera["dropped_positions"],
                camera["breaks"],
            ),
            (3, 5 * DISCS + 4, 1, 0),
        )

    def test_rotation_without_the_swaps_that_track_calls_possible(self):
        # Discs 3 and 4 swap their IDs in frame 6000. In tracks of `swirl track`, which have radii,
        # nothing is repaired.
        table = {k: dict(f) for k, f in self.answer()[2].items()}

        def rotation(possible):
            with open(self.path("tracks.csv"), "w", encoding="utf-8") as opened:
                opened.write("frame,particle,x,y,seen,radius\n")
                for k, places in table.items():
                    for disc, (x, y) in places.items():
                        name = {3: 4, 4: 3}.get(disc, disc) if k >= 6000 else disc
                        px, py = CENTRE[0] + SCALE * x, CENTRE[1] - SCALE * y
                        opened.write(f"{k},{name},{px!r},{py!r},1,{SCALE}\n")
            camera = {
                "camera-fps": FPS,
                "scale": SCALE,
                "omega": OMEGA,
                "centre": CENTRE,
                "phase": 0.0,
                "amplitude": AMPLITUDE,
                "container-radius": RADIUS,
                "clockwise": False,
            }
            quality = {"possible_swaps": possible}
            with open(self.path("tracks.camera.json"), "w", encoding="utf-8") as opened:
                json.dump({"format": 1, "camera": camera, "quality": quality}, opened)
            done = swirl("measure", self.path("tracks.csv"), "--json", self.path("found.json"))
            self.assertEqual(done.returncode, 0, done.stderr)
            return read_json(self.path("found.json"))["rotation"], done.stdout

        swap = {"frame": 6000, "linked_from": 5999, "discs": [3, 4], "chance": 0.4}
        plain, said = rotation([])
        self.assertNotIn("without_swaps", plain)
        self.assertNotIn("possible swap", said)
        found, said = rotation([swap])
        self.assertIn("without 1 possible swap of IDs", said)
        # The swap adds a false velocity to two discs, and leaving it out gives the exact rate.
        exact = self.answer()[0]["rotation"]["mean_by_time"]["mean"]
        with_swap = found["mean_by_time"]["mean"]
        without = found["without_swaps"]["mean_by_time"]["mean"]
        self.assertEqual(with_swap, plain["mean_by_time"]["mean"])
        self.assertNotEqual(without, with_swap)
        self.assertLess(abs(without - exact), 0.01)

    def test_discs_may_appear_and_disappear(self):
        table = {k: dict(f) for k, f in self.answer()[2].items()}
        for disc, (begin, end) in enumerate(((2000, 2040), (8000, 8100), (12000, 12008))):
            for k in range(begin, end):
                del table[k][disc]
        for k in range(15000, 15020):
            del table[k]
        self.write(table)
        found = self.assert_like_the_exact(self.measured())
        self.assertEqual(found["camera"]["breaks"], 6)
        self.assertIn("appear or disappear", found["remark"])

    def test_frames_at_the_vertices_alone_warn_that_rolling_is_invisible(self):
        for frames, remark in ((30, "no sphere rolls in any of the frames"), (31, "")):
            recording = self.path(f"{frames}.h5")
            self.assert_works(
                "run",
                "--preset",
                "experiment",
                "--discs",
                8,
                "--periods",
                4,
                "--frames-per-period",
                frames,
                "--trajectory",
                recording,
                "--quiet",
            )
            found = json.loads(
                swirl("measure", recording, "--measure", "rolling", "--json", "-").stdout
            )
            self.assertEqual(found["remark"][: len(remark) or None], remark)
            share = found["measured"]["rolling"]["rolling_share"]["mean"]
            self.assertEqual(share > 0.5, not remark)
        done = swirl("measure", self.path("30.h5"), "--measure", "rolling")
        self.assertIn("hint: record 511 frames per period", done.stderr)

    def test_values_below_the_frame_rate_of_their_definition_are_missing_with_the_reason(self):
        # At 30 frames per period the depinning angle was 133.1 ± 0.6 degrees instead of 5 ± 1.
        names = "pinned,residence,slip,order,density"
        at_400 = "residence (400)"
        at_511 = (
            "pinned, residence.sensitivity, slip.pinned_region, order.pinned, "
            "order.six_pinned (511)"
        )
        # A recording of few periods lacks a frame: it has a little less than 511 per period.
        for frames, missing in (
            (30, ("slip.resident, order.resident (120)", at_400, at_511)),
            (128, (at_400, at_511)),
            (400, (at_511,)),
            (511, ()),
        ):
            recording = self.path(f"{frames}.h5")
            self.assert_works(
                "run",
                "--discs",
                20,
                "--periods",
                4,
                "--warmup",
                0,
                "--frames-per-period",
                frames,
                "--trajectory",
                recording,
                "--quiet",
                "--overwrite",
            )
            done = swirl("measure", recording, "--measure", names, "--json", "-")
            found = json.loads(done.stdout)
            for reason in missing:
                self.assertIn(reason, done.stderr)
                self.assertIn(reason, found["remark"])
            self.assertEqual("too few" in done.stderr, bool(missing))
            measured = found["measured"]
            self.assertEqual(measured["pinned"]["depinning"]["mean"] is None, frames < 511)
            self.assertEqual(measured["pinned"]["pinning"]["mean"] is None, frames < 511)
            self.assertEqual(measured["residence"]["length"]["mean"] is None, frames < 400)
            self.assertEqual(measured["residence"]["share"]["mean"] is None, frames < 400)
            self.assertEqual(measured["order"]["pinned"]["mean"] is None, frames < 511)
            # Columns of tables are missing as rows are.
            self.assertEqual(
                measured["residence"]["sensitivity"]["share"].count(None), 0 if frames == 511 else 9
            )
            self.assertIsNotNone(measured["order"]["all"]["mean"])
            self.assertIsNotNone(measured["slip"]["cluster"]["mean"])

    def test_tracks_with_few_frames_per_period_have_no_rotation(self):
        # Differences of positions miss collisions: with 2 frames per period ϖ/Ω was 0.08 instead of
        # 0.20.
        for frames, known in ((2, False), (8, False), (16, True)):
            self.assert_works(
                "run",
                "--discs",
                5,
                "--periods",
                60,
                "--frames-per-period",
                frames,
                "--trajectory",
                self.path("t.h5"),
                "--quiet",
                "--overwrite",
            )
            self.assert_works(
                "export",
                self.path("t.h5"),
                "--format",
                "csv",
                "--out",
                self.path("t.csv"),
                "--quiet",
            )
            done = self.assert_works(
                "measure",
                self.path("t.csv"),
                "--camera-fps",
                frames / 11.866071,
                "--scale",
                20,
                "--omega",
                0.5295084874,
                "--centre",
                "209.84,209.84",
                "--amplitude",
                1.892,
                "--container-radius",
                8.6,
            )
            self.assertEqual("ϖ/Ω = n/a" not in done.stdout, known, done.stdout)
            self.assertEqual("the rotation (16)" not in done.stderr, known, done.stderr)

    def test_positions_alone_have_no_moments_of_velocities(self):
        # Differences of positions miss collisions: at this rate the granular temperature of 48
        # discs was 66 errors off. Tracks with 100 or more frames per period have smoothed
        # velocities.
        self.assert_works(
            "run",
            "--discs",
            12,
            "--periods",
            6,
            "--frames-per-period",
            64,
            "--trajectory",
            self.path("t.h5"),
            "--quiet",
        )
        self.assert_works(
            "export", self.path("t.h5"), "--format", "csv", "--out", self.path("t.csv"), "--quiet"
        )
        done = self.assert_works(
            "measure",
            self.path("t.csv"),
            "--camera-fps",
            64 / 11.866071,
            "--scale",
            20,
            "--omega",
            0.5295084874,
            "--centre",
            "209.84,209.84",
            "--amplitude",
            1.892,
            "--container-radius",
            8.6,
            "--measure",
            "temperature,centre,profile",
            "--json",
            "-",
        )
        found = json.loads(done.stdout)["measured"]
        self.assertIsNone(found["temperature"]["granular"]["mean"])
        self.assertIsNone(found["centre"]["coriolis"]["mean"])
        self.assertIsNotNone(found["centre"]["distance"]["mean"])
        self.assertEqual(set(found["profile"]["speed"]), {None})
        self.assertIn("positions alone do not show these values", done.stderr)
        self.assertIn("centre.coriolis, centre.max_coriolis", done.stderr)

    def test_exports_have_the_pinned_and_resident_discs_if_they_are_known(self):
        for frames, known in ((30, False), (511, True)):
            recording, table, dump, xyz = (
                self.path(f"e{frames}{end}") for end in (".h5", ".csv", ".dump", ".xyz")
            )
            swirl(
                "run",
                "--discs",
                20,
                "--periods",
                2,
                "--warmup",
                0,
                "--frames-per-period",
                frames,
                "--trajectory",
                recording,
                "--quiet",
            )
            for form, out in (("table", table), ("lammps", dump), ("xyz", xyz)):
                done = swirl(
                    "export",
                    recording,
                    "--format",
                    form,
                    "--out",
                    out,
                    "--quiet",
                    "--range",
                    "0:599",
                )
                self.assertEqual(done.returncode, 0 if known else 2, done.stderr)
                if not known:
                    done = swirl("export", recording, "--format", form, "--out", out, "--quiet")
            rows = read_rows(table)
            self.assertEqual("pinned" in rows[0], known)
            text = read_text(dump)
            self.assertEqual(text.count("mass omegaz pinned resident\n") > 0, known)
            self.assertEqual(":pinned:I:1:resident:I:1 Time" in read_text(xyz), known)
            if not known:
                continue
            # It takes seven earlier and seven later frames.
            self.assertEqual({row["pinned"] for row in rows if int(row["frame"]) < 7}, {""})
            later = [row for row in rows if int(row["frame"]) == 300]
            self.assertEqual({row["pinned"] for row in later}, {"0", "1"})
            self.assertEqual({row["resident"] for row in later}, {"0", "1"})
            atoms = text.split("ITEM: ATOMS")[301].splitlines()[1:21]
            self.assertEqual([atom.split()[-2] for atom in atoms], [row["pinned"] for row in later])

    def test_all_frames_of_a_slow_recording_are_used(self):
        # One frame per period: an average of every 100th had one of 100, and the effective samples
        # of all.
        recording = self.path("slow.h5")
        swirl(
            "run",
            "--discs",
            20,
            "--periods",
            100,
            "--warmup",
            0,
            "--frames-per-period",
            1,
            "--trajectory",
            recording,
            "--quiet",
        )
        found = json.loads(
            swirl(
                "measure", recording, "--measure", "order,packing,pair_correlation", "--json", "-"
            ).stdout
        )["measured"]
        for name, row in (
            ("order", "all"),
            ("packing", "all"),
            ("pair_correlation", "inner_packing"),
        ):
            estimate = found[name][row]
            self.assertGreater(estimate["effective_samples"], 20)
            # The scatter of one frame is below 1, so the error of the mean of 20 is below 1/√20.
            self.assertLess(estimate["error"], 0.22)

    def test_missing_averages_of_a_short_recording_are_one_line(self):
        recording = self.path("short.h5")
        swirl(
            "run", "--discs", 8, "--periods", 2, "--warmup", 0, "--trajectory", recording, "--quiet"
        )
        done = self.assert_works("measure", recording, "--measure", "all", "--warmup", 1.96)
        self.assertEqual(done.stdout.count("n/a"), 1, done.stdout)
        self.assertRegex(done.stdout, r"(?m)^  n/a +\d+ of \d+ averages$")
        self.assertIn("\n  average     1 frame\n", done.stdout)

    def test_fields_errors_and_balances_are_in_one_file(self):
        self.assert_works(
            "run",
            "--discs",
            20,
            "--periods",
            14,
            "--warmup",
            2,
            "--measure",
            "fields",
            "--json",
            self.path("fields.json"),
            "--quiet",
        )
        fields = read_json(self.path("fields.json"))["measured"]["fields"]
        for name in ("m_frame_2", "m_frame_4", "lab_2"):
            columns = fields[name]
            self.assertEqual({len(column) for column in columns.values()}, {400}, name)
            values = {column for column in columns if not column.endswith("_error")} - {"x", "y"}
            self.assertEqual(
                set(columns) - values - {"x", "y"}, {f"{value}_error" for value in values}
            )
            self.assertEqual(len(set(zip(columns["x"], columns["y"]))), 400)
        # The lab's square contains all kernels but for small parts at its edges. Discs visit all
        # places between the points of the grid.
        lab = fields["lab_2"]
        spacing = lab["x"][1] - lab["x"][0]
        self.assertAlmostEqual(sum(lab["density"]) * spacing**2 / 20, 1.0, delta=0.02)
        for balance in ("mass", "momentum", "spin"):
            # Relative to the scale of rounding errors, some 10^4 of which add up.
            self.assertLess(fields[f"{balance}_residual"], 1e-12)

    def test_a_single_frame_gives_no_rotation(self):
        self.write({0: self.answer()[2][0]})
        self.rejected("a single frame", warmup=0, measure="density")

    def test_discs_with_changing_ids_have_no_tracks(self):
        # Every disc gets a new ID every ten frames, at a position where no disc was: every second
        # group of ten frames is dropped.
        table = {}
        for k, frame in self.answer()[2].items():
            if k < 2000 and k // 10 % 2 == 0:
                table[k] = {disc + 100 * (k // 10): position for disc, position in frame.items()}
        self.write(table)
        self.rejected("consecutive frames", "slip", warmup=0, measure="slip")
        self.measured(warmup=0, measure="density,temperature")


if __name__ == "__main__":
    unittest.main()
