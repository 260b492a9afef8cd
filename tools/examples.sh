#!/usr/bin/env bash
# Every example reaches its goal and violates no property: with its own fleet and others, calm and over
# a bad network, for several seeds. One line a run; a run that fails is shown with the command line that
# repeats it.
#
# Usage: tools/examples.sh STARL [SEEDS]
#
# STARL is the command, SEEDS how many seeds each case is run with (default 5).
set -uo pipefail
starl=${1:?usage: tools/examples.sh STARL [SEEDS]}
seeds=${2:-5}

bad_network="--set network.loss=0.2 --set network.delay=100ms"
failed=0
runs=0

# fleets EXAMPLE: the fleets it is run with, one a line, as options; an empty line is its own.
fleets() {
    echo
    case $1 in
    race) printf -- '--robots %s\n' create=4 drone=4 create=6,drone=6 ;;
    formation) printf -- '--robots %s\n' create=2,drone=1 create=7 ;;
    esac
}

# try WORD...: runs an example and tells what came of it.
try() {
    local summary status
    summary=$("$starl" run "$@" 2>&1)
    status=$?
    runs=$((runs + 1))
    if [ $status = 0 ]; then
        echo "ok: run $*: $(head -n 1 <<<"$summary")"
        return
    fi
    failed=$((failed + 1))
    echo "FAILED with status $status; to repeat it:"
    echo "  $starl run $*"
    sed 's/^/    /' <<<"$summary"
}

examples=$("$starl" list --json |
    python3 -c 'import json, sys; print(*(e["name"] for e in json.load(sys.stdin)["examples"]), sep="\n")')
if [ -z "$examples" ]; then
    echo "$starl names no examples" >&2
    exit 1
fi
while read -r example; do
    while read -r fleet; do
        for network in "" "$bad_network"; do
            # So many cars that they wait longer than promised where agreement takes longer.
            [ "$example$network" = "intersection-stream$bad_network" ] && continue
            for seed in $(seq "$seeds"); do
                # The options hold no spaces but those between them.
                # shellcheck disable=SC2086
                try "$example" $fleet $network --seed "$seed"
            done
        done
    done < <(fleets "$example")
done <<<"$examples"

echo "$((runs - failed)) passed, $failed failed"
[ $failed = 0 ]
