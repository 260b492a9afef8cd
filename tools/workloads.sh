#!/usr/bin/env bash
# Runs `starl test` on every workload of a list, to the end whatever goes wrong on the way.
#
# Usage: tools/workloads.sh STARL LIST [OPTION...]
#
# STARL is the command, LIST tools/workloads.txt, tools/loads.txt or tools/storage.txt, and OPTION any of `starl test`. The
# status is 1 if anything went wrong.
set -euo pipefail
starl=${1:?usage: tools/workloads.sh STARL LIST [OPTION...]}
list=${2:?usage: tools/workloads.sh STARL LIST [OPTION...]}
shift 2
here=$(dirname "$0")

worst=0
while read -r name scenario options; do
    case $name in "" | "#"*) continue ;; esac
    echo "$name"
    status=0
    # The options are words of a shell, some of them in quotes.
    eval "words=($options)"
    # shellcheck disable=SC2154 # words is set above
    "$starl" test "$here/../examples/primitives/$scenario.toml" "${words[@]}" "$@" </dev/null || status=$?
    [ "$status" -le 1 ] || exit "$status"
    [ "$status" -eq 0 ] || worst=1
done <"$list"
exit "$worst"
