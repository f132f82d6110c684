"""The launcher ./swirl on a small project of one file: it builds after changes, never runs a stale
program, starts no other program if the build is up to date, and becomes the program."""

import fcntl
import os
import re
import shutil
import signal
import subprocess
import time
import unittest

from program import HANG, SOURCE, InFolder, other_user, read_text, swirl, wait_until, write_text

WITHOUT_COMMANDS = """cmake_minimum_required(VERSION 3.25)
project(small LANGUAGES CXX)
file(GLOB sources CONFIGURE_DEPENDS src/*.cpp)
add_executable(swirl ${sources})
"""
CMAKE = (
    WITHOUT_COMMANDS
    + """foreach(name run movie image synthetic-video crossing sweep map track experiment paper)
  add_executable(swirl-${name} ${sources})
endforeach()
"""
)
# Without CMake's tests of the compiler, which the tests below do not need.
PRESETS = """{"version": 6, "configurePresets": [{"name": "release", "generator": "Ninja",
 "binaryDir": "${sourceDir}/build/release", "cacheVariables": {"CMAKE_CXX_COMPILER_FORCED": "ON",
 "CMAKE_CXX_COMPILER_ID_RUN": "ON", "CMAKE_CXX_COMPILER_ID": "GNU"}}]}"""
PROGRAM = """#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <unistd.h>
int main(int argc, char** argv) {
    if (std::getenv("SWIRL_PARSE_ONLY")) return argc > 2 && std::strcmp(argv[2], "--wrong") == 0 ? 2 : 0;
    std::printf("%s %d\\n", "WORD", int(getpid()));
    std::fflush(stdout);
    if (argc > 2 && std::strcmp(argv[2], "wait") == 0) pause();
    return argc > 1 ? std::atoi(argv[1]) : 0;
}
"""


class Launcher(InFolder):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path("cmake"))
        os.makedirs(self.path("bindings/python"))
        self.copy("swirl")
        self.copy("cmake/launcher.sh")
        self.copy("src/swirl/cli/command_list.hpp")
        self.write("packages", "[build]\ng++\ncmake\nninja-build\n[figures]\n")
        self.write("CMakeLists.txt", CMAKE)
        self.write("CMakePresets.json", PRESETS)
        self.write_program("first")

    def copy(self, name):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        shutil.copy(os.path.join(SOURCE, name), self.path(name))

    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        write_text(self.path(name), text)

    def write_program(self, word):
        self.write("src/main.cpp", PROGRAM.replace("WORD", word))

    def call(self, *arguments):
        return subprocess.run(
            [self.path("swirl"), *arguments], capture_output=True, text=True, timeout=HANG, cwd="/"
        )

    def word(self):
        done = self.call()
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.split()[0]

    def test_builds_once_and_then_starts_only_the_program(self):
        done = self.call()
        self.assertEqual(done.stdout.split()[0], "first")
        self.assertIn("building", done.stderr)
        # The second call starts no program that builds, installs or queries packages.
        for name in (
            "cmake",
            "ninja",
            "make",
            "c++",
            "g++",
            "cc",
            "gcc",
            "ld",
            "ccache",
            "dpkg-query",
            "apt-get",
            "git",
            "python3",
        ):
            self.stand_in(name, f'echo {name} >>{self.path("started")}\nexit 1\n')
        done = self.call_with_stand_ins()
        self.assertEqual((done.stdout.split()[:1], done.stderr), (["first"], ""))
        self.assertFalse(os.path.exists(self.path("started")))
        self.write_program("second")  # the stand-ins make a build fail
        self.assertNotEqual(self.call_with_stand_ins().returncode, 0)
        self.assertTrue(os.path.exists(self.path("started")))

    def test_environment_variables_do_not_leak_into_the_build(self):
        names = (
            "settings",
            "me",
            "long",
            "home",
            "stamp",
            "section",
            "sections",
            "camera",
            "door",
            "folder",
            "changed",
            "log",
            "missing",
            "wanted",
            "installed",
            "git_folder",
            "built",
        )
        leaks = dict(os.environ, **{name: "-DLEAKED=ON" for name in names})
        self.copy("bindings/python/python.sh")
        self.write(
            "CMakeLists.txt",
            CMAKE
            + """add_custom_target(swirl_python VERBATIM
  COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/bindings/python/swirl.py python/swirl.py)
""",
        )
        self.write("bindings/python/swirl.py", "word = 'module'\n")
        for call, word in (
            ([], "first"),
            (["python", "-c", "import swirl; print(swirl.word)"], "module"),
        ):
            with self.subTest(call):
                done = subprocess.run(
                    [self.path("swirl"), *call],
                    capture_output=True,
                    text=True,
                    timeout=HANG,
                    env=leaks,
                    cwd="/",
                )
                self.assertEqual(done.stdout.split()[:1], [word], done.stderr)
                self.assertNotIn("LEAKED", done.stderr)
                self.assertFalse("LEAKED" in read_text(self.path("build/release/CMakeCache.txt")))

    def test_an_empty_entry_of_pythonpath_is_not_the_current_folder(self):
        self.copy("bindings/python/python.sh")
        self.write("CMakeLists.txt", CMAKE + "add_custom_target(swirl_python)\n")
        for given, others in (("", []), (":", []), (":/x::/y:", ["/x", "/y"])):
            with self.subTest(given):
                done = subprocess.run(
                    [
                        self.path("swirl"),
                        "python",
                        "-P",
                        "-S",
                        "-c",
                        "import sys; print(*sys.path)",
                    ],
                    capture_output=True,
                    text=True,
                    timeout=HANG,
                    cwd="/tmp",
                    env=dict(os.environ, PYTHONPATH=given),
                )
                path = done.stdout.split()
                self.assertEqual(
                    path[: 1 + len(others)],
                    [self.path("build/release/python"), *others],
                    done.stderr,
                )
                self.assertNotIn("/tmp", path)

    def test_a_stale_build_of_another_user_is_an_error_with_a_hint(self):
        self.assertEqual(self.word(), "first")
        as_other = other_user()
        os.chmod(self.folder, 0o755)
        if not as_other:
            os.chmod(self.path("build/release"), 0o555)
            self.addCleanup(os.chmod, self.path("build/release"), 0o755)

        def call():
            return subprocess.run(
                [self.path("swirl")],
                capture_output=True,
                text=True,
                timeout=HANG,
                cwd="/",
                **as_other,
            )

        done = call()
        self.assertEqual(done.stdout.split()[:1], ["first"], done.stderr)  # the build is up to date
        self.write_program("second")
        done = call()
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        said = done.stderr.splitlines()
        self.assertEqual(len(said), 2, done.stderr)
        self.assertRegex(
            said[0], rf"^error: cannot build: '{self.folder}/build.*' cannot be written"
        )
        remedy = r"sudo chown -R \d+" if as_other else r"chmod -R u\+w"
        self.assertRegex(said[1], rf"^hint: {remedy} {self.folder}/build(;|$)")

    def test_never_runs_a_stale_program(self):
        self.assertEqual(self.word(), "first")
        self.write_program("second")
        self.assertEqual(self.word(), "second")
        # A file with an old date replaces the new one, as with `mv` or `tar`.
        self.write_program("third")
        os.utime(self.path("src/main.cpp"), (1e9, 1e9))
        self.assertEqual(self.word(), "third")
        # Adding and removing a file.
        self.write("src/more.cpp", "int more() { return 1; }\n")
        self.assertEqual(self.word(), "third")
        os.remove(self.path("src/more.cpp"))
        self.assertEqual(self.word(), "third")

    def test_a_failed_build_is_reported_and_nothing_is_run(self):
        self.assertEqual(self.word(), "first")
        self.write("src/main.cpp", "int main() { return missing_name; }\n")
        done = self.call()
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout, "")
        self.assertIn("missing_name", done.stderr)
        self.assertIn("the build failed", done.stderr)
        self.write_program("fixed")
        self.assertEqual(self.word(), "fixed")

    def test_a_moved_tree_is_built_from_scratch(self):
        self.assertEqual(self.word(), "first")
        new = self.path("moved")
        os.makedirs(new)
        for name in (
            "src",
            "cmake",
            "build",
            "swirl",
            "packages",
            "CMakeLists.txt",
            "CMakePresets.json",
        ):
            shutil.move(self.path(name), new)
        write_text(os.path.join(new, "src", "main.cpp"), PROGRAM.replace("WORD", "elsewhere"))
        done = subprocess.run(
            [os.path.join(new, "swirl")], capture_output=True, text=True, timeout=HANG
        )
        self.assertEqual(done.stdout.split()[:1], ["elsewhere"], done.stderr)

    def test_becomes_the_program_with_its_exit_code_and_signals(self):
        self.assertEqual(self.word(), "first")
        self.assertEqual(self.call("7").returncode, 7)
        process = subprocess.Popen(
            [self.path("swirl"), "0", "wait"], stdout=subprocess.PIPE, text=True
        )
        self.assertEqual(process.stdout.readline().split(), ["first", str(process.pid)])
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=HANG)
        self.assertEqual(process.returncode, -signal.SIGTERM)

    def built(self):
        """The commands that have a program."""
        files = os.listdir(self.path("build/release"))
        return sorted(name[6:] for name in files if re.fullmatch("swirl-[a-z-]+", name))

    def test_a_command_is_built_when_it_is_called(self):
        self.write("CMakeLists.txt", CMAKE + "add_custom_target(swirl_python)\n")
        called = set()
        for name in ("run", "run", "movie", "run", "paper", "paper", "synthetic-video", "movie"):
            with self.subTest(name):
                done = self.call(name)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual("building" in done.stderr, name not in called)
                called.add(name)
                self.assertEqual(self.built(), sorted(called))
        self.call("paper", "--movies")
        # A change of the sources builds the command that is called.
        self.write_program("second")
        self.assertEqual(self.call("run").stdout.split()[0], "second")
        for name, word in (("run", "second"), ("movie", "first")):
            done = subprocess.run(
                [self.path("build/release/swirl-" + name)], capture_output=True, text=True
            )
            self.assertEqual(done.stdout.split()[0], word)

    def test_movies_of_the_paper_need_a_second_command(self):
        self.write("CMakeLists.txt", CMAKE + "add_custom_target(swirl_python)\n")
        self.assertEqual(self.call("paper", "--movies").returncode, 0)
        self.assertEqual(self.built(), ["movie", "paper"])

    def test_videos_of_an_experiment_need_a_second_command(self):
        done = self.call("experiment", "tracks.csv", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.built(), ["experiment"])
        self.assertEqual(self.call("experiment", "tracks.csv", "N36.mp4").returncode, 0)
        self.assertEqual(self.built(), ["experiment", "track"])

    def test_help_builds_no_command_but_the_command_help_does(self):
        self.call("run")
        done = self.call("movie", "--help")
        self.assertIn("`./swirl help movie` builds it", done.stderr)
        self.assertEqual((done.returncode, self.built()), (0, ["run"]))
        self.assertEqual(self.call("help", "movie").returncode, 0)
        self.assertEqual(self.built(), ["movie", "run"])

    def test_a_command_without_its_library_is_built_when_the_library_is_there(self):
        without = CMAKE.replace(" track", "") + "add_custom_target(swirl-track)\n"
        self.write("CMakeLists.txt", without)
        for _ in range(2):
            self.assertIn("building", self.call("track").stderr)
            self.assertEqual(self.built(), [])
        self.write("CMakeLists.txt", CMAKE)
        self.call("track")
        self.assertEqual(self.built(), ["track"])
        self.assertEqual(self.call("track").stderr, "")

    def test_works_through_a_link(self):
        os.symlink(self.path("swirl"), self.path("link"))
        done = subprocess.run([self.path("link")], capture_output=True, text=True, timeout=HANG)
        self.assertEqual(done.stdout.split()[0], "first")

    def test_simultaneous_calls_build_once(self):
        both = [
            subprocess.Popen(
                [self.path("swirl")], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
            )
            for _ in range(2)
        ]
        outputs = [process.communicate(timeout=HANG) for process in both]
        self.assertEqual([out.split()[0] for out, _ in outputs], ["first", "first"])
        self.assertEqual(sum("building" in errors for _, errors in outputs), 1)

    def stand_in(self, name, script):
        """A program of that name, first on the PATH of call_with_stand_ins()."""
        os.makedirs(self.path("bin"), exist_ok=True)
        self.write("bin/" + name, "#!/bin/sh\n" + script)
        os.chmod(self.path("bin/" + name), 0o755)

    def call_with_stand_ins(self, *arguments, **environment):
        path = self.path("bin") + ":" + os.environ["PATH"]
        return subprocess.run(
            [self.path("swirl"), *arguments],
            capture_output=True,
            text=True,
            timeout=HANG,
            env=dict(os.environ, PATH=path, **environment),
        )

    def test_without_root_the_install_command_is_printed(self):
        self.write("packages", "[build]\ng++\nswirl-no-such-package\n[figures]\n")
        self.stand_in("id", "echo 1000\n")
        done = self.call_with_stand_ins()
        self.assertEqual(done.returncode, 1)
        self.assertIn(
            "sudo apt-get install --no-install-recommends swirl-no-such-package\n", done.stderr
        )

    def test_as_root_it_can_be_forbidden_to_install(self):
        self.write("packages", "[build]\ng++\nswirl-no-such-package\n[figures]\n")
        self.stand_in("id", "echo 0\n")
        self.stand_in("apt-get", f'echo "$@" >>{self.path("asked")}\nexit 1\n')
        done = self.call_with_stand_ins(SWIRL_INSTALL="no")
        self.assertEqual(done.returncode, 1)
        self.assertIn(
            "\n    apt-get install --no-install-recommends swirl-no-such-package\n", done.stderr
        )
        self.assertFalse(os.path.exists(self.path("asked")))
        done = self.call_with_stand_ins()
        self.assertEqual(done.returncode, 1)
        self.assertTrue(os.path.exists(self.path("asked")))
        self.assertIn(
            "installing Debian packages, once (SWIRL_INSTALL=no forbids it): "
            "swirl-no-such-package\n",
            done.stderr,
        )

    def test_an_interrupted_installation_is_reported_with_its_remedy(self):
        self.write("packages", "[build]\nswirl-no-such-package\n")
        self.stand_in("id", "echo 0\n")
        self.stand_in(
            "apt-get",
            f"""echo "$@" >>{self.path("asked")}
echo "E: dpkg was interrupted, you must manually run 'dpkg --configure -a' to correct the problem." >&2
exit 100
""",
        )
        done = self.call_with_stand_ins()
        self.assertEqual(done.returncode, 1)
        self.assertTrue(done.stderr.endswith("\n    dpkg --configure -a\n"), done.stderr)
        self.assertNotIn("update", read_text(self.path("asked")))

    def test_a_usage_error_installs_nothing(self):
        self.write("packages", "[build]\ng++\n[movies]\nno-movies\n")
        self.stand_in("id", "echo 0\n")
        self.stand_in("apt-get", f'echo "$@" >>{self.path("asked")}\n')
        for command in ("movie", "track"):
            done = self.call_with_stand_ins(command, "--wrong")
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertFalse(os.path.exists(self.path("asked")))
        done = self.call_with_stand_ins("track", "right")
        self.assertEqual(done.stdout.split()[:1], ["first"], done.stderr)
        self.assertTrue(os.path.exists(self.path("asked")))

    def test_packages_of_a_library_are_installed_to_build_the_command(self):
        self.write("packages", "[build]\ng++\n[drawing]\ng++\n[camera]\nno-camera\n")
        self.stand_in("id", "echo 1000\n")
        self.assertEqual(self.call_with_stand_ins("movie").returncode, 0)
        done = self.call_with_stand_ins("track")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("sudo apt-get install --no-install-recommends no-camera\n", done.stderr)

    def test_help_installs_and_builds_nothing(self):
        for name in ("cmake", "ninja", "g++", "apt-get", "dpkg-query"):
            self.stand_in(name, f'echo {name} >>{self.path("started")}\nexit 1\n')
        listed = self.call_with_stand_ins("--help")
        self.assertEqual((listed.returncode, listed.stderr), (0, ""))
        for call in (["-h"], ["help"], ["run", "--help"], ["run", "--discs", "4", "-h"]):
            with self.subTest(call):
                done = self.call_with_stand_ins(*call)
                self.assertEqual((done.returncode, done.stdout), (0, listed.stdout))
        self.assertIn("`./swirl help run` builds it and prints its options", done.stderr)
        done = self.call_with_stand_ins("nothing", "-h")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("there is no command 'nothing'", done.stderr)
        self.copy("bindings/python/python.sh")
        self.assertIn("Usage: swirl python", self.call_with_stand_ins("python", "--help").stdout)
        self.assertFalse(os.path.exists(self.path("started")))
        self.assertFalse(os.path.exists(self.path("build")))
        # With a program, help comes from the program, even if the sources have changed since.
        self.call("run")
        self.write_program("second")
        done = self.call_with_stand_ins("run", "--help")
        self.assertEqual(done.stdout.split()[:1], ["first"])
        self.assertIn("note: this is the help of the last build", done.stderr)
        self.assertFalse(os.path.exists(self.path("started")))

    def test_the_list_of_commands_is_that_of_the_program(self):
        """`./swirl --help` adds the scripts of this folder."""
        ours = swirl("--help").stdout.splitlines()
        with_scripts = self.call("--help").stdout.splitlines()
        scripts = [line for line in with_scripts if line not in ours]
        self.assertEqual(
            [line.strip().partition("  ")[0] for line in scripts],
            ["lab", "For developers:", "site", "python"],
        )
        # Their group has an empty line above it, too.
        self.assertEqual(
            [line for line in with_scripts if line and line not in scripts],
            [line for line in ours if line],
        )

    def test_only_changes_of_the_packages_of_the_build_make_it_stale(self):
        launcher = read_text(self.path("cmake/launcher.sh"))
        self.write("cmake/launcher.sh", launcher.replace("/var/lib/dpkg", self.path("dpkg")))
        packages = [
            self.path("dpkg/info/" + name)
            for name in (
                "g++.list",
                "cmake:amd64.list",
                "other.list",
                "coreutils.list",
                "libfmt-dev:amd64.list",
            )
        ]
        self.write(
            "packages",
            "[build]\ng++\ncmake\nninja-build\nlibfmt-dev\n[figures]\nother\n[camera]\ncoreutils\n",
        )
        for name in [self.path("dpkg/status"), *packages]:
            self.write(name, "")
        self.call("run")
        self.call("track")
        for name, builds in (
            (self.path("dpkg/status"), False),
            (packages[2], False),
            (packages[0], True),
            (packages[1], False),
            (packages[3], False),
            (packages[4], True),
        ):
            with self.subTest(name):
                os.utime(name)
                self.assertEqual(
                    "sources have changed" in self.call("run", "--help").stderr, builds
                )
                self.assertEqual(self.call("run").returncode, 0)
                self.assertNotIn("note", self.call("run", "--help").stderr)
        # The camera's packages count for the commands that use it.
        self.call("track")
        self.write(packages[3], "")
        self.assertIn("sources have changed", self.call("track", "--help").stderr)
        self.assertNotIn("note", self.call("run", "--help").stderr)

    def test_without_dpkg_it_lists_what_is_missing(self):
        everything = self.path("bin")
        os.makedirs(everything)
        for folder in ("/bin", "/usr/bin"):
            for name in os.listdir(folder):
                if not name.startswith(("dpkg", "apt", "cmake", "ninja")):
                    if not os.path.lexists(os.path.join(everything, name)):
                        os.symlink(os.path.join(folder, name), os.path.join(everything, name))

        def call():
            return subprocess.run(
                [self.path("swirl")],
                capture_output=True,
                text=True,
                timeout=HANG,
                env=dict(os.environ, PATH=everything),
            )

        done = call()
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("no dpkg, so install these yourself:\n    cmake\n    ninja\n", done.stderr)
        self.assertIn("cmake --preset release && cmake --build --preset release", done.stderr)
        self.assertNotIn("compiler", done.stderr)
        self.assertNotIn("fmt", done.stderr)
        for name in ("c++", "g++", "clang++"):
            if os.path.lexists(os.path.join(everything, name)):
                os.remove(os.path.join(everything, name))
        self.assertIn("\n    a C++20 compiler\n", call().stderr)

    def test_rejects_folders_that_cmake_does_not_support(self):
        for name in ('a "b"', "a;b", "a\\b"):
            strange = self.path(name)
            os.makedirs(strange)
            for part in ("src", "cmake"):
                shutil.copytree(self.path(part), os.path.join(strange, part))
            shutil.copy(self.path("swirl"), strange)
            done = subprocess.run([os.path.join(strange, "swirl")], capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(
                done.stderr, r"\Aerror: cannot build in '.*': CMake does not support .*\n\Z"
            )
            self.assertFalse(os.path.exists(os.path.join(strange, "build")))

    def test_works_in_a_folder_with_a_strange_name_and_without_home(self):
        strange = self.path("it's a tëst & $HOME `x`")
        os.makedirs(strange)
        for name in ("src", "cmake", "swirl", "packages", "CMakeLists.txt", "CMakePresets.json"):
            shutil.move(self.path(name), strange)
        subprocess.run(["git", "init", "-q", strange], check=True)
        subprocess.run(
            [
                "git",
                "-C",
                strange,
                "-c",
                "user.name=a",
                "-c",
                "user.email=a@b",
                "commit",
                "-q",
                "--allow-empty",
                "-m",
                "first",
            ],
            check=True,
        )
        for builds in (True, False):
            done = subprocess.run(
                [os.path.join(strange, "swirl")],
                capture_output=True,
                text=True,
                timeout=HANG,
                cwd="/",
                env={name: text for name, text in os.environ.items() if name != "HOME"},
            )
            self.assertEqual(done.stdout.split()[:1], ["first"], done.stderr)
            self.assertEqual("building" in done.stderr, builds)

    def start(self, *arguments, **more):
        return subprocess.Popen(
            [self.path("swirl"), *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            **more,
        )

    def start_a_build_that_waits(self, **more):
        """A call whose build continues when the file build/release/end exists."""
        self.write("wait.sh", "echo . >>begun\nuntil [ -e end ]; do sleep 0.05; done\n")
        self.write(
            "CMakeLists.txt",
            CMAKE
            + """add_custom_command(OUTPUT waited.txt VERBATIM
  COMMAND sh ${PROJECT_SOURCE_DIR}/wait.sh COMMAND ${CMAKE_COMMAND} -E touch waited.txt)
add_custom_target(waits DEPENDS waited.txt)
add_dependencies(swirl waits)
""",
        )
        started = self.start(**more)
        wait_until(lambda: os.path.exists(self.path("build/release/begun")), started)
        return started

    WAITS = r"\Aswirl: waiting for another build \(since \d\d:\d\d\)\n\Z"

    def test_a_call_waits_for_the_build_of_a_killed_call_and_says_so(self):
        killed = self.start_a_build_that_waits()
        killed.kill()
        killed.wait()
        second = self.start()
        self.assertRegex(second.stderr.readline(), self.WAITS)
        self.write("build/release/end", "")
        self.assertEqual(second.communicate(timeout=HANG)[0].split()[0], "first")
        killed.communicate(timeout=HANG)
        with open(self.path("build/release/begun")) as file:
            self.assertEqual(len(file.readlines()), 1)

    def held(self, name):
        """Holds a folder as a build does, until the returned function is called."""
        os.makedirs(self.path(name), exist_ok=True)
        folder = os.open(self.path(name), os.O_RDONLY)
        fcntl.flock(folder, fcntl.LOCK_EX)
        self.write(name + "/.since", "14:03\n")
        return lambda: os.close(folder)

    def test_only_a_call_that_must_build_waits_for_the_build_of_the_same_preset(self):
        for folder in ("build", "build/tests", "build/wasm"):
            self.addCleanup(self.held(folder))
        self.assertEqual(self.word(), "first")
        let_go = self.held("build/release")
        done = self.call()  # up to date
        self.assertEqual((done.stdout.split()[0], done.stderr), ("first", ""))
        self.write_program("second")
        for call in (
            ["--version"],
            ["--help"],
            ["run", "--help"],
            ["lab", "--help"],
            ["python", "--help"],
        ):
            with self.subTest(call):
                self.copy("web/lab.sh")
                self.assertNotIn("waiting", self.call(*call).stderr)
        waits = self.start()
        self.assertEqual(
            waits.stderr.readline(), "swirl: waiting for another build (since 14:03)\n"
        )
        let_go()
        self.assertEqual(waits.communicate(timeout=HANG)[0].split()[0], "second")

    def test_the_version_needs_no_build(self):
        self.write(
            "CMakeLists.txt",
            CMAKE + "# as in the real project\nproject(swirl VERSION 3.2.1 LANGUAGES CXX)\n",
        )
        done = self.call("--version")
        self.assertEqual(
            (done.returncode, done.stdout, done.stderr), (0, "3.2.1 (not built yet)\n", "")
        )
        self.assertFalse(os.path.exists(self.path("build")))

    def test_the_page_is_built_without_waiting_for_the_program(self):
        self.copy("web/lab.sh")
        for name, script in (
            ("clang++-19", "exit 0"),
            ("wasm-opt", "exit 0"),
            ("node", "exit 0"),
            ("zopfli", "echo x"),
            (
                "cmake",
                'case "$*" in *--fresh* | *--build*) exit 0 ;; esac; exit 1',
            ),  # in a moved tree
            (
                "npm",
                f"echo x >>{self.path('builds')}\n"
                "[ $1 != run ] || { mkdir -p ../build/lab && echo page | tee "
                "../build/lab/index.html >../build/lab/laboratory.html; }",
            ),
        ):
            self.stand_in(name, script + "\n")
        for folder in ("build", "build/release", "build/tests"):
            self.addCleanup(self.held(folder))
        call = ["lab", "--out", self.path("page.html")]
        self.assertEqual(self.call_with_stand_ins(*call).returncode, 0)
        let_go = self.held("build/wasm")
        done = self.call_with_stand_ins(*call)
        self.assertNotIn("waiting", done.stderr)
        self.assertEqual(read_text(self.path("builds")), "x\nx\n")  # install and run, once
        # A build that failed leaves no page that a later call takes for a finished one.
        let_go()
        self.write("web/page.ts", "")
        self.stand_in(
            "npm",
            "mkdir -p ../build/lab && echo half | tee ../build/lab/index.html "
            ">../build/lab/laboratory.html\nexit 1\n",
        )
        for _ in range(2):
            done = self.call_with_stand_ins(*call)
            self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(read_text(self.path("page.html")), "page\n")

    def test_ctrl_c_ends_all_processes_of_a_build(self):
        started = self.start_a_build_that_waits(start_new_session=True)
        os.killpg(started.pid, signal.SIGINT)
        said = started.communicate(timeout=HANG)[1]  # until all of them have closed the pipes
        self.assertNotEqual(started.returncode, 0)
        self.assertNotIn("error", said)
        self.write("build/release/end", "")
        self.assertEqual(self.word(), "first")

    def test_reports_of_progress_end_with_a_killed_call_that_its_caller_has_not_noticed(self):
        self.stand_in("sleep", "exec /bin/sleep 0.1\n")
        path = self.path("bin") + ":" + os.environ["PATH"]
        started = self.start_a_build_that_waits(env=dict(os.environ, PATH=path))
        started.kill()  # from now on it is a zombie, since nothing waits for it
        self.write("build/release/end", "")
        started.communicate(timeout=HANG)

    def test_a_clock_that_was_ahead_leaves_no_stale_program(self):
        self.assertEqual(self.word(), "first")
        ahead = time.time() + 7200
        for folder, _, names in os.walk(self.folder):
            for name in names:
                if not os.path.islink(os.path.join(folder, name)):
                    os.utime(os.path.join(folder, name), (ahead, ahead))
        self.write_program("second")
        self.assertEqual(self.word(), "second")
        self.assertEqual(self.call().stderr, "")
        self.write_program("third")
        self.assertEqual(self.word(), "third")

    def on_a_small_disk(self, script):
        """Runs a script of sh in which build is a disk of 16 kB and ./swirl the launcher; its
        output and errors in one. The script changes the disk with `change OPTIONS`."""
        os.makedirs(self.path("build"))
        self.write("CMakeLists.txt", WITHOUT_COMMANDS)
        # The old options of the disk name an owner without a number in the new namespace, so they
        # are ignored.
        before = """change() { mount --options-mode ignore -t tmpfs -o "remount,$1" swirl build || fail; }
fail() { echo "cannot mount"; exit; }
cd "$1" && mount -t tmpfs -o size=16k swirl build || fail
"""
        done = subprocess.run(
            [
                "unshare",
                "--map-root-user",
                "--mount",
                "sh",
                "-c",
                before + script,
                "sh",
                self.folder,
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=HANG,
        )
        if done.stdout.startswith("unshare: ") or "cannot mount\n" in done.stdout:
            self.skipTest("no small disk can be mounted here: " + done.stdout)
        return done.stdout

    def test_a_full_disk_leaves_nothing_that_a_later_call_takes_for_finished(self):
        said = self.on_a_small_disk(
            """for size in 16k 64k 150k 250k 350k 450k 600k; do
            change size=$size; ./swirl; echo "code $?"; done
        change size=100m; ./swirl"""
        )
        self.assertRegex(said, r"first \d+\n\Z")
        codes = re.findall(r"^code (\d+)$", said, re.M)
        self.assertEqual(
            codes, sorted(codes, reverse=True)
        )  # it builds as soon as the disk suffices
        self.assertIn("1", codes)
        self.assertLessEqual(set(codes), {"0", "1"})
        errors = re.findall(r"^error: .*$", said, re.M)
        self.assertEqual(len(errors), codes.count("1"), said)
        for error in errors:
            self.assertRegex(
                error, "^error: cannot build: no space is left in '.*/build/release'.$"
            )

    def test_a_read_only_tree_runs_what_is_built_and_reports_what_is_not(self):
        said = self.on_a_small_disk(
            """change size=100m; ./swirl
        change ro; ./swirl; echo "code $?"; touch src/main.cpp; ./swirl; echo "code $?"
        umount build; mount -t tmpfs -o ro swirl build || fail; ./swirl; echo "code $?"
        """
        )
        built, stale, empty = re.split(r"code \d\n", said)[:3]
        self.assertEqual(re.findall(r"code (\d)", said), ["0", "1", "1"], said)
        self.assertRegex(
            stale, r"\Aerror: cannot build: '.*' cannot be written\.\nhint: [^\n]*\n\Z"
        )
        self.assertRegex(empty, r"\Aerror: cannot write to [^\n]*\n\Z")

    def test_packages_of_a_subcommand_are_installed_once(self):
        self.write("CMakeLists.txt", CMAKE + "add_custom_target(swirl_python)\n")
        self.write(
            "packages", "[build]\ng++\n[figures]\nno-painter\n[movies]\nno-camera\n[images]\ng++\n"
        )
        self.stand_in("id", "echo 0\n")
        self.stand_in("apt-get", f'echo "$@" >>{self.path("asked")}\n')
        for call, wanted in (
            (["run"], None),
            (["image"], None),
            (["image", "--", "--movies"], None),
            (["movie"], "no-camera"),
            (["movie"], None),
            (["paper"], "no-painter"),
            (["paper", "--movies"], "no-camera no-painter"),
            (["image", "--over", "p.jpg"], "no-camera"),
        ):
            with self.subTest(call):
                done = self.call_with_stand_ins(*call)
                self.assertEqual(done.stdout.split()[:1], ["first"], done.stderr)
                asked = []
                if os.path.exists(self.path("asked")):
                    asked = read_text(self.path("asked")).splitlines()
                    os.remove(self.path("asked"))
                self.assertEqual(
                    [line.split("--no-install-recommends ")[1] for line in asked],
                    [wanted] if wanted else [],
                )

    def test_a_subcommand_runs_without_its_packages(self):
        self.write("packages", "[build]\ng++\n[movies]\nno-camera\n")
        self.stand_in("id", "echo 1000\n")
        done = self.call_with_stand_ins("movie")
        self.assertIn("sudo apt-get install --no-install-recommends no-camera\n", done.stderr)
        self.assertEqual(done.stdout.split()[:1], ["first"])

    def test_python_finds_the_module(self):
        self.copy("bindings/python/python.sh")
        self.write(
            "CMakeLists.txt",
            CMAKE
            + """add_custom_target(swirl_python VERBATIM
  COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/bindings/python/swirl.py python/swirl.py)
""",
        )
        for word in ("first", "second"):
            self.write("bindings/python/swirl.py", f"word = {word!r}\n")
            for _ in range(2):
                done = self.call(
                    "python",
                    "-c",
                    "import swirl, sys; print(swirl.word, sys.executable, sys.argv[1:])",
                    "a b",
                )
                self.assertEqual(done.stdout, f"{word} /usr/bin/python3 ['a b']\n", done.stderr)
        # The module has its own build.
        self.assertFalse(os.path.exists(self.path("build/release/swirl")))
        self.assertEqual(self.word(), "first")

    def test_a_long_build_prints_its_progress(self):
        # The launcher reports when its sleep has ended: here when the build has begun its second
        # step, which waits for the second sleep. The second sleep writes one file and a third one
        # none: a sleep may outlive the launcher, and the test then removes the folder.
        self.write("slower.sh", "touch begun\nuntil [ -e slept-twice ]; do sleep 0.05; done\n")
        self.stand_in(
            "sleep",
            f"""[ "$1" = 10 ] || exec /bin/sleep $1
cd {self.path("build/release")} && ! [ -e slept-twice ] || exit 1
while ! [ -e begun ]; do [ -d {self.folder} ] || exit; /bin/sleep 0.05; done
if [ -e slept ]; then touch slept-twice; else touch slept; fi
""",
        )
        self.write(
            "CMakeLists.txt",
            CMAKE
            + """add_custom_command(OUTPUT slow.txt VERBATIM
  COMMAND ${CMAKE_COMMAND} -E touch slow.txt)
add_custom_command(OUTPUT slower.txt DEPENDS slow.txt VERBATIM
  COMMAND sh ${PROJECT_SOURCE_DIR}/slower.sh COMMAND ${CMAKE_COMMAND} -E touch slower.txt)
add_custom_target(slow DEPENDS slower.txt)
add_dependencies(swirl slow)
""",
        )
        self.assertRegex(self.call_with_stand_ins().stderr, r"building: [1-9] of \d, \d\d %\n")


if __name__ == "__main__":
    unittest.main()
