"""`swirl paper` passes its call as JSON (command.py)."""

import json
import os
import sys


def main():
    call = json.loads(sys.argv[1])
    if call.get("module"):
        sys.path.insert(0, call["module"])
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    import command
    import console

    console.stop_on_signals()
    try:
        return command.main(call)
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
