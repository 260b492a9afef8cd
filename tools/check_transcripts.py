"""Runs the commands that pages show after `$`, and compares what they print with what the page shows.

    python3 tools/check_transcripts.py STARL [PAGE]...

A page's commands run in a folder of their own, in order. Those of `starl` and Python are run; others, such as
`cargo`, are counted. In a page

- `<!-- $ COMMAND -->` is a command that readers do not see. If the next line begins a block without a `$`, that is
  what it prints.
- `<!-- not run: REASON -->` leaves out the next block, and `<!-- not run below: REASON -->` the rest of the page.
- A block that begins with a comment such as `# before.py FILE` is that file.
- `...` stands for anything on its line, or for any lines if it is a line. Times of computing are not compared.
"""

import difflib
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORK = ROOT / "target" / "transcripts"
PIECE = re.compile(
    r"^<!-- (?P<note>.*?) -->$|^```(?P<kind>\w*)\n(?P<text>.*?)^```$|^<!--.*?-->$", re.MULTILINE | re.DOTALL
)
# Times of computing differ from one machine to the next. Both sides lose them.
COMPUTING = [
    (re.compile(r"simulated in .*"), "simulated"),
    (re.compile(r"^[\d,]+ runs? in [\d.]+ s on .*\n?", re.MULTILINE), ""),
]


def steps(text):
    """The commands of a page with what they are to print, none if that does not matter, and its files."""
    hidden, skipped, end = None, False, 0
    for piece in PIECE.finditer(text):
        note, block = piece["note"], piece["text"]
        directly = text[end : piece.start()].strip() == ""
        if note and note.startswith("not run below:"):
            return
        if note and note.startswith("not run:"):
            skipped = True
        elif note and note.startswith("$ "):
            if hidden:
                yield hidden, None
            hidden = note[2:]
        elif block is not None:
            named = re.match(r"# (\w+\.py)\b", block)
            commands = re.split(r"^\$ ", block, flags=re.MULTILINE)
            shows = directly and len(commands) == 1 and piece["kind"] == "text"
            if hidden:
                yield hidden, block if shows and not skipped else None
            if named:
                yield None, (named[1], block)
            if not skipped:
                for command in commands[1:]:
                    line, _, printed = command.partition("\n")
                    yield line, printed
            hidden, skipped = None, False
        end = piece.end()
    if hidden:
        yield hidden, None


def comparable(text):
    for pattern, replacement in COMPUTING:
        text = pattern.sub(replacement, text)
    return [line.rstrip() for line in text.strip("\n").split("\n")]


def agree(shown, printed):
    """Whether lines are as shown."""
    if not shown:
        return not printed
    if shown[0] == "...":
        return any(agree(shown[1:], printed[start:]) for start in range(len(printed) + 1))
    if not printed:
        return False
    pattern = re.escape(shown[0]).replace(r"\.\.\.", ".*")
    return re.fullmatch(pattern, printed[0]) is not None and agree(shown[1:], printed[1:])


def check(page, starl):
    """The differences of a page, and how many of its commands were run and how many were not."""
    folder = WORK / re.sub(r"\W", "_", str(page.relative_to(ROOT)))
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "bin").mkdir(parents=True)
    (folder / "bin" / "starl").symlink_to(starl)
    (folder / "examples").symlink_to(ROOT / "examples")
    environment = {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}"}
    problems, run, left = [], 0, 0
    for command, shown in steps(page.read_text(encoding="utf-8")):
        if command is None:
            (folder / shown[0]).write_text(shown[1], encoding="utf-8")
            continue
        command = re.sub(r"^(venv/bin/)?python ", f"{sys.executable} ", command)
        if not command.startswith(("starl ", sys.executable, "sed ")):
            left += 1
            continue
        done = subprocess.run(
            command,
            shell=True,
            cwd=folder,
            env=environment,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        run += 1
        if shown is None:
            continue
        shown, printed = comparable(shown), comparable(done.stdout)
        if not agree(shown, printed):
            difference = "\n".join(difflib.unified_diff(shown, printed, "shown", "printed", lineterm=""))
            problems.append(f"{page.relative_to(ROOT)}: {command}\n{difference}")
    return problems, run, left


def main():
    starl = pathlib.Path(sys.argv[1]).resolve()
    tracked = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, capture_output=True, text=True, check=True)
    named = sys.argv[2:] or tracked.stdout.splitlines()
    problems, run, left = [], 0, 0
    for name in named:
        page = (ROOT / name).resolve()
        if re.search(r"^\$ |^<!-- \$ ", page.read_text(encoding="utf-8"), re.MULTILINE):
            wrong, done, others = check(page, starl)
            problems += wrong
            run, left = run + done, left + others
    if problems:
        sys.exit("\n\n".join(problems))
    print(f"{run} commands print what their pages show; {left} of other programs were not run")


main()
