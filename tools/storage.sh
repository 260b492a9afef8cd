#!/usr/bin/env bash
# With storage that outlasts a crash, whatever needs only a majority reaches its goal.
#
# Usage: tools/storage.sh STARL [OPTION...]
#
# STARL is the command, and OPTION any of `starl test`. Mutexes by permission and by quorums are left out: who waits for
# a robot that holds a lock and never comes back waits for ever.
set -euo pipefail
starl=${1:?usage: tools/storage.sh STARL [OPTION...]}
shift
primitives=$(dirname "$0")/../examples/primitives

try() {
    "$starl" test --demand-goal --set storage.kept=true --profile crashes,chaos "$@" </dev/null
}

try "$primitives/register.toml" "$@"
try "$primitives/election.toml" --set parameters.algorithm=leases "$@"
try "$primitives/mutex.toml" --set parameters.algorithm=lease "$@"
try "$primitives/memory.toml" "$@"
# All crash again and again, also all at once; what they have stored and what programs call stable stays.
storms() {
    "$starl" test --demand-goal --set storage.kept=true --set fault_rates.crash=0.1/s --set fault_rates.restart_after=1s \
        --profile calm,lossy "$@" </dev/null
}

storms "$primitives/register.toml" "$@"
storms "$primitives/mutex.toml" --set parameters.algorithm=lease "$@"
storms "$primitives/election.toml" --set parameters.algorithm=leases "$@"
