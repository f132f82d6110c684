"""swirl image and the movies of swirl paper, as a user calls them."""

import os
import resource
import signal
import struct
import subprocess
import unittest

from program import HANG, SWIRL, InFolder, read_bytes, wait_until, write_text


def swirl(*arguments):
    return subprocess.run([SWIRL, *arguments], capture_output=True, text=True, timeout=HANG)


def contents(path):
    return read_bytes(path)


class ImageTest(InFolder):
    def test_every_format_is_reproducible(self):
        for ending, signature in (("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")):
            both = []
            for name in ("one.", "two."):
                out = self.path(name + ending)
                result = swirl(
                    "image",
                    "--discs",
                    "28",
                    "--start",
                    "3.3",
                    "--view",
                    "both",
                    "--color",
                    "pinned",
                    "--trails",
                    "--size",
                    "400x240",
                    "--theme",
                    "light",
                    "--out",
                    out,
                )
                self.assertEqual(result.returncode, 0, result.stderr)
                both.append(contents(out))
            self.assertTrue(both[0].startswith(signature))
            self.assertTrue(both[0] == both[1], ending)

    def test_png_has_the_given_size(self):
        result = swirl(
            "image", "--discs", "5", "--start", "0", "--size", "123x77", "--out", self.path("x.png")
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(struct.unpack(">II", contents(self.path("x.png"))[16:24]), (123, 77))

    def test_the_report_says_since_when_turns_are_counted(self):
        for more, said in (
            (("--start", "25"), r"period 25, 64x64 pixels, turns since period 15\.\n\Z"),
            (("--start", "4"), r", turns since period 0\.\n\Z"),
            (("--color", "spin"), r"64x64 pixels\.\n\Z"),  # without turns
        ):
            result = swirl(
                "image", "--discs", "5", "--size", "64x64", *more, "--out", self.path("x.png")
            )
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stdout, said)

    def test_invalid_options_are_rejected(self):
        out = self.path("x.png")
        for arguments, word in (
            ((), "--out"),
            (("--out", self.path("x.bmp")), ".svg"),
            (("--out", out, "--start", "-1"), "-1"),
            (("--out", out, "--start", "nan"), "nan"),
            (("--out", out, "--strobe", "0"), "--strobe is 0"),
            (("--out", out, "--start", "-9", "--strobe", "30"), "-9"),
            (("--out", out, "--every", "0"), "0"),
            (("--out", out, "--turned-angle", "--view", "m"), "--view"),
            (("--out", out, "--angles"), "--view"),
            (("--out", out, "--trail-length", "0"), "--trail-length"),
            (("--out", out, "--rolling-ball", "1", "--compare", "3"), "--compare"),
            (("--out", out, "--rolling-ball", "1", "--ball-radius", "9"), "9"),
        ):
            result = swirl("image", *arguments)
            self.assertEqual(result.returncode, 2, (arguments, result.stderr))
            self.assertIn(word, result.stderr)
            self.assertRegex(result.stderr, r"\A[^\n]+\.\n(hint: [^\n]+\.\n)?\Z")
        self.assertEqual(os.listdir(self.folder), [])

    def test_image_is_written_atomically_and_not_through_a_link(self):
        write_text(self.path("mine"), "of another user")
        for ending in ("png", "svg", "pdf"):
            out = self.path("x." + ending)
            os.symlink(self.path("mine"), out + ".partial")
            call = ("image", "--discs", "5", "--start", "0", "--size", "64x64", "--quiet", "--out")
            result = swirl(*call, out)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(contents(self.path("mine")), b"of another user", ending)
            os.remove(out + ".partial")
            result = swirl(*call, self.path("no/such/folder." + ending))
            self.assertEqual(result.returncode, 1)
            self.assertIn("no/such/folder", result.stderr)
            limited = subprocess.run(
                [SWIRL, *call, self.path("y." + ending)],
                capture_output=True,
                text=True,
                timeout=HANG,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100)),
            )
            self.assertEqual(limited.returncode, 1, limited.stderr)
            self.assertIn("File too large", limited.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), ["mine", "x.pdf", "x.png", "x.svg"])

    def test_invalid_recording_is_an_error(self):
        write_text(self.path("x.h5"), "hello")
        result = swirl("image", self.path("x.h5"), "--out", self.path("x.png"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("x.h5", result.stderr)

    def test_movies_of_the_paper_are_made_once(self):
        call = [SWIRL, "paper", "--movies", "--quick", "--quiet", "--out", self.folder]
        # Stop after some movies and damage one of them: only that one is made again.
        process = subprocess.Popen(call, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        parts = self.path("parts")

        def complete():
            """A movie is complete when its part is stored; a part that is being written has another
            ending."""
            return (
                sorted(
                    name[len("movie-") : -len(".json")] + ".mp4"
                    for name in os.listdir(parts)
                    if name.endswith(".json")
                )
                if os.path.isdir(parts)
                else []
            )

        wait_until(lambda: len(complete()) >= 2, process)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=HANG)
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn("the same call makes the others", errors)
        self.assertNotIn("movies.html", os.listdir(self.folder))
        done = complete()
        with open(self.path(done[0]), "r+b") as file:
            file.truncate(100)
        before = {name: os.stat(self.path(name)).st_mtime_ns for name in done}
        result = subprocess.run(call, capture_output=True, text=True, timeout=HANG)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(f"{len(done) - 1} of 16 movies are from an earlier call", result.stdout)
        for name in done:
            is_old = os.stat(self.path(name)).st_mtime_ns == before[name]
            self.assertEqual(is_old, name != done[0])
        self.assertGreater(os.path.getsize(self.path(done[0])), 1000)

        page = contents(self.path("movies.html")).decode()
        movies = [name for name in os.listdir(self.folder) if name.endswith(".mp4")]
        self.assertEqual(len(movies), 16)
        for name in movies:
            self.assertEqual(page.count(f'src="{name}"'), 1)
        self.assertEqual(page.count("<figcaption>"), 16)
        for system in ("all-friction", "no-disc-friction", "no-wall-friction"):
            for frame in ("lab-frame", "m-frame"):
                for case in ("rotating", "counterrotating"):
                    self.assertIn(f"numerical-{frame}-{system}-{case}.mp4", movies)
        for frame in ("lab-frame", "m-frame"):
            for case in ("no-slip", "slip"):
                self.assertIn(f"minimal-model-{frame}-{case}.mp4", movies)
        frames = subprocess.run(
            [
                "ffprobe",
                "-v",
                "error",
                "-count_frames",
                "-of",
                "csv=p=0",
                "-show_entries",
                "stream=width,height,nb_read_frames,duration",
                self.path(movies[0]),
            ],
            capture_output=True,
            text=True,
            check=True,
        ).stdout.strip()
        self.assertEqual(frames, "360,360,3.000000,90")


if __name__ == "__main__":
    unittest.main()
