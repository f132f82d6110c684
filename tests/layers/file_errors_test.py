"""A file that cannot be read is not absent: no code catches a file error without passing it on, and
only one place decides whether an optional file exists (src/swirl/io/optional_file.hpp,
paper/optional_file.py)."""

import os
import re
import unittest

SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)

# Handlers that do not pass the error on, by file and number in it, with the reason.
HANDLERS = {
    "src/swirl/cli/main.cpp": "prints the message and ends the program with its exit code",
    "src/swirl/cli/documents.cpp": "as above",
    "src/swirl/cli/swirl.cpp": "as above, for a call that no command gets",
    "src/swirl/cli/trial_reading.cpp": "a child process, of which only a crash matters",
    "src/swirl/io/journaled_driver.cpp": "the HDF5 library is in between: the message is stored "
    "and thrown after it",
    "src/swirl/io/hdf5.cpp": "as above",
    "src/swirl/io/result_writer.cpp": "a thread's error is stored and thrown again by finish()",
    "src/swirl/io/trajectory_writer.cpp": "a thread's error is stored and thrown again",
    "src/swirl/render/frame_pipeline.cpp": "as above",
    "src/swirl/run/parallel_for.cpp": "as above; and fewer threads, if the system gives no more",
    "src/swirl/run/recorded_run.cpp": "a checkpoint that cannot be written is a warning",
    "src/swirl/study/sweep.cpp": "file errors are thrown before; other errors are those of one "
    "run, and stored",
    "track/cli/command_experiment.cpp": "the message is the result of this video, and a warning",
    "bindings/python/calls.cpp": "becomes a Python exception",
    "bindings/python/module.cpp": "becomes a Python exception",
}
# What asks the system about a file and takes every error for absence.
LENIENT_CPP = re.compile(r"(?:fs|filesystem)::exists\(|\bifstream\b|\baccess\([^)]*F_OK")
LENIENT_PYTHON = re.compile(
    r"os\.path\.(?:exists|isfile|isdir)\(|\.is_file\(\)|\.exists\(\)|\bglob\.glob\("
)
PYTHON_PLACES = {
    "paper/catalogue.py": "the modules of the program itself",
    "paper/optional_file.py": "the only place",
    "bindings/python/swirl/_files.py": "the only place of the module",
}
CPP_PLACES = {
    "src/swirl/io/atomic_file.cpp": "names of new files, and messages",
    "src/swirl/cli/command_paper.cpp": "the module of the program itself",
    "track/video/video.cpp": "only chooses the message of an error",
}


def sources(folders, ending):
    for folder in folders:
        for where, _, names in os.walk(os.path.join(SOURCE, folder)):
            relative = os.path.relpath(where, SOURCE)
            if "tests" in relative.split(os.sep):
                continue
            for name in sorted(names):
                if name.endswith(ending):
                    with open(os.path.join(where, name), encoding="utf-8") as file:
                        yield os.path.join(relative, name), file.read()


def block_after(text, begin):
    """The text from an opening brace to the one that closes it."""
    depth = 0
    for k in range(begin, len(text)):
        depth += {"{": 1, "}": -1}.get(text[k], 0)
        if depth == 0:
            return text[begin:k]
    return text[begin:]


class FileErrors(unittest.TestCase):
    def test_no_handler_swallows_a_file_error(self):
        catch = re.compile(r"catch \((?:const (?:FileError|std::exception)\b[^)]*|\.\.\.)\) \{")
        for path, text in sources(("src", "track", "bindings"), (".cpp", ".hpp")):
            for found in catch.finditer(text):
                block = block_after(text, found.end() - 1)
                with self.subTest(path=path, handler=block[:80]):
                    self.assertTrue(
                        "throw" in block or path in HANDLERS, "this handler ends the error"
                    )

    def test_python_does_not_swallow_a_file_error(self):
        handler = re.compile(
            r"^( *)except (?:\([^)]*\b(?:OSError|IOError)\b[^)]*\)|OSError|IOError)[^\n]*:[^\n]*\n"
            r"((?:\1 +[^\n]*\n|\n)+)",
            re.M,
        )
        for path, text in sources(("paper", "bindings/python", "track"), ".py"):
            for found in handler.finditer(text):
                passes = re.search(r"\braise\b|sys\.exit|\breport\(", found[2])
                is_clean_up = "another process writes it" in found[0]
                with self.subTest(path=path, handler=found[0][:80]):
                    self.assertTrue(passes or is_clean_up, "this handler ends the error")

    def test_one_place_decides_whether_a_file_exists(self):
        for files, lenient, allowed in (
            (sources(("src", "track", "bindings"), (".cpp", ".hpp")), LENIENT_CPP, CPP_PLACES),
            (sources(("paper", "bindings/python", "track"), ".py"), LENIENT_PYTHON, PYTHON_PLACES),
        ):
            for path, text in files:
                code = re.sub(r"//[^\n]*|#(?!include)[^\n]*|\"\"\".*?\"\"\"", "", text, flags=re.S)
                with self.subTest(path=path):
                    if path not in allowed:
                        self.assertEqual(lenient.findall(code), [])


if __name__ == "__main__":
    unittest.main()
