#!/usr/bin/env python3
"""Count the lines of code of programs in the StarL language and print them as a table.

    tools/program_lengths.py [FILE ...]

Without files: all programs and libraries under examples/. A line of code is a line that is left after removing

- blank lines and comments;
- parameters (`param`), which the scenario sets;
- properties (`invariant`, `always`, `eventually`), with the lines that they go on in.

Functions count, also those that only a property uses. The last column adds the libraries of the same folder that a
program imports.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LEFT_OUT = re.compile(r"param |(invariant|always|eventually)\b(?!\s*=)")


def lines_of_code(path):
    """How many lines of a file count."""
    count, counts = 0, True
    for line in path.read_text().splitlines():
        code = re.sub(r"//.*", "", line).rstrip()
        if not code:
            continue
        # An indented line belongs to the declaration above it.
        if code[0] != " ":
            counts = not LEFT_OUT.match(code)
        count += counts
    return count


def with_libraries(program):
    """A file and the libraries beside it that it imports, directly or through others."""
    seen, left = set(), [program]
    while left:
        path = left.pop()
        seen.add(path)
        for name in re.findall(r"^import (\w+)", path.read_text(), re.MULTILINE):
            library = program.parent / f"{name}.starl"
            if library.exists() and library not in seen:
                left.append(library)
    return seen


def main():
    paths = [Path(name).resolve() for name in sys.argv[1:]] or sorted(ROOT.glob("examples/**/*.starl"))
    print("| program | lines of code | with libraries |")
    print("| --- | ---: | ---: |")
    for path in paths:
        name = path.relative_to(ROOT) if path.is_relative_to(ROOT) else path
        total = sum(map(lines_of_code, with_libraries(path)))
        print(f"| `{name}` | {lines_of_code(path)} | {total} |")


if __name__ == "__main__":
    main()
