"""A stop signal ends the program cleanly in all of its phases: placement of discs, construction of
the neighbour lists, events, movies, tracking and figures. The phases are reached by processor time,
since the machine may have other work."""

import os
import re
import shutil
import signal
import subprocess
import time

from program import HANG, SOURCE, SWIRL, InFolder, main, processor_seconds, some, swirl, worked


class Started:
    def __init__(self, folder, *arguments, preexec_fn=None, **environment):
        self.process = subprocess.Popen(
            [SWIRL, *map(str, arguments)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=folder,
            preexec_fn=preexec_fn,
            env=dict(os.environ, NO_COLOR="1", **environment),
        )

    def wait_for(self, seconds):
        """Waits until it has used that much processor time; False if it ended before."""
        return worked(self.process, seconds)

    def stop(self, sent=signal.SIGTERM):
        """Sends the signal; exit code and errors."""
        self.process.send_signal(sent)
        _, errors = self.process.communicate(timeout=HANG)
        return self.process.returncode, errors


class Stop(InFolder):
    def count_clean_stops(self, moments, *arguments, sent=signal.SIGTERM):
        """Stops a program after each of these processor times; how often it had not ended
        before."""
        stops = 0
        for moment in moments:
            with self.subTest(arguments=arguments, moment=moment):
                started = Started(self.folder, *arguments)
                if not started.wait_for(moment):
                    started.process.communicate()
                    continue
                code, errors = started.stop(sent)
                self.assertEqual(code, 130, errors)
                self.assertRegex(errors, r"error: [Ss]topped [^\n]*\.\n(hint: [^\n]+\n)?$")
                stops += 1
        return stops

    def test_during_placement(self):
        self.assertGreaterEqual(
            self.count_clean_stops(
                [0.1, 0.5], "run", "--discs", 250, "--radius", 0.5, "--events", 100
            ),
            1,
        )

    def test_during_preparation_and_run_of_a_million_discs(self):
        radius = 8.6 * (1e6 / 48) ** 0.5
        # The moments are in the placement and in the construction of the lists, which is the
        # longest phase.
        moments = some([0.4, 1.8, 0.1, 0.8, 1.2, 2.6], 2)
        self.assertGreaterEqual(
            self.count_clean_stops(
                moments,
                "run",
                "--discs",
                1000000,
                "--container-radius",
                radius,
                "--events",
                "1e8",
                "--quiet",
            ),
            len(moments),
        )

    def test_during_placement_of_a_dense_mixture(self):
        # No lattice fits at this density, so overlapping pairs are pushed apart for seconds.
        self.count_clean_stops(
            [0.5],
            "run",
            "--discs",
            3020,
            "--mixture",
            "3000:0.1",
            "--container-radius",
            7.6,
            "--events",
            100,
        )

    def test_while_an_image_of_a_late_time_is_computed(self):
        self.assertEqual(
            self.count_clean_stops([0.5], "image", "--start", 1e7, "--out", self.path("a.png")), 1
        )
        self.assertEqual(self.left_behind(), [])

    def test_while_a_video_is_made_and_tracked(self):
        if shutil.which("ffmpeg") is None:
            self.skipTest("this test needs ffmpeg")
        video = [
            "synthetic-video",
            "--discs",
            16,
            "--container-radius",
            6.5,
            "--scale",
            12,
            "--width",
            240,
            "--height",
            240,
            "--frames-per-period",
            40,
            "--periods",
            1.2,
            "--quiet",
            "--out",
        ]
        self.assertGreaterEqual(self.count_clean_stops([0.05], *video, self.path("stopped.mp4")), 1)
        self.assertEqual(self.left_behind(), [])
        self.assert_works(*video, self.path("video.mp4"))
        made = self.left_behind()
        track = ["track", self.path("video.mp4"), "--quiet", "--out", self.path("tracks.csv")]
        if "no camera support" in swirl(*track, "--max-frames", 1).stderr:
            self.skipTest("this build was made without OpenCV")
        self.assertGreaterEqual(self.count_clean_stops([0.05, 0.2, 0.35, 0.5], *track), 3)
        self.assertEqual(self.left_behind(), made)

    def test_while_figures_are_drawn(self):
        shutil.copytree(os.path.join(SOURCE, "paper"), self.path("figures"))
        with open(self.path("figures/style.py"), "a", encoding="utf-8") as script:
            script.write(
                "\n\ndef save(*_):\n    import os, time\n"
                f"    open(os.path.join({self.path('figures')!r}, str(os.getpid())), 'w').close()\n"
                "    time.sleep(3600)\n"
            )  # beyond the time limit of this test
        for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            started = Started(
                self.folder,
                "paper",
                "--figure",
                "5b",
                "--quick",
                "--events",
                "2000",
                "--quiet",
                "--out",
                self.path("out"),
                SWIRL_FIGURES=self.path("figures"),
            )
            while not (
                pids := [name for name in os.listdir(self.path("figures")) if name.isdigit()]
            ):
                self.assertIsNone(started.process.poll())
                time.sleep(0.01)
            code, errors = started.stop(sent)
            self.assertEqual(code, 130, errors)
            self.assertRegex(errors, r"error: [Ss]topped [^\n]*\.\n(hint: [^\n]+\n)?$")
            self.assertIsNone(processor_seconds(int(pids[0])))
            os.remove(self.path(f"figures/{pids[0]}"))

    def test_hang_up_writes_a_checkpoint_like_other_signals(self):
        for sent in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM):
            with self.subTest(sent=sent):
                name = f"{sent.name}.json"
                started = Started(
                    self.folder,
                    "run",
                    "--events",
                    1e12,
                    "--json",
                    self.path(name),
                    "--resume",
                    "--quiet",
                )
                self.assertTrue(started.wait_for(0.3))
                code, errors = started.stop(sent)
                self.assertEqual(code, 130, errors)
                self.assertIn("--resume to continue from", errors)
                checkpoint = re.search(r"continue from '([^']+)'", errors).group(1)
                self.assertTrue(os.path.exists(checkpoint), checkpoint)

    def test_a_run_started_by_nohup_ignores_a_hang_up(self):
        started = Started(
            self.folder,
            "run",
            "--events",
            1e12,
            "--quiet",
            preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN),
        )
        self.assertTrue(started.wait_for(0.2))
        started.process.send_signal(signal.SIGHUP)
        self.assertTrue(started.wait_for(0.5))
        self.assertEqual(started.stop()[0], 130)


if __name__ == "__main__":
    main()
