#!/usr/bin/env bash
# Runs `starl test` on every workload of tools/workloads.txt, to the end whatever goes wrong on the way.
#
# Usage: tools/workloads.sh STARL [OPTION...]
#
# STARL is the command, and OPTION any of `starl test`. The status is 1 if anything went wrong.
set -euo pipefail
starl=${1:?usage: tools/workloads.sh STARL [OPTION...]}
shift
here=$(dirname "$0")

worst=0
while read -r scenario setting; do
    case $scenario in "" | "#"*) continue ;; esac
    [ -z "$setting" ] || echo "$setting"
    status=0
    "$starl" test "$here/../examples/primitives/$scenario.toml" ${setting:+--set "$setting"} "$@" </dev/null || status=$?
    [ "$status" -le 1 ] || exit "$status"
    [ "$status" -eq 0 ] || worst=1
done <"$here/workloads.txt"
exit "$worst"
