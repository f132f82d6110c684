"""Mutation testing: does a test fail when the source is wrong? (docs/explanation/reliability.md)

A mutation changes one piece of text in a source file. The mutated file goes to a scratch folder
that the compiler searches first; the source tree is not changed. For every test file that includes
the mutated file, this script compiles one program and runs it, until one fails: then the mutation
is killed. The tests of the file's own layer come first. Each program must pass without the mutation
before it may kill one. As in ./check, the tests of math, physics and engine run again with the
engine's invariants and under the sanitizers. At last, a warning of the compiler kills it, as it
stops the build of the tests.

A random mutation above the engine that is still alive is built into the program, in a copy of the
tree, and the scripts that call the program are run (tests/cli, tests/faults).

    mutate.py                       the chosen mutations of mutations.py
    mutate.py measure/slip          those of files whose path contains this text
    mutate.py --number 17           one mutation
    mutate.py --every 6             the first of each six mutations
    mutate.py --check               only checks that each text occurs exactly once
    mutate.py --random 100 --seed 4 mutations drawn from a seed (draw.py)
    mutate.py --random 60 --seed today --score 90
                                    a sample for which no test was written: the seed is the date
                                    (UTC)
    mutate.py --random 60 --seed 4 --number 0 1 2 3 --objects FOLDER
                                    a part of a sample. The next call, for the next part, uses the
                                    objects of this one

The score of a random sample is the share that a test notices, of the mutations that are built,
compile and are not in equivalent.py. A line for another processor or a wider vector is not built. A
mutation that changes no result, and is not in equivalent.py yet, counts as missed.

The exit code is 1 if a mutation survives that the table (or equivalent.py) does not declare
equivalent (with --score: if the score is lower), if an equivalent one is killed, if a chosen one
does not compile, or if the table no longer matches the sources.
"""

import argparse
import concurrent.futures
import datetime
import functools
import hashlib
import math
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading

import draw
from equivalent import EQUIVALENT
from mutations import MUTATIONS

SOURCE = os.environ.get(
    "SWIRL_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
)
COMPILER = os.environ.get("CXX", "c++")
FLAGS = [
    "-std=c++20",
    "-O1",
    "-w",
    "-DNDEBUG",
    "-fno-math-errno",
    "-fno-trapping-math",
    "-ffp-contract=off",
    f'-DSWIRL_SOURCE_DIR="{SOURCE}"',
]
WIDE = {
    "_avx2.cpp": ["-mavx2"],
    "_avx512.cpp": [
        "-mavx512f",
        "-mavx512vl",
        "-mavx512dq",
        "-mavx512bw",
        "-mprefer-vector-width=512",
    ],
}
LIBRARIES = [
    "-lrapidcheck",
    "-lgmock_main",
    "-lgmock",
    "-lgtest",
    "-lfmt",
    "-lhdf5_serial",
    "-lhdf5_serial_hl",
]
# In this order; a test belongs to the layer of its folder. The higher layers need other programs to
# be tested.
LAYERS = ("math", "physics", "engine", "statistics", "measure", "io", "run", "study")
# ./check also runs these layers with the engine's invariants and under the sanitizers (the preset
# `sanitize`).
SANITIZED = ("math", "physics", "engine")
SANITIZERS = [
    "-fsanitize=address,undefined",
    "-fno-sanitize-recover=all",
    "-fno-omit-frame-pointer",
    "-g1",  # a trace has the name of the invariant that does not hold
    "-DSWIRL_INTERNAL_CHECKS=1",
]
# The scripts that call the program. Those of the page and of the launcher make builds of their own.
SCRIPTS = ["-R", r"^(cli|faults)\.", "-E", "lab|site|launcher|check_test", "-LE", "slow|soak"]
# Of these folders a test links the files whose headers it includes, of the others all files.
BY_HEADER = ("src/swirl/statistics", "src/swirl/measure")
# The build of the tests treats warnings as errors (cmake/options.cmake); some of them need the
# optimiser.
WARNINGS = ["-O3", "-Wall", "-Wextra", "-Werror"]
# The longest of these test programs needs a minute, compiled as above. A mutated one may run
# without end.
CPU_SECONDS = 150
# Seconds by the clock. The scripts need ten minutes on two cores, with the build. A mutated program
# may wait without end.
HANG = 3600

OUTCOMES = ("killed", "equivalent", "survived", "not compiled", "not built")


def text_of(path):
    with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
        return file.read()


@functools.lru_cache(maxsize=None)
def included(path):
    """All files of this project that `path` includes, directly or through others, and `path`
    itself."""
    found, waiting = set(), [path]
    while waiting:
        path = waiting.pop()
        if path in found:
            continue
        found.add(path)
        for name in re.findall(r'^#include "([^"]+)"', text_of(path), re.M):
            folder = (
                "src"
                if name.startswith("swirl/")
                else "bench"
                if name.startswith("baselines/")
                else "tests"
            )
            if name.startswith("../"):
                folder = os.path.dirname(path)
            if name != "version.inc":  # made by the build
                waiting.append(os.path.normpath(f"{folder}/{name}"))
    return frozenset(found)


@functools.lru_cache(maxsize=None)
def sources_in(folder, ending):
    return sorted(
        os.path.relpath(os.path.join(where, name), SOURCE)
        for where, _, names in os.walk(os.path.join(SOURCE, folder))
        for name in names
        if name.endswith(ending)
    )


@functools.lru_cache(maxsize=None)
def parts(test):
    """The test and the .cpp files whose functions it needs, by the headers that it includes."""
    needed, grew = [test], True
    while grew:
        headers = frozenset().union(*(included(part) for part in needed))
        more = [
            cpp
            for folder in ("bench/baselines", *(f"src/swirl/{layer}" for layer in LAYERS))
            if folder in BY_HEADER or any(header.startswith(folder) for header in headers)
            for cpp in sources_in(folder, ".cpp")
            if cpp not in needed
            and (
                folder not in BY_HEADER or re.sub(r"(_avx2|_avx512)?\.cpp$", ".hpp", cpp) in headers
            )
        ]
        needed, grew = needed + more, bool(more)
    return tuple(needed)


def tests_of(file, layers=LAYERS):
    """The test files that include the file: those of its own layer first, then the one with its
    name."""
    own, stem = file.split("/")[2], os.path.basename(file).split(".")[0]
    tests = [
        test
        for layer in layers
        for test in sources_in(f"tests/{layer}", "_test.cpp")
        if any(file in included(part) for part in parts(test))
    ]
    return sorted(
        tests,
        key=lambda test: (
            test.split("/")[1] != own,
            LAYERS.index(test.split("/")[1]),
            os.path.basename(test) != stem + "_test.cpp",
            file not in included(test),
            test,
        ),
    )


@functools.lru_cache(maxsize=None)
def version_of_compiler():
    return subprocess.run(
        [COMPILER, "--version"], capture_output=True, text=True, check=True
    ).stdout


class Builder:
    """Compiles and runs test programs in a scratch folder, and caches the objects there or in
    another folder."""

    def __init__(self, scratch, baseline_only=False, objects=None, sanitizers=()):
        self.scratch = scratch
        self.objects = objects or scratch
        os.makedirs(self.objects, exist_ok=True)
        flags = [flag for flag in FLAGS if not sanitizers or flag != "-DNDEBUG"] + [*sanitizers]
        self.compiled_by = repr([version_of_compiler(), flags, baseline_only])
        self.flags = flags + [
            f"-I{scratch}",
            "-isystem/usr/include/hdf5/serial",
            '-DSWIRL_BUILD="mutated"',
        ]
        self.baseline_only = baseline_only
        if baseline_only:  # the vector width; the wide loops are the same source
            self.flags.append("-DSWIRL_BASELINE_ONLY=1")
        with open(os.path.join(scratch, "version.inc"), "w", encoding="utf-8") as file:
            file.write('#define SWIRL_VERSION "0"\n#define SWIRL_COMMIT "0"\n')
        self.lock = threading.Lock()
        self.baselines = {}
        self.sanitized = None  # made for the first mutation that needs it
        self.sanitizers = [*sanitizers]
        self.headers = os.path.join(scratch, "headers.hpp")
        with open(self.headers, "w", encoding="utf-8") as file:
            file.write(
                "#include <gmock/gmock.h>\n#include <gtest/gtest.h>\n"
                "#include <rapidcheck.h>\n#include <rapidcheck/gtest.h>\n"
            )
        subprocess.run(
            [COMPILER, *self.flags, "-x", "c++-header", self.headers, "-o", self.headers + ".gch"],
            check=True,
        )

    def parts(self, test):
        """Those of parts(test) that this builder compiles."""
        return [p for p in parts(test) if not (self.baseline_only and self.wide_flags(p))]

    @staticmethod
    def wide_flags(part):
        return [flag for ending, flags in WIDE.items() if part.endswith(ending) for flag in flags]

    def command(self, part, file, overlay):
        """The call of the compiler for `part`, with the file of that name in the overlay."""
        where = os.path.join(SOURCE, part)
        if part == file:
            where = os.path.join(overlay, part.removeprefix("src/"))
        folders = [overlay, *(os.path.join(SOURCE, folder) for folder in ("src", "tests", "bench"))]
        search = ["-I" + folder for folder in folders]
        return [COMPILER, *self.flags, *self.wide_flags(part), *search, where]

    def compiled(self, part, file, text, overlay):
        """The object of `part`, compiled with `text` instead of `file`; None if it does not
        compile."""
        seen = included(part)
        hashed = hashlib.sha256((self.compiled_by + part).encode())
        for path in sorted(seen):
            hashed.update((text if path == file else text_of(path)).encode())
        target = os.path.join(self.objects, hashed.hexdigest()[:32] + ".o")
        if os.path.exists(target):
            return target
        # The precompiled headers were compiled without the flags of wide vectors.
        headers = [] if self.wide_flags(part) else ["-include", self.headers]
        made = target + f".{os.getpid()}.{threading.get_ident()}"
        result = subprocess.run(
            [*self.command(part, file, overlay), *headers, "-c", "-o", made],
            capture_output=True,
            text=True,
        )
        if result.returncode != 0:
            return None
        os.replace(made, target)
        return target

    def run(self, test, file=None, text=None, overlay=""):
        """Compiles and runs one test file. Returns "passed", "failed", "time" or "not compiled",
        and the test or the file concerned."""
        objects = []
        for part in self.parts(test):
            made = self.compiled(part, file, text, overlay or self.scratch)
            if made is None:
                return "not compiled", part
            objects.append(made)
        program = os.path.join(
            overlay or self.scratch, "program_" + os.path.basename(test).removesuffix(".cpp")
        )
        subprocess.run(
            [COMPILER, *self.sanitizers, *objects, *LIBRARIES, "-o", program], check=True
        )
        result = subprocess.run(
            [program, "--gtest_filter=-*.Slow_*:*.Soak_*", "--gtest_brief=1", "--gtest_fail_fast"],
            capture_output=True,
            text=True,
            errors="replace",
            env={**os.environ, "ASAN_OPTIONS": "handle_sigill=1"},  # as in invariant_test.cpp
            preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_CPU, (CPU_SECONDS, CPU_SECONDS + 1)
            ),
        )
        os.remove(program)
        if result.returncode == -signal.SIGXCPU:
            return "time", test
        if result.returncode == 0:
            return "passed", test
        failed = re.search(r"\[  FAILED  \] ([\w./]+)", result.stdout)
        return "failed", failed.group(1) if failed else f"{test} (exit code {result.returncode})"

    def passes_unchanged(self, test):
        with self.lock:
            if test not in self.baselines:
                self.baselines[test] = self.run(test)
                if self.baselines[test][0] != "passed":
                    print(
                        f"warning: {test} fails without a mutation: {self.baselines[test]}",
                        flush=True,
                    )
        return self.baselines[test][0] == "passed"

    def with_sanitizers(self):
        with self.lock:
            if self.sanitized is None:
                scratch = os.path.join(self.scratch, "sanitized")
                os.mkdir(scratch)
                self.sanitized = Builder(
                    scratch, baseline_only=True, objects=self.objects, sanitizers=SANITIZERS
                )
        return self.sanitized

    def outcomes(self, file, text, overlay, layers):
        """The builder, the outcome and the test or file of each test program, in their order."""
        for test in tests_of(file, layers):
            yield self, test, *self.run(test, file, text, overlay)
        sanitized_layers = [layer for layer in layers if layer in SANITIZED]
        for test in tests_of(file, sanitized_layers):
            builder = self.with_sanitizers()
            outcome, what = builder.run(test, file, text, overlay)
            yield builder, test, outcome, f"{what}, under the sanitizers"

    def is_rejected(self, file, overlay):
        """True if the build of the tests stops at a warning about the mutated file."""
        result = subprocess.run(
            [
                COMPILER,
                *(flag for flag in self.flags if flag not in ("-w", "-O1")),
                *WARNINGS,
                f"-I{overlay}",
                f"-I{SOURCE}/src",
                "-c",
                os.path.join(overlay, file.removeprefix("src/")),
                "-o",
                os.devnull,
            ],
            capture_output=True,
            text=True,
        )
        return result.returncode != 0

    def preprocessed(self, part, file, overlay, more):
        return subprocess.run(
            [*self.command(part, file, overlay), *more, "-E", "-P"], capture_output=True
        ).stdout

    def is_built(self, file, overlay, layers):
        """True if a part of the tests contains the mutated line. A line for another processor,
        compiler or vector width is in none."""
        all_parts = [part for test in tests_of(file, layers) for part in self.parts(test)]
        return any(
            self.preprocessed(part, file, overlay, more)
            != self.preprocessed(part, None, self.scratch, more)
            for part in dict.fromkeys(all_parts)
            if file in included(part)
            for more in ((), SANITIZERS)
        )

    def judge(self, name, file, text, layers=LAYERS):
        """Returns "killed", "survived", "not compiled" or "not built", and the test or the file
        concerned."""
        overlay = os.path.join(self.scratch, f"mutation_{name}")
        where = os.path.join(overlay, file.removeprefix("src/"))
        os.makedirs(os.path.dirname(where))
        with open(where, "w", encoding="utf-8") as opened:
            opened.write(text)
        if not self.is_built(file, overlay, layers):
            return "not built", ""
        for builder, test, outcome, what in self.outcomes(file, text, overlay, layers):
            if outcome == "not compiled":
                return outcome, what
            if outcome != "passed" and builder.passes_unchanged(test):
                return "killed", what if outcome == "failed" else f"{what} (out of time)"
        if file.endswith(".cpp") and self.is_rejected(file, overlay):
            return "killed", "a warning of the compiler"
        return "survived", ""


class ProgramInACopy:
    """A copy of the tree, whose program is built with one mutation after the other."""

    def __init__(self, scratch):
        self.tree = os.path.join(scratch, "tree")
        self.log = os.path.join(scratch, "check.log")
        self.lock = threading.Lock()
        self.passes = None  # without a mutation; unknown before the first one

    def failed_script(self):
        """The first script that fails or never ends, or nothing."""
        call = ["timeout", str(HANG), f"{self.tree}/check", "--stop-on-failure", *SCRIPTS]
        with open(self.log, "w", encoding="utf-8") as log:
            code = subprocess.run(call, stdout=log, stderr=subprocess.STDOUT).returncode
        if code == 0:
            return ""
        if code == 124:
            return "a script (waits for ever)"
        with open(self.log, encoding="utf-8", errors="replace") as log:
            said = log.read()
        failed = re.search(r": (\S+) \.*\*\*\*", said)
        return failed.group(1) if failed else f"the build: {said[-300:]}"

    def noticed_by(self, file, text):
        with self.lock:
            if self.passes is None:
                omitted = shutil.ignore_patterns("build", ".git", "node_modules", "__pycache__")
                shutil.copytree(SOURCE, self.tree, ignore=omitted, symlinks=True)
                failed = self.failed_script()
                self.passes = not failed
                if failed:
                    print(f"warning: {failed} fails without a mutation", flush=True)
            if not self.passes:
                return ""
            where = os.path.join(self.tree, file)
            with open(where, "w", encoding="utf-8") as opened:
                opened.write(text)
            failed = self.failed_script()
            shutil.copyfile(os.path.join(SOURCE, file), where)
            return failed


def check_table():
    """Each text before occurs exactly once, and the text after is another; the tests of each file
    can be found."""
    wrong = 0
    for file in sorted({file for file, *_ in MUTATIONS}):
        if not tests_of(file):
            print(f"error: no test includes {file}")
            wrong += 1
    for number, (file, before, after, *_) in enumerate(MUTATIONS):
        count = text_of(file).count(before)
        if count != 1 or before == after:
            print(f"error: mutation {number}: {before!r} occurs {count} times in {file}")
            wrong += 1
    return wrong


def run_chosen(options, pool):
    chosen = [
        number
        for number, (file, *_) in enumerate(MUTATIONS)
        if options.part in file and (not options.number or number in options.number)
    ][:: options.every]

    def judge(builder, number):
        file, before, after, _, *equivalent = MUTATIONS[number]
        # Only the tests of its layer for what no test can notice.
        layers = (file.split("/")[2], "measure") if equivalent else LAYERS
        return builder.judge(number, file, text_of(file).replace(before, after), layers)

    count, wrong = dict.fromkeys(OUTCOMES, 0), 0
    with tempfile.TemporaryDirectory(prefix="swirl_mutation_") as scratch:
        builder = Builder(scratch, objects=options.objects)
        for number, (outcome, what) in zip(
            chosen, pool.map(functools.partial(judge, builder), chosen)
        ):
            file, before, after, description, *equivalent = MUTATIONS[number]
            if outcome == "survived" and equivalent:
                outcome, what = "equivalent", equivalent[0]
            elif outcome != "killed" or equivalent:
                wrong += 1
            count[outcome] += 1
            print(
                f"{number:3} {outcome:12} {file.removeprefix('src/')}: {description}"
                f"{' — ' + what if what else ''}",
                flush=True,
            )
            if outcome == "killed" and equivalent:
                print("    error: the table declares it equivalent", flush=True)
    print(f"{len(chosen)} mutations: " + ", ".join(f"{n} {name}" for name, n in count.items()))
    return wrong


def run_random(options, pool):
    reasons = {(file, before, after): reason for file, before, after, reason in EQUIVALENT}
    count = dict.fromkeys(OUTCOMES, 0)

    def judge(builder, number, site):
        file, line, before, after, _ = site
        if (file, before.strip(), after.strip()) in reasons:
            return "equivalent", reasons[file, before.strip(), after.strip()]
        lines = text_of(file).splitlines(keepends=True)
        lines[line - 1] = after + "\n"
        own = file.split("/")[2]
        layers = (own,) if options.own_layer else LAYERS
        outcome, what = builder.judge(f"random_{number}", file, "".join(lines), layers)
        if outcome == "survived" and own not in SANITIZED and not options.own_layer:
            what = program.noticed_by(file, "".join(lines))
            outcome = "killed" if what else outcome
        return outcome, what

    with tempfile.TemporaryDirectory(prefix="swirl_mutation_") as scratch:
        builder = Builder(scratch, baseline_only=True, objects=options.objects)
        program = ProgramInACopy(scratch)
        chosen = [
            (number, site)
            for number, site in enumerate(draw.drawn(SOURCE, options.random, options.seed))
            if options.part in site[0] and (not options.number or number in options.number)
        ]
        judged = pool.map(lambda numbered: judge(builder, *numbered), chosen)
        for (number, site), (outcome, what) in zip(chosen, judged):
            file, line, before, after, operator = site
            count[outcome] += 1
            print(
                f"{number:3} {outcome:12} {file.removeprefix('src/')}:{line} "
                f"({operator}){' — ' * bool(what)}{what}"
            )
            if outcome == "survived":
                print(f"    - {before.strip()}\n    + {after.strip()}")
            sys.stdout.flush()
    print(f"seed {options.seed}: " + ", ".join(f"{n} {name}" for name, n in count.items()))
    judged = count["killed"] + count["survived"]
    if judged == 0:
        return 0
    score = count["killed"] / judged
    print(
        f"score: {count['killed']} of {judged} noticed, {100 * score:.0f} % ± "
        f"{100 * math.sqrt(score * (1 - score) / judged):.0f} %"
    )
    return count["survived"] if options.score is None else 100 * score < options.score


def seed_in(text):
    return int(
        f"{datetime.datetime.now(datetime.timezone.utc):%Y%m%d}" if text == "today" else text
    )


def main():
    call = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    call.add_argument("part", nargs="?", default="", help="mutate files whose path contains this")
    call.add_argument("--number", type=int, nargs="*", help="numbers of the mutations to run")
    call.add_argument("--every", type=int, default=1, help="run the first of each N mutations [1]")
    call.add_argument("--check", action="store_true", help="check the table only")
    call.add_argument(
        "--random", type=int, default=0, metavar="COUNT", help="draw this many mutations"
    )
    call.add_argument(
        "--seed", type=seed_in, default=1, help="of the random mutations, or today: the date [1]"
    )
    call.add_argument(
        "--score", type=float, metavar="PERCENT", help="random ones: fail only below this score"
    )
    call.add_argument(
        "--own-layer",
        action="store_true",
        help="random ones: run the tests of the file's layer only",
    )
    call.add_argument(
        "--objects", metavar="FOLDER", help="keep the compiled objects there, for the next call"
    )
    call.add_argument("--jobs", type=int, default=1, help="mutations at a time [1]")
    options = call.parse_args()
    os.nice(max(0, 15 - os.nice(0)))
    if check_table() > 0:
        return 1
    if options.check:
        print(f"{len(MUTATIONS)} mutations, each text found exactly once")
        return 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        return 1 if (run_random if options.random else run_chosen)(options, pool) else 0


if __name__ == "__main__":
    sys.exit(main())
