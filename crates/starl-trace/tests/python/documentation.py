"""Runs the Python program of docs/reference/trace.md on a trace.

    python documentation.py FILE.mcap
"""

import pathlib
import re
import sys

PAGE = pathlib.Path(__file__).resolve().parents[4] / "docs" / "reference" / "trace.md"

programs = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.M | re.S)
if not programs:
    sys.exit(f"{PAGE} has no Python program")
for program in programs:
    exec(compile(program, str(PAGE), "exec"), {"__name__": "documentation"})
