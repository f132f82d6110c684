"""swirl movie, as a user calls it."""

import glob
import os
import re
import shlex
import shutil
import signal
import struct
import subprocess
import time
import unittest

from program import HANG, SOURCE, SWIRL, InFolder, read_bytes, read_text, wait_until, write_text

# One message, and an optional hint on a second line.
ONE_ERROR = r"\A[^\n]+\.\n(hint: [^\n]+\.\n)?\Z"


def commands_in_the_documents():
    """The words of every command in the README and in docs/, on a line of its own or in
    backquotes."""
    for path in [
        os.path.join(SOURCE, "README.md"),
        *sorted(glob.glob(os.path.join(SOURCE, "docs", "**", "*.md"), recursive=True)),
    ]:
        text = read_text(path).replace("\\\n", " ")
        for command in re.findall(r"(?:^|`)((?:(?:\./)?swirl|ffmpeg|node) [^`\n]+)", text, re.M):
            yield shlex.split(command.replace("…", ""), comments=True)


def swirl(*arguments, **more):
    return subprocess.run(
        [SWIRL, "movie", *arguments], capture_output=True, text=True, timeout=HANG, **more
    )


def probe(path, entries):
    return subprocess.run(
        [
            "ffprobe",
            "-v",
            "error",
            "-count_frames",
            "-select_streams",
            "v:0",
            "-of",
            "csv=p=0",
            "-show_entries",
            entries,
            path,
        ],
        capture_output=True,
        text=True,
        check=True,
    ).stdout.strip()


def png_size(path):
    with open(path, "rb") as file:
        head = file.read(24)
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", head[16:24])


class MovieTest(InFolder):
    def assert_usage_error(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, ONE_ERROR)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def test_count_and_duration_are_exact(self):
        out = self.path("x.mp4")
        result = swirl(
            "--discs",
            "12",
            "--seconds",
            "0.7",
            "--fps",
            "30",
            "--size",
            "320x180",
            "--start",
            "1",
            "--view",
            "both",
            "--plot",
            "--out",
            out,
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(
            probe(out, "stream=width,height,r_frame_rate,duration,nb_read_frames"),
            "320,180,30/1,0.700000,21",
        )
        self.assertIn("frames      21, 30 per second", result.stdout)

    def test_duration_in_periods(self):
        out = self.path("x.mp4")
        result = swirl(
            "--discs",
            "12",
            "--periods",
            "0.25",
            "--pace",
            "0.5",
            "--fps",
            "20",
            "--size",
            "64x64",
            "--start",
            "0",
            "--out",
            out,
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(probe(out, "stream=duration,nb_read_frames"), "0.500000,10")

    def test_bytes_do_not_depend_on_the_number_of_cores(self):
        # With another number of cores, frames are distributed differently to the workers.
        for ending, fps in (("mp4", "60"), ("webm", "60"), ("gif", "50")):
            both = []
            for name, cores in (
                ("one.", {min(os.sched_getaffinity(0))}),
                ("two.", os.sched_getaffinity(0)),
            ):
                out = self.path(name + ending)
                result = swirl(
                    "--discs",
                    "20",
                    "--seconds",
                    "0.3",
                    "--fps",
                    fps,
                    "--size",
                    "320x240",
                    "--start",
                    "1",
                    "--trails",
                    "--color",
                    "spin",
                    "--out",
                    out,
                    preexec_fn=lambda cores=cores: os.sched_setaffinity(0, cores),
                )
                self.assertEqual(result.returncode, 0, result.stderr)
                both.append(read_bytes(out))
            self.assertTrue(both[0] == both[1], ending)

    def test_frames_need_no_ffmpeg(self):
        result = swirl(
            "--discs",
            "5",
            "--seconds",
            "0.1",
            "--fps",
            "30",
            "--size",
            "65x33",
            "--start",
            "0",
            "--frame-files",
            self.path("frames"),
            env={**os.environ, "PATH": self.folder},
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        names = sorted(os.listdir(self.path("frames")))
        self.assertEqual(names, [f"frame-{k:06d}.png" for k in (1, 2, 3)])
        self.assertEqual(png_size(self.path("frames/frame-000001.png")), (65, 33))

    def test_tiny_and_huge_movies_in_both_themes(self):
        for size, theme, more in (
            ("16x16", "light", ["--view", "both", "--plot", "--trails"]),
            ("16x4096", "dark", ["--view", "m", "--forces", "--plot"]),
            ("3840x2160", "light", ["--view", "both", "--color", "speed"]),
        ):
            out = self.path("x.mp4")
            result = swirl(
                "--discs",
                "12",
                "--seconds",
                "0.1",
                "--fps",
                "20",
                "--start",
                "1",
                "--size",
                size,
                "--theme",
                theme,
                "--out",
                out,
                *more,
            )
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(
                probe(out, "stream=width,height,nb_read_frames"), size.replace("x", ",") + ",2"
            )

    def test_animations_of_the_readme_are_made_by_the_documented_commands(self):
        self.assertIn("](docs/images/swirl.gif)", read_text(os.path.join(SOURCE, "README.md")))
        # Ten seconds; the GIF has the width of a phone, so that its captions can be read there.
        for name, wanted in (
            ("swirl.gif", "gif,390,146,10/1,100"),
            ("swirl.mp4", "h264,720,270,20/1,200"),
        ):
            (call,) = [
                words[1:]
                for words in commands_in_the_documents()
                if words[1] == "movie" and f"docs/images/{name}" in words
            ]
            made = self.path(name)
            stored = os.path.join(SOURCE, "docs", "images", name)
            call[call.index(f"docs/images/{name}")] = made
            result = subprocess.run([SWIRL, *call], capture_output=True, text=True, timeout=HANG)
            self.assertEqual(result.returncode, 0, result.stderr)
            entries = "stream=codec_name,width,height,r_frame_rate,nb_read_frames"
            self.assertEqual(probe(made, entries), wanted)
            self.assertEqual(probe(stored, entries), wanted)
            self.assertLess(max(os.path.getsize(made), os.path.getsize(stored)), 1e6)
            self.assert_looks_like(made, stored)

    def test_a_movie_with_the_defaults_is_small(self):
        out = self.path("x.mp4")
        result = swirl("--discs", "48", "--size", "1280x720", "--seconds", "2", "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        # Ten seconds take less than 3 MB. The first frame is a part of both.
        self.assertLess(os.path.getsize(out), 0.62e6)

    def assert_looks_like(self, made, stored):
        """Fonts and versions of cairo may differ, so images are compared by their signal-to-noise
        ratio. Moved discs reduce it below 25 dB."""
        seen = subprocess.run(
            ["ffmpeg", "-v", "info", "-i", made, "-i", stored, "-lavfi", "psnr", "-f", "null", "-"],
            capture_output=True,
            text=True,
            check=True,
        ).stderr
        found = re.search(r"PSNR.* min:(\S+)", seen)
        self.assertGreater(
            float(found.group(1)), 25.0, f"{stored} is out of date: repeat the documented command"
        )

    def test_every_image_of_the_documents_has_a_documented_command(self):
        made = set()
        for words in commands_in_the_documents():
            made |= {os.path.basename(word) for word in words if word.startswith("docs/images/")}
            if "--figure" in words:
                made |= {f"figure_{word}.png" for word in words}
            # A script of paper/ that draws on its own.
            made |= {
                f"{name}.png" for word in words for name in re.findall(r"^paper/(\w+)\.py$", word)
            }
        made |= self.screenshots()
        # The gallery has the command next to the name of the image.
        gallery = read_text(os.path.join(SOURCE, "web", "gallery.txt"))
        made |= {
            os.path.basename(row[2])
            for row in (line.split(" | ") for line in gallery.splitlines())
            if len(row) == 3
        }
        stored = {
            name
            for name in os.listdir(os.path.join(SOURCE, "docs", "images"))
            if name.endswith((".png", ".gif"))
        }
        self.assertGreater(len(stored), 5)
        self.assertEqual(stored - made, set())

    @staticmethod
    def screenshots():
        """The images of the browser page, which docs/how-to/browser_page.md makes with one
        command."""
        with open(os.path.join(SOURCE, "web", "test", "screenshots.mjs"), encoding="utf-8") as file:
            states = re.findall(r'^    \[\s*"(\w+)",\s*"', file.read(), re.MULTILINE)
        return {f"lab_{state}.png" for state in states}

    def test_images_are_made_by_the_documented_commands(self):
        calls = {
            tuple(words[1:])
            for words in commands_in_the_documents()
            if words[1] == "image" and words[-1].startswith("docs/images/")
        }
        self.assertGreater(len(calls), 3)
        for call in calls:
            with self.subTest(call[-1]):
                made = self.path(os.path.basename(call[-1]))
                result = subprocess.run(
                    [SWIRL, *call[:-1], made], capture_output=True, text=True, timeout=HANG
                )
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assert_looks_like(made, os.path.join(SOURCE, call[-1]))

    def test_second_movie_with_the_same_name_is_rejected(self):
        out = self.path("m.mp4")
        long = [SWIRL, "movie", "--seconds", "600", "--size", "160x160", "--out", out, "--quiet"]
        first = subprocess.Popen(long, stderr=subprocess.DEVNULL)
        self.addCleanup(first.wait)
        self.addCleanup(first.kill)
        while not os.path.exists(out + ".partial"):
            self.assertIsNone(first.poll())
            time.sleep(0.01)
        time.sleep(0.2)
        second = swirl("--seconds", "0.1", "--size", "160x160", "--out", out, "--quiet")
        self.assertEqual(second.returncode, 1)
        self.assertIn("is being made by another process", second.stderr)
        first.kill()
        first.wait()
        # Files left behind by the killed process do not prevent another movie.
        again = swirl("--seconds", "0.1", "--size", "160x160", "--out", out, "--quiet")
        self.assertEqual(again.returncode, 0, again.stderr)

    def test_encoder_of_a_killed_process_does_not_write_into_the_next_movie(self):
        # This encoder sleeps until the next movie has opened its file and written the first frames.
        os.mkdir(self.path("slow"))
        write_text(
            self.path("slow/ffmpeg"),
            "#!/bin/sh\ntouch begun\nwhile ! [ -e wake ]; do sleep 0.01; done\n"
            f'{shutil.which("ffmpeg")} "$@"\ntouch asleep\n',
        )
        os.chmod(self.path("slow/ffmpeg"), 0o755)
        out = self.path("m.mp4")
        call = ["--seconds", "6", "--size", "640x640", "--quiet", "--out", out]
        killed = subprocess.Popen(
            [SWIRL, "movie", *call],
            cwd=self.folder,
            env={**os.environ, "PATH": self.path("slow") + ":" + os.environ["PATH"]},
        )
        wait_until(
            lambda: os.path.exists(out + ".partial") and os.path.exists(self.path("begun")), killed
        )
        killed.kill()
        killed.wait()
        second = subprocess.Popen([SWIRL, "movie", *call])
        self.addCleanup(second.wait)
        self.addCleanup(second.kill)
        wait_until(
            lambda: os.path.exists(out + ".partial") and os.path.getsize(out + ".partial") > 50_000,
            second,
        )
        open(self.path("wake"), "w").close()
        wait_until(lambda: os.path.exists(self.path("asleep")))
        self.assertIsNone(second.poll(), "the second movie ended before the first encoder woke up")
        self.assertEqual(second.wait(timeout=HANG), 0)
        self.assertEqual(probe(out, "stream=nb_read_frames"), "360")

    def test_missing_ffmpeg_is_an_error_with_a_hint(self):
        result = swirl(
            "--discs",
            "5",
            "--seconds",
            "0.1",
            "--out",
            self.path("x.mp4"),
            env={**os.environ, "PATH": self.folder},
        )
        self.assertEqual(result.returncode, 1)
        self.assertIn("apt-get install ffmpeg", result.stderr)
        self.assertEqual(os.listdir(self.folder), [])

    def test_ctrl_c_completes_the_movie(self):
        for ending in ("mp4", "webm", "gif"):
            with self.subTest(ending):
                self.stop_a_movie("x." + ending)
                os.remove(self.path("x." + ending))

    def stop_a_movie(self, name):
        out = self.path(name)
        # A separate process group, as a shell creates it: the signal reaches all its processes.
        process = subprocess.Popen(
            [
                SWIRL,
                "movie",
                "--discs",
                "48",
                "--seconds",
                "400",
                "--fps",
                "50",
                "--size",
                "160x120",
                "--start",
                "0",
                "--out",
                out,
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            process_group=0,
        )
        # The palette of a GIF depends on all frames, so its file is empty until the end.
        min_size = 0 if name.endswith(".gif") else 1
        wait_until(
            lambda: os.path.exists(out + ".partial")
            and os.path.getsize(out + ".partial") >= min_size,
            process,
        )
        time.sleep(0.2)
        # Two signals in a row, as timeout(1) sends them.
        os.killpg(process.pid, signal.SIGINT)
        os.killpg(process.pid, signal.SIGINT)
        _, errors = process.communicate(timeout=HANG)
        self.assertEqual(process.returncode, 130, errors)
        self.assertRegex(errors, r"stopped after \d+ of 20000 frames")
        frames = int(errors.split("stopped after ")[1].split()[0])
        self.assertEqual(int(probe(out, "stream=nb_read_frames")), frames)
        self.assertEqual(os.listdir(self.folder), [name])

    def test_failing_ffmpeg_is_an_error(self):
        os.mkdir(self.path("bin"))
        script = self.path("bin/ffmpeg")
        write_text(script, "#!/bin/sh\nhead -c 1000 >/dev/null\necho 'out of paint' >&2\nexit 4\n")
        os.chmod(script, 0o755)
        result = swirl(
            "--discs",
            "5",
            "--seconds",
            "5",
            "--size",
            "320x240",
            "--out",
            self.path("x.mp4"),
            env={**os.environ, "PATH": self.path("bin") + ":" + os.environ["PATH"]},
        )
        self.assertEqual(result.returncode, 1)
        self.assertIn("out of paint", result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1)
        self.assertEqual(os.listdir(self.folder), ["bin"])

    def test_invalid_options_are_rejected(self):
        out = self.path("x.mp4")
        self.assert_usage_error(swirl(), "--out", "--frame-files")
        self.assert_usage_error(swirl("--out", self.path("x.avi")), "x.avi", ".webm")
        self.assert_usage_error(swirl("--out", out, "--size", "12"), "'12'")
        self.assert_usage_error(swirl("--out", out, "--size", "8x8"), "'8x8'")
        self.assert_usage_error(swirl("--out", out, "--size", "99999x99999"), "99999")
        self.assert_usage_error(swirl("--out", out, "--size", "101x100"), "even")
        self.assert_usage_error(swirl("--out", out, "--fps", "0"), "--fps is 0")
        self.assert_usage_error(swirl("--out", out, "--fps", "59.94"), "'59.94'", "whole number")
        self.assert_usage_error(swirl("--out", out, "--seconds", "long"), "'long'", "a number")
        self.assert_usage_error(swirl("--out", out, "--trail-length", "0"), "--trail-length")
        self.assert_usage_error(swirl("--out", self.path("x.gif"), "--fps", "30"), "hundredths")
        self.assert_usage_error(swirl("--out", out, "--seconds", "0"), "0 seconds")
        self.assert_usage_error(swirl("--out", out, "--seconds", "nan"))
        self.assert_usage_error(
            swirl("--out", out, "--seconds", "1", "--periods", "1"), "--periods"
        )
        self.assert_usage_error(swirl("--out", out, "--pace", "-1"))
        self.assert_usage_error(swirl("--out", out, "--start", "-3"), "-3")
        self.assert_usage_error(swirl("--out", out, "--view", "n"), "'n'", "both")
        self.assert_usage_error(swirl("--out", out, "--color", "red"), "'red'", "pinned")
        self.assert_usage_error(swirl("--out", out, "--theme", "x"), "'x'")
        self.assert_usage_error(swirl("--out", out, "--forces"), "--view m")
        self.assert_usage_error(swirl("--out", out, "--discs", "70"))
        self.assert_usage_error(swirl("--out", out, "--compare", "70"))
        for wrong in ("8,", "x", "0", "1,2,3,4,5,6"):
            self.assert_usage_error(swirl("--out", out, "--compare", wrong), "--compare", wrong)
        self.assert_usage_error(
            swirl("--out", out, "--captions-only", "--title", "x"), "--captions-only"
        )
        self.assert_usage_error(swirl("--out", out, "--rolling-ball", "2"), "2")
        self.assert_usage_error(
            swirl("--out", self.path("x.gif"), "--seconds", "600", "--size", "1920x1080"), "memory"
        )

    def test_recording_is_shown_to_its_end(self):
        run = subprocess.run(
            [
                SWIRL,
                "run",
                "--discs",
                "10",
                "--periods",
                "2",
                "--quiet",
                "--trajectory",
                self.path("run.h5"),
            ],
            capture_output=True,
            text=True,
        )
        self.assertEqual(run.returncode, 0, run.stderr)
        out = self.path("x.mp4")
        result = swirl(
            self.path("run.h5"), "--pace", "2", "--fps", "20", "--size", "64x64", "--out", out
        )
        self.assertEqual(result.returncode, 0, result.stderr)
        # Two periods at two per second: the last frame may be just outside the recording.
        self.assertIn(int(probe(out, "stream=nb_read_frames")), (20, 21))
        wrong = swirl(self.path("run.h5"), "--discs", "3", "--out", out)
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("--discs", wrong.stderr)
        wrong = swirl(self.path("run.h5"), "--seconds", "100", "--out", out)
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("ends at period", wrong.stderr)

    def test_full_disk_is_an_error(self):
        if os.geteuid() != 0:
            self.skipTest("only root can mount a small disk")
        disk = self.path("disk")
        os.mkdir(disk)
        if (
            subprocess.run(
                ["mount", "-t", "tmpfs", "-o", "size=64k", "none", disk], capture_output=True
            ).returncode
            != 0
        ):
            self.skipTest("a small disk cannot be mounted here")
        try:
            result = swirl(
                "--discs",
                "48",
                "--seconds",
                "3",
                "--size",
                "640x360",
                "--start",
                "0",
                "--out",
                os.path.join(disk, "x.mp4"),
            )
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn("No space left", result.stderr)
            self.assertEqual(os.listdir(disk), [])
        finally:
            subprocess.run(["umount", disk], check=True)


if __name__ == "__main__":
    unittest.main()
