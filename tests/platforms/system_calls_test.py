"""The branches of io/system_calls.cpp for macOS and for other POSIX systems compile, and pass the
tests of the Linux branches. The folder macos/ has the declarations of macOS, and Linux functions
behind them. Nothing here ran on a Mac."""

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
MACOS = os.path.join(SOURCE, "tests", "platforms", "macos")
NO_LINUX = ["-U__linux__", "-U__gnu_linux__"]
BRANCHES = {
    "POSIX": NO_LINUX,
    "macOS": [
        *NO_LINUX,
        "-D__APPLE__",
        "-isystem",
        MACOS,
        "-include",
        os.path.join(MACOS, "macos.h"),
    ],
}
HOME = "src/swirl/io/system_calls.cpp"
# Functions, constants and files that only Linux has, or only some systems.
NOT_PORTABLE = (
    r"renameat2|RENAME_NOREPLACE|getrandom|getentropy|fdatasync|syncfs|sync_file_range|"
    r"sched_[gs]etaffinity|cpu_set_t|memfd_create|SOCK_CLOEXEC|SOCK_NONBLOCK|MSG_NOSIGNAL|pipe2|"
    r"accept4|O_TMPFILE|O_PATH|posix_fadvise|fallocate|prctl|epoll_\w+|eventfd|signalfd|"
    r"timerfd_\w+|inotify_\w+|splice|sendfile|copy_file_range|gettid|secure_getenv|get_nprocs|"
    r"getauxval|program_invocation_name|strerrorname_np|mremap|environ"
)


def code_of(path):
    with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
        return re.sub(r"//[^\n]*", "", file.read())


def sources():
    for top in ("src", "track", "bindings"):
        for folder, _, names in os.walk(os.path.join(SOURCE, top)):
            for name in names:
                if name.endswith((".cpp", ".hpp")):
                    yield os.path.relpath(os.path.join(folder, name), SOURCE)


class SystemCalls(unittest.TestCase):
    def test_one_file_has_what_differs_between_systems(self):
        files = set(sources())
        self.assertIn(HOME, files)
        self.assertTrue(re.search(rf"\b(?:{NOT_PORTABLE})\b", code_of(HOME)))
        for path in files - {HOME}:
            code = code_of(path)
            self.assertEqual(re.findall(rf"\b(?:{NOT_PORTABLE})\b", code), [], path)
            self.assertEqual(
                re.findall(r'"/proc/[^"]*"|<linux/[^>]*>|<sys/(?:prctl|random|epoll)\.h>', code),
                [],
                path,
            )
            # Large pages are a hint to Linux.
            if path != "src/swirl/engine/aligned_memory.hpp":
                self.assertNotRegex(code, r"__linux__|__APPLE__|madvise", path)

    def test_branches_for_other_systems_pass_the_tests(self):
        compiler = shutil.which("g++")
        if not compiler:
            self.skipTest("there is no g++")

        def compiled(source, name, *flags):
            output = os.path.join(folder, name)
            language = ["-std=gnu11"] if source.endswith(".c") else ["-std=c++20"]
            subprocess.run(
                [
                    compiler.replace("g++", "gcc") if source.endswith(".c") else compiler,
                    *language,
                    "-Wall",
                    "-Wextra",
                    "-Werror",
                    f"-I{SOURCE}/src",
                    f"-I{SOURCE}/tests",
                    *flags,
                    "-c",
                    os.path.join(SOURCE, source),
                    "-o",
                    output,
                ],
                check=True,
            )
            return output

        with tempfile.TemporaryDirectory() as folder:
            tests = compiled("tests/io/system_calls_test.cpp", "tests.o")
            macos = compiled("tests/platforms/macos/macos.c", "macos.o", *BRANCHES["macOS"][3:])
            for branch, flags in BRANCHES.items():
                with self.subTest(branch):
                    calls = compiled(
                        HOME,
                        "calls.o",
                        "-Wpedantic",
                        "-Wconversion",
                        "-Wno-sign-conversion",
                        *flags,
                    )
                    program = os.path.join(folder, "program")
                    subprocess.run(
                        [compiler, tests, calls, macos, "-lgtest", "-lgtest_main", "-o", program],
                        check=True,
                    )
                    done = subprocess.run([program], capture_output=True, text=True)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                    self.assertIn("[  PASSED  ] 6 tests", done.stdout)


if __name__ == "__main__":
    unittest.main()
