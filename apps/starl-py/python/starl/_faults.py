"""Faults that overwrite the variables of robots in Python."""

from __future__ import annotations

from typing import Any

from starl import _native


class Draws:
    """Random numbers for `RobotProgram.corrupt`, the same in every run of a scenario and seed."""

    def __init__(self, native: _native.Draws) -> None:
        self._native = native

    def random(self) -> float:
        """A number from 0 to 1, without 1."""
        return self._native.random()

    def below(self, bound: int) -> int:
        """A whole number from 0, below a bound."""
        return int(self.random() * bound)


#: Collections that a fault overwrites get fewer elements than this.
_MOST_ELEMENTS = 5


def overwritten(value: Any, draws: Draws) -> Any:
    """Another value of the same type."""
    if isinstance(value, bool):
        return draws.random() < 0.5
    if isinstance(value, int | float):
        # Small and large ones, as likely.
        magnitude = draws.random() * 2.0 ** draws.below(32)
        return type(value)(magnitude if draws.random() < 0.5 else -magnitude)
    if isinstance(value, str):
        return "".join(chr(ord("a") + draws.below(26)) for _ in range(draws.below(_MOST_ELEMENTS)))
    if isinstance(value, tuple) and type(value) is tuple:
        return tuple(overwritten(one, draws) for one in value)
    if isinstance(value, list):
        # Another length too: the elements that are left are like those that were there.
        count = draws.below(_MOST_ELEMENTS) if value else 0
        return [overwritten(value[draws.below(len(value))], draws) for _ in range(count)]
    if isinstance(value, dict):
        return {key: overwritten(one, draws) for key, one in value.items() if draws.random() < 0.5}
    if isinstance(value, set):
        return {overwritten(one, draws) for one in sorted(value) if draws.random() < 0.5}
    return value
