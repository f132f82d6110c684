"""_engine.pyi is generated from the compiled module: a docstring begins with the signature, which
C++ cannot tell as precisely. This rewrites the file:

    SWIRL_WRITE_DOCS=1 ctest --test-dir build/tests -R python.stubs
"""

import inspect
import os
import re
import textwrap
import types

import numpy as np

import swirl
from scenes import SOURCE
from swirl import _engine

FILE = os.path.join(SOURCE, "bindings", "python", "swirl", "_engine.pyi")
WIDTH = 100
HEAD = '''"""The compiled module (bindings/python/*.cpp). tests/python/stubs_test.py makes this file of its
docstrings."""

from collections.abc import Callable, Sequence
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from ._results import Report

_Floats = npt.NDArray[np.float64]
_Estimate = tuple[float, float, float, int]  # mean, error, effective samples, blocks
_Curve = list[tuple[float, float, float]]  # N, mean, error
_SeriesColumns = tuple[list[str], list[str], list[str], _Floats]
'''


def parts(thing):
    """The signature of a function or property in one line, and its documentation."""
    documented = thing.__func__ if isinstance(thing, staticmethod) else thing
    signature, _, text = (inspect.getdoc(documented) or "").partition("\n\n")
    return " ".join(signature.split()), text


def split_at_commas(text):
    """The parts of a text between commas outside of brackets."""
    found, depth = [""], 0
    for character in text:
        depth += (character in "([{") - (character in ")]}")
        if character == "," and depth == 0:
            found.append("")
        else:
            found[-1] += character
    return [part.strip() for part in found if part.strip()]


def docstring(text):
    """Its lines. The quotes at the end have a line of their own if the last line is full."""
    lines = textwrap.indent(f'"""{text}"""', "    ").splitlines()
    if len(lines[-1]) > WIDTH:
        lines[-1:] = [lines[-1][:-3], '    """']
    return lines


def definition(signature, text, indent):
    """A function of the stub, as black writes it."""
    lines = [f"def {signature}:"]
    if len(indent) + len(lines[0]) + (0 if text else 4) > WIDTH:
        name, arguments, result = re.fullmatch(r"(\w+)\((.*)\)( -> .*)", signature).groups()
        if len(indent) + 4 + len(arguments) <= WIDTH:
            middle = [f"    {arguments}"]
        else:
            middle = [f"    {argument}," for argument in split_at_commas(arguments)]
        lines = [f"def {name}(", *middle, f"){result}:"]
    if text:
        lines += docstring(text)
    else:
        lines[-1] += " ..."
    return [indent + line if line else "" for line in lines]


def python_signature(function):
    """The signature of a function that swirl/_display.py adds to a class."""
    hints = function.__annotations__

    def shown(parameter):
        star = {parameter.VAR_POSITIONAL: "*", parameter.VAR_KEYWORD: "**"}.get(parameter.kind, "")
        hint = "" if parameter.name == "self" else f": {hints[parameter.name]}"
        default = "" if parameter.default is parameter.empty else f" = {parameter.default!r}"
        return f"{star}{parameter.name}{hint}{default}"

    parameters = ["self"]
    for parameter in list(inspect.signature(function).parameters.values())[1:]:
        if parameter.kind == parameter.KEYWORD_ONLY and "*" not in parameters:
            parameters.append("*")
        parameters.append(shown(parameter))
    return f"({', '.join(parameters)}) -> {hints['return']}"


def member(name, thing):
    if isinstance(thing, property):
        result, text = parts(thing)
        return ["    @property", *definition(f"{name}(self) {result}", text, "    ")]
    if isinstance(thing, types.FunctionType):
        text = inspect.getdoc(thing) or ""
        return definition(f"{name}{python_signature(thing)}", text, "    ")
    decorator = ["    @staticmethod"] if isinstance(thing, staticmethod) else []
    return decorator + definition(*parts(thing), "    ")


def is_declared(name, thing):
    """Objects have the other names, too."""
    if name in ("__init__", "__len__", "__getitem__"):
        return inspect.getdoc(thing) != inspect.getdoc(getattr(object, name, None))
    return not name.startswith(("__", "_pybind11"))  # the second are of some versions only


def class_of(name, kind):
    base = kind.__bases__[0].__name__
    base = "" if base in ("object", "pybind11_object") else f"({base})"
    body = []
    if kind.__doc__:
        body += [*docstring(kind.__doc__), ""]
    for each, thing in vars(kind).items():
        if is_declared(each, thing):
            body += member(each, thing)
    return ["", f"class {name}{base}:", *body]


def attribute(name, value):
    kind = "np.dtype[np.void]" if isinstance(value, np.dtype) else type(value).__name__
    return [f"{name}: {kind}"]


def stub():
    names = [(name, thing) for name, thing in vars(_engine).items() if not name.startswith("__")]
    classes = [class_of(name, thing) for name, thing in names if isinstance(thing, type)]
    functions = [
        definition(*parts(thing), "")
        for name, thing in names
        if isinstance(thing, types.BuiltinFunctionType)
    ]
    values = [
        attribute(name, thing)
        for name, thing in names
        if not isinstance(thing, (type, types.BuiltinFunctionType))
    ]
    blocks = [*classes, [""], *values, [""], *functions]
    text = HEAD + "\n".join(line.rstrip() for block in blocks for line in block) + "\n"
    return re.sub(r'("""\n)\n(?=\nclass )', r"\1", text)


def test_the_stub_file_is_up_to_date():
    assert swirl.__version__  # swirl/_display.py has added its functions to the classes
    made = stub()
    if os.environ.get("SWIRL_WRITE_DOCS"):
        with open(FILE, "w", encoding="utf-8") as file:
            file.write(made)
        return
    with open(FILE, encoding="utf-8") as file:
        assert made == file.read(), "_engine.pyi is out of date (SWIRL_WRITE_DOCS)."


def test_every_name_has_a_signature():
    for name, thing in vars(_engine).items():
        if isinstance(thing, types.BuiltinFunctionType):
            assert re.match(rf"{name}\(.*\) -> ", parts(thing)[0]), name
