"""Reads a trace with the `mcap` package and checks all that docs/reference/trace.md promises.

    python read_trace.py FILE.mcap...

Nothing of StarL's own code takes part. Needs the packages `mcap` and `jsonschema`. Exits with
status 1 and one line for each fault found.
"""

import base64
import json
import sys
from collections import Counter

from jsonschema import Draft202012Validator
from mcap.reader import make_reader

RECORDS = {
    "pose": "Pose",
    "estimate": "Pose",
    "sent": "Sent",
    "delivered": "Delivered",
    "dropped": "Dropped",
    "collision": "Collision",
    "action": "Action",
    "program": "Program",
    "primitive": "Primitive",
    "log": "Log",
    "mark": "Mark",
    "fault": "Fault",
    "discovered": "Discovered",
    "status": "Status",
    "violation": "Violation",
    "thing": "Thing",
    "intervention": "Intervention",
    "summary": "Summary",
}
VIEWS = {
    "foxglove.FrameTransforms",
    "foxglove.Log",
    "foxglove.PoseInFrame",
    "foxglove.SceneUpdate",
}


def unreadable_in_foxglove(schema, where):
    """What Foxglove's reader of JSON Schema, which knows only a part of it, would refuse."""
    if schema.get("type") != "object" or "properties" not in schema:
        yield f"{where}: no object with properties"
        return
    for name, member in schema["properties"].items():
        here = f"{where}.{name}"
        if "oneOf" in member:
            if not all(isinstance(choice.get("const"), int) for choice in member["oneOf"]):
                yield f"{here}: a choice that is not of numbers"
            continue
        kind = member.get("type")
        if kind == "array":
            member = member["items"]
            kind = member.get("type")
        if kind == "object":
            yield from unreadable_in_foxglove(member, here)
        elif kind not in ("boolean", "string", "number", "integer"):
            yield f"{here}: type {kind}"


def check(path):
    """Yields the faults of one file."""
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        metadata = {record.name: record.metadata for record in reader.iter_metadata()}
        if "starl" not in metadata:
            yield "no metadata record `starl`"
            return
        if metadata["starl"].get("format_version") != "1":
            yield "format_version is not 1"
        int(metadata["starl"]["seed"])
        attachments = {attachment.name: attachment.data for attachment in reader.iter_attachments()}
        if not attachments.get("starl/scenario.toml"):
            yield "no scenario"
        world = json.loads(attachments["starl/world.json"])
        robots = {robot["id"]: robot for robot in world["robots"]}

        channels = reader.get_summary().channels.values()
        schemas = reader.get_summary().schemas
        validators = {}
        for schema in schemas.values():
            text = json.loads(schema.data)
            Draft202012Validator.check_schema(text)
            yield from unreadable_in_foxglove(text, schema.name)
            validators[schema.id] = Draft202012Validator(text)
        for channel in channels:
            name = schemas[channel.schema_id].name
            if channel.topic.startswith("/starl/"):
                kind = channel.topic.removeprefix("/starl/")
                if name != "starl." + RECORDS.get(kind, "?"):
                    yield f"{channel.topic} has the schema {name}"
            elif name not in VIEWS:
                yield f"{channel.topic} has the schema {name}, which no viewer knows"

        counts = Counter()
        sent = set()
        previous = None
        summary = None
        for schema, channel, message in reader.iter_messages():
            where = f"{channel.topic} at {message.log_time} ns"
            content = json.loads(message.data)
            for error in validators[schema.id].iter_errors(content):
                yield f"{where}: {error.json_path}: {error.message}"
            if not channel.topic.startswith("/starl/"):
                continue
            if previous is not None and (message.log_time, message.sequence) <= previous:
                yield f"{where}: out of order"
            previous = (message.log_time, message.sequence)
            if summary is not None:
                yield f"{where}: comes after the summary"
            kind = channel.topic.removeprefix("/starl/")
            if kind == "summary":
                summary = content
                continue
            counts[kind] += 1
            if "robot" in content and content["robot"] not in robots:
                yield f"{where}: robot {content['robot']} is not in the fleet"
            if kind == "intervention":
                json.loads(content["intervention"])
            if kind == "sent":
                base64.b64decode(content["payload"], validate=True)
                sent.add((content["robot"], content["sequence"]))
            if kind == "delivered" and (content["from"], content["sequence"]) not in sent:
                yield f"{where}: delivered but never sent"
        if summary is None:
            yield "no summary"
            return
        if summary["records"] != counts.total():
            yield f"the summary counts {summary['records']} records, the file has {counts.total()}"
        if {count["topic"]: count["records"] for count in summary["counts"]} != dict(counts):
            yield f"the summary's counts {summary['counts']} are not {dict(counts)}"
        print(f"{path}: {counts.total()} records, outcome {summary['outcome']}: {dict(counts)}")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    faults = [f"{path}: {fault}" for path in sys.argv[1:] for fault in check(path)]
    for fault in faults[:20]:
        print(fault, file=sys.stderr)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
