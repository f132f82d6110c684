"""math, physics, engine, statistics and measure build for Windows with mingw-w64, and a program
that uses them links. The program does not run here: there is no Windows."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)
COMPILER = "x86_64-w64-mingw32-g++-posix"
PROJECT = """cmake_minimum_required(VERSION 3.22)
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_COMPILER %s)
set(CMAKE_BUILD_TYPE Release)
project(windows LANGUAGES CXX)
set(SWIRL_WIDE_VECTORS OFF)
add_subdirectory("%s" swirl)
add_executable(program program.cpp)
target_include_directories(program PRIVATE "%s/examples")
target_link_libraries(program PRIVATE swirl::engine swirl::measure swirl::statistics)
"""


class Windows(unittest.TestCase):
    def test_a_program_of_the_library_links(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(
                os.path.join(SOURCE, "examples", "custom_measurement.cpp"),
                os.path.join(folder, "program.cpp"),
            )
            with open(os.path.join(folder, "CMakeLists.txt"), "w") as file:
                file.write(PROJECT % (COMPILER, SOURCE, SOURCE))
            build = os.path.join(folder, "build")
            for command in (
                ["cmake", "-S", folder, "-B", build, "-G", "Ninja"],
                ["cmake", "--build", build],
            ):
                done = subprocess.run(command, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with open(os.path.join(build, "program.exe"), "rb") as file:
                self.assertEqual(file.read(2), b"MZ")


if __name__ == "__main__":
    for tool in (COMPILER, "cmake", "ninja"):
        if not shutil.which(tool):
            print("skipped: this test needs", tool)
            sys.exit(77)
    unittest.main()
