"""Another project includes swirl with add_subdirectory. It gets the two libraries, but not the
warning flags, the tests or the packages that the program needs."""

import os
import subprocess
import tempfile
import unittest

SOURCE = os.environ["SWIRL_SOURCE"]

PROJECT = """cmake_minimum_required(VERSION 3.22)
project(other LANGUAGES CXX)
enable_testing()
add_subdirectory({source} swirl EXCLUDE_FROM_ALL)
add_executable(other other.cpp)
target_link_libraries(other PRIVATE swirl::engine swirl::measure)
"""
# The warning flags of this project would reject the unused variable.
PROGRAM = """#include <cstdio>
#include "swirl/engine/paper_scene.hpp"
#include "swirl/measure/cluster_rotation.hpp"
#include "swirl/engine/simulation.hpp"
int main() {
    int unused;
    swirl::Simulation simulation(swirl::paper_scene(28, 0.5, 7));
    simulation.run(1000);
    std::printf("%d", swirl::cluster_rotation(simulation.snapshot()).rigid != 0.0);
}
"""
NOT_NEEDED = ("PkgConfig", "fmt", "nlohmann_json", "tomlplusplus", "CLI11", "GTest", "Threads")


class Subdirectory(unittest.TestCase):
    def test_needs_only_the_engine(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (
                ("CMakeLists.txt", PROJECT.format(source=SOURCE)),
                ("other.cpp", PROGRAM),
            ):
                with open(os.path.join(folder, name), "w") as file:
                    file.write(text)
            build = os.path.join(folder, "build")
            for words in (
                [
                    "cmake",
                    "-S",
                    folder,
                    "-B",
                    build,
                    "-G",
                    "Ninja",
                    "-DCMAKE_BUILD_TYPE=Debug",
                    "-DCMAKE_CXX_FLAGS_DEBUG=-O0",
                    *(f"-DCMAKE_DISABLE_FIND_PACKAGE_{p}=ON" for p in NOT_NEEDED),
                ],
                ["cmake", "--build", build],
            ):
                done = subprocess.run(words, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(
                subprocess.run(
                    [os.path.join(build, "other")], capture_output=True, check=True
                ).stdout,
                b"1",
            )
            tests = subprocess.run(
                ["ctest", "--test-dir", build, "-N"], capture_output=True, text=True
            ).stdout
            self.assertIn("Total Tests: 0", tests)


if __name__ == "__main__":
    unittest.main()
