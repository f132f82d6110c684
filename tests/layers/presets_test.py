"""Every preset of CMakePresets.json configures and compiles, and every header compiles alone. The
builds of ./check compile several files at once, which hides missing includes and warnings. In the
default suite, one file of each folder is compiled with the flags of the preset `dev`, and one file
of the statistics with those of each other preset that ./check does not build; with --all, the
preset `dev` is built, and every header and folder is compiled."""

import concurrent.futures
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import tempfile
import unittest

from program import ALL, SOURCE, main, slow

SOURCE = pathlib.Path(SOURCE)
HEADERS = [
    file
    for top in ("src", "track")
    for file in sorted((SOURCE / top).rglob("*.hpp"))
    if "tests" not in file.parts
]
# Parsed by the compilers of both presets within a second.
SMALL = "src/swirl/statistics/"
# ./check builds these completely.
BUILT_BY_CHECK = ("tests", "sanitize")


def presets():
    configured = json.loads((SOURCE / "CMakePresets.json").read_text(encoding="utf-8"))[
        "configurePresets"
    ]
    return {preset["name"]: preset for preset in configured}


def smallest_of_each_folder(files):
    """One file of each folder, the smallest."""
    first = {}
    for file in sorted(files, key=lambda file: (file.stat().st_size, file)):
        first.setdefault(file.parent, file)
    return list(first.values())


class Presets(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="swirl-presets-")
        cls.addClassCleanup(cls.scratch.cleanup)
        names = [name for name in presets() if ALL or name not in BUILT_BY_CHECK]
        with cls.pool() as pool:
            cls.configured = dict(zip(names, pool.map(cls.configure, names)))

    @staticmethod
    def pool():
        return concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0)))

    @classmethod
    def folder(cls, preset):
        return pathlib.Path(cls.scratch.name, preset)

    @classmethod
    def configure(cls, preset):
        compiler = presets()[preset]["cacheVariables"].get("CMAKE_CXX_COMPILER", "c++")
        if shutil.which(compiler) is None:
            return None
        # Without unity builds, the flags of each file are listed.
        return subprocess.run(
            ["cmake", "--preset", preset, "-B", cls.folder(preset), "-DSWIRL_UNITY=OFF"],
            cwd=SOURCE,
            capture_output=True,
            text=True,
        )

    def flags(self, preset):
        """By source file: its compiler with the flags of this preset."""
        found = {}
        for entry in json.loads(
            (self.folder(preset) / "compile_commands.json").read_text(encoding="utf-8")
        ):
            words = [word for word in shlex.split(entry["command"]) if not word.endswith("ccache")]
            found[pathlib.Path(entry["file"])] = words[: words.index("-o")]
        return found

    def assert_compile(self, calls):
        """Parses each file or text without writing an object. `calls` are (name, compiler and
        flags, file or text)."""

        def parse(call):
            name, flags, code = call
            source = ["-x", "c++", "-"] if isinstance(code, str) else [code]
            done = subprocess.run(
                [*flags, "-fsyntax-only", *source],
                cwd=SOURCE,
                capture_output=True,
                text=True,
                input=code if isinstance(code, str) else None,
            )
            return name, done.returncode, done.stderr

        with self.pool() as pool:
            for name, code, errors in pool.map(parse, calls):
                with self.subTest(name):
                    self.assertEqual(code, 0, errors)

    def test_every_preset_configures(self):
        for preset, done in self.configured.items():
            with self.subTest(preset):
                if done is None:
                    self.skipTest("its compiler is not installed")
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_files_of_every_preset_compile(self):
        calls = []
        for preset, done in self.configured.items():
            if done is None or preset == "dev" and ALL:
                continue
            flags = self.flags(preset)
            for file in smallest_of_each_folder(
                file for file in flags if file.name != "version.cpp"
            ):  # needs a made file
                name = str(file.relative_to(SOURCE)) if file.is_relative_to(SOURCE) else ""
                if name.startswith(("src", "track") if ALL or preset == "dev" else SMALL):
                    calls.append((f"{preset}: {name}", flags[file], file))
        self.assertGreater(len(calls), 15)
        self.assert_compile(calls)

    @slow("it takes 13 minutes of processor time")
    def test_dev_builds(self):
        done = subprocess.run(
            ["cmake", "--build", self.folder("dev"), "--target", "all"],
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, done.stdout[-10000:])

    @slow("the files above include their own header first")
    def test_headers_compile_alone(self):
        flags = self.flags("dev")
        by_folder = {file.parent: words for file, words in sorted(flags.items(), reverse=True)}
        calls = []
        for header in HEADERS:
            name = header.relative_to(SOURCE)
            folder = next(
                parent
                for parent in (*header.parents, SOURCE / "src/swirl/engine")
                if parent in by_folder
            )
            include = name.relative_to("src") if name.parts[0] == "src" else name
            calls.append((name, [*by_folder[folder], f"-I{SOURCE}"], f'#include "{include}"\n'))
        self.assert_compile(calls)


if __name__ == "__main__":
    main()
