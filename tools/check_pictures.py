"""The pictures of the examples are what their commands draw.

Runs each `starl run ... --plot PICTURE.svg` of the examples' pages and compares. With --write the pictures are
written instead.

Usage: check_pictures.py PATH-OF-STARL [--write]
"""

import os
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
COMMAND = re.compile(r"^starl (run .*--plot (\S+\.svg))", re.MULTILINE)


def draw(starl, page, command, picture):
    """The picture that a command of a page draws."""
    with tempfile.TemporaryDirectory() as folder:
        arguments = [starl, *shlex.split(command), "--quiet"]
        done = subprocess.run(arguments, cwd=folder, capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{page}: `starl {command}` ends with {done.returncode}: {done.stdout}{done.stderr}")
        return (Path(folder) / picture).read_text()


def main():
    starl, write = Path(sys.argv[1]).resolve(), sys.argv[2:] == ["--write"]
    stale = []
    pages = sorted(ROOT.glob("examples/*/README.md"))
    commands = [(page, *found) for page in pages for found in COMMAND.findall(page.read_text())]
    assert len(commands) >= 12, commands
    # Runs share the cores, since each of them uses one.
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        pictures = list(pool.map(lambda command: draw(starl, *command), commands))
    for (page, _, picture), drawn in zip(commands, pictures):
        kept = page.parent / picture
        if write:
            kept.write_text(drawn)
        elif kept.read_text() != drawn:
            stale.append(kept.relative_to(ROOT))
    if stale:
        names = ", ".join(map(str, stale))
        sys.exit(f"not what their commands draw: {names}; tools/check_pictures.py STARL --write draws them")
    print(f"{len(commands)} pictures are what their commands draw")


main()
