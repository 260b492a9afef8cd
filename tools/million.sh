#!/usr/bin/env bash
# Runs the workloads of tools/workloads.txt, and a tenth as often those of tools/loads.txt, with every profile of faults
# until there are a million runs, and sums them up. The summary of each block of seeds is kept as a file, so that it continues where it was stopped;
# what goes wrong is kept beside them, as scenarios and drawings.
#
# Usage: tools/million.sh STARL FOLDER [RUNS [SEEDS]]
#
# STARL is the command, RUNS how many there are to be in all (default 1000000), SEEDS how many each profile
# is tried with in a block (default 500). To start again, name another folder.
set -euo pipefail
starl=${1:?usage: tools/million.sh STARL FOLDER [RUNS [SEEDS]]}
folder=${2:?usage: tools/million.sh STARL FOLDER [RUNS [SEEDS]]}
runs=${3:-1000000}
seeds=${4:-500}
here=$(dirname "$0")
mkdir -p "$folder"

# Runs one workload with one block of so many seeds, unless that is done.
block() {
    local first=$1 seeds=$2 name=$3 scenario=$4 options=$5 status=0
    local block=$folder/seeds-$first-$seeds-$name.json
    [ ! -e "$block" ] || return 0
    # The options are words of a shell, some of them in quotes.
    eval "words=($options)"
    # shellcheck disable=SC2154 # words is set above
    "$starl" test "$here/../examples/primitives/$scenario.toml" "${words[@]}" --seeds "$seeds" \
        --first-seed "$first" --out "$folder" --json </dev/null >"$block.partial" || status=$?
    # 1 is a finding; more is a fault of the command or its input, and 130 someone's wish to stop.
    if [ "$status" -gt 1 ] || grep -q '"interrupted": true' "$block.partial"; then
        rm -f "$block.partial"
        echo "stopped with status $status; the same command goes on from here" >&2
        exit 2
    fi
    mv "$block.partial" "$block"
}

# Runs a block of every workload of a list.
blocks() {
    local name scenario options
    while read -r name scenario options; do
        case $name in "" | "#"*) continue ;; esac
        block "$1" "$2" "$name" "$scenario" "$options"
    done <"$3"
}

first=1
few=$((seeds / 10 > 0 ? seeds / 10 : 1))
while [ "$(python3 "$here/million.py" --runs "$folder")" -lt "$runs" ]; do
    blocks "$first" "$seeds" "$here/workloads.txt"
    blocks "$first" "$few" "$here/loads.txt"
    first=$((first + seeds))
done
python3 "$here/million.py" "$folder"
