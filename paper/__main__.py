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
from paper import console, optional_file  # noqa: E402


def main():
    name = sys.argv[1] if len(sys.argv) > 1 else ""
    if not name.isidentifier() or not optional_file.exists(os.path.join(FOLDER, f"{name}.py")):
        return console.report(
            console.Problem(f"usage: {__doc__[__doc__.index('/usr'):].split(chr(10))[0]}", 2)
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
