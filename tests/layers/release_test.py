"""The version is defined in CMakeLists.txt. All other files state the same. The page of file
formats has the numbers of the sources."""

import json
import os
import re
import unittest

SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)
# The pattern of the version in each file.
STATED = {
    "CITATION.cff": r"^version: (\S+)$",
    ".zenodo.json": r'^  "version": "(\S+)",$',
    "packaging/conda/meta.yaml": r'set version = "(\S+)"',
    "packaging/spack/package.py": r'^    version\("(\S+?)"|/swirl-(\d+\.\d+\.\d+)\.tar',
    "packaging/homebrew/swirl.rb": r"/swirl-(\d+\.\d+\.\d+)\.tar",
}
# Row of docs/reference/files.md, and the constant in the sources.
FORMATS = {
    "result": ("src/swirl/run/result.hpp", r"result_format = (\d+)"),
    "trajectory": ("src/swirl/io/h5md.hpp", r"recording_format = (\d+)"),
    "event log": ("src/swirl/io/h5md.hpp", r"recording_format = (\d+)"),
    "checkpoint": ("src/swirl/io/checkpoint.cpp", r"swirl checkpoint (\d+)"),
    "calibration": ("src/swirl/cli/track_options.hpp", r"camera_format = (\d+)"),
    "plan of a sweep": ("src/swirl/study/sweep_folder.hpp", r"sweep_format = (\d+)"),
}


def text_of(name):
    with open(os.path.join(SOURCE, name), encoding="utf-8") as file:
        return file.read()


def cmake_version():
    return re.search(r"^project\(swirl VERSION (\d+\.\d+\.\d+) ", text_of("CMakeLists.txt"), re.M)[
        1
    ]


class Release(unittest.TestCase):
    def test_every_file_states_the_version_of_cmake(self):
        for name, pattern in STATED.items():
            with self.subTest(name):
                found = [
                    next(filter(None, match.groups()))
                    for match in re.finditer(pattern, text_of(name), re.M)
                ]
                self.assertTrue(found)
                self.assertEqual(set(found), {cmake_version()})

    def test_python_takes_the_version_from_cmake(self):
        text = text_of("pyproject.toml")
        self.assertRegex(text, r'(?m)^dynamic = \["version"')
        self.assertIn('input = "CMakeLists.txt"', text)
        pattern = re.search(r"^regex = '(.*)'$", text, re.M)[1]
        self.assertEqual(re.search(pattern, text_of("CMakeLists.txt"))["value"], cmake_version())

    def test_the_page_of_formats_has_the_numbers_of_the_sources(self):
        page = text_of("docs/reference/files.md")
        for row, (file, pattern) in FORMATS.items():
            with self.subTest(row):
                number = re.search(pattern, text_of(file))[1]
                cells = re.search(rf"^\| {row}[^|]*\|[^|]*\|[^|]*\| (\d+),", page, re.M)
                self.assertEqual(cells[1], number)

    def test_one_minimum_version_of_cmake(self):
        minimum = set()
        for folder, folders, names in os.walk(SOURCE):
            folders[:] = [
                f for f in folders if not f.startswith((".", "build", "node_modules", "out"))
            ]
            if "CMakeLists.txt" in names:
                minimum.update(
                    re.findall(
                        r"cmake_minimum_required\(VERSION ([\d.]+)",
                        text_of(os.path.relpath(os.path.join(folder, "CMakeLists.txt"), SOURCE)),
                    )
                )
        self.assertEqual(len(minimum), 1, minimum)
        wanted = minimum.pop()
        presets = json.loads(text_of("CMakePresets.json"))["cmakeMinimumRequired"]
        self.assertEqual(f"{presets['major']}.{presets['minor']}", wanted)
        self.assertIn(f"cmake >={wanted}", text_of("packaging/conda/meta.yaml"))
        self.assertIn(f"cmake@{wanted}:", text_of("packaging/spack/package.py"))


if __name__ == "__main__":
    unittest.main()
