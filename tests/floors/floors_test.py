"""The house has floors, and the stairs go down only (docs/design.md). Reads every #include of src/
and fails on a climb; and holds the engine's floors to what they promise: standard library only, no
input or output, no clock, no threads, no exceptions."""

import os
import re
import unittest

SOURCE = os.environ.get("SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__)))))

# Which floors each may look at, its own aside.
ENGINE = ("math", "physics", "simulation", "measure")
BELOW = {
    "math": set(),
    "physics": {"math"},
    "simulation": {"math", "physics"},
    "measure": {"math", "physics"},
    "files": {*ENGINE},
    "draw": {"math", "physics", "measure"},
    "run": {*ENGINE, "files"},
    "study": {*ENGINE, "files", "run"},
    "film": {*ENGINE, "files", "draw", "run"},
    "vision": {*ENGINE, "files", "draw", "run"},
    "paper": {*ENGINE, "files", "draw", "run", "study", "film"},
    "app": {*ENGINE, "files", "draw", "run", "study", "film", "vision", "paper"},
}

FORBIDDEN_HEADERS = {
    "iostream", "fstream", "sstream", "cstdio", "stdio.h", "filesystem", "chrono", "ctime", "time.h",
    "thread", "mutex", "atomic", "future", "condition_variable", "random", "unistd.h", "print",
    "unordered_map", "unordered_set", "iomanip", "ostream", "istream", "format",
}
FORBIDDEN_WORDS = {"virtual", "throw", "try", "catch", "thread_local", "getenv", "rand"}

# docs/design.md: what the engine may ask of the system.
EXCEPTIONS = {("src/simulation/simulation.cpp", "sys/mman.h")}
STANDARD = {
    "algorithm", "array", "bit", "bitset", "cfloat", "charconv", "climits", "cmath", "compare",
    "complex", "concepts", "cstddef", "cstdint", "cstdlib", "cstring", "deque", "functional",
    "initializer_list", "iterator", "limits", "list", "map", "memory", "new", "numbers", "numeric",
    "optional", "queue", "ranges", "set", "span", "stack", "string", "string_view", "tuple",
    "type_traits", "utility", "variant", "vector", "version", "immintrin.h", "cpuid.h",
}


def sources(floor):
    for folder, _, names in sorted(os.walk(os.path.join(SOURCE, "src", floor))):
        for name in sorted(names):
            if name.endswith((".hpp", ".cpp", ".h", ".c", ".inc")):
                yield os.path.join(folder, name)


def text_of(file):
    with open(file, encoding="utf-8") as opened:
        return opened.read()


def includes(file):
    """(what, quoted?) of every #include."""
    return [(m.group(2), m.group(1) == '"')
            for m in re.finditer(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', text_of(file), re.M)]


def code_of(file):
    """The text without comments and string literals."""
    text = re.sub(r'"(\\.|[^"\\\n])*"', '""', text_of(file))
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    return re.sub(r"//[^\n]*", " ", text)


# Floors of whose files the compiler gets a few at once (the command line, too, whose files write
# one function for each kind of call).
COMPILED_AT_ONCE = ("measure", "files", "draw", "run", "study", "film", "vision", "paper")
DEFINITIONS = (
    # A function, up to its brace; a type; a constant.
    r"^(?!return|namespace|using|\s|template|\})[\w:<>&*,\[\]. ]*?[\w>&*\]] [*&]?(\w+)\([^;{}]*?\)"
    r"(?: const| noexcept)? \{",
    r"^(?:struct|class|enum|enum class) (\w+)",
    r"^(?:static )?(?:constexpr|const) [\w:<>*, ]*?(\w+)(?:\[[^\]]*\])? ?[={(]",
)


def names_of_its_own(text):
    """What a file defines in its unnamed namespaces."""
    code = re.sub(r'R"\((?:.|\n)*?\)"', '""', text)
    return {name
            for own in re.findall(r"^namespace \{\n(.*?)^\}  // namespace\n", code, re.S | re.M)
            for definition in DEFINITIONS for name in re.findall(definition, own, re.M)}


class Floors(unittest.TestCase):
    def test_every_folder_of_src_is_a_floor(self):
        found = {name for name in os.listdir(os.path.join(SOURCE, "src"))
                 if os.path.isdir(os.path.join(SOURCE, "src", name))}
        self.assertEqual(found - set(BELOW), set())
        for floor in ENGINE:
            self.assertTrue(list(sources(floor)), floor)

    def test_headers_that_take_long_to_compile_stay_in_few_files(self):
        for header, homes in (("CLI/CLI.hpp", {"parser.cpp"}), ("toml++/toml.h", {"config.cpp"})):
            found = {os.path.basename(file) for floor in BELOW for file in sources(floor)
                     if header in [what for what, _ in includes(file)]}
            self.assertEqual(found, homes, header)

    def test_one_place_says_what_is_compiled_for_several_processors(self):
        # And for which compilers and sanitizers not: the thread sanitizer's programs do not even
        # begin with such functions.
        found = {os.path.relpath(file, SOURCE) for floor in BELOW for file in sources(floor)
                 if "target_clones" in text_of(file)}
        self.assertEqual(found, {"src/math/wide.hpp"})

    def test_no_floor_looks_up_or_sideways(self):
        for floor, below in BELOW.items():
            for file in sources(floor):
                for what, _ in includes(file):
                    if not what.startswith("swirl/"):
                        continue
                    other = what.split("/")[1]
                    if other != floor:
                        self.assertIn(other, below, f"{file} includes {what}")

    def test_own_headers_are_named_as_whoever_uses_the_library_names_them(self):
        for floor in BELOW:
            for file in sources(floor):
                for what, quoted in includes(file):
                    if quoted and what != "version.inc":
                        self.assertTrue(what.startswith("swirl/"), f"{file} includes {what}")
                        self.assertIn(what.split("/")[1], BELOW, f"{file} includes {what}")
                        self.assertTrue(os.path.exists(os.path.join(SOURCE, "include", what)),
                                        f"{file} includes {what}, which is not there")

    def test_the_engine_uses_nothing_but_the_standard_library(self):
        for floor in ENGINE:
            for file in sources(floor):
                for what, quoted in includes(file):
                    if not quoted and (os.path.relpath(file, SOURCE), what) not in EXCEPTIONS:
                        self.assertIn(what, STANDARD, f"{file} includes <{what}>")
                        self.assertNotIn(what, FORBIDDEN_HEADERS, f"{file} includes <{what}>")

    def test_the_engine_keeps_its_promises(self):
        for floor in ENGINE:
            for file in sources(floor):
                words = set(re.findall(r"[A-Za-z_]+", code_of(file)))
                self.assertEqual(words & FORBIDDEN_WORDS, set(), file)
                self.assertNotRegex(code_of(file), r"std::\w*_distribution", file)
                self.assertNotRegex(code_of(file), r"std::\w*(random_device|mt19937)", file)

    def test_files_compiled_at_once_do_not_take_each_other_s_names(self):
        # A second function of one name would be a redefinition at best; with other parameters it
        # could be called in the place of the first without a word (cmake/program.cmake).
        for floor in COMPILED_AT_ONCE:
            where = {}
            for file in sources(floor):
                if file.endswith(".cpp"):
                    for name in names_of_its_own(text_of(file)):
                        where.setdefault(name, set()).add(os.path.basename(file))
            self.assertEqual({n: f for n, f in where.items() if len(f) > 1}, {}, floor)

    def test_headers_are_included_once_and_open_with_what_they_are(self):
        for floor in BELOW:
            for file in sources(floor):
                if not file.endswith(".hpp"):
                    continue
                text = text_of(file)
                self.assertIn("#pragma once", text, file)
                self.assertTrue(text.startswith("// "), f"{file} does not say what it is")

    def test_no_header_is_left_that_nobody_includes(self):
        wanted = set()
        for top in ("src", "tests", "bench", "examples"):
            for folder, _, names in os.walk(os.path.join(SOURCE, top)):
                for name in names:
                    if name.endswith((".hpp", ".cpp")):
                        wanted.update(what for what, _ in includes(os.path.join(folder, name)))
        for floor in BELOW:
            for file in sources(floor):
                if file.endswith(".hpp"):
                    name = "swirl/" + os.path.relpath(file, os.path.join(SOURCE, "src"))
                    self.assertIn(name, wanted)

    def test_no_drawers_for_odds_and_ends(self):
        for floor in BELOW:
            for file in sources(floor):
                name = os.path.basename(file)
                self.assertNotRegex(name, r"util|manager|helper|handler|\bbase\b|misc", file)


if __name__ == "__main__":
    unittest.main()
