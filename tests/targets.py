"""Prints the targets that `ctest -R NAME` or `ctest -L LABEL` needs: targets.py ARGUMENTS-OF-CTEST.
Prints nothing if it needs all, or if this is not known."""

import os
import re
import sys

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
# Folder of tests in C++: the label of its tests, which is also the beginning of their names.
LAYERS = {
    f"tests/{layer}": layer
    for layer in (
        "math",
        "physics",
        "engine",
        "statistics",
        "measure",
        "io",
        "run",
        "render",
        "study",
    )
}
LAYERS |= {f"track/tests/{part}": f"track_{part}" for part in ("experiment", "video")}
# What scripts with a label need; "help" builds nothing, and "" is everything.
SCRIPTS = {
    "cli": "swirl python_module",
    "track": "swirl",
    "python": "swirl python_module",
    "paper": "swirl python_module",
    "faults": "swirl faults",
    "engine": "test_engine",
    "measure": "test_measure",
    "layers": "help",
    "mutation": "help",
    "library": "",
    "platforms": "",
    "bench": "",
}


def tests():
    """Label, name without parameters, and targets of each test."""
    for folder, layer in LAYERS.items():
        for file in os.listdir(os.path.join(SOURCE, folder)):
            if file.endswith("_test.cpp"):
                with open(os.path.join(SOURCE, folder, file), encoding="utf-8") as opened:
                    for suite, name in re.findall(
                        r"^(?:TEST\w*|RC_GTEST_PROP)\(\s*(\w+),\s*(\w+)", opened.read(), re.M
                    ):
                        yield layer, f"{layer}.{suite}.{name}", f"test_{layer}"
    for label, targets in SCRIPTS.items():
        folder = f"{label}/tests" if label in ("track", "paper") else f"tests/{label}"
        for file in os.listdir(os.path.join(SOURCE, folder)):
            if file.endswith(".py"):
                yield label, f"{label}.{file[:-3]}", targets


def needed(arguments):
    chosen = [
        (option, value) for option, value in zip(arguments, arguments[1:]) if option in ("-R", "-L")
    ]
    if len(chosen) != 1 or any(re.match("-(E|LE|I|FS)", word) for word in arguments):
        return ""
    ((option, pattern),) = chosen
    found = {
        targets
        for label, name, targets in tests()
        if re.search(pattern, label if option == "-L" else name)
    }
    return (
        ""
        if "" in found
        else " ".join(sorted({target for targets in found for target in targets.split()}))
    )


if __name__ == "__main__":
    print(needed(sys.argv[1:]))
