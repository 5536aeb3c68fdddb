#!/bin/sh
# Draws the diagram of the README anew: sh docs/images/draw.sh RESULTS, with the results folder of studies/beam-with-stop.toml.
# HAMMERBEAM names the command, if it is not the one of this checkout.
set -eu
results=${1:?usage: sh docs/images/draw.sh RESULTS}
here=$(dirname "$0")
drawn=$(mktemp -d)
trap 'rm -rf "$drawn"' EXIT
${HAMMERBEAM:-cargo run --release --quiet --} figure "$results" --kind response --resolution 150 --out "$drawn" > "$drawn/files.txt"
cp "$drawn/response_displacement.png" "$here/"
