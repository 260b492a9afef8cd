#!/bin/sh
# The drawings of `starl explain` are what they are meant to be: Mermaid's own parser reads each step of
# them, and Graphviz draws them. Takes the command's path; needs Node.js with npm, and Graphviz's `dot`.
set -eu
starl=$(realpath "$1")
cd "$(dirname "$0")/.."
folder=target/diagrams
mkdir -p $folder
cp tools/diagrams/package.json tools/diagrams/parse.mjs $folder
# Earlier drawings are not needed.
rm -f $folder/*.mmd $folder/*.svg
npm install --prefix $folder --silent --no-audit --no-fund

for program in examples/*/*.starl crates/starl-lang/tests/listings/*.starl crates/starl-editor/tests/drawings/*.starl; do
    name=$(echo "${program%.starl}" | tr / -)
    # A library, or a program without states, has nothing to draw.
    "$starl" explain "$program" --output "$folder/$name.mmd" 2>/dev/null || continue
    "$starl" explain "$program" --format dot | dot -Tsvg >"$folder/$name.svg"
done
node $folder/parse.mjs $folder/*.mmd
