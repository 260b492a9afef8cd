"""Scenarios and programs: what is to be simulated."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from starl._errors import Diagnostic, StarlError
from starl._native import Engine
from starl._requests import request
from starl._robots import RobotProgram

#: Answers requests without a simulation.
_SHARED = Engine()


@dataclass(frozen=True)
class Program:
    """A program in the StarL language.

    Raises StarlError, with all diagnostics, if it has errors. Warnings stand in `warnings`.
    """

    text: str = field(repr=False)
    #: What messages call the program; libraries and models that it names are looked for in the folder of this path.
    path: str = "program.starl"
    #: Libraries by name, which come before those in the folder.
    libraries: Mapping[str, str] = field(default_factory=dict, repr=False)
    warnings: list[Diagnostic] = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        _text(self.text, "a program")
        found = [Diagnostic._of(one) for one in request(_SHARED, "check", files=self._files())]
        errors = [one for one in found if one.severity == "error"]
        if errors:
            raise StarlError("\n".join(map(str, errors)), found)
        object.__setattr__(self, "warnings", found)

    @classmethod
    def from_file(cls, path: str | Path) -> Program:
        """The program in a file."""
        return cls(_read(path), path=str(path))

    def _files(self) -> dict[str, str]:
        folder = Path(self.path).parent
        libraries = {str(folder / f"{name}.starl"): text for name, text in self.libraries.items()}
        return {self.path: self.text, **libraries}

    def formatted(self) -> str:
        """The text as `starl fmt` lays it out."""
        text: str = request(_SHARED, "format", text=self.text)
        return text


class Scenario:
    """A fleet, its world, its network and its programs: all that a run depends on but the seed, which it may name.

    `Scenario("race")` is an example of that name, `Scenario.from_file(path)` a file and `Scenario.from_text(text)` the
    text of one. Without any of these it starts from an empty floor with a few robots. Keywords are fields of the
    scenario (docs/reference/scenario.md), tables as dictionaries:

        Scenario(program=Program(text), robots="create=4", network={"loss": 0.1}, duration="60s")

    Lengths, times and other quantities are text with a unit, or a number in the unit that the reference gives. Raises
    StarlError that names file, line and field of everything that is wrong.
    """

    def __init__(
        self,
        example: str | None = None,
        *,
        program: Program | RobotProgram | str | Path | None = None,
        robots: str | None = None,
        faults: str | Path | None = None,
        seed: int | None = None,
        duration: str | float | None = None,
        **fields: Any,
    ) -> None:
        self._files: dict[str, str] = {}
        self._programs: dict[str, RobotProgram] = {}
        self._options: dict[str, Any] = {"scenario": example} if example is not None else {}
        self._change(program=program, robots=robots, faults=faults, seed=seed, duration=duration, **fields)

    @classmethod
    def from_file(cls, path: str | Path, **changes: Any) -> Scenario:
        """The scenario of a file; it finds the files that it names beside it. Keywords change it as for `with_`."""
        return cls._of({str(path): _read(path)}, str(path), changes)

    @classmethod
    def from_text(
        cls, text: str, *, path: str = "scenario.toml", files: Mapping[str, str] | None = None, **changes: Any
    ) -> Scenario:
        """The scenario of a text. `files` are others that it names; those that are not there are looked for on disk,
        from the folder of `path`."""
        return cls._of({path: _text(text, "a scenario"), **(files or {})}, path, changes)

    @classmethod
    def _from(cls, given: Scenario | str) -> Scenario:
        """The scenario, or the example of that name."""
        if not isinstance(given, (Scenario, str)):
            raise StarlError(f"{given!r} is not a scenario; give a `Scenario` or the name of an example")
        return cls(given) if isinstance(given, str) else given

    @classmethod
    def _of(cls, files: dict[str, str], path: str, changes: Mapping[str, Any]) -> Scenario:
        scenario = cls.__new__(cls)
        scenario._files = files
        scenario._programs = {}
        scenario._options = {"scenario": path}
        scenario._change(**changes)
        return scenario

    def with_(self, **changes: Any) -> Scenario:
        """The same scenario with other fields, as keywords: see Scenario."""
        scenario = Scenario.__new__(Scenario)
        scenario._files = dict(self._files)
        scenario._programs = dict(self._programs)
        scenario._options = {**self._options, "set": list(self._options.get("set", []))}
        scenario._change(**changes)
        return scenario

    def set(self, field: str, value: Any) -> Scenario:
        """The same scenario with another value of a field, such as `set("network.loss", 0.2)`."""
        scenario = self.with_()
        scenario._options["set"].append(f"{field}={_toml(field, value)}")
        scenario._check()
        return scenario

    def _change(
        self,
        *,
        program: Program | RobotProgram | str | Path | None = None,
        robots: str | None = None,
        faults: str | Path | None = None,
        seed: int | None = None,
        duration: str | float | None = None,
        **fields: Any,
    ) -> None:
        options = self._options
        if isinstance(program, Program):
            self._files.update(program._files())
            options["program"] = program.path
        elif isinstance(program, RobotProgram):
            name = type(program).__name__
            self._programs = {name: program}
            options["program"] = name
        elif isinstance(program, type) and issubclass(program, RobotProgram):
            raise StarlError(f"program: give an object, `{program.__name__}(...)`, and not the class")
        elif program is not None:
            if not isinstance(program, (str, Path)):
                raise StarlError(f"program: {program!r} is not a program, a file, or an example's name")
            program = str(program)
            if program.endswith(".starl") and program not in self._files and Path(program).exists():
                self._files[program] = _read(program)
            options["program"] = program
        if robots is not None:
            if not isinstance(robots, str):
                raise StarlError(f'robots: {robots!r} is not a fleet; write it as "create=4" or "create=2,drone=2"')
            options["robots"] = robots
        if faults is not None:
            self._files[str(faults)] = _read(faults)
            options["faults"] = str(faults)
        if seed is not None:
            options["seed"] = str(seed)
        if duration is not None:
            options["duration"] = duration if isinstance(duration, str) else f"{duration}s"
        assignments = options.setdefault("set", [])
        for name, value in fields.items():
            assignments.extend(f"{name}={_toml(name, value)}" for name, value in _leaves(name, value))
        self._check()

    def _engine(self) -> Engine:
        """An engine that knows the programs in Python."""
        return Engine(self._programs) if self._programs else _SHARED

    @contextmanager
    def _opened(self) -> Iterator[tuple[Engine, dict[str, Any]]]:
        """A simulation of the scenario for a moment: its engine, and the answer of the request that opened it."""
        engine = self._engine()
        opened = request(engine, "open", files=self._files, options=self._options, topics=[])
        try:
            yield engine, opened
        finally:
            request(engine, "close", simulation=opened["simulation"])

    def _check(self) -> None:
        with self._opened() as (_, opened):
            self._title: str = opened["title"]

    @property
    def title(self) -> str:
        """What the scenario is called."""
        return self._title

    def text(self) -> str:
        """The whole scenario as the text of a file, changes and defaults included."""
        with self._opened() as (engine, opened):
            text: str = request(engine, "scenario", simulation=opened["simulation"])
        return text

    def __repr__(self) -> str:
        return f"<starl.Scenario {self._title!r}>"


def examples() -> dict[str, str]:
    """The examples that come with StarL: name, and what one sees in one line."""
    return {example["name"]: example["summary"] for example in request(_SHARED, "examples")}


def _read(path: str | Path) -> str:
    try:
        return Path(path).read_bytes().decode()
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise StarlError(f"{path}:{line}: is not text in UTF-8; save it as that") from None
    except OSError as error:
        raise StarlError(f"{path}: cannot be read: {error.strerror}") from None


def _text(text: Any, what: str) -> str:
    if not isinstance(text, str):
        raise StarlError(f"the text of {what} is a str, not {type(text).__name__}")
    try:
        text.encode()
    except UnicodeEncodeError as error:
        line = text[: error.start].count("\n") + 1
        raise StarlError(f"the text of {what} is not Unicode in line {line}: {text[error.start]!a} is half a character") from None
    return text


def _leaves(name: str, value: Any) -> list[tuple[str, Any]]:
    """The single fields of a table."""
    if isinstance(value, Mapping) and value:
        return [leaf for key, inner in value.items() for leaf in _leaves(f"{name}.{key}", inner)]
    return [(name, value)]


def _toml(name: str, value: Any) -> str:
    """A value as scenario files write it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float) and math.isfinite(value):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=True)
    if isinstance(value, Mapping):
        inner = ", ".join(f"{json.dumps(key)} = {_toml(name, one)}" for key, one in value.items())
        return f"{{{inner}}}"
    if hasattr(value, "tolist"):
        return _toml(name, value.tolist())
    if isinstance(value, list | tuple):
        return f"[{', '.join(_toml(name, one) for one in value)}]"
    raise StarlError(f"{name}: a scenario holds numbers, texts, lists and dictionaries, not {value!r}")
