"""What StarL refuses, and where."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Diagnostic:
    """One problem of a scenario or a program."""

    #: The file's path; None for a problem with an option.
    file: str | None
    #: From 1.
    line: int
    #: From 1, in characters.
    column: int
    #: "error" or "warning".
    severity: str
    #: The number in the reference of errors; None for scenarios.
    code: str | None
    #: The field of a scenario, such as `network.loss`, or the option.
    field: str | None
    message: str
    #: A suggested fix.
    help: str | None
    #: More that is worth knowing, a line each.
    notes: tuple[str, ...] = ()

    @classmethod
    def _of(cls, found: dict[str, Any]) -> Diagnostic:
        members = {name: found[name] for name in cls.__dataclass_fields__}
        return cls(**{**members, "notes": tuple(found["notes"])})

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}:{self.column}: " if self.file and self.line else ""
        help = f"; {self.help}" if self.help else ""
        return f"{place}{self.severity}: {self.message}{help}"


class StarlError(ValueError):
    """What StarL refuses: the message says what is wrong and where."""

    def __init__(self, message: str, diagnostics: list[Diagnostic] | None = None) -> None:
        super().__init__(message)
        #: The single problems; empty where there is no more to say than the message does.
        self.diagnostics: list[Diagnostic] = diagnostics or []
