"""Requests to the simulator and its answers, as apps/starl-catalog/src/service/request.rs lists them."""

from __future__ import annotations

import json
from typing import Any

from starl._errors import Diagnostic, StarlError
from starl._native import Engine


def request(engine: Engine, name: str, **parameters: Any) -> Any:
    """The answer to a request; raises the StarlError that it is refused with. Parameters that are None are left out."""
    given = {key: value for key, value in parameters.items() if value is not None}
    try:
        text = json.dumps({name: given}, allow_nan=False, default=_plain)
    except ValueError:
        raise StarlError(f"{name}: a number is not finite") from None
    except TypeError as error:
        raise StarlError(f"{name}: {error}") from None
    answer = json.loads(engine.request(text.encode()))
    if "error" in answer:
        refused = answer["error"]
        raise StarlError(refused["message"], [Diagnostic._of(found) for found in refused["diagnostics"]])
    return answer["ok"]


def _plain(value: Any) -> Any:
    """A number or an array of NumPy as JSON can write it."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{value!r} is not a number, a text, a list or a dictionary")
