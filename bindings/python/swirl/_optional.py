"""Packages that only some functions need."""

from __future__ import annotations

import importlib
from typing import Any


def optional(module: str, caller: str) -> Any:
    """Imports a module. Call it before any work, so that a missing package costs none."""
    package = module.partition(".")[0]
    try:
        return importlib.import_module(module)
    except ImportError as error:
        missing = getattr(error, "name", None) or package
        raise ImportError(
            f"{caller} needs the package {package}, which cannot be imported: {error}.\n"
            f"hint: pip install {missing.partition('.')[0]}",
            name=missing,
        ) from error
