"""Checks the schema of scenarios that `starl schema` prints: check_schema.py STARL

Every example's scenario is valid, and all defaults are; a scenario with an unknown field, or with a value of a wrong
type, is not. Of single values the schema says what the command says.
"""

import copy
import json
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from jsonschema import Draft202012Validator

EXAMPLES = Path(__file__).parent.parent / "examples"

# Tables whose members are the program's own, or the model's.
FREE = ("parameters", "fields", "model_parameters")

# Values of fields: those that are taken, and those that are refused.
VALUES = [
    ("network", "delay", ["15ms", "1.5 s", "0", 0, "2_000us", "15\u00b5s"], [15, "15", "15 m", "-1ms", "fast", True]),
    ("network", "loss", [0.2, "20%", "0.5", 1], [1.5, -0.1, "20 m", "-5%", [0.1]]),
    ("network", "range", ["everywhere", "5m", ".5km"], [5, "0", "nowhere", "-1m"]),
    ("network", "largest", [1, 1000], [0, 0.5, "1000", 1 << 40]),
    ("network", "distribution", ["normal"], ["gauss", 1]),
    ("motion", "avoidance", [True, False, {"margin": "5cm"}], ["yes", {"margins": "5cm"}, {"margin": 5}]),
    ("physics", "step", ["25ms"], [25, "25", 0, "0"]),
    ("wind", "steady", [[1, 0], [1, 0.5, 0], ["1m/s", "3.6km/h"]], [1, [1], [1, 2, 3, 4], ["1m", 0]]),
]


def scenarios():
    """Every example's scenario, with its path."""
    for path in sorted(EXAMPLES.glob("**/*.toml")):
        scenario = tomllib.loads(path.read_text())
        # Fleet files have a table of robots, scenarios a list.
        if isinstance(scenario.get("robots"), list):
            yield path, scenario


def places(value, place=()):
    """The places of all tables and of all other values in a scenario."""
    yield place, value
    if isinstance(value, dict):
        for name, member in value.items():
            if name not in FREE:
                yield from places(member, (*place, name))
    elif isinstance(value, list):
        for index, element in enumerate(value):
            yield from places(element, (*place, index))


def put(scenario, place, value):
    """The scenario with another value at a place."""
    changed = copy.deepcopy(scenario)
    inner = changed
    for step in place[:-1]:
        inner = inner[step]
    inner[place[-1]] = value
    return changed


def fields(schema, place=()):
    """Every field of the schema with its place."""
    for name, field in schema.get("properties", {}).items():
        # The additions of a model do not describe the field itself.
        if not field.keys() <= {"properties", "additionalProperties"}:
            yield (*place, name), field
    for part in [*schema.get("properties", {}).items(), ("", schema.get("items")), ("", schema.get("then"))]:
        if isinstance(part[1], dict):
            yield from fields(part[1], (*place, part[0]))
    for part in [*schema.get("anyOf", []), *schema.get("allOf", [])]:
        yield from fields(part, place)


def toml(value):
    """A value as TOML."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{name} = {toml(member)}" for name, member in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


def takes(starl, scenario):
    """Whether the command takes a scenario."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scenario.toml"
        path.write_text("".join(f"{name} = {toml(value)}\n" for name, value in scenario.items()))
        return subprocess.run([starl, "run", path, "--quiet"], capture_output=True).returncode != 2


def main():
    starl = sys.argv[1]
    schema = json.loads(subprocess.run([starl, "schema"], check=True, capture_output=True).stdout)
    Draft202012Validator.check_schema(schema)
    validator = Draft202012Validator(schema)
    examples = refused = defaults = 0
    for path, scenario in scenarios():
        problems = [f"{path}: {problem.json_path}: {problem.message}" for problem in validator.iter_errors(scenario)]
        assert not problems, "\n".join(problems)
        examples += 1
        for place, value in places(scenario):
            wrong = [put(scenario, (*place, "no_such_field"), 1)] if isinstance(value, dict) else []
            if place:
                # No field holds a table of this kind, or a list of lists of flags.
                wrong += [put(scenario, place, other) for other in ({"no": [[True]]}, [[[True]]])]
            for changed in wrong:
                assert not validator.is_valid(changed), f"{path}: {place} can be wrong"
                refused += 1
    small = {"program": "race", "duration": "25ms", "robots": [{"model": "create", "start": [{"position": [0, 0]}]}]}
    assert validator.is_valid(small)
    assert not validator.is_valid({})
    for model, good, bad in [("create", "radius", "wheelbase"), ("car", "wheelbase", "axles")]:
        for name, is_valid in [(good, True), (bad, False)]:
            group = {"model": model, "model_parameters": {name: "0.2m"}}
            assert validator.is_valid({"robots": [group]}) == is_valid, group
    for table, name, good, bad in VALUES:
        for value, is_valid in [(value, True) for value in good] + [(value, False) for value in bad]:
            scenario = {**small, table: {name: value}}
            assert validator.is_valid(scenario) == is_valid, (table, name, value)
            assert takes(starl, scenario) == is_valid, (table, name, value)
    for place, field in fields(schema):
        assert "x-kind" in field and ("description" in field or "x-unit" in field), place
        if "default" in field:
            own = {"$defs": schema["$defs"], **field}
            Draft202012Validator(own).validate(field["default"])
            defaults += 1
    assert examples > 15 and defaults > 80, (examples, defaults)
    print(f"{examples} scenarios are valid, {refused} wrong ones are refused, {defaults} defaults are valid")


main()
