"""Layers of src/swirl, and the folders of track/: each includes only the layers listed before it
(docs/explanation/architecture.md).

The test reads every #include. It also checks the rules of the engine's layers: standard library
only, no input or output, no clock, no threads, no exceptions.
"""

import os
import re
import unittest

SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)

# The lowest layer first.
ENGINE_PROGRAM = (
    "math",
    "physics",
    "engine",
    "statistics",
    "measure",
    "io",
    "run",
    "render",
    "study",
    "cli",
)
TRACK = ("track/video", "track/synthetic", "track/experiment", "track/cli")
LAYERS = (*ENGINE_PROGRAM[: ENGINE_PROGRAM.index("cli")], *TRACK, "cli")
# Layers that use the standard library only, and compile for WebAssembly.
ENGINE = ("math", "physics", "engine", "statistics", "measure")
# Layers that do not include each other although one is listed before the other: a measurement
# cannot know where its snapshots come from, statistics know no physics, and the program builds
# without the camera support.
FORBIDDEN_PAIRS = {
    ("measure", "engine"),
    ("statistics", "engine"),
    ("statistics", "physics"),
    ("study", "render"),
    ("track/synthetic", "track/video"),
    ("track/experiment", "track/video"),
    ("track/experiment", "track/synthetic"),
    # src knows no video. Tables of tracks, by any tracker, are read by src/swirl/io.
    *((layer, part) for layer in ENGINE_PROGRAM for part in TRACK),
}

FORBIDDEN_HEADERS = {
    "iostream",
    "fstream",
    "sstream",
    "cstdio",
    "stdio.h",
    "filesystem",
    "chrono",
    "ctime",
    "time.h",
    "thread",
    "mutex",
    "atomic",
    "future",
    "condition_variable",
    "random",
    "unistd.h",
    "print",
    "unordered_map",
    "unordered_set",
    "iomanip",
    "ostream",
    "istream",
    "format",
}
FORBIDDEN_WORDS = {"virtual", "throw", "try", "catch", "thread_local", "getenv", "rand"}

# docs/explanation/architecture.md: what the engine may ask of the system.
EXCEPTIONS = {
    ("src/swirl/engine/aligned_memory.hpp", "sys/mman.h"),
    ("src/swirl/engine/validate.cpp", "cstdio"),
}
STANDARD = {
    "algorithm",
    "array",
    "bit",
    "bitset",
    "cfloat",
    "charconv",
    "climits",
    "cmath",
    "compare",
    "complex",
    "concepts",
    "cstddef",
    "cstdint",
    "cstdlib",
    "cstring",
    "deque",
    "functional",
    "initializer_list",
    "iterator",
    "limits",
    "list",
    "map",
    "memory",
    "new",
    "numbers",
    "numeric",
    "optional",
    "queue",
    "ranges",
    "set",
    "span",
    "stack",
    "string",
    "string_view",
    "tuple",
    "type_traits",
    "utility",
    "variant",
    "vector",
    "version",
    "immintrin.h",
    "cpuid.h",
}


def folder_of(layer):
    return os.path.join(SOURCE, layer if layer in TRACK else os.path.join("src", "swirl", layer))


def header_of(what):
    """The file that an include names: track/... from the root, swirl/... from src."""
    return os.path.join(SOURCE, what if what.startswith("track/") else os.path.join("src", what))


def layer_of(what):
    """The layer of an included header; None if it is not of the project."""
    first, *rest = what.split("/")
    return {"swirl": rest[0], "track": "/".join([first, *rest[:1]])}.get(first) if rest else None


def sources(layer):
    for folder, _, names in sorted(os.walk(folder_of(layer))):
        for name in sorted(names):
            if name.endswith((".hpp", ".cpp", ".h", ".c", ".inc")):
                yield os.path.join(folder, name)


def all_sources():
    for layer in LAYERS:
        yield from sources(layer)


def text_of(file):
    with open(file, encoding="utf-8") as opened:
        return opened.read()


def includes(file):
    """(what, quoted?) of every #include."""
    return [
        (m.group(2), m.group(1) == '"')
        for m in re.finditer(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', text_of(file), re.M)
    ]


def code_of(file):
    """The text without comments and string literals."""
    text = re.sub(r'"(\\.|[^"\\\n])*"', '""', text_of(file))
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    return re.sub(r"//[^\n]*", " ", text)


# Layers of which the compiler gets several files at once (and the command line, whose files write
# one function for each kind of call).
COMPILED_AT_ONCE = (
    "measure",
    "io",
    "run",
    "render",
    "study",
    *(part for part in TRACK if part != "track/cli"),
)
DEFINITIONS = (
    # A function, up to its brace; a type; a constant.
    r"^(?!return|namespace|using|\s|template|\})[\w:<>&*,\[\]. ]*?[\w>&*\]] [*&]?(\w+)\([^;{}]*?\)"
    r"(?: const| noexcept)? \{",
    r"^(?:struct|class|enum|enum class) (\w+)",
    r"^(?:static )?(?:constexpr|const) [\w:<>*, ]*?(\w+)(?:\[[^\]]*\])? ?[={(]",
)


def names_of_its_own(text):
    """The names that a file defines in its unnamed namespaces."""
    code = re.sub(r'R"\((?:.|\n)*?\)"', '""', text)
    return {
        name
        for own in re.findall(r"^namespace \{\n(.*?)^\}  // namespace\n", code, re.S | re.M)
        for definition in DEFINITIONS
        for name in re.findall(definition, own, re.M)
    }


SCOPES = re.compile(
    r"[{}]|\bnamespace\s*([\w:]*)\s*\{"
    r"|\b(?:struct|class|union|enum(?:\s+class|\s+struct)?)\s+(?:alignas\([^)]*\)\s*)?([\w:]+)\s*"
    r"(?:final\s*)?(?::[^:;{}()][^;{}]*)?\{"
)


def types_in(code):
    """The qualified names of the types that a file defines, except in unnamed namespaces and
    functions.

    A specialisation of a template is not a type of its own.
    """
    scopes = []
    for found in SCOPES.finditer(code):
        text, space, name = found.group(0), found.group(1), found.group(2)
        if text == "}":
            if scopes:
                scopes.pop()
        elif text == "{":
            scopes.append(None)
        elif space is not None:
            scopes.append(space or None)
        else:
            scopes.append(name)
            if all(scopes):
                yield "::".join(scopes)


def bindings_sources():
    for folder, _, names in os.walk(os.path.join(SOURCE, "bindings")):
        yield from (os.path.join(folder, name) for name in names if name.endswith((".hpp", ".cpp")))


def depends_on(header, file, known):
    """Whether the file includes the header, perhaps through others. `known` are the answers so
    far."""
    if file not in known:
        known[file] = False  # for headers that include each other
        known[file] = any(
            what == header or depends_on(header, header_of(what), known)
            for what, quoted in includes(file)
            if quoted and layer_of(what)
        )
    return known[file]


class Layers(unittest.TestCase):
    def test_a_change_of_the_collision_law_compiles_the_event_loops_only(self):
        # Each event loop takes longer to compile than a whole layer, so nothing else is to be
        # compiled then.
        known = {}
        compiled = {
            os.path.basename(file)
            for file in all_sources()
            if file.endswith(".cpp") and depends_on("swirl/physics/collision_law.hpp", file, known)
        }
        self.assertEqual(
            compiled,
            {
                f"event_loop_{name}.cpp"
                for name in ("avx2", "avx512", "baseline", "partial_friction")
            },
        )

    def test_every_folder_of_src_is_a_layer(self):
        self.assertEqual(os.listdir(os.path.join(SOURCE, "src")), ["swirl"])
        self.assertEqual(set(os.listdir(os.path.join(SOURCE, "src", "swirl"))), set(ENGINE_PROGRAM))
        self.assertEqual(
            set(os.listdir(os.path.join(SOURCE, "track"))),
            {part.removeprefix("track/") for part in TRACK} | {"tests"},
        )
        for layer in LAYERS:
            self.assertTrue(list(sources(layer)), layer)

    def test_slow_headers_are_included_by_one_file_each(self):
        for header, homes in (
            ("CLI/CLI.hpp", {"parser.cpp"}),
            ("toml++/toml.h", {"toml_file.cpp"}),
        ):
            found = {
                os.path.basename(file)
                for file in all_sources()
                if header in [what for what, _ in includes(file)]
            }
            self.assertEqual(found, homes, header)
        # Headers of these libraries are most of what a file reads. Headers of swirl declare JSON
        # only.
        for file in all_sources():
            if file.endswith(".hpp") and os.path.relpath(file, SOURCE).startswith("src"):
                self.assertFalse(
                    [
                        what
                        for what, _ in includes(file)
                        if what.startswith(("fmt/", "nlohmann/json.hpp"))
                    ],
                    file,
                )

    def test_target_clones_occurs_in_one_file(self):
        # And for which compilers and sanitizers not: the thread sanitizer's programs do not even
        # begin with such functions.
        found = {
            os.path.relpath(file, SOURCE)
            for file in all_sources()
            if "target_clones" in text_of(file)
        }
        self.assertEqual(found, {"src/swirl/math/wide.hpp"})

    def test_a_layer_includes_only_layers_before_it(self):
        for rank, layer in enumerate(LAYERS):
            for file in sources(layer):
                for what, _ in includes(file):
                    other = layer_of(what)
                    if other is None or (layer, other) == ("track/cli", "cli"):  # one program
                        continue
                    self.assertIn(other, LAYERS[: rank + 1], f"{file} includes {what}")
                    self.assertNotIn((layer, other), FORBIDDEN_PAIRS, f"{file} includes {what}")
        for file in bindings_sources():
            for what, _ in includes(file):
                self.assertNotIn(layer_of(what), TRACK, f"{file} includes {what}")

    def test_quoted_includes_name_a_header_of_the_project(self):
        for file in all_sources():
            for what, quoted in includes(file):
                if quoted and what != "version.inc":
                    self.assertIsNotNone(layer_of(what), f"{file} includes {what}")
                    self.assertTrue(
                        os.path.exists(header_of(what)),
                        f"{file} includes {what}, which does not exist",
                    )

    def test_the_engine_uses_nothing_but_the_standard_library(self):
        for layer in ENGINE:
            for file in sources(layer):
                for what, quoted in includes(file):
                    if not quoted and (os.path.relpath(file, SOURCE), what) not in EXCEPTIONS:
                        self.assertIn(what, STANDARD, f"{file} includes <{what}>")
                        self.assertNotIn(what, FORBIDDEN_HEADERS, f"{file} includes <{what}>")

    def test_the_engine_has_no_virtual_functions_exceptions_or_globals(self):
        for layer in ENGINE:
            for file in sources(layer):
                words = set(re.findall(r"[A-Za-z_]+", code_of(file)))
                self.assertEqual(words & FORBIDDEN_WORDS, set(), file)
                self.assertNotRegex(code_of(file), r"std::\w*_distribution", file)
                self.assertNotRegex(code_of(file), r"std::\w*(random_device|mt19937)", file)

    def test_files_compiled_together_define_distinct_names(self):
        # A second function of one name would be a redefinition at best; with other parameters it
        # could silently be called instead of the first (cmake/program.cmake).
        bindings = os.path.join(SOURCE, "bindings", "python")
        for layer, files in (
            *((layer, sources(layer)) for layer in COMPILED_AT_ONCE),
            ("python", [os.path.join(bindings, name) for name in sorted(os.listdir(bindings))]),
        ):
            where = {}
            for file in files:
                if file.endswith(".cpp"):
                    for name in names_of_its_own(text_of(file)):
                        where.setdefault(name, set()).add(os.path.basename(file))
            self.assertEqual({n: f for n, f in where.items() if len(f) > 1}, {}, layer)

    def test_no_type_is_defined_twice_in_one_namespace(self):
        # The linker would keep the functions of one of them, and use them for both.
        where = {}
        for file in [*all_sources(), *bindings_sources()]:
            for name in types_in(code_of(file)):
                where.setdefault(name, set()).add(os.path.relpath(file, SOURCE))
        self.assertIn("swirl::Simulation::Storage", where)
        self.assertEqual({name: files for name, files in where.items() if len(files) > 1}, {})

    def test_headers_have_pragma_once_and_open_with_a_comment(self):
        for layer in LAYERS:
            for file in sources(layer):
                if not file.endswith(".hpp"):
                    continue
                text = text_of(file)
                self.assertIn("#pragma once", text, file)
                self.assertTrue(text.startswith("// "), f"{file} does not open with a comment")

    def test_every_header_is_included_somewhere(self):
        wanted = set()
        for top in ("src", "track", "bindings", "tests", "bench", "examples"):
            for folder, _, names in os.walk(os.path.join(SOURCE, top)):
                for name in names:
                    if name.endswith((".hpp", ".cpp")):
                        wanted.update(what for what, _ in includes(os.path.join(folder, name)))
        for layer in LAYERS:
            for file in sources(layer):
                if file.endswith(".hpp"):
                    root = SOURCE if layer in TRACK else os.path.join(SOURCE, "src")
                    self.assertIn(os.path.relpath(file, root), wanted)

    def test_no_file_is_named_utils_or_manager(self):
        for layer in LAYERS:
            for file in sources(layer):
                name = os.path.basename(file)
                self.assertNotRegex(name, r"util|manager|helper|handler|\bbase\b|misc", file)


if __name__ == "__main__":
    unittest.main()
