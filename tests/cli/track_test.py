"""swirl film-test and swirl track: from made-up films, whose truth is known, to ϖ.

    track_test.py            small films
    track_test.py --table    the four films of docs/camera.md, and their table (minutes)
    track_test.py --spin     the bias of measured spins over spin, noise and compression (minutes)
"""

import csv
import json
import math
import os
import subprocess
import sys
import unittest

from program import InFolder, swirl

# Twenty discs of twelve pixels in a dish of 6.5 radii, 64 pictures a swirl.
SMALL = ["--discs", 20, "--container-radius", 6.5, "--scale", 12, "--width", 240, "--height", 240,
         "--frames-per-period", 64, "--noise", 2, "--quality", 14, "--seed", 3]
# Of sixteen pixels.
LARGER = ["--discs", 20, "--container-radius", 6.5, "--scale", 16, "--width", 340, "--height", 340,
          "--frames-per-period", 64, "--noise", 2, "--quality", 14, "--seed", 3]


def rows(path):
    with open(path, encoding="utf-8") as file:
        yield from csv.DictReader(file)


def places(path, x="x", y="y"):
    """{frame: {particle: (x, y)}}, of what was seen."""
    found = {}
    for row in rows(path):
        if row.get("seen", "1") == "1":
            found.setdefault(int(row["frame"]), {})[int(row["particle"])] = (float(row[x]),
                                                                              float(row[y]))
    return found


class Judged:
    """Places by name against the true ones: {frame: {name: (x, y)}} each."""

    def __init__(self, truth, found, about):
        radius = about["scale"]
        errors, owner = [], {}
        self.exchanges = self.full = 0
        for frame, discs in truth.items():
            hits = 0
            for disc, (x, y) in discs.items():
                near = min(((math.hypot(u - x, v - y), track)
                            for track, (u, v) in found.get(frame, {}).items()), default=(1e9, -1))
                if near[0] > 0.5 * radius:
                    continue
                hits += 1
                errors.append(near[0])
                self.exchanges += owner.get(disc, near[1]) != near[1]
                owner[disc] = near[1]
            self.full += hits == len(discs)
        self.frames = len(truth)
        self.complete = self.full / self.frames
        self.rms = math.sqrt(sum(e * e for e in errors) / len(errors) / 2.0)
        periods = self.frames * about["omega"] / (2.0 * math.pi)
        self.exchanges_per_thousand = 1000.0 * self.exchanges / (about["discs"] * periods)


class Truth:
    """What is beside a film."""

    def __init__(self, film):
        with open(film[:-len(".mp4")] + ".truth.json", encoding="utf-8") as file:
            self.about = json.load(file)


class Comparison(Judged):
    """Tracks against the truth of a film."""

    def __init__(self, film, tracks):
        self.truth = Truth(film).about
        with open(tracks[:-len(".csv")] + ".camera.json", encoding="utf-8") as file:
            self.found = json.load(file)
        super().__init__(places(film[:-len(".mp4")] + ".truth.csv", "x_ideal", "y_ideal"),
                         places(tracks), self.truth)
        fps = self.found["fps"]
        self.omega = self.found["path"]["omega"] / fps / self.truth["omega"] - 1.0
        self.centre = math.dist(self.found["path"]["centre"], self.truth["centre"])
        self.amplitude = self.found["path"]["amplitude"] - self.truth["amplitude"]
        self.radius = self.found["kinds"][0]["radius"] / self.truth["scale"] - 1.0


class SpinComparison:
    """Spins in tracks against those of the film's truth, in Ω."""

    def __init__(self, film, tracks):
        stem = film[:-len(".mp4")]
        with open(stem + ".truth.json", encoding="utf-8") as file:
            truth = json.load(file)
        with open(tracks[:-len(".csv")] + ".camera.json", encoding="utf-8") as file:
            found = json.load(file)
        step, omega = found["spins"]["step"], found["path"]["omega"]
        turns, here = {}, {}
        for row in rows(stem + ".truth.csv"):
            frame, disc = int(row["frame"]), int(row["particle"])
            turns[frame, disc] = float(row["spin_z"])
            here.setdefault(frame, []).append((float(row["x_ideal"]), float(row["y_ideal"]), disc))
        self.pairs = []  # true, by registration, by PIV
        for row in rows(tracks):
            frame = int(row["frame"])
            if row["seen"] != "1" or not row["texture_match"] or float(row["texture_match"]) == 0.0:
                continue
            place = float(row["x"]), float(row["y"])
            distance, disc = min((math.dist(place, (x, y)), disc) for x, y, disc in here[frame])
            steps = range(frame - step + 1, frame + step + 1)
            if distance > 0.3 * truth["scale"] or any((k, disc) not in turns for k in steps) \
                    or frame < step:
                continue
            true = sum(turns[k, disc] for k in steps) / (2 * step) / truth["omega"]
            self.pairs.append((true, float(row["spin"]) / omega, float(row["piv_spin"]) / omega))

    def slope(self, which, least=0.0, most=1e9):
        """Of the estimate against the truth, through zero; which: 1 registration, 2 PIV."""
        part = [pair for pair in self.pairs if least <= abs(pair[0]) < most]
        return sum(p[0] * p[which] for p in part) / max(sum(p[0] ** 2 for p in part), 1e-300)

    def rms(self, which):
        return math.sqrt(sum((p[which] - p[0]) ** 2 for p in self.pairs) / len(self.pairs))


class FilmTest(InFolder):
    def film(self, *more, name="film.mp4", length=1.15, of=tuple(SMALL)):
        path = self.path(name)
        done = swirl("film-test", *of, "--length", length, "--out", path, "--quiet", *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        return path

    def track(self, film, *more, name="tracks.csv"):
        out = self.path(name)
        done = swirl("track", film, "--out", out, *more)
        if "has no eyes" in done.stderr:
            self.skipTest("this build was made without OpenCV")
        self.assertEqual(done.returncode, 0, done.stderr)
        return out, done.stdout

    def refused(self, code, *words, call):
        if "has no eyes" in call.stderr:
            self.skipTest("this build was made without OpenCV")
        self.assertEqual(call.returncode, code, call.stdout + call.stderr)
        for word in words:
            self.assertIn(word, call.stderr)
        self.assertFalse(os.path.exists(self.path("tracks.csv")))

    def assert_rotation_of_the_truth(self, film, tracks, truth):
        """The same measurement on the truth's own places."""
        with open(self.path("truth.csv"), "w", encoding="utf-8") as table:
            table.write("frame,particle,x,y\n")
            for row in rows(film[:-4] + ".truth.csv"):
                table.write(f"{row['frame']},{row['particle']},{row['x_ideal']},{row['y_ideal']}\n")
        of_truth = swirl("measure", self.path("truth.csv"), "--camera-fps", 1, "--scale",
                         truth["scale"], "--omega", truth["omega"], "--centre",
                         "%r,%r" % tuple(truth["centre"]), "--phase", truth["phase"], "--amplitude",
                         truth["amplitude"] / truth["scale"], "--container-radius",
                         truth["container_radius"] / truth["scale"], "--json", "-")
        of_film = swirl("measure", tracks, "--json", "-")  # no option: it lies beside the tracks
        values = []
        for done in (of_truth, of_film):
            self.assertEqual(done.returncode, 0, done.stderr)
            values.append(json.loads(done.stdout)["rotation"]["rigid_by_time"]["mean"])
        self.assertLess(abs(values[0] - values[1]), 0.02)  # of Ω, in little more than one swirl

    def test_a_tilted_camera(self):
        for degrees in (0, 3, 8):
            with self.subTest(degrees=degrees):
                film = self.film("--tilt", degrees, "--tilt-towards", 250, length=1.1, of=LARGER,
                                 name=f"tilt{degrees}.mp4")
                tracks, said = self.track(film, name=f"tilt{degrees}.csv")
                result = Comparison(film, tracks)
                lens = result.found["lens"]
                if degrees == 0:
                    self.assertEqual(lens["tilt"], 0.0)
                    self.assertIn("no tilt, which would be below", said)
                else:
                    self.assertLess(abs(lens["tilt"] - degrees), 3.0 * lens["tilt_error"])
                    self.assertLess(lens["tilt_error"], 0.6)
                    self.assertLess(abs(lens["tilt_towards"] - 250.0),
                                    3.0 * lens["tilt_towards_error"])
                # As good as the film that is seen from above.
                self.assertEqual(result.complete, 1.0)
                self.assertLess(result.rms, 0.2)
                self.assertLess(result.centre, 0.2)
                self.assertLess(abs(result.amplitude), 0.3)
                self.assertLess(abs(result.omega), 5e-4)
                self.assert_rotation_of_the_truth(film, tracks, result.truth)
        # What is given is taken, and nothing where none is.
        film = self.path("tilt8.mp4")
        given, _ = self.track(film, "--tilt", "8,250", "--quiet", name="given.csv")
        self.assertLess(Comparison(film, given).rms, 0.2)
        none, _ = self.track(film, "--tilt", 0, "--quiet", name="none.csv")
        self.assertGreater(Comparison(film, none).rms, 0.5)

    def test_from_a_film_to_the_rotation(self):
        film = self.film()
        tracks, said = self.track(film, "--json", self.path("found.json"), "--report",
                                  self.path("report"))
        self.assertIn("20 discs", said)
        with open(self.path("report/report.html"), encoding="utf-8") as file:
            report = file.read()
        for part in ("What was found", "20, bright", "pictures with all discs", "Over time",
                     "counter-clockwise", "data:image/png;base64,", "swirl track"):
            self.assertIn(part, report)
        with open(self.path("found.json"), encoding="utf-8") as file:
            path = json.load(file)["path"]
        self.assertIn(path["sides"], (30, None))  # the run's, if it can be told
        for row in rows(self.path("report/pictures.csv")):
            self.assertLessEqual(int(row["seen"]) + int(row["filled"]) + int(row["missing"]), 20)
        result = Comparison(film, tracks)
        self.assertEqual(result.found["discs"], 20)
        self.assertTrue(result.found["discs_are"] == "bright")
        self.assertFalse(result.found["path"]["clockwise"])
        self.assertGreater(result.complete, 0.95)
        self.assertEqual(result.exchanges, 0)
        self.assertLess(result.rms, 0.4)          # a thirtieth of a radius
        self.assertLess(abs(result.omega), 5e-4)
        self.assertLess(result.centre, 0.3)
        self.assertLess(abs(result.amplitude), 0.3)
        self.assertLess(abs(result.radius), 0.04)
        self.assert_rotation_of_the_truth(film, tracks, result.truth)

    def test_tracks_as_hdf5_say_what_the_table_says(self):
        film = self.film(length=1.05)
        table, _ = self.track(film, "--quiet", name="table.csv")
        recording, _ = self.track(film, "--quiet", name="same.h5")
        results = []
        for tracks in (table, recording):
            done = swirl("measure", tracks, "--measure", "density,temperature,pinned", "--json", "-")
            self.assertEqual(done.returncode, 0, done.stderr)
            results.append({key: value for key, value in json.loads(done.stdout).items()
                            if key != "file"})
        self.assertEqual(*results)
        again = swirl("track", film, "--out", recording)
        self.refused(1, "is there already", call=again)
        self.track(film, "--quiet", "--overwrite", name="same.h5")
        self.refused(2, "must end with .csv or .h5",
                     call=swirl("track", film, "--out", self.path("tracks.txt")))
        os.truncate(recording, os.path.getsize(recording) // 2)
        self.assertEqual(swirl("measure", recording).returncode, 1)

    def test_spins_from_the_texture(self):
        film = self.path("film.mp4")
        done = swirl("film-test", "--discs", 20, "--container-radius", 6.5, "--scale", 16, "--width",
                     300, "--height", 300, "--frames-per-period", 64, "--noise", 2, "--quality", 0,
                     "--seed", 3, "--length", 1.1, "--out", film, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        tracks, _ = self.track(film, "--spin")
        spins = SpinComparison(film, tracks)
        self.assertGreater(len(spins.pairs), 800)
        # Discs of 16 pixels: better than a twentieth, and PIV a quarter, which it is known to miss.
        self.assertLess(abs(spins.slope(1) - 1.0), 0.05)
        self.assertLess(abs(spins.slope(2) - 1.0), 0.25)
        self.assertLess(spins.rms(1), 0.1)
        # They are measured with: a disc at the wall spins, but not as fast as the swirl.
        done = swirl("measure", tracks, "--measure", "frustration", "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        wall = json.loads(done.stdout)["measured"]["frustration"]["wall_spin"]["mean"]
        self.assertGreater(wall, 0.05)
        self.assertLess(wall, 1.5)

    def test_a_poor_film(self):
        # Low contrast, noise, blur and compression: discs are known by what all look like.
        film = self.path("film.mp4")
        done = swirl("film-test", "--camera", "bad", "--discs", 28, "--length", 1.5, "--quality", 26,
                     "--out", film, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        tracks, _ = self.track(film)
        result = Comparison(film, tracks)
        self.assertEqual(result.found["discs"], 28)
        self.assertGreaterEqual(result.complete, 0.9)
        self.assertLessEqual(result.exchanges, 2)
        self.assertLess(result.rms, 0.65)  # pixels; 0.9 by the edges alone

    def test_a_mirrored_film_and_dark_discs(self):
        film = self.film("--mirrored", "--disc-level", 60, "--floor-level", 200, "--rim-level", 90,
                         "--table-level", 150, "--gloss", 120, "--texture", 0.1)
        tracks, said = self.track(film)
        result = Comparison(film, tracks)
        self.assertTrue(result.found["path"]["clockwise"])
        self.assertEqual(result.found["discs_are"], "dark")
        self.assertEqual(result.found["discs"], 20)
        self.assertIn("clockwise in the picture", said)
        self.assertLess(result.rms, 0.4)
        self.assertLess(abs((result.found["path"]["phase"] - result.truth["phase"] + 180) % 360
                            - 180), 1.0)

    def test_few_discs_that_are_seldom_at_the_wall_do_not_make_the_dish_smaller(self):
        film = self.film(of=["--discs", 2, *LARGER[2:]])
        tracks, said = self.track(film)
        self.assertIn("at the wall too seldom", said)
        self.assertNotIn("outer edge of the wall. The latter", said)
        result = Comparison(film, tracks)
        # To the width of the wall that is drawn; discs in most pictures stay farther inside.
        self.assertLess(abs(result.found["dish"]["radius"] / result.truth["container_radius"] - 1.0),
                        0.06)

    def test_a_path_of_few_sides_is_told(self):
        three = self.film("--sides", 3, name="three.mp4")
        self.refused(1, "few corners", call=swirl("track", three, "--out", self.path("tracks.csv")))
        _, said = self.track(self.film("--sides", 4))
        self.assertIn("along a polygon of 4 sides", said)

    def test_the_error_of_the_amplitude_knows_of_that_of_the_lens(self):
        film = self.film("--distortion", 0.06, "--seed", 5, of=LARGER[:-2])
        result = Comparison(film, self.track(film)[0])
        # The mean distance of the sides of a 30-gon with its corners on A, to (pi/30)^4.
        true = result.truth["amplitude"] * (1.0 - (math.pi / 30) ** 2 / 3.0)
        path = result.found["path"]
        self.assertLess(abs(path["amplitude"] - true), 3.0 * path["amplitude_error"])
        # And is not just large.
        self.assertLess(path["amplitude_error"], 0.01 * true)

    def test_numbered_pictures_give_the_same_as_the_film(self):
        film = self.film(length=0.8)
        os.makedirs(self.path("seen"))
        subprocess.run(["ffmpeg", "-v", "error", "-i", film, "-pix_fmt", "gray",
                        "-start_number", "100",
                        self.path("seen/%05d.png")], check=True)
        tables = []
        for source, name in ((film, "a.csv"), (self.path("seen/%05d.png"), "b.csv")):
            out, _ = self.track(source, "--fps", 64, "--quiet", name=name)
            with open(out, "rb") as file:
                tables.append(file.read())
        self.assertTrue(tables[0] == tables[1])

    def test_what_is_wrong_is_named(self):
        still = self.film("--still", name="still.mp4", length=0.5)
        out = self.path("tracks.csv")
        self.refused(1, "stands still", call=swirl("track", still, "--out", out))
        empty = self.path("empty.mp4")
        subprocess.run(["ffmpeg", "-v", "error", "-f", "lavfi", "-i",
                        "nullsrc=s=240x240:r=30:d=2,geq=lum='100+30*random(1)':cb=128:cr=128",
                        empty], check=True)
        self.refused(1, "No dish was found", call=swirl("track", empty, "--out", out))
        with open(still, "rb") as file:
            part = file.read()[:20000]
        for name, content in (("cut.mp4", part[:-2000] if b"moov" not in part else part[:30]),
                              ("text.mp4", b"this is no film")):
            with open(self.path(name), "wb") as file:
                file.write(content)
            self.refused(1, "no pictures that can be read",
                         call=swirl("track", self.path(name), "--out", out))
        self.refused(1, "There is no film", call=swirl("track", self.path("none.mp4"), "--out", out))
        self.refused(1, "no pictures named",
                     call=swirl("track", self.path("no%05d.png"), "--out", out))

    def test_what_telephones_do_to_a_film(self):
        film = self.film()

        def changed(name, *arguments):
            subprocess.run(["ffmpeg", "-v", "error", "-i", film, *arguments, self.path(name)],
                           check=True)
            return self.track(self.path(name), name=name[:-4] + ".csv")

        # Held upright: the file says that it is to be turned, and it is.
        tracks, _ = changed("turned.mp4", "-c", "copy", "-metadata:s:v:0", "rotate=90")
        with open(tracks[:-4] + ".camera.json", encoding="utf-8") as file:
            found = json.load(file)
        self.assertEqual(found["discs"], 20)
        self.assertLess(abs((found["path"]["phase"] - 90.0 + 180.0) % 360.0 - 180.0), 1.0)
        _, said = changed("two.mp4", "-vf", "split[a][b];[a][b]hstack", "-qp", "14")
        self.assertIn("second circle of the dish's size", said)
        tracks, said = changed("hand.mp4", "-vf", "drawbox=x=0:y=0:w=110:h=240:color=0x9a8070:t=fill:"
                               "enable='between(n,25,40)'", "-qp", "14")
        self.assertIn("a hand perhaps", said)
        after = places(tracks)
        for frame in range(48, 70):
            self.assertEqual(len(after[frame]), 20, frame)  # all are found again
        _, said = changed("cut.mp4", "-vf", "crop=150:240:0:0", "-qp", "14")
        self.assertIn("not wholly in the picture", said)
        _, said = changed("uneven.mp4", "-vf", "select='not(mod(n,7))+mod(n,2)'", "-vsync", "vfr",
                          "-qp", "14")
        self.assertIn("frame rate varies", said)

    def with_times(self, film, name, times):
        """The same pictures with other times: an expression of N, in frames."""
        subprocess.run(["ffmpeg", "-v", "error", "-i", film, "-vf", f"setpts='({times})/60/TB'",
                        "-fps_mode", "passthrough", "-enc_time_base", "1/600", "-c:v", "libx264",
                        "-bf", "0", "-qp", "10", self.path(name)], check=True)
        return self.path(name)

    def test_frames_that_share_a_time(self):
        film = self.film()
        # Frame 40 has the time of frame 39, or the other way round; three frames have one time.
        for name, times, untimed in (("late.mkv", "if(eq(N,40),39,N)", {39, 40}),
                                     ("early.mkv", "if(eq(N,39),40,N)", {39, 40}),
                                     ("three.mkv", "if(between(N,39,41),39,N)", {39, 40, 41})):
            with self.subTest(times=times):
                tracks, said = self.track(self.with_times(film, name, times), name=name[:-4] + ".csv")
                self.assertIn(f"{len(untimed)} of the 74 frames", said)
                self.assertIn("the first at frame 39", said)
                self.assertNotIn("damaged", said)
                with open(tracks[:-4] + ".camera.json", encoding="utf-8") as file:
                    found = json.load(file)
                truth = Truth(film).about
                # 60 frames per second, as the other frames have it.
                omega = found["path"]["omega"] / 60.0 / truth["omega"]
                self.assertLess(abs(omega - 1.0), 1e-3)
                seen = places(tracks)
                self.assertEqual(set(range(74)) - set(seen), untimed)  # filled in, not seen
                true = places(film[:-4] + ".truth.csv", "x_ideal", "y_ideal")
                judged = Judged({k: true[k] for k in seen}, seen, truth)
                self.assertEqual(judged.complete, 1.0)
                self.assertEqual(judged.exchanges, 0)
                self.assertLess(judged.rms, 0.4)  # as of the film with good times
        # All frames are used where their spacing is given.
        tracks, said = self.track(self.path("late.mkv"), "--fps", 60, name="given.csv")
        self.assertNotIn("time of their own", said)
        self.assertEqual(set(places(tracks)), set(range(74)))

    def test_times_that_cannot_be_right_are_rejected(self):
        film = self.film()
        out = self.path("tracks.csv")
        # An hour passes between two frames; every other frame shares its time.
        for name, times, word in (("pause.mkv", "if(gte(N,40),N+216000,N)", "3.6e+03 s pass"),
                                  ("period.mkv", "if(gte(N,40),N+47,N)", "half a period"),
                                  ("half.mkv", "2*floor(N/2)", "do not ascend")):
            with self.subTest(times=times):
                self.refused(1, word, "--fps", call=swirl(
                    "track", self.with_times(film, name, times), "--out", out))
        # A gap of 30 frames, less than half a period, is none of these.
        tracks, said = self.track(self.with_times(film, "gap.mkv", "if(gte(N,40),N+20,N)"))
        self.assertIn("frame rate varies", said)

    def test_wrong_calls(self):
        for words, arguments in ((["--out"], []), ([".csv"], ["--out", self.path("x.txt")]),
                                 (["--fps"], ["--out", self.path("x.csv"), "--fps", -1]),
                                 (["--discs"], ["--out", self.path("x.csv"), "--discs", 0]),
                                 (["--tilt"], ["--out", self.path("x.csv"), "--tilt", "5"]),
                                 (["--view-angle"], ["--out", self.path("x.csv"), "--view-angle",
                                                     200])):
            call = swirl("track", "film.mp4", *arguments)
            self.refused(2, *words, call=call)
        self.refused(2, "one of laboratory", call=swirl("film-test", "--camera", "x", "--out",
                                                        self.path("x.mp4")))
        self.refused(2, ".mp4", call=swirl("film-test", "--out", self.path("x.avi")))
        self.assertEqual(self.left_behind(), [])


FILMS = (("laboratory", ["--discs", 36, "--length", 1.5]),
         ("telephone", ["--discs", 48, "--length", 4, "--quality", 26]),
         ("bad", ["--discs", 28, "--length", 12, "--quality", 26]),
         ("steel", ["--discs", 32, "--mixture", "10:1.35", "--length", 4, "--quality", 24]))


def print_table(folder):
    print("| film | pictures with all discs | exchanges per 1000 | rms, pixels | Ω | centre, pixels "
          "| amplitude, pixels | radius |")
    print("|---|---|---|---|---|---|---|---|")
    for name, options in FILMS:
        film, tracks = (os.path.join(folder, name + end) for end in (".mp4", ".csv"))
        for call in (["film-test", "--camera", name, *options, "--out", film, "--overwrite"],
                     ["track", film, "--out", tracks, "--overwrite"]):
            done = swirl(*call, "--quiet", timeout=1200)
            if done.returncode != 0:
                print(done.stderr)
                return 1
        c = Comparison(film, tracks)
        print(f"| {name} | {100 * c.complete:.1f} % | {c.exchanges_per_thousand:.1f} | {c.rms:.2f} "
              f"| {c.omega:+.0e} | {c.centre:.2f} | {c.amplitude:+.2f} | {100 * c.radius:+.1f} % |",
              flush=True)
    return 0


def print_spins(folder):
    print("| noise, levels | compression | registration: slope, 0–0.3 Ω | 0.3–0.6 | above | rms, Ω "
          "| PIV: slope, 0–0.3 Ω | 0.3–0.6 | above | rms, Ω |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    film, tracks = os.path.join(folder, "film.mp4"), os.path.join(folder, "tracks.csv")
    for noise, quality in ((0, 0), (2, 0), (4, 0), (8, 0), (2, 10), (2, 18), (2, 26)):
        for call in (["film-test", "--discs", 36, "--frames-per-period", 64, "--frames", 80,
                      "--noise", noise, "--quality", quality, "--out", film, "--overwrite"],
                     ["track", film, "--spin", "--out", tracks, "--overwrite"]):
            done = swirl(*call, "--quiet", timeout=1200)
            if done.returncode != 0:
                print(done.stderr)
                return 1
        spins = SpinComparison(film, tracks)
        cells = [f"{noise}", f"{quality}"]
        for which in (1, 2):
            cells += [f"{spins.slope(which, *bounds):.3f}"
                      for bounds in ((0, 0.3), (0.3, 0.6), (0.6,))] + [f"{spins.rms(which):.3f}"]
        print("| " + " | ".join(cells) + " |", flush=True)
    return 0


if __name__ == "__main__":
    if sys.argv[1:2] in (["--table"], ["--spin"]):
        import tempfile
        with tempfile.TemporaryDirectory(prefix="swirl-films-") as place:
            sys.exit((print_table if sys.argv[1] == "--table" else print_spins)(place))
    unittest.main()
