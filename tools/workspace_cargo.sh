#!/usr/bin/env bash
# Cargo as maturin runs it to build the native module for the tests of the Python package. It builds the module within the
# whole workspace. Then the dependencies have the features with which `make unit` has built them, and are not built again:
# cargo unifies the features of the packages that one command builds.
#
# Usage: CARGO=tools/workspace_cargo.sh maturin build ...
#
# maturin names one package, `cargo rustc OPTION... --manifest-path PATH --lib -- OPTION...`. The options for rustc, which
# strip the module, are left out: only `cargo rustc` takes them.
set -euo pipefail
if [ "${1:-}" != rustc ]; then
    exec cargo "$@"
fi
shift
options=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do
    case $1 in
    --manifest-path) shift ;;
    *) options+=("$1") ;;
    esac
    shift
done
# With the examples come the features that dependencies for development ask for.
exec cargo build "${options[@]}" --workspace --features starl/zenoh --examples
