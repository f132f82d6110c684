"""The sources compile with clang and its standard library, libc++, which macOS and FreeBSD use. The
compiler checks the program and generates no code. Nothing is compiled for a Mac here.

The files of a layer become one file where the build does the same, so that headers are read
once."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)
GENERATED = os.path.join(
    os.environ.get("SWIRL_LIBRARIES", os.path.join(SOURCE, "build", "tests")), "generated"
)
COMPILER = "clang++-19"
FLAGS = [
    "-std=c++20",
    "-stdlib=libc++",
    "-fsyntax-only",
    "-ffp-contract=off",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-Wno-deprecated-declarations",
    f"-I{SOURCE}/src",
    f"-I{SOURCE}",
    f"-I{GENERATED}",
    '-DSWIRL_BUILD=""',
    "-DSWIRL_HAS_DRAWING=1",
    "-DSWIRL_HAS_CAMERA=1",
]
SYSTEM_FOLDERS = ("/usr/include/hdf5/serial", "/usr/include/opencv4")
ONE_BY_ONE = ("cli", "engine")
VECTORS = {"avx2": ["-mavx2"], "avx512": ["-mavx512f", "-mavx512vl", "-mavx512dq", "-mavx512bw"]}


def flags_of(package):
    return (
        subprocess.run(["pkg-config", "--cflags-only-I", package], capture_output=True, text=True)
        .stdout.replace("-I", "-isystem ")
        .split()
    )


def units():
    """The files that the compiler gets at once, with a name and further flags."""
    parts = [
        os.path.join(SOURCE, *part.split("/"), name)
        for part in ("src/swirl", "track")
        for name in sorted(os.listdir(os.path.join(SOURCE, *part.split("/"))))
        if name != "tests"
    ]
    for part in parts:
        layer, together = os.path.basename(part), []
        for folder, _, names in sorted(os.walk(part)):
            for name in sorted(name for name in names if name.endswith(".cpp")):
                path = os.path.join(folder, name)
                width = re.search(r"_(avx\w+)\.cpp$", name)
                if width:
                    yield name, [path], VECTORS[width[1]]
                elif layer in ONE_BY_ONE:
                    yield name, [path], []
                else:
                    together.append(path)
        if together:
            yield layer, together, []


class Libcxx(unittest.TestCase):
    def test_all_sources_compile(self):
        with tempfile.TemporaryDirectory() as folder:
            unit = os.path.join(folder, "unit.cpp")
            command = [
                COMPILER,
                *FLAGS,
                *flags_of("cairo"),
                *(word for path in SYSTEM_FOLDERS for word in ("-isystem", path)),
                unit,
            ]

            def errors(text, *more):
                with open(unit, "w") as file:
                    file.write(text)
                done = subprocess.run([*command, *more], capture_output=True, text=True)
                return done.stderr if done.returncode else None

            # Checks the test itself: the compiler reports errors, and it uses libc++.
            self.assertIn("error:", errors("int main() { return undeclared; }"))
            self.assertIsNone(
                errors("#include <version>\nstatic_assert(_LIBCPP_VERSION >= 190000);")
            )
            checked = 0
            for name, files, more in units():
                with self.subTest(name):
                    self.assertIsNone(
                        errors("".join(f'#include "{file}"\n' for file in files), *more)
                    )
                    checked += len(files)
            self.assertGreater(checked, 100)


if __name__ == "__main__":
    if not shutil.which(COMPILER):
        print("skipped: this test needs", COMPILER)
        sys.exit(77)
    probe = subprocess.run(
        [COMPILER, "-stdlib=libc++", "-fsyntax-only", "-x", "c++", "-"],
        text=True,
        input="#include <vector>\n",
        capture_output=True,
    )
    if probe.returncode:
        print("skipped: this test needs libc++ 19 (Debian's package libc++-19-dev)")
        sys.exit(77)
    unittest.main()
