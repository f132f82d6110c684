"""Every command in a block of the README and of docs/ is valid, and works.

The default suite parses each call of swirl as it is shown, and runs it where that takes little time
or SHORTER makes it so. Each page is a folder of its own, so a command finds the files of the
commands before it. The suite `slow` (--all) runs the blocks of each page as they are, with bash.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import unittest

from program import HANG, SOURCE, SWIRL, InFolder, read_text, swirl, write_text

CALL = re.compile(r"(?:^|[\s;&|])(?:\./|build/release/)?swirl ([^&|\n]+)", re.M)

# Lines without a call of swirl that no test runs, and why.
NOT_RUN = (
    (
        r"cmake |cpack |ninja |ctest |apt |cd build/|\./check|bench/|build/release/bench/|taskset ",
        "builds, installs or measures; ./check, tests/library and tests/bench do the same",
    ),
    (r"sbatch ", "needs a cluster"),
    (r"snakemake ", "a package of its own; cluster_test runs the workflow"),
    (r"python3 tests/mutation/", "takes hours; the suite slow runs it"),
    (r"/usr/bin/python3 paper |ffmpeg |'\[0\]trim", "draws from the output of a long command"),
    (r"for |done$|grep ", "the shell around a call"),
)
# Subcommands of the launcher script, with tests of their own (launcher, lab, site, python.*).
LAUNCHER = ("lab", "site", "python")
# More options for a short run, by subcommand. The others take seconds or more, or need a video.
SHORTER = {
    "run": ["--events", "3000"],
    "crossing": ["--events", "3000", "--from", "34", "--to", "42", "--tolerance", "5"],
    "sweep": ["--threads", "2"],
    "map": ["--steps", "3", "--periods", "3", "--replicates", "2", "--from", "34", "--to", "36"],
    "movie": ["--seconds", "0.1", "--fps", "10", "--size", "320x180"],
    "image": [],
    "collect": [],
    "export": [],
    "measure": [],
    "verify": [],
}
# Replaced in a call, so that it is short: (as shown, shorter).
SHORTENED = (
    ("--events 1e9", "--events 3000"),
    ("--events 1e6", "--events 3000"),
    ("--periods 400", "--periods 8 --warmup 1"),
    ("--periods 500", "--periods 8 --warmup 1"),
    ("--warmup 8 --periods 28", "--warmup 1 --periods 2"),
    ("'$seed'", "1"),
    ("'seed_$seed'", "seed_1"),
    ("--tolerance 0.2", "--tolerance 5"),
    ("--grow --to 55", "--grow --to 40"),
    (
        "--motion circle,ellipse:0.8,ellipse:0.5,line",
        "--motion circle,ellipse:0.8,ellipse:0.5,line --events 3000",
    ),
    ("--periods 200", "--periods 4 --warmup 1"),
    ("--periods 150", "--periods 2"),
    ("--periods 100", "--periods 8"),
    ("periods = 300", "periods = 1"),
    ("replicates = 8", "replicates = 1"),
    ('discs = "5:48"', 'discs = "46:48"'),
    ("mu = [0.1, 0.5, 1]", "mu = [0.5, 1]"),
    ("--range 1000:1999", "--range 100:199"),
    (
        "--discs 20 --out shaker.mp4",
        "--discs 20 --container-radius 6.5 --scale 12 --width 240 --height 240 "
        "--frames-per-period 48 --periods 2.2 --out shaker.mp4",
    ),
    (
        "--discs 40 --mu 0.1:0.1:1 --periods 120 --warmup 20 --replicates 4 --chain mu",
        "--discs 20 --mu 0.4:0.2:1 --periods 6 --warmup 2 --replicates 2 --chain mu",
    ),
    ("--x container_radius=5:9", "--x container_radius=8:9"),  # 36 discs fit
    (
        "--x mu=0:2 --y amplitude=0.5:4 --steps 31 --replicates 32",
        "--x mu=0:2 --y amplitude=0.5:4 --steps 3 --replicates 3",
    ),
)
# Calls that only the suite slow runs, or that no machine but the reader's can run.
PARSED = (
    ("--slurm", "needs a cluster (cluster_test)"),
    ("/shared/", "the folder of a cluster"),
    ("--camera-fps", "tracks of the reader's camera"),
    ("--mu 0.2:0.2:1", "six searches"),
    ("--mixture 10%:1.4,30%:1.4,50%:1.4", "searches that take as long as thirty others"),
    ("--mu-wall 1 --cannot-spin 1", "a search that takes as long as ten others"),
    ("--checkpoint long.checkpoint", "continues a run that was stopped"),
    ("--compare", "writes a picture of the documentation"),
)


def pages():
    names = ["README.md"]
    for folder, _, files in os.walk(os.path.join(SOURCE, "docs")):
        names += [
            os.path.relpath(os.path.join(folder, file), SOURCE)
            for file in files
            if file.endswith(".md")
        ]
    return sorted(names)


def text_of(page):
    return read_text(os.path.join(SOURCE, page))


def blocks(text):
    """(language, content) of the blocks with commands and configurations. Of a console, the
    commands."""
    for _, kind, content in re.findall(
        r"^( *)```(sh|bash|console|toml)\n(.*?)^ *```$", text, re.M | re.S
    ):
        if kind == "console":
            content = "\n".join(re.findall(r"^\$ (.*)$", content, re.M))
        yield kind, content


def calls(content):
    """The words of each call of swirl in a block."""
    joined = content.replace("\\\n", " ")
    for call in CALL.findall(joined):
        words = shlex.split(call, comments=True)
        if words and words[0] not in LAUNCHER:
            yield words


def shortened(words):
    """The words of a shorter call, or None if it is too long for the default suite."""
    call = shlex.join(words)
    if (
        words[0] not in SHORTER
        and "shaker.mp4" not in words
        or any(part in call for part, _ in PARSED)
    ):
        return None
    for shown, shorter in SHORTENED:
        call = call.replace(shown, shorter)
    words = shlex.split(call) + ["--no-figure"] * (words[0] == "map")
    more = SHORTER.get(words[0], [])
    if (
        "--periods" in words
        or "--grow" in words
        or "--help" in words
        or words[0] == "run"
        and "--events" in words
    ):
        more = []
    return words + [
        word
        for option, value in zip(more[::2], more[1::2])
        if option not in words
        for word in (option, value)
    ]


# Videos of the reader, which the suite slow replaces with synthetic ones: name and number of discs.
VIDEOS = {
    "dish.mp4": 24,
    "N24.mp4": 24,
    "N36.mp4": 36,
    "N48.mp4": 48,
    "rough/a.mp4": 40,
    "s36.mp4": 36,
    "s48.mp4": 48,
    "shaker.mp4": 20,
}


# Files of the reader whose content a page shows, and their first line.
SHOWN_FILES = {
    "shaker.csv": "t,x,y",
    "radii.csv": "radius,mass",
    "start.csv": "x,y,vx,vy,spin",
    "points.csv": "discs,mu,replicates",
}


def write_shown_files(folder, text):
    for name, first_line in SHOWN_FILES.items():
        shown = re.search(rf"^```\n({first_line}\n.*?)^```$", text, re.M | re.S)
        if shown and name in text:
            write_text(os.path.join(folder, name), shown.group(1))


# Files that an earlier call of the page writes, and a shown file with the same columns.
WRITTEN_FILES = {"motion.csv": "shaker.csv"}


# Blocks with a call of swirl that even the suite slow omits: a part of the block, and the reason.
OMITTED = (
    ("--slurm", "needs a cluster"),
    ("sbatch ", "needs a cluster"),
    ("/shared/", "the folder of a cluster"),
    ("--camera-fps", "tracks of the reader's camera"),
    ("--checkpoint long.checkpoint", "continues a run that was stopped"),
    ("--events 1e9", "a run that the reader stops"),
    ("swirl paper --out results", "takes hours: every figure, chapters included"),
    *((f"swirl {name}", "the launcher script has tests of its own") for name in LAUNCHER),
    ("cmake ", "builds the program"),
    ("./check", "builds the program and runs these tests"),
)

# Blocks that show an error, and their exit code.
FAILING = {"swirl run --discs 57": 1}


def can_run(content):
    """False for blocks without a call of swirl and for those of OMITTED."""
    return bool(list(calls(content))) and not any(part in content for part, _ in OMITTED)


def exit_code(content):
    return next((code for part, code in FAILING.items() if part in content), 0)


def missing_input(words, folder):
    """A video or a recording that a shortened call reads and that only a long call writes."""
    return any(
        re.search(r"\.(mp4|csv|h5|json|toml)$", word)
        and not os.path.exists(os.path.join(folder, word))
        for option, word in zip(words, words[1:])
        if not option.startswith("--") or option in ("--over", "--motion")
    )


class Pages(InFolder):
    def test_every_line_of_a_block_is_a_call_or_excluded_with_a_reason(self):
        calls_found = 0
        for page in pages():
            for kind, content in blocks(text_of(page)):
                if kind == "toml":
                    continue
                for line in content.replace("\\\n", " ").splitlines():
                    found = bool(CALL.search(line))
                    calls_found += found
                    excluded = any(re.match(rf"\s*(?:{pattern})", line) for pattern, _ in NOT_RUN)
                    self.assertTrue(found or excluded or not line.strip(), f"{page}: {line}")
        self.assertGreater(calls_found, 80)

    def test_every_call_is_valid(self):
        for page in pages():
            folder = self.path(page.replace("/", "-"))
            os.makedirs(folder)
            write_shown_files(folder, text_of(page))
            for name, shown in WRITTEN_FILES.items():
                if name in text_of(page):
                    shutil.copy(os.path.join(folder, shown), os.path.join(folder, name))
            for _, content in blocks(text_of(page)):
                for words in calls(content):
                    with self.subTest(page=page, call=shlex.join(words)):
                        done = swirl(*words, cwd=folder, environment={"SWIRL_PARSE_ONLY": "1"})
                        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_omitted_and_failing_blocks_exist(self):
        shown = [
            content
            for page in pages()
            for _, content in blocks(text_of(page))
            if list(calls(content)) or any(f"swirl {name}" in content for name in LAUNCHER)
        ]
        for part in (*(part for part, _ in OMITTED), *FAILING):
            self.assertTrue(any(part in content for content in shown), part)

    def test_a_misspelt_option_is_found(self):
        content = (
            "./swirl run --disks 48        # a comment\n"
            "swirl movie --colour id --oout a.mp4 && ./swirl lab\n"
        )
        for words in calls(content):
            self.assertEqual(
                swirl(*words, environment={"SWIRL_PARSE_ONLY": "1"}).returncode, 2, words
            )
        self.assertEqual(len(list(calls(content))), 2)

    def test_short_calls_work(self):
        ran = 0
        for page in pages():
            folder = self.path(page.replace("/", "-"))
            os.makedirs(folder)
            write_shown_files(folder, text_of(page))
            for kind, content in blocks(text_of(page)):
                if kind == "toml":
                    for shown, shorter in SHORTENED:
                        content = content.replace(shown, shorter)
                    write_text(os.path.join(folder, "plan.toml"), content)
                    continue
                for words in map(shortened, calls(content)):
                    if words is None or missing_input(words, folder):
                        continue
                    with self.subTest(page=page, call=shlex.join(words)):
                        self.assert_works(*words, cwd=folder)
                        ran += 1
        self.assertGreater(ran, 40)


class PagesAsShown(InFolder):
    """The blocks with calls of swirl, in the order of their page, with bash. For the suite slow,
    because of its runs, videos and movies."""

    def prepare(self, folder, text):
        """The program under test at the names that the pages use, the sources that they read, and
        the reader's videos."""
        os.makedirs(os.path.join(folder, "build/release"))
        for name in ("swirl", "build/release/swirl"):
            os.symlink(os.path.abspath(SWIRL), os.path.join(folder, name))
        os.symlink(os.path.join(SOURCE, "paper"), os.path.join(folder, "paper"))
        os.makedirs(os.path.join(folder, "docs/images"))
        os.makedirs(os.path.join(folder, "rough"))
        write_shown_files(folder, text)
        for name, discs in VIDEOS.items():
            if re.search(rf"(?<!out ){name.replace('a.mp4', '')}", text):
                self.assert_works(
                    "synthetic-video",
                    "--discs",
                    discs,
                    "--camera",
                    "phone",
                    "--periods",
                    2,
                    "--out",
                    name,
                    cwd=folder,
                    timeout=HANG,
                )
        if "swirl movie run.h5" in text:
            self.assert_works(
                "run",
                "--periods",
                45,
                "--frames-per-period",
                60,
                "--trajectory",
                "run.h5",
                cwd=folder,
            )

    def test_blocks_work(self):
        for page in pages():
            folder = self.path(page.replace("/", "-"))
            self.prepare(folder, text_of(page))
            for kind, content in blocks(text_of(page)):
                if kind == "toml":
                    write_text(os.path.join(folder, "plan.toml"), content)
                elif can_run(content):
                    with self.subTest(page=page, block=content):
                        done = subprocess.run(
                            ["bash", "-e", "-o", "pipefail", "-c", content],
                            cwd=folder,
                            text=True,
                            capture_output=True,
                            stdin=subprocess.DEVNULL,
                            env={**os.environ, "PATH": folder + os.pathsep + os.environ["PATH"]},
                        )
                        self.assertEqual(done.returncode, exit_code(content), done.stderr[-2000:])


if __name__ == "__main__":
    if "--all" in sys.argv:
        sys.argv.remove("--all")
    else:
        del PagesAsShown
    unittest.main()
