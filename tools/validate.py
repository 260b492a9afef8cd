"""Validates the simulator from its traces alone: makes the figures and plots of docs/reference/validation.md.

No code is shared with the project: traces are read by the specification of MCAP, and what should be is computed here.

Usage: validate.py PATH-OF-STARL
"""

import re
import sys
from pathlib import Path

from validation import motion, network, wind
from validation.trace import Simulator

PAGE = Path(__file__).resolve().parent.parent / "docs/reference/validation.md"


def main():
    simulator, folder = Simulator(sys.argv[1]), PAGE.with_suffix("")
    folder.mkdir(exist_ok=True)
    for name, part in [("motion", motion), ("wind", wind), ("network", network)]:
        figures = part.validate(simulator, folder)
        marks = re.compile(rf"(<!-- {name}: tools/validate.py -->\n).*?(<!-- end -->)", re.DOTALL)
        text, count = marks.subn(lambda found: f"{found[1]}\n{figures}\n{found[2]}", PAGE.read_text())
        assert count == 1, f"{PAGE} has no place for {name}"
        PAGE.write_text(text)
        print(f"{name}\n\n{figures}\n", flush=True)


main()
