#!/usr/bin/env bash
# Runs the workloads of tools/workloads.txt with every profile of faults until there are a million runs, and sums
# them up. The summary of each block of seeds is kept as a file, so that it goes on where it was stopped;
# what goes wrong is kept beside them, as scenarios and drawings.
#
# Usage: tools/million.sh STARL FOLDER [RUNS [SEEDS]]
#
# STARL is the command, RUNS how many there are to be in all (default 1000000), SEEDS how many each profile
# is tried with in a block (default 500). To begin afresh, name another folder.
set -euo pipefail
starl=${1:?usage: tools/million.sh STARL FOLDER [RUNS [SEEDS]]}
folder=${2:?usage: tools/million.sh STARL FOLDER [RUNS [SEEDS]]}
runs=${3:-1000000}
seeds=${4:-500}
here=$(dirname "$0")
mkdir -p "$folder"

# Runs one workload with one block of seeds, unless that is done.
block() {
    local scenario=$1 setting=$2 status=0
    local name=$scenario${setting:+-${setting##*=}}
    local block=$folder/seeds-$first-$seeds-$name.json
    [ ! -e "$block" ] || return 0
    "$starl" test "$here/../examples/primitives/$scenario.toml" ${setting:+--set "$setting"} --seeds "$seeds" \
        --first-seed "$first" --out "$folder" --json </dev/null >"$block.partial" || status=$?
    # 1 is a finding; more is a fault of the command or its input, and 130 someone's wish to stop.
    if [ "$status" -gt 1 ] || grep -q '"interrupted": true' "$block.partial"; then
        rm -f "$block.partial"
        echo "stopped with status $status; the same command goes on from here" >&2
        exit 2
    fi
    mv "$block.partial" "$block"
}

first=1
while [ "$(python3 "$here/million.py" --runs "$folder")" -lt "$runs" ]; do
    while read -r scenario setting; do
        case $scenario in "" | "#"*) continue ;; esac
        block "$scenario" "$setting"
    done <"$here/workloads.txt"
    first=$((first + seeds))
done
python3 "$here/million.py" "$folder"
