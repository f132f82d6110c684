"""The Python module swirl, imported when it is first used: to draw a table, it need not be built."""

import importlib


class Module:
    def __getattr__(self, name):
        return getattr(importlib.import_module("swirl"), name)


swirl = Module()


def simulation_of(parameters):
    """A swirl.Simulation with the parameters of a run, without its length."""
    return swirl.Simulation(**{name: value for name, value in parameters.items()
                               if name not in ("periods", "warmup", "events")})
