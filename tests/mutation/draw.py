"""Random mutations of the sources that compute: constants, comparisons, signs, indices and
conditions.

A site is one place in a line where one operator applies. mutate.py --random draws sites with equal
chances from a seed, so a large file has more of them.
"""

import os
import random
import re

LAYERS = ("math", "physics", "engine", "statistics", "measure", "run", "study")

# The source is formatted: a binary operator stands between spaces, and the brackets of a template
# do not.
SWAPS = {
    "comparison": {
        " < ": " <= ",
        " <= ": " < ",
        " > ": " >= ",
        " >= ": " > ",
        " == ": " != ",
        " != ": " == ",
    },
    "sign": {
        " + ": " - ",
        " - ": " + ",
        " * ": " / ",
        " / ": " * ",
        " += ": " -= ",
        " -= ": " += ",
    },
    "boolean": {" && ": " || ", " || ": " && ", "true": "false", "false": "true"},
    "off by one": {".size()": ".size() - 1", ".begin()": ".begin() + 1", "++": "--"},
}
NUMBER = re.compile(r"(?<![\w.])(\d+\.\d+|\d+)(e-?\d+)?(?![\w.'\"])")
CONDITION = re.compile(
    r"\bif \((?!constexpr)|\breturn (?=[^;{}\"]*(?:[=!<>]=| [<>] |&&|\|\|)[^;{}\"]*;)"
)
# Nothing that runs: declarations of templates and concepts, and what the compiler checks.
SKIPPED = re.compile(
    r"^\s*(#|//|template|static_assert|namespace|using|requires|concept|SWIRL_CHECK|SWIRL_HAS)"
)


def blanked(text):
    """The text with comments and strings replaced by spaces: sites have the same positions."""
    return re.sub(
        r"//[^\n]*|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'",
        lambda found: " " * len(found[0]),
        text,
    )


def other_number(text):
    if "." in text or "e" in text:
        return repr(1.2 * float(text)) if float(text) else "1.0"
    return str(int(text) + 1)


def closing(line, begin):
    """The position of the bracket that closes the one before `begin`; -1 if it is in a later
    line."""
    depth = 1
    for at in range(begin, len(line)):
        depth += {"(": 1, ")": -1}.get(line[at], 0)
        if depth == 0:
            return at
    return -1


def sites_of_line(line):
    """(begin, end, replacement, operator) for each site of a blanked line."""
    for operator, swaps in SWAPS.items():
        for before, after in swaps.items():
            pattern = rf"\b{before}\b" if before.isalpha() else re.escape(before)
            for found in re.finditer(pattern, line):
                yield found.start(), found.end(), after, operator
    for found in NUMBER.finditer(line):
        yield found.start(), found.end(), other_number(found[0]), "constant"
    for found in CONDITION.finditer(line):
        begin = found.end()
        end = closing(line, begin) if found[0].startswith("if") else line.find(";", begin)
        if end > begin:
            yield begin, end, f"!({line[begin:end]})", "boolean"


def sites(source):
    """All sites: (file, number of the line, line before, line after, operator)."""
    found = []
    for layer in LAYERS:
        for folder, _, names in sorted(os.walk(os.path.join(source, "src/swirl", layer))):
            for name in sorted(names):
                if not name.endswith((".hpp", ".cpp")) or "_avx" in name:
                    continue
                path = os.path.join(folder, name)
                with open(path, encoding="utf-8") as file:
                    text = file.read()
                rows = zip(text.splitlines(), blanked(text).splitlines())
                for number, (line, code) in enumerate(rows, 1):
                    if SKIPPED.match(line):
                        continue
                    for begin, end, after, operator in sites_of_line(code):
                        changed = line[:begin] + after + line[end:]
                        if after.startswith("!("):  # with the strings that were blanked
                            changed = f"{line[:begin]}!({line[begin:end]}){line[end:]}"
                        found.append(
                            (os.path.relpath(path, source), number, line, changed, operator)
                        )
    return found


def drawn(source, count, seed):
    return random.Random(seed).sample(sites(source), count)
