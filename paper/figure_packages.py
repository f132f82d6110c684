"""Whether the figures can be drawn; called before work begins whose end is a figure."""

import importlib

from paper.console import Problem

PACKAGES = {
    "numpy": "python3-numpy",
    "matplotlib": "python3-matplotlib",
    "jinja2": "python3-jinja2",
}


def missing():
    """The Debian packages whose modules cannot be imported."""
    absent = []
    for module, package in PACKAGES.items():
        try:
            importlib.import_module(module)
        except ImportError:
            absent.append(package)
    return absent


def main():
    if absent := missing():
        names = " and ".join(absent)
        raise Problem(
            f"figures and report need the Debian package{'s' if len(absent) > 1 else ''} {names}; "
            "nothing was begun.\n"
            f"hint: apt install {' '.join(absent)}."
        )
