"""Runs the function main() of a module of this package:

    /usr/bin/python3 paper draw out/figure_5b.csv

The program calls the modules in the same way (src/swirl/run/python_script.hpp).
"""

import importlib
import importlib.util
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))


def load_package():
    """Makes this folder the package `paper`. Neither its modules nor files next to it can then
    replace the modules of others."""
    sys.path[:] = [path for path in sys.path if os.path.abspath(path) != FOLDER]
    spec = importlib.util.spec_from_file_location(
        "paper", os.path.join(FOLDER, "__init__.py"), submodule_search_locations=[FOLDER]
    )
    sys.modules["paper"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(sys.modules["paper"])


load_package()
from paper import console  # noqa: E402


def scripts():
    """The names of the modules with a function main()."""
    found = []
    for file in os.listdir(FOLDER):
        if file.endswith(".py") and not file.startswith("_"):
            with open(os.path.join(FOLDER, file), encoding="utf-8") as text:
                if "\ndef main(" in text.read():
                    found.append(file.removesuffix(".py"))
    return sorted(found)


def main():
    name = sys.argv[1] if len(sys.argv) > 1 else ""
    if name not in scripts():
        example = __doc__[__doc__.index("/usr") :].split("\n")[0]
        return console.report(
            console.Problem(
                f"there is no script '{name}'.\n"
                f"hint: the scripts are {', '.join(scripts())}, for example `{example}`.",
                2,
            )
        )
    sys.argv[:2] = [f"{sys.argv[0]} {name}"]
    try:
        return importlib.import_module(f"paper.{name}").main()
    except console.Problem as problem:
        return console.report(problem)
    except KeyboardInterrupt:
        return console.report(console.Problem("stopped before the end.", console.INTERRUPTED))
    except ImportError as missing:
        return console.report(
            f"a Python module is missing: {missing}.\n"
            "hint: ./swirl paper installs and builds what is missing."
        )
    except OSError as error:
        return console.report(f"'{error.filename}': {error.strerror}." if error.filename else error)


if __name__ == "__main__":
    sys.exit(main())
