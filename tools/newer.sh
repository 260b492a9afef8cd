#!/usr/bin/env bash
# Whether something changed since a file was made: true if the file is not there, or if a file or folder among the paths,
# or below them, is newer.
#
# Usage: tools/newer.sh FILE PATH...
set -euo pipefail
made=$1
shift
[ ! -e "$made" ] || [ -n "$(find "$@" -newer "$made" -print -quit)" ]
