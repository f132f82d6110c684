"""Checks of arguments, and of assignments to attributes: one sentence for each mistake."""

from __future__ import annotations

import difflib
import enum
import os
from typing import Any

import numpy as np

from . import _engine


def shown(value: object) -> str:
    """repr(), in one line and with at most 80 characters, for messages. Numbers of NumPy are shown
    as those of Python: NumPy 2 would name their types."""
    value = value.item() if isinstance(value, np.generic) else value
    text = " ".join(repr(value).split())
    return _engine.shortened(text.encode("utf-8", "backslashreplace").decode())


def text(name: str, value: object) -> str:
    """The text, which UTF-8 can encode."""
    if not isinstance(value, str):
        raise TypeError(f"{name} is {shown(value)}, but it must be a text.")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise ValueError(
            f"{name} is {_engine.shortened(ascii(value))}, but half of a surrogate pair is not a "
            "character."
        ) from None
    return value


def file_name(name: str, value: object) -> str:
    """The name of a file or folder."""
    if not isinstance(value, (str, bytes, os.PathLike)):
        raise TypeError(f"{name} is {shown(value)}, but it must be the name of a file or folder.")
    return text(name, os.fsdecode(value))


def closed(cls: type) -> None:
    """An assignment that would have no effect raises AttributeError, with what to do. The instances
    of `cls` have no dictionary, except the members of an enumeration."""
    assign: Any = cls.__setattr__
    is_enumeration = issubclass(cls, enum.Enum)

    def set_attribute(self: Any, name: str, value: object) -> None:
        kind = AttributeError
        try:
            if not is_enumeration:
                assign(self, name, value)
                return
        except AttributeError as error:
            kind = type(error)
        raise kind(_sentence_on(self, name)) from None

    setattr(cls, "__setattr__", set_attribute)


def _sentence_on(owner: Any, name: str) -> str:
    kind = f"swirl.{type(owner).__name__}"
    if kind == "swirl.Simulation" and name in (row[0] for row in _engine.parameters()):
        return (
            f"{name} cannot be assigned: a simulation keeps its parameters.\n"
            "hint: make another one with "
            f"swirl.Simulation({name}=...), or let ramp change a parameter during the run."
        )
    public = [other for other in dir(type(owner)) if not other.startswith("_")]
    if name in public:
        return f"{name} of {kind} cannot be assigned.\nhint: keep your value in a variable."
    similar = difflib.get_close_matches(name, public, 1)
    meant = f"did you mean {similar[0]}? Otherwise " if similar else ""
    return (
        f"{kind} has no attribute '{_engine.shortened(name)}'.\n"
        f"hint: {meant}keep your value in a variable."
    )
