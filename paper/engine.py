"""The Python module swirl, imported when it is first used: to draw a table, it need not be built."""

import importlib


class Module:
    def __getattr__(self, name):
        return getattr(importlib.import_module("swirl"), name)


swirl = Module()
