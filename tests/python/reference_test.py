"""docs/reference/python.md is generated from the public signatures and docstrings. This rewrites it:

    SWIRL_WRITE_DOCS=1 ctest --test-dir build/tests -R python.reference
"""

import ast
import inspect
import os
import textwrap

import swirl
import swirl.plot
from scenes import SOURCE

FILE = os.path.join(SOURCE, "docs", "reference", "python.md")
HEAD = """# Python: reference

Generated from the docstrings of `bindings/python/swirl` by `tests/python/reference_test.py`. The guide is
[python.md](python.md); parameters of runs are listed in [parameters.md](parameters.md).
"""


def code(text):
    return f"```\n{textwrap.dedent(text).strip()}\n```\n"


def stub_classes():
    """The compiled classes, whose docstrings are in the stub file."""
    with open(os.path.join(os.path.dirname(swirl.__file__), "_engine.pyi"), encoding="utf-8") as file:
        tree = ast.parse(file.read())
    return {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}


def of_stub(name, node):
    lines = [f"## swirl.{name}\n", code(ast.get_docstring(node) or "")]
    for method in node.body:
        if not isinstance(method, ast.FunctionDef) or method.name.startswith("_") or \
                method.name == "to_bytes":
            continue
        is_property = bool(method.decorator_list)
        said = " ".join((ast.get_docstring(method) or "").split())
        lines.append(f"- `.{method.name}{'' if is_property else '()'}`{': ' + said if said else ''}")
    return "\n".join(lines).rstrip() + "\n"


def without_parameters(text):
    """The docstring without the list of parameters, which has its own page."""
    return text.split("\nParameters (docs/reference/parameters.md)")[0].rstrip()


def arguments(function):
    """The arguments in the source, without the parameters of runs."""
    names = []
    function = inspect.unwrap(function)
    code_ = function.__code__
    given = code_.co_varnames[:code_.co_argcount + code_.co_kwonlyargcount]
    defaults = {**dict(zip(given[:code_.co_argcount][::-1], (function.__defaults__ or ())[::-1])),
                **(function.__kwdefaults__ or {})}
    for name in given:
        if name not in ("self", "cls"):
            names.append(f"{name}={defaults[name]!r}" if name in defaults else name)
    if code_.co_flags & inspect.CO_VARKEYWORDS:
        names.append("**parameters")
    return ", ".join(names)


def of_class(name, kind):
    own_init = kind.__dict__.get("__init__")
    takes = f"({arguments(own_init)})" if own_init and not hasattr(kind, "__dataclass_fields__") and \
        name in ("Simulation", "Trajectory", "Tracks") else ""
    lines = [f"## swirl.{name}{takes}\n", code(without_parameters(inspect.getdoc(kind) or ""))]
    for method, value in vars(kind).items():
        if method.startswith("_"):
            continue
        target = value.fget if isinstance(value, property) else getattr(value, "__func__", value)
        if not inspect.isfunction(target):
            continue
        said = " ".join((inspect.getdoc(target) or "").split())
        call = "" if isinstance(value, property) else f"({arguments(target)})"
        lines.append(f"- `.{method}{call}`{': ' + said if said else ''}")
    return "\n".join(lines).rstrip() + "\n"


def reference():
    stubs, parts = stub_classes(), [HEAD]
    for name in sorted(swirl.__all__, key=str.lower):
        thing = getattr(swirl, name)
        # An internal class may have the name of a public one (Recording).
        if name in stubs and thing is getattr(swirl._engine, name):
            parts.append(of_stub(name, stubs[name]))
        elif inspect.isclass(thing):
            parts.append(of_class(name, thing))
        elif callable(thing):
            parts.append(f"## swirl.{name}({arguments(thing)})\n\n"
                         f"{code(without_parameters(inspect.getdoc(thing)))}")
    for name, thing in sorted(vars(swirl.plot).items()):
        if inspect.isfunction(thing) and not name.startswith("_") and \
                thing.__module__ == "swirl.plot":
            parts.append(f"## swirl.plot.{name}({arguments(thing)})\n\n{code(inspect.getdoc(thing))}")
    return "\n".join(parts)


def test_reference_is_up_to_date():
    made = reference()
    there = ""
    if os.path.exists(FILE):
        with open(FILE, encoding="utf-8") as file:
            there = file.read()
    if made != there and os.environ.get("SWIRL_WRITE_DOCS"):
        with open(FILE, "w", encoding="utf-8") as file:
            file.write(made)
    assert made == there, "docs/reference/python.md is out of date (SWIRL_WRITE_DOCS)."
