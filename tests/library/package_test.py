"""`cmake --install` writes a library for other projects and a program that works in any folder.
`cpack` writes one Debian package of each, with its dependencies."""

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

from program import other_user

SOURCE = os.environ["SWIRL_SOURCE"]
BUILD = os.environ["SWIRL_LIBRARIES"]


def output_of(*words, **more):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **more)
    assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
    return done.stdout


def files_below(folder):
    return sorted(os.path.join(path, name) for path, _, names in os.walk(folder) for name in names)


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swirl-package-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        os.chmod(cls.folder, 0o755)
        cls.prefix = os.path.join(cls.folder, "prefix")
        output_of("cmake", "--install", BUILD, "--prefix", cls.prefix)
        output_of("cmake", "--install", BUILD, "--prefix", cls.prefix, "--component", "python")
        cls.program = os.path.join(cls.prefix, "bin", "swirl")

    def test_files_do_not_contain_paths_of_the_build(self):
        for file in files_below(self.prefix):
            with open(file, "rb") as opened:
                content = opened.read()
            for folder in (SOURCE, BUILD):
                self.assertNotIn(folder.encode(), content, file)

    def test_dependents_get_one_compile_option_for_exact_arithmetic(self):
        text = ""
        for file in glob.glob(f"{self.prefix}/**/cmake/swirl/*.cmake", recursive=True):
            with open(file) as opened:
                text += opened.read()
        self.assertEqual(
            set(re.findall(r'INTERFACE_COMPILE_OPTIONS "(.*)"', text)), {"-ffp-contract=off"}
        )
        self.assertNotIn("INTERFACE_COMPILE_DEFINITIONS", text)

    def test_the_headers_outside_detail_are_those_of_the_reference(self):
        include = os.path.join(self.prefix, "include")
        headers = {os.path.relpath(file, include) for file in files_below(include)}
        public = {header for header in headers if not header.startswith("swirl/detail/")}
        with open(os.path.join(SOURCE, "docs", "reference", "cpp.md"), encoding="utf-8") as page:
            documented = set(re.findall(r"\.\./\.\./src/(swirl/[\w/]+\.hpp)", page.read()))
        self.assertEqual(public, documented)
        self.assertEqual(
            sorted(os.listdir(os.path.join(include, "swirl/detail/swirl"))),
            ["engine", "math", "measure", "physics", "statistics"],
        )

    def build_examples(self, compiler):
        build = os.path.join(self.folder, os.path.basename(compiler))
        output_of(
            "cmake",
            "-S",
            os.path.join(SOURCE, "examples"),
            "-B",
            build,
            "-G",
            "Ninja",
            f"-DCMAKE_PREFIX_PATH={self.prefix}",
            f"-DCMAKE_CXX_COMPILER={compiler}",
            "-DCMAKE_CXX_FLAGS=-O1 -Wall -Werror",
        )
        output_of("cmake", "--build", build)
        examples = "rotation_rate events_one_by_one custom_measurement custom_contact_law"
        return {name: output_of(os.path.join(build, name)) for name in examples.split()}

    def test_examples(self):
        output = self.build_examples("g++")
        self.assertEqual(len(re.findall("impulse|vertex", output["events_one_by_one"])), 10)
        self.assertIn("\n10000 events", output["events_one_by_one"])
        # Distances lie between 0, the centre, and 7.6, where discs touch the wall of radius 8.6.
        distance = float(re.search(r"centre: ([0-9.]+)", output["custom_measurement"])[1])
        self.assertTrue(4.0 < distance < 6.0, distance)
        law = output["custom_contact_law"]
        speeds = re.findall(r"^ +\d+  (\S+)  (\S+)$", law, re.MULTILINE)
        self.assertEqual(len(speeds), 5)
        for found, expected in speeds:
            self.assertEqual(found, expected)
        own, constants = re.search(r"state (\w+), with the law of constants (\w+)", law).groups()
        self.assertEqual(own, constants)
        # The program starts from other velocities: the means agree within four standard errors.
        program = json.loads(
            output_of(
                self.program, "run", "--discs", 48, "--periods", 220, "--quiet", "--json", "-"
            )
        )["rotation"]["mean_by_event"]
        varpi, error = map(
            float,
            re.search(
                r"counterrotate: ϖ/Ω = (-[0-9.]+) ± ([0-9.]+)", output["rotation_rate"]
            ).groups(),
        )
        self.assertLess(abs(varpi - program["mean"]), 4.0 * math.hypot(error, program["error"]))
        if shutil.which("clang++-19"):
            self.assertEqual(self.build_examples("clang++-19"), output)

    def test_program_gives_the_hashes_that_packages_are_checked_with(self):
        checker = os.path.join(SOURCE, "packaging", "test_installation.py")
        said = output_of("/usr/bin/python3", "-B", checker, self.program)
        self.assertIn("expected state hashes", said)

    def test_program_draws_for_an_unprivileged_user_in_any_folder(self):
        before = files_below(self.prefix)
        work = os.path.join(self.folder, "work")
        os.mkdir(work)
        os.chmod(work, 0o777)
        output_of(
            self.program,
            "paper",
            "--figure",
            "5b",
            "--quick",
            "--events",
            2000,
            cwd=work,
            env={"PATH": "/usr/bin:/bin", "HOME": "/nonexistent"},
            **other_user(),
        )
        with open(os.path.join(work, "out", "figure_5b.csv"), newline="") as file:
            self.assertGreater(len(list(csv.DictReader(file))), 10)
        self.assertGreater(os.path.getsize(os.path.join(work, "out", "figure_5b.png")), 5000)
        self.assertEqual(files_below(self.prefix), before)


@unittest.skipUnless(shutil.which("dpkg-shlibdeps"), "this test needs dpkg-dev")
class DebianPackages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="swirl-debian-")
        cls.addClassCleanup(folder.cleanup)
        output_of("cpack", "-G", "DEB", "-B", folder.name, cwd=BUILD)
        cls.packages = sorted(glob.glob(folder.name + "/*.deb"))

    def package(self, name):
        (package,) = (p for p in self.packages if os.path.basename(p).startswith(name + "_"))
        return package

    def field(self, package, name):
        return re.split(", ?", output_of("dpkg-deb", "--field", package, name).strip())

    def test_program_lists_its_dependencies_once(self):
        package = self.package("swirl")
        required, recommended = self.field(package, "Depends"), self.field(package, "Recommends")
        # HDF5 is part of the program on Debian 12 (cmake/program.cmake), and needs zlib there.
        # Elsewhere it is a library, which depends on zlib itself.
        of_hdf5 = "libhdf5" if "libhdf5" in ", ".join(required) else "zlib1g"
        for name in ("libc6", "libcairo2", "libfmt", of_hdf5, "fonts-dejavu-core"):
            self.assertIn(name, ", ".join(required))
        for name in ("ffmpeg", "python3-matplotlib"):
            self.assertIn(name, recommended)
        names = [name.partition(" ")[0] for name in required + recommended]
        self.assertEqual(sorted(set(names)), sorted(names))
        files = output_of("dpkg-deb", "--contents", package)
        for path in (
            "usr/bin/swirl",
            "usr/libexec/swirl/swirl-commands",
            "usr/share/swirl/paper/figures/figure_5b.py",
            "usr/share/doc/swirl/copyright",
            "usr/share/man/man1/swirl.1.gz",
            "usr/share/man/man1/swirl-run.1.gz",
            "usr/share/bash-completion/completions/swirl",
            "usr/share/zsh/vendor-completions/_swirl",
            "usr/share/fish/vendor_completions.d/swirl.fish",
        ):
            self.assertIn(path, files)
        for path in ("usr/include", ".a\n", "swirlConfig.cmake"):
            self.assertNotIn(path, files)

    def test_library_depends_on_the_standard_library_alone(self):
        package = self.package("libswirl-dev")
        self.assertEqual(self.field(package, "Depends"), ["g++ | libstdc++-dev"])
        self.assertEqual(self.field(package, "Recommends"), [""])
        files = output_of("dpkg-deb", "--contents", package)
        for path in (
            "usr/include/swirl/engine/simulation.hpp",
            "swirlConfig.cmake",
            "usr/share/doc/libswirl-dev/copyright",
        ):
            self.assertIn(path, files)
        self.assertNotIn("usr/bin", files)

    @unittest.skipUnless(shutil.which("lintian"), "this test needs lintian")
    def test_lintian_finds_no_error(self):
        done = subprocess.run(
            ["lintian", "--allow-root", "--fail-on", "error", *self.packages],
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, done.stdout)
        for tag in ("manual-page", "groff-message", "gzip", "whatis"):
            self.assertNotIn(tag, done.stdout)

    def test_apt_can_install_them_together(self):
        self.assertEqual(len(self.packages), 2)
        output_of("apt-get", "install", "--simulate", "--no-install-recommends", *self.packages)


if __name__ == "__main__":
    unittest.main()
