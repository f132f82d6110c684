"""Configuration files instead of options, for every command that accepts them. Options on the
command line override the file."""

import json
import os
import unittest

from program import InFolder, read_bytes, result_of, write_text


class ConfigFiles(InFolder):
    def config(self, *lines):
        write_text(self.path("a.toml"), "\n".join(lines) + "\n")
        return self.path("a.toml")

    def error_of(self, *arguments):
        return self.assert_fails(2, *arguments).stderr

    def bytes_of(self, name):
        return read_bytes(self.path(name))

    def test_a_file_that_may_be_truncated_gets_a_warning(self):
        for text, warns in (
            ("discs = 5\nevents = 10", True),
            ("discs = 5\nevents = 10\n", False),
            ('events = 10\npreset = "experiment"', False),
        ):
            write_text(self.path("a.toml"), text)
            said = self.assert_works("run", self.path("a.toml"), "--quiet").stderr
            self.assertEqual(
                "warning: '" + self.path("a.toml") + "' has no line break at its end" in said,
                warns,
                said,
            )

    def test_an_image(self):
        options = [
            "--discs",
            12,
            "--mu-wall",
            0.25,
            "--view",
            "m",
            "--angles",
            "--size",
            "320x240",
            "--trail-length",
            0.5,
            "--start",
            2,
        ]
        self.assert_works("image", *options, "--out", self.path("hand.png"))
        file = self.config(
            "discs = 12",
            "mu_wall = 0.25",
            'frame = "m"',
            "angles = true",
            'size = "320x240"',
            "trail_length = 0.5",
            "start = 2",
            "strobe = 1",
            f'out = "{self.path("file.png")}"',
        )
        said = self.assert_works("image", file).stdout
        self.assertIn("320x240", said)
        self.assertEqual(self.bytes_of("hand.png"), self.bytes_of("file.png"))
        # An option on the command line overrides the file, also if the file has an equivalent
        # option of another name.
        self.assert_works(
            "image", file, "--discs", 5, "--mu", 1, "--start", 3, "--out", self.path("x.png")
        )
        self.assert_works(
            "image",
            *options[4:-2],
            "--start",
            3,
            "--discs",
            5,
            "--mu",
            1,
            "--out",
            self.path("y.png"),
        )
        self.assertEqual(self.bytes_of("x.png"), self.bytes_of("y.png"))

    def test_an_image_of_a_recording_that_the_file_names(self):
        self.assert_works(
            "run",
            "--discs",
            5,
            "--events",
            2000,
            "--frames-per-period",
            20,
            "--trajectory",
            self.path("t.h5"),
            "--quiet",
        )
        file = self.config(f'file = "{self.path("t.h5")}"', 'size = "200x200"')
        self.assert_works("image", file, "--start", 1, "--out", self.path("file.png"))
        self.assert_works(
            "image",
            self.path("t.h5"),
            "--size",
            "200x200",
            "--start",
            1,
            "--out",
            self.path("hand.png"),
        )
        self.assertEqual(self.bytes_of("hand.png"), self.bytes_of("file.png"))

    def test_a_movie(self):
        file = self.config(
            "discs = 8",
            'size = "160x120"',
            "fps = 10",
            "seconds = 2",
            "start = 1",
            "pace = 1",
            "plot = true",
        )
        self.assert_works("movie", file, "--frame-files", self.path("a"))
        self.assertEqual(len(os.listdir(self.path("a"))), 20)
        # --periods replaces the file's seconds.
        self.assert_works("movie", file, "--periods", 0.5, "--frame-files", self.path("b"))
        self.assertEqual(len(os.listdir(self.path("b"))), 5)

    def test_a_crossing(self):
        file = self.config(
            "mu = 1",
            "events = 20000",
            "from = 5",
            "to = 8",
            "tolerance = 3",
            "seed = 7",
            f'json = "{self.path("file.json")}"',
        )
        self.assert_works("crossing", file, "--quiet")
        self.assert_works(
            "crossing",
            "--mu",
            1,
            "--events",
            20000,
            "--from",
            5,
            "--to",
            8,
            "--tolerance",
            3,
            "--seed",
            7,
            "--json",
            self.path("hand.json"),
            "--quiet",
        )
        found = []
        for name in ("file.json", "hand.json"):
            result = json.loads(self.bytes_of(name))
            for of_the_call in ("command", "seconds", "events_per_second"):
                result.pop(of_the_call, None)
            found.append(result)
        self.assertEqual(found[0], found[1])

    def test_the_paper(self):
        file = self.config(
            'figure = ["1c"]',
            "quick = true",
            "events = 3000",
            "seed = 3",
            f'out = "{self.path("out")}"',
        )
        self.assert_works("paper", file, "--quiet")
        self.assertTrue(any(name.startswith("figure_1c") for name in os.listdir(self.path("out"))))

    def test_what_to_measure_may_be_a_list(self):
        lists = self.config("discs = 5", "events = 2000", 'measure = ["slip", "radial"]')
        found = result_of(lists)
        text = self.config("discs = 5", "events = 2000", 'measure = "slip,radial"')
        self.assertEqual(list(found["measured"]), ["slip", "radial"])
        self.assertEqual(result_of(text)["measured"], found["measured"])
        self.assert_works("sweep", lists, "--out", self.path("s"), "--quiet")
        self.assertIn("discs is a list", self.error_of("run", self.config("discs = [5, 6]")))

    def test_invalid_entries_are_rejected_with_the_line(self):
        out = ["--out", self.path("x.png")]
        for command, line, words in (
            ("image", "events = 100", "there is no option 'events'"),
            ("image", "sieze = '20x20'", "did you mean 'size'?"),
            ("image", "angles = 3", "angles is '3', but it must be true or false"),
            ("image", "strobe = 1.5", "strobe is '1.5', but it must be a whole number"),
            ("image", "start = 'soon'", "start is 'soon', but it must be a number"),
            ("movie", "fps = 9999999999", "whole number"),
            ("movie", "discs = [5, 6]", "list"),
            ("crossing", "discs = 40", "there is no option 'discs'"),
            ("crossing", "config = 'b.toml'", "there is no option 'config'"),
            ("paper", "mu = 1", "there is no option 'mu'"),
        ):
            with self.subTest(line):
                self.assertIn(
                    words,
                    self.error_of(command, self.config(line), *(out if command == "image" else [])),
                )
        self.assertEqual(self.left_behind(), ["a.toml"])


if __name__ == "__main__":
    unittest.main()
