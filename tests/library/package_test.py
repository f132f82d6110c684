"""What `cmake --install` writes is a library that others build on, and a program that works
wherever it was put; what `cpack` writes is a Debian package with its dependencies."""

import csv
import glob
import json
import math
import os
import re
import shutil
import subprocess
import tempfile
import unittest

SOURCE = os.environ["SWIRL_SOURCE"]
BUILD = os.environ["SWIRL_LIBRARIES"]


def output_of(*words, **more):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **more)
    assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
    return done.stdout


def files_below(folder):
    return sorted(os.path.join(path, name) for path, _, names in os.walk(folder) for name in names)


def somebody_without_rights():
    """For subprocess: the user nobody, where that can be chosen."""
    return {"user": 65534, "group": 65534, "extra_groups": []} if os.getuid() == 0 else {}


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swirl-package-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        os.chmod(cls.folder, 0o755)
        cls.prefix = os.path.join(cls.folder, "prefix")
        output_of("cmake", "--install", BUILD, "--prefix", cls.prefix)
        cls.program = os.path.join(cls.prefix, "bin", "swirl")

    def test_names_no_folder_of_the_build(self):
        for file in files_below(self.prefix):
            with open(file, "rb") as opened:
                content = opened.read()
            for folder in (SOURCE, BUILD):
                self.assertNotIn(folder.encode(), content, file)

    def test_asks_nothing_of_who_links_to_it_but_exact_arithmetic(self):
        text = ""
        for file in glob.glob(f"{self.prefix}/**/cmake/swirl/*.cmake", recursive=True):
            with open(file) as opened:
                text += opened.read()
        self.assertEqual(set(re.findall(r'INTERFACE_COMPILE_OPTIONS "(.*)"', text)),
                         {"-ffp-contract=off"})
        self.assertNotIn("INTERFACE_COMPILE_DEFINITIONS", text)

    def test_holds_the_headers_of_the_engine_alone(self):
        self.assertEqual(sorted(os.listdir(os.path.join(self.prefix, "include", "swirl"))),
                         ["engine", "math", "measure", "physics", "statistics"])

    def build_examples(self, compiler):
        build = os.path.join(self.folder, os.path.basename(compiler))
        output_of("cmake", "-S", os.path.join(SOURCE, "examples"), "-B", build, "-G", "Ninja",
                  f"-DCMAKE_PREFIX_PATH={self.prefix}", f"-DCMAKE_CXX_COMPILER={compiler}",
                  "-DCMAKE_CXX_FLAGS=-O1 -Wall -Werror")
        output_of("cmake", "--build", build)
        return {name: output_of(os.path.join(build, name))
                for name in ("rotation_rate", "events_one_by_one", "custom_measurement")}

    def test_examples(self):
        said = self.build_examples("g++")
        self.assertEqual(len(re.findall("impulse|vertex", said["events_one_by_one"])), 10)
        self.assertIn("\n10000 events", said["events_one_by_one"])
        # From the middle of a dish of 8.6 to where discs touch the wall: 0 to 7.6.
        distance = float(re.search(r"centre: ([0-9.]+)", said["custom_measurement"])[1])
        self.assertTrue(4.0 < distance < 6.0, distance)
        # The program starts from other velocities: the same within four standard errors.
        ours = json.loads(output_of(self.program, "run", "--discs", 48, "--periods", 220, "--quiet",
                                    "--json", "-"))["rotation"]["by_event"]
        varpi, error = map(float, re.search(r"counterrotate: ϖ/Ω = (-[0-9.]+) ± ([0-9.]+)",
                                            said["rotation_rate"]).groups())
        self.assertLess(abs(varpi - ours["mean"]), 4.0 * math.hypot(error, ours["error"]))
        if shutil.which("clang++-19"):
            self.assertEqual(self.build_examples("clang++-19"), said)

    def test_the_program_draws_for_a_user_without_rights_in_any_folder(self):
        before = files_below(self.prefix)
        work = os.path.join(self.folder, "work")
        os.mkdir(work)
        os.chmod(work, 0o777)
        output_of(self.program, "paper", "--figure", "5b", "--quick", "--events", 2000, cwd=work,
                  env={"PATH": "/usr/bin:/bin", "HOME": "/nonexistent"}, **somebody_without_rights())
        with open(os.path.join(work, "out", "figure_5b.csv"), newline="") as file:
            self.assertGreater(len(list(csv.DictReader(file))), 10)
        self.assertGreater(os.path.getsize(os.path.join(work, "out", "figure_5b.png")), 5000)
        self.assertEqual(files_below(self.prefix), before)


@unittest.skipUnless(shutil.which("dpkg-shlibdeps"), "this test needs dpkg-dev")
class DebianPackage(unittest.TestCase):
    def test_holds_the_program_and_names_what_it_needs(self):
        with tempfile.TemporaryDirectory() as folder:
            output_of("cpack", "-G", "DEB", "-B", folder, cwd=BUILD)
            (package,) = glob.glob(folder + "/*.deb")
            needed = output_of("dpkg-deb", "--field", package, "Depends")
            for name in ("libc6", "libcairo2", "libfmt9", "libhdf5", "python3-matplotlib"):
                self.assertIn(name, needed)
            self.assertIn("ffmpeg", output_of("dpkg-deb", "--field", package, "Recommends"))
            files = output_of("dpkg-deb", "--contents", package)
            for path in ("usr/bin/swirl", "usr/share/swirl/figures/figure_5b.py",
                         "usr/include/swirl/physics/disc.hpp", "swirlConfig.cmake"):
                self.assertIn(path, files)
            output_of("apt-get", "install", "--simulate", "--no-install-recommends", package)


if __name__ == "__main__":
    unittest.main()
