"""docs/reference/output.md names every key of the JSON of run, crossing, measure and track."""

import json
import os
import re
import unittest

from program import SOURCE, InFolder, read_text, result_of

PAGE = read_text(os.path.join(SOURCE, "docs", "reference", "output.md"))
# Keys with a page of their own: parameters and measurements.
ELSEWHERE = {"config", "measured"}


def keys(value):
    if isinstance(value, list):
        for inner in value:
            yield from keys(inner)
    elif isinstance(value, dict):
        for key, inner in value.items():
            yield key
            if key not in ELSEWHERE:
                yield from keys(inner)


def section(title):
    return re.search(rf"^## {title}\n(.*?)(?=^## |\Z)", PAGE, re.MULTILINE | re.DOTALL)[1]


class OutputKeys(InFolder):
    def assert_documented(self, found, *titles):
        text = "".join(section(title) for title in titles)
        for key in sorted(set(found)):
            with self.subTest(key):
                # `x_error` next to `x` may be written as `…_error`.
                known = f"`{key}`" in text or (key.endswith("_error") and "`…_error`" in text)
                self.assertTrue(known, f"{key} is not in {titles}")

    def call(self, *arguments):
        done = self.assert_works(*arguments, "--quiet", cwd=self.folder)
        return done.stdout

    def test_run(self):
        result = result_of("--discs", 8, "--events", "2e4", "--measure", "pinned")
        self.assert_documented(keys(result), "JSON of `swirl run`")
        rows = result["measured"]["pinned"]
        self.assert_documented(keys(rows["pinning"]), "JSON of `swirl run`")

    def test_crossing(self):
        found = json.loads(
            self.call(
                "crossing",
                "--from",
                36,
                "--to",
                42,
                "--step",
                3,
                "--events",
                "2e4",
                "--tolerance",
                5,
                "--json",
                "-",
            )
        )
        self.assertTrue(found["points"])
        self.assert_documented(keys(found), "JSON of `swirl crossing`", "JSON of `swirl run`")

    def test_measure(self):
        self.call(
            "run",
            "--discs",
            12,
            "--periods",
            4,
            "--warmup",
            1,
            "--frames-per-period",
            128,
            "--trajectory",
            "t.h5",
        )
        self.call("export", "t.h5", "--format", "lammps", "--out", "t.lammpstrj")
        found = json.loads(
            self.call(
                "measure",
                "t.lammpstrj",
                "--omega",
                0.529508,
                "--camera-fps",
                128 / 11.866071,
                "--amplitude",
                1.892,
                "--container-radius",
                8.6,
                "--max-invalid",
                1,
                "--json",
                "-",
            )
        )
        self.assertIsNotNone(found["camera"])
        self.assert_documented(keys(found), "JSON of `swirl measure`", "JSON of `swirl run`")

    def test_track(self):
        # Tracking a video takes too long here, so the keys come from the source.
        text = read_text(os.path.join(SOURCE, "track", "cli", "tracked_video.cpp"))
        found = re.findall(r'\{"([a-z_-]+)",', text) + re.findall(r'json\["(\w+)"\]', text)
        # Without the texts of the HDF5 file and the columns of the tables.
        found = [key for key in found if key not in ("command", "film", "frame", "particle")]
        self.assertGreater(len(found), 40)
        self.assert_documented(found, "JSON of `swirl track`")


if __name__ == "__main__":
    unittest.main()
