"""Prints 20 texts of the project that a stranger reads before a release. The version is the seed of
the draw:

    python3 tests/layers/text_sample.py 1.0.0
"""

import pathlib
import random
import re
import subprocess
import sys

import prose_test as prose

SOURCE = prose.SOURCE
KINDS = ("page", "help", "message", "comment", "commit")


def texts():
    """(kind, place, text) of every paragraph of the pages, option, error message, comment and body
    of a commit."""
    for page in prose.PAGES:
        name = str(page.relative_to(SOURCE))
        text = page.read_text(encoding="utf-8")
        for paragraph in re.split(r"\n\s*\n", re.sub(r"```.*?```", "", text, flags=re.S)):
            if re.match(r"[A-Z*-]", paragraph):
                yield "page", name, paragraph
    for file in (
        file
        for folder in ("src", "track", "paper")
        for file in sorted((SOURCE / folder).rglob("*"))
    ):
        name = str(file.relative_to(SOURCE))
        if file.suffix in (".cpp", ".hpp", ".py"):
            text = file.read_text(encoding="utf-8")
            for sentence in prose.comment_sentences(text, "#" if file.suffix == ".py" else "//"):
                yield "comment", name, sentence
            for option, description in re.findall(
                r'\{?"(--[a-z-]+)", [\w>&.-]+,\s+(?:"[A-Z|.]+",\s+)?"([A-Z][^"]*)"', text
            ):
                yield "help", name, f"{option}  {description}"
            for message in re.findall(
                r'(?:Error|Failure)\(\s*(?:fmt::format\(\s*)?((?:"(?:\\.|[^"\\])*"\s*)+)', text
            ):
                yield "message", name, "".join(re.findall(r'"((?:\\.|[^"\\])*)"', message))
    log = subprocess.run(
        ["git", "-C", SOURCE, "log", "--no-merges", "-200", "--format=%h%x00%s%n%b%x01"],
        capture_output=True,
        text=True,
        check=False,
    ).stdout
    for entry in log.split("\1"):
        name, _, text = entry.strip().partition("\0")
        if text:
            yield "commit", name, text


def sample(version):
    """Four texts of each kind. The same version and sources give the same texts."""
    everything = list(dict.fromkeys(texts()))
    draw = random.Random(version)
    of_kind = ([text for text in everything if text[0] == kind] for kind in KINDS)
    return [text for found in of_kind for text in draw.sample(found, min(4, len(found)))]


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    for number, (kind, place, text) in enumerate(sample(sys.argv[1]), 1):
        print(f"{number}. {kind}, {place}\n{text.strip()}\n")


if __name__ == "__main__":
    main()
