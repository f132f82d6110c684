"""docs/reference/python.md is generated from the public signatures and docstrings. This rewrites
it:

    SWIRL_WRITE_DOCS=1 ctest --test-dir build/tests -R python.reference
"""

import inspect
import os

import swirl
import swirl.plot
from scenes import SOURCE

FILE = os.path.join(SOURCE, "docs", "reference", "python.md")
HEAD = """# Python: reference

For users of the module: every public name, with its first sentence. `help(swirl.run)` and the editor show the arguments, methods and units
of each. `tests/python/reference_test.py` writes this page from the docstrings. The guide is [First steps in Python](../tutorials/python.md),
and [parameters.md](parameters.md) lists the parameters of runs.

| name | purpose |
|---|---|
"""


def row(name, docstring, is_call=False):
    first = " ".join(docstring.split("\n\n")[0].split())
    return f"| `{name}{'()' if is_call else ''}` | {first.split('. ')[0].rstrip('.:')} |\n"


def reference():
    rows = []
    for name in sorted(swirl.__all__, key=str.lower):
        thing = getattr(swirl, name)
        if callable(thing):
            rows.append(row(f"swirl.{name}", inspect.getdoc(thing), not inspect.isclass(thing)))
    for name, thing in sorted(vars(swirl.plot).items()):
        if (
            inspect.isfunction(thing)
            and not name.startswith("_")
            and thing.__module__ == "swirl.plot"
        ):
            rows.append(row(f"swirl.plot.{name}", inspect.getdoc(thing), True))
    return HEAD + "".join(rows)


def test_reference_is_up_to_date():
    made = reference()
    there = ""
    if os.path.exists(FILE):
        with open(FILE, encoding="utf-8") as file:
            there = file.read()
    if os.environ.get("SWIRL_WRITE_DOCS"):
        with open(FILE, "w", encoding="utf-8") as file:
            file.write(made)
        return
    assert made == there, "docs/reference/python.md is out of date (SWIRL_WRITE_DOCS)."
