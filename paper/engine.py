"""The Python module swirl, imported when it is first used: to draw a table, it need not be
built."""

import importlib
import json


class Module:
    def __getattr__(self, name):
        return getattr(importlib.import_module("swirl"), name)


swirl = Module()


def result_of(parameters, measure):
    """The result of a run, as it is stored."""
    return json.loads(swirl.run(measure=list(measure), **parameters).to_json())


def simulation_of(parameters):
    """A swirl.Simulation with the parameters of a run, without its length."""
    return swirl.Simulation(
        **{
            name: value
            for name, value in parameters.items()
            if name not in ("periods", "warmup", "events")
        }
    )
