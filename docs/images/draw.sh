#!/bin/sh
# Draws the pictures of the documentation anew: sh docs/images/draw.sh RESULTS, with the results folder of studies/beam-with-stop.toml.
# HAMMERBEAM names the command, if it is not the one of this checkout.
set -eu
results=${1:?usage: sh docs/images/draw.sh RESULTS}
here=$(dirname "$0")
drawn=$(mktemp -d)
trap 'rm -rf "$drawn"' EXIT
${HAMMERBEAM:-cargo run --release --quiet --} figure "$results" --kind structure,response,orbits --resolution 150 --out "$drawn" > "$drawn/files.txt"
for name in structure modes excitation response_displacement response_acceleration orbit_32.34Hz_period1-history orbit_53Hz_period2-phase orbit_67.8Hz_period2-spectrum; do
    cp "$drawn/$name.png" "$here/$name.png"
done
