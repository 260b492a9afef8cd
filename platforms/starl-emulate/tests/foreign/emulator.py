"""The emulated devices as a process: the example `devices` of starl-emulate."""

import json
import subprocess
import tempfile


class Emulator:
    """Started by `with`; `where` says where the devices are."""

    def __init__(self, program):
        self.program = program

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        pipe = subprocess.PIPE
        self.process = subprocess.Popen([self.program, self.folder.name], stdin=pipe, stdout=pipe, text=True)
        self.where = json.loads(self.process.stdout.readline())
        return self

    def __exit__(self, *error):
        self.process.stdin.close()
        self.process.wait(timeout=5)
        self.folder.cleanup()

    def pose(self, name):
        """The true pose of a body: x, y, z, yaw."""
        return self.ask()[name]

    def ask(self):
        """The true poses of all bodies by their names, and the time of the devices in seconds."""
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())
