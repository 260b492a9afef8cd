"""Sums up the blocks of runs that tools/million.sh has kept in a folder.

    python3 tools/million.py FOLDER           a table, and exit status 1 if anything went wrong
    python3 tools/million.py --runs FOLDER    how many runs there are
"""

import collections
import json
import pathlib
import sys

KEYS = ["runs", "reached", "timed_out", "violated", "failed", "wrong"]

folder = pathlib.Path(sys.argv[-1])
# Called seeds-FIRST-COUNT-WORKLOAD.json.
blocks = [
    (path.stem.split("-", 3)[3], json.loads(path.read_text(encoding="utf-8")))
    for path in sorted(folder.glob("seeds-*.json"))
]
runs = sum(block["runs"] for _, block in blocks)
if "--runs" in sys.argv:
    print(runs)
    sys.exit()

rows = collections.defaultdict(collections.Counter)
for name, block in blocks:
    for target in block["targets"]:
        for row in target["profiles"]:
            rows[name, row["profile"]].update({key: row[key] for key in KEYS})
print(f"{'workload':24} {'profile':11}" + "".join(f"{key:>11}" for key in KEYS))
for (name, profile), counts in rows.items():
    print(f"{name:24} {profile:11}" + "".join(f"{counts[key]:>11,}" for key in KEYS))

wall = sum(block["wall_seconds"] for _, block in blocks)
processors = sum(block["processor_seconds"] for _, block in blocks)
print(f"{runs:,} runs in {wall / 3600:.2f} h, {runs / max(processors, 1e-9):,.0f} a second of a core")
findings = collections.Counter()
for name, block in blocks:
    for finding in block["findings"]:
        findings[name, finding["property"]] += finding["times"]
for (name, what), times in findings.items():
    print(f"WRONG: {name}: {what}, {times:,} times")
sys.exit(bool(findings))
