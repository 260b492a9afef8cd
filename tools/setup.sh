#!/usr/bin/env bash
# Installs what `make test` needs beyond a Rust toolchain, make and git: compilation targets, Python's test tools in a
# folder of their own, and Node.js to run WebAssembly. It skips what is installed, and prints what it installs.
#
# Usage: tools/setup.sh [compiler], where `compiler` installs only what Rust code is built with.
set -euo pipefail
cd "$(dirname "$0")/.."

need() { # need COMMAND PACKAGE...: the command, from Debian's packages if it is missing
    local command=$1
    shift
    if command -v "$command" >/dev/null; then
        return
    fi
    if ! command -v apt-get >/dev/null; then
        echo "setup: '$command' is missing; install it and run this again" >&2
        exit 1
    fi
    local sudo=""
    [ "$(id -u)" = 0 ] || sudo=sudo
    echo "setup: '$command' is missing; installing Debian packages with ${sudo:+sudo }apt-get: $*"
    $sudo apt-get update -q
    $sudo apt-get install -qy "$@"
}

need cc gcc
rustup target add wasm32-unknown-unknown thumbv7em-none-eabihf
rustup component add rustfmt clippy
[ "${1:-}" != compiler ] || exit 0

need python3 python3 python3-venv
need node nodejs

venv=target/venv
if ! cmp -s tools/requirements.txt "$venv/requirements.txt"; then
    python3 -c 'import ensurepip' 2>/dev/null || need python3-venv-is-missing python3-venv
    echo "setup: installing Python packages of tools/requirements.txt into $venv"
    rm -rf "$venv"
    python3 -m venv "$venv"
    "$venv/bin/pip" install --quiet --disable-pip-version-check -r tools/requirements.txt
    cp tools/requirements.txt "$venv/requirements.txt"
fi

# The page: its build tools, and the browser that tests it.
need npm npm
need chromium chromium
need wasm-opt binaryen
if ! node -e 'const [a, b] = process.versions.node.split("."); process.exit(a > 20 || (a == 20 && b >= 19) ? 0 : 1)'; then
    echo "setup: the page needs Node.js 20.19 or later; this is $(node --version)" >&2
    exit 1
fi
if ! cmp -s playground/package-lock.json playground/node_modules/package-lock.json; then
    echo "setup: installing npm packages of playground/package-lock.json into playground/node_modules"
    (cd playground && npm ci --no-audit --no-fund)
    cp playground/package-lock.json playground/node_modules/package-lock.json
fi
