"""swirl track --live: images that arrive in a folder, a video on standard input, the images in the browser,
and the end by Ctrl-C."""

import csv
import http.client
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from program import SWIRL, InFolder, folder_in_memory, main, slow, swirl

FRAMES = 84
VIDEO = ["--discs", 20, "--container-radius", 6.5, "--scale", 12, "--width", 240, "--height", 240,
         "--frames-per-period", 40, "--noise", 2, "--quality", 14, "--seed", 3, "--frames", FRAMES, "--quiet"]

if not shutil.which("ffmpeg"):
    print("skipped: ffmpeg is not installed.")
    sys.exit(77)


def table(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Live(InFolder):
    in_memory = True

    def setUp(self):
        super().setUp()
        os.mkdir(self.path("live"))

    @classmethod
    def setUpClass(cls):
        """One video for all tests, and its tracks."""
        folder = tempfile.TemporaryDirectory(prefix="swirl-test-", dir=folder_in_memory())
        cls.addClassCleanup(folder.cleanup)
        cls.video = os.path.join(folder.name, "video.mp4")
        cls.batch_tracks = os.path.join(folder.name, "batch.csv")
        done = swirl("synthetic-video", *VIDEO, "--out", cls.video)
        assert done.returncode == 0, done.stderr
        done = swirl("track", cls.video, "--fps", 60, "--out", cls.batch_tracks, "--quiet")
        if "no camera support" in done.stderr:
            raise unittest.SkipTest("this build has no camera support")
        assert done.returncode == 0, done.stderr

    def make_images(self, extension="png"):
        """The images of the video; returns their pattern."""
        os.mkdir(self.path("images"))
        pattern = self.path("images/frame_%05d." + extension)
        subprocess.run(["ffmpeg", "-v", "error", "-i", self.video, "-pix_fmt", "gray", pattern], check=True)
        return pattern

    def feed(self, names):
        """Writes images into the folder as a camera does: in parts, and each under its final name."""
        for name in names:
            with open(self.path("images/" + name), "rb") as file:
                image = file.read()
            with open(self.path("live/" + name), "wb") as file:
                file.write(image[:len(image) // 2])
                file.flush()
                time.sleep(0.002)
                file.write(image[len(image) // 2:])

    def start(self, *more):
        """The running program with the folder `live`."""
        process = subprocess.Popen(
            [SWIRL, "track", "--live", self.path("live"), "--out", self.path("live.csv"), *map(str, more)],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, stdin=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        return process

    def check_same_tracks(self):
        with open(self.path("live.csv"), "rb") as one, open(self.batch_tracks, "rb") as other:
            self.assertEqual(one.read(), other.read())

    def test_a_growing_folder_gives_the_tracks_of_the_finished_video(self):
        self.make_images()
        names = sorted(os.listdir(self.path("images")))
        # The survey takes all frames, as that of the finished video does: bitwise the same.
        process = self.start("--survey", FRAMES, "--fps", 60, "--json", self.path("live.json"),
                             "--timeout", 60)
        feeder = threading.Thread(target=self.feed, args=(names,))
        feeder.start()
        feeder.join()
        # The program needs the time to read the folder; the tracks must have all frames.
        deadline = time.time() + 60
        said = ""
        while "of 20 discs" not in said and time.time() < deadline:
            said += process.stderr.readline()
        process.send_signal(signal.SIGINT)
        out, rest = process.communicate(timeout=100)
        self.assertEqual(process.returncode, 0, said + rest)
        self.assertIn("20 discs in %d frames" % FRAMES, out)
        self.check_same_tracks()
        with open(self.path("live.json"), encoding="utf-8") as file:
            live = json.load(file)["live"]
        self.assertEqual((live["surveyed_frames"], live["periods"]), (FRAMES, 2))
        # The rotation that was shown has the sign of that in the finished tracks, from the same velocities.
        measured = swirl("measure", self.batch_tracks, "--json", "-")
        rotation = json.loads(measured.stdout)["rotation"]["by_time"]["mean"]
        self.assertGreater(rotation * live["rotation"], 0.0)
        # The live value has the frames of two whole periods, the other one all: less than the mean of the two.
        self.assertLess(abs(rotation - live["rotation"]), 0.5 * abs(rotation))

    def test_a_short_survey_finds_the_same_discs(self):
        pattern = self.make_images("pgm")
        done = swirl("track", "--live", pattern, "--survey", 48, "--timeout", 0.3, "--fps", 60, "--quiet",
                     "--out", self.path("live.csv"))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.batch_tracks[:-4] + ".camera.json", encoding="utf-8") as file:
            claimed = json.load(file)["quality"]["position_error"]
        live, batch = table(self.path("live.csv")), table(self.batch_tracks)
        self.assertEqual([(row["frame"], row["particle"]) for row in live],
                         [(row["frame"], row["particle"]) for row in batch])
        square = sum((float(a[k]) - float(b[k])) ** 2 for a, b in zip(live, batch) for k in "xy")
        # Another survey gives another blur and radius, whose effect is within the claimed error.
        self.assertLess(math.sqrt(square / (2 * len(live))), claimed)

    def test_a_video_on_standard_input_is_tracked(self):
        piped = subprocess.run(["ffmpeg", "-v", "error", "-i", self.video, "-c", "copy", "-f",
                                "matroska", "-"], capture_output=True, check=True).stdout
        done = subprocess.run([SWIRL, "track", "--live", "-", "--survey", str(FRAMES), "--fps", "60", "--quiet",
                               "--out", self.path("live.csv")], input=piped, capture_output=True, timeout=100)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check_same_tracks()

    def test_the_browser_gets_images(self):
        self.make_images()
        process = self.start("--view", 0, "--timeout", 60, "--quiet")
        address = re.fullmatch(r"live images: http://(127\.0\.0\.1:\d+)/\n", process.stderr.readline())[1]
        connection = http.client.HTTPConnection(address, timeout=20)

        def get(path):
            connection.request("GET", path)
            answer = connection.getresponse()
            body = answer.read()
            connection.close()
            return answer.status, answer.getheader("Content-Type"), body

        self.assertEqual(get("/frame.jpg")[0], 503)  # none has arrived
        self.assertEqual(get("/other")[0], 404)
        self.assertIn(b"/stream.mjpg", get("/")[2])
        self.feed(sorted(os.listdir(self.path("images")))[:5])
        deadline = time.time() + 30
        while (answer := get("/frame.jpg"))[0] == 503 and time.time() < deadline:
            pass
        self.assertEqual(answer[:2], (200, "image/jpeg"))
        with open(self.path("frame.jpg"), "wb") as file:
            file.write(answer[2])
        pixels = subprocess.run(["ffmpeg", "-v", "error", "-xerror", "-i", self.path("frame.jpg"), "-f",
                                 "rawvideo", "-pix_fmt", "gray", "-"], capture_output=True, check=True).stdout
        self.assertEqual(len(pixels), 240 * 240)
        connection.request("GET", "/stream.mjpg")
        stream = connection.getresponse()
        self.assertEqual(stream.getheader("Content-Type"), "multipart/x-mixed-replace; boundary=frame")
        self.assertEqual(stream.readline(), b"--frame\r\n")
        self.assertEqual(stream.readline(), b"Content-Type: image/jpeg\r\n")
        length = int(re.fullmatch(rb"Content-Length: (\d+)\r\n", stream.readline())[1])
        self.assertEqual(stream.readline(), b"\r\n")
        image = stream.read(length)
        self.assertEqual((image[:2], image[-2:]), (b"\xff\xd8", b"\xff\xd9"))
        # Ctrl-C before the survey: nothing is written, and an open connection does not delay the end.
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 130, said)
        self.assertIn("nothing was written", said)
        self.assertFalse(os.path.exists(self.path("live.csv")))

    def test_a_missing_image_ends_the_tracking_with_a_warning(self):
        self.make_images()
        names = sorted(os.listdir(self.path("images")))
        self.feed(names[:60] + names[61:])
        process = self.start("--timeout", 0.5, "--quiet")
        _, said = process.communicate(timeout=100)
        self.assertEqual(process.returncode, 0, said)
        self.assertIn(f"{names[60]} did not arrive", said)
        self.assertEqual({int(row["frame"]) for row in table(self.path("live.csv"))}, set(range(60)))

    @slow("two more ends by the same code")
    def test_an_incomplete_image_is_not_used(self):
        self.make_images("jpg")
        names = sorted(os.listdir(self.path("images")))
        self.feed(names)
        os.truncate(self.path("live/" + names[70]), 1000)
        process = self.start("--timeout", 0.5, "--quiet")
        _, said = process.communicate(timeout=100)
        self.assertEqual(process.returncode, 0, said)
        self.assertIn(f"{names[70]} stayed incomplete", said)
        self.assertEqual({int(row["frame"]) for row in table(self.path("live.csv"))}, set(range(70)))

    def test_sources_without_frames_are_rejected_with_a_hint(self):
        live, out = self.path("live"), self.path("live.csv")
        with open(self.path("live/notes.txt"), "w", encoding="utf-8") as file:
            file.write("no image")
        with open(self.path("broken.png"), "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n" + 100 * b"x" + b"IEND\xaeB`\x82")
        os.mkdir(self.path("broken"))
        shutil.copy(self.path("broken.png"), self.path("broken/1.png"))
        for code, words, call in (
                (1, "there is no camera '/dev/video77'", ["--live", "/dev/video77"]),
                (1, "no image arrived", ["--live", live, "--timeout", 0.2]),
                (1, "no readable frames", ["--live", self.path("broken"), "--timeout", 0.2]),
                (1, "no camera or folder", ["--live", self.path("none")]),
                (1, "no readable frames", ["--live", "-"]),
                (2, "must be a camera", ["--live", self.path("broken.png")]),
                (2, "live images must be PNG", ["--live", self.path("%d.tif")]),
                (2, "cannot be tracked as well", ["--live", live, self.path("broken.png")]),
                (2, "exclude each other", ["--live", live, "--spin"]),
                (2, "from 0 to 65535", ["--live", live, "--view", 70000]),
                (2, "must be from 8", ["--live", live, "--survey", 3]),
                (2, "above 0", ["--live", live, "--timeout", 0]),
                (2, "--view needs --live", [self.path("broken.png"), "--view", 0]),
                (2, "missing required argument VIDEO", [])):
            with self.subTest(call):
                done = swirl("track", *call, "--out", out, "--quiet")
                self.assertEqual(done.returncode, code, done.stderr)
                self.assertIn(words, done.stderr)
                self.assertRegex(done.stderr, r"\Aerror: [^\n]+\n(hint: [^\n]+\n)?\Z")
                self.assertFalse(os.path.exists(out))
        # A port that another program uses.
        first = self.start("--view", 0, "--timeout", 60, "--quiet")
        port = re.search(r":(\d+)/", first.stderr.readline())[1]
        done = swirl("track", "--live", live, "--view", port, "--out", out, "--quiet")
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"cannot listen on port {port}", done.stderr)
        first.send_signal(signal.SIGINT)
        first.communicate(timeout=60)


if __name__ == "__main__":
    main()
