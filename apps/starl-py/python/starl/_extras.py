"""Packages that only some parts need."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def needed(module: str, extra: str) -> Any:
    """Imports a package that an extra installs; the error of a missing one says so."""
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        package = module.split(".")[0]
        if (error.name or "").split(".")[0] != package:
            raise
        raise ModuleNotFoundError(f"this needs {package}: pip install 'starl[{extra}]'", name=package) from None
