"""Images and movies of tracks, drawn over the camera's frames.

The test writes grey frames of bright discs at known positions and a trackpy table of these
positions. The outlines that swirl draws must coincide with the discs.
"""

import math
import os
import struct
import subprocess
import unittest
import zlib

from program import InFolder, swirl

WIDTH, HEIGHT = 240, 200
SCALE = 10.0  # pixels per disc radius
CENTRE = (118.4, 101.3)  # of the container's path
RADIUS, AMPLITUDE = 7.0, 1.5  # of the container, in disc radii
CAMERA_FPS, OMEGA = 40.0, 2.0 * math.pi  # forty frames per period
PHASE = 30.0
BRIGHT = 0.6  # radius of a disc's bright centre, in disc radii; lies within the outline
SIDE = 500  # of the output images, in pixels
RING = (0x7F, 0xA6, 0xCC)  # colour of discs in the dark theme


def write_png(path, rows, width):
    """Write a grey image; rows are bytes objects with one byte per pixel."""

    def chunk(kind, data):
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    with open(path, "wb") as file:
        file.write(
            b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 0, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 1))
            + chunk(b"IEND", b"")
        )


def read_png(path, side):
    """The pixels of a square image: (x, y, red, green, blue)."""
    raw = subprocess.run(
        ["ffmpeg", "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
        capture_output=True,
        check=True,
    ).stdout
    assert len(raw) == 3 * side * side
    for k in range(side * side):
        yield (k % side, k // side, *raw[3 * k : 3 * k + 3])


def positions(frame, clockwise=False):
    """Positions of the discs in pixels, y down. The first moves on its own circle; the others are
    at rest relative to the container."""
    turn = math.radians(PHASE) + OMEGA * frame / CAMERA_FPS
    mirror = -1.0 if clockwise else 1.0
    x, y = CENTRE

    def pixel(px, py):
        return x + mirror * SCALE * px, y - SCALE * py

    cx, cy = AMPLITUDE * math.cos(turn), AMPLITUDE * math.sin(turn)
    found = [pixel(cx + 2.2 * math.cos(-0.7 * turn), cy + 2.2 * math.sin(-0.7 * turn))]
    found += [pixel(cx + 5.6 * math.cos(a), cy + 5.6 * math.sin(a)) for a in (0.4, 1.7, 3.9)]
    return found


def write_image(path, discs):
    rows = [bytearray([70] * WIDTH) for _ in range(HEIGHT)]
    for px, py in discs:
        reach = BRIGHT * SCALE
        for y in range(int(py - reach) - 1, int(py + reach) + 3):
            for x in range(int(px - reach) - 1, int(px + reach) + 3):
                inside = min(max(reach + 0.5 - math.hypot(x - px, y - py), 0.0), 1.0)
                if inside > 0.0:
                    rows[y][x] = max(rows[y][x], round(70 + 170 * inside))
    write_png(path, rows, WIDTH)


def middle(points):
    return (sum(x for x, _ in points) / len(points), sum(y for _, y in points) / len(points))


class CameraTest(InFolder):
    def record(self, frames, clockwise=False, lose=None, first=0):
        """Write frames and tracks; disc 0 is missing from frame `lose` on."""
        os.makedirs(self.path("seen"), exist_ok=True)
        with open(self.path("tracks.csv"), "w", encoding="utf-8") as table:
            table.write("frame,particle,x,y\n")
            for frame in range(frames):
                discs = positions(frame, clockwise)
                write_image(self.path(f"seen/{frame + first:04d}.png"), discs)
                for k, (x, y) in enumerate(discs):
                    if not (k == 0 and lose is not None and frame >= lose):
                        table.write(f"{frame},{k},{x!r},{y!r}\n")

    def call(self, command, *more, over=True):
        # --phase is the angle in the mirrored image.
        phase = 180.0 - PHASE if "--clockwise" in more else PHASE
        arguments = [
            command,
            self.path("tracks.csv"),
            "--camera-fps",
            CAMERA_FPS,
            "--scale",
            SCALE,
            "--omega",
            OMEGA,
            "--centre",
            "%g,%g" % CENTRE,
            "--phase",
            phase,
            "--amplitude",
            AMPLITUDE,
            "--container-radius",
            RADIUS,
            "--size",
            f"{SIDE}x{SIDE}",
            "--theme",
            "dark",
        ]  # the page is no bright blob
        if "--color" not in more:
            arguments += ["--color", "none"]
        if over:
            arguments += ["--over", self.path("seen/%04d.png")]
        return swirl(*arguments, *more)

    def assert_good(self, result):
        self.assertEqual(result.returncode, 0, result.stderr)

    def assert_usage_error(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, r"\A[^\n]+\.\n(hint: [^\n]+\.\n)?\Z")
        for word in words:
            self.assertIn(word, result.stderr)

    def assert_outlines_lie_on_the_discs(self, path, count=4):
        """Each bright grey blob is at the centre of a ring in the discs' colour."""
        bright, ring = set(), set()
        for x, y, red, green, blue in read_png(path, SIDE):
            if red == green == blue and red > 155:  # half height of its edge
                bright.add((x, y))
            elif (red, green, blue) == RING:
                ring.add((x, y))
        blobs = []
        while bright:
            blob, open_ends = [], [bright.pop()]
            while open_ends:
                x, y = open_ends.pop()
                blob.append((x, y))
                for near in ((x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)):
                    if near in bright:
                        bright.remove(near)
                        open_ends.append(near)
            if len(blob) > 500:  # not a part of the wall
                blobs.append(blob)
        self.assertEqual(len(blobs), count)
        offsets = []
        for blob in blobs:
            x, y = middle(blob)
            reach = math.sqrt(len(blob) / math.pi)
            around = [(a, b) for a, b in ring if math.hypot(a - x, b - y) < reach / BRIGHT + 5.0]
            self.assertGreater(len(around), 60)
            ring_x, ring_y = middle(around)
            offsets.append((ring_x - x, ring_y - y))
            # Few pixels of a ring have its exact colour, so its centre is known to a few tenths of
            # a pixel.
            self.assertLess(math.hypot(*offsets[-1]), 0.9)
            radius = sum(math.hypot(a - x, b - y) for a, b in around) / len(around)
            self.assertLess(abs(radius - reach / BRIGHT), 0.7)
        # A camera pixel has 2.7 output pixels. An error of half a camera pixel, the usual mistake,
        # would shift all rings by 1.9.
        self.assertLess(math.hypot(*middle(offsets)), 0.35)

    def test_outlines_coincide_with_the_discs(self):
        for clockwise in (False, True):
            self.record(14, clockwise)
            for frame in ("laboratory", "m"):
                out = self.path("x.png")
                self.assert_good(
                    self.call(
                        "image",
                        "--view",
                        frame,
                        "--start",
                        0.31,
                        "--no-annotations",
                        "--out",
                        out,
                        *(["--clockwise"] if clockwise else []),
                    )
                )
                self.assert_outlines_lie_on_the_discs(out)

    def test_movie_shows_each_camera_frame_once(self):
        self.record(7, first=100)
        self.assert_good(
            self.call(
                "movie",
                "--over-first",
                100,
                "--no-annotations",
                "--frame-files",
                self.path("made"),
                "--fps",
                30,
            )
        )
        names = sorted(os.listdir(self.path("made")))
        self.assertEqual(len(names), 7)
        for name in (names[0], names[6]):
            self.assert_outlines_lie_on_the_discs(self.path("made/" + name))

    def test_movie_of_tracks_without_camera_frames(self):
        self.record(7)
        out = self.path("x.mp4")
        result = self.call(
            "movie",
            "--pace",
            0.5,
            "--fps",
            20,
            "--trails",
            "--plot",
            "--view",
            "both",
            "--out",
            out,
            over=False,
        )
        self.assert_good(result)
        self.assertIn("no orientation", result.stderr)
        frames = subprocess.run(
            [
                "ffprobe",
                "-v",
                "error",
                "-count_frames",
                "-of",
                "csv=p=0",
                "-show_entries",
                "stream=nb_read_frames",
                out,
            ],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        self.assertEqual(frames.strip(), "7")  # 6/40 of a period, 1/40 of a period each

    def test_video_and_its_frames_give_equal_movies(self):
        self.record(6)
        subprocess.run(
            [
                "ffmpeg",
                "-v",
                "error",
                "-framerate",
                "10",
                "-i",
                self.path("seen/%04d.png"),
                "-c:v",
                "ffv1",
                "-pix_fmt",
                "gray",
                self.path("seen.avi"),
            ],
            check=True,
        )
        made = []
        for images in ("seen/%04d.png", "seen.avi"):
            folder = self.path("made-" + images[-3:])
            self.assert_good(
                self.call("movie", "--over", self.path(images), "--frame-files", folder, over=False)
            )
            frames = []
            for name in sorted(os.listdir(folder)):
                with open(os.path.join(folder, name), "rb") as file:
                    frames.append(file.read())
            made.append(frames)
        self.assertEqual(len(made[0]), 6)
        self.assertTrue(made[0] == made[1])
        subprocess.run(
            [
                "ffmpeg",
                "-v",
                "error",
                "-i",
                self.path("seen.avi"),
                "-frames:v",
                "4",
                "-c",
                "copy",
                self.path("short.avi"),
            ],
            check=True,
        )
        short = self.call(
            "movie", "--over", self.path("short.avi"), "--out", self.path("x.mp4"), over=False
        )
        self.assertEqual(short.returncode, 1)
        self.assertIn("there are no more images", short.stderr)

    def test_jpeg_frames_are_read(self):
        self.record(5)
        subprocess.run(
            [
                "ffmpeg",
                "-v",
                "error",
                "-i",
                self.path("seen/%04d.png"),
                "-q:v",
                "1",
                "-start_number",
                "0",
                self.path("seen/%04d.jpg"),
            ],
            check=True,
        )
        self.assert_good(
            self.call(
                "image",
                "--start",
                0.05,
                "--no-annotations",
                "--over",
                self.path("seen/%04d.jpg"),
                "--out",
                self.path("x.png"),
                over=False,
            )
        )
        self.assertGreater(
            sum(red > 220 for _, _, red, _, _ in read_png(self.path("x.png"), SIDE)), 2000
        )

    def test_tracks_may_begin_and_end(self):
        self.record(14, lose=9)
        out = self.path("x.png")
        self.assert_good(self.call("image", "--trails", "--start", 0.3, "--out", out))
        self.assert_good(
            self.call("movie", "--trails", "--color", "id", "--plot", "--out", self.path("x.mp4"))
        )
        every = self.call("image", "--color", "pinned", "--start", 0.1, "--out", out)
        self.assert_usage_error(every, "the same discs in every frame")
        self.record(14)
        few = self.call("image", "--color", "pinned", "--start", 0.1, "--out", out)
        self.assert_good(few)
        self.assertIn("40 frames per period", few.stderr)

    def test_invalid_options_are_rejected(self):
        self.record(3)
        out = self.path("x.png")
        wrong = self.assert_usage_error
        wrong(self.call("image", "--color", "spin", "--out", out), "no spins")
        wrong(self.call("image", "--discs", 4, "--out", out), "--discs")
        wrong(self.call("image", "--compare", 4, "--out", out), "--compare")
        wrong(self.call("image", "--over", "seen.png", "--out", out, over=False), "%05d")
        wrong(self.call("image", "--over", "%d/%d.png", "--out", out, over=False), "%05d")
        wrong(self.call("image", "--start", 5, "--out", out), "5")
        wrong(swirl("image", "--over", "%d.png", "--out", out), "--over", "no FILE")
        wrong(swirl("image", self.path("tracks.csv"), "--out", out), "--omega")
        wrong(
            swirl("image", self.path("tracks.csv"), "--omega", 1, "--out", out),
            "--container-radius",
        )
        missing = self.call("movie", "--over-first", 7, "--out", self.path("x.mp4"))
        self.assertEqual(missing.returncode, 1)
        self.assertIn("0007.png", missing.stderr)
        self.assertEqual(self.left_behind(), ["seen", "tracks.csv"])

    def test_unreadable_frames_are_reported_by_name(self):
        self.record(5)
        with open(self.path("seen/0002.png"), "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\nrest missing")
        out = self.path("x.mp4")
        result = self.call("movie", "--out", out)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("0002.png", result.stderr)
        os.remove(self.path("seen/0002.png"))
        result = self.call("movie", "--out", out)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("0002.png", result.stderr)
        with open(self.path("no.avi"), "w", encoding="utf-8") as file:
            file.write("this is no video")
        result = self.call("movie", "--over", self.path("no.avi"), "--out", out, over=False)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("no.avi", result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertNotIn("x.mp4", self.left_behind())


if __name__ == "__main__":
    unittest.main()
