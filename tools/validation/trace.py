"""Runs scenarios and reads their traces. The reader is made from the specification of MCAP alone."""

import collections
import json
import struct
import subprocess
import tempfile
from pathlib import Path


def records(data):
    """The records of an uncompressed MCAP file, or of a chunk: opcode and content."""
    at = 0
    while at < len(data):
        opcode, length = struct.unpack_from("<BQ", data, at)
        yield opcode, data[at + 9 : at + 9 + length]
        at += 9 + length


def messages(path):
    """Topic, time in nanoseconds and content of each message that is a record of the run."""
    data, topics = Path(path).read_bytes()[8:-8], {}

    def within(data):
        for opcode, content in records(data):
            if opcode == 0x04:
                number, _, length = struct.unpack_from("<HHI", content)
                topics[number] = content[8 : 8 + length].decode()
            elif opcode == 0x05:
                number, _, time, _ = struct.unpack_from("<HIQQ", content)
                if topics[number].startswith("/starl/"):
                    yield topics[number], time, json.loads(content[22:])
            elif opcode == 0x06:
                length = struct.unpack_from("<I", content, 28)[0]
                assert length == 0, "chunks are not compressed"
                yield from within(content[40:])

    yield from within(data)


class Simulator:
    """Runs scenarios in a folder of its own."""

    def __init__(self, starl):
        self.starl = Path(starl).resolve()

    def run(self, scenario, **files):
        """The messages of a run by topic: lists of (nanoseconds, content)."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "scenario.toml").write_text(scenario)
            for program, text in files.items():
                (folder / f"{program}.starl").write_text(text)
            arguments = [self.starl, "run", "scenario.toml", "--quiet", "--trace", "trace.mcap"]
            done = subprocess.run(arguments, cwd=folder, capture_output=True, text=True)
            assert done.returncode in (0, 1), done.stderr
            found = collections.defaultdict(list)
            for topic, time, content in messages(folder / "trace.mcap"):
                found[topic.removeprefix("/starl/")].append((time, content))
            return found
