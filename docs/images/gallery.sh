#!/bin/sh
# Draws the pictures of docs/reference/gallery.md anew, in about a minute: sh docs/images/gallery.sh
# HAMMERBEAM names the command, if it is not the one of this checkout. To be started in the root of the checkout.
set -eu
here=docs/images/gallery
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT
hammerbeam() { ${HAMMERBEAM:-cargo run --release --quiet --} "$@" > "$results/printed.txt"; }
# The results folder and the figures to keep; in `detail` the part that is drawn again, larger.
detail=
keep() {
    from=$1
    shift
    hammerbeam figure "$results/$from" --format png --resolution 150 ${detail:+--detail "$detail"}
    for name in "$@"; do cp "$results/$from/$name.png" "$here/$from-$name.png"; done
}

# Beside the demo cusp of AUTO-07p.
hammerbeam run studies/duffing-in-two-parameters.toml --out "$results/duffing"
keep duffing vary_1_excitation_amplitude_n_displacement curves_excitation_amplitude_n

# Beside the demo impact of COCO: the same oscillator, c = 0.1, 1 rad/s.
hammerbeam run studies/impact-oscillator.toml --out "$results/impact" \
    --set structure.damper.1.damping_n_s_m=0.1 --set 'excitation.frequency_hz=[0.05, 0.24]' \
    --set 'vary=[{ parameter = "excitation.amplitude_n", range = [0.05, 1.05], frequency_hz = 0.15915494309 }]' \
    --set 'curve=[{ of = "grazing", near_hz = 0.13, parameter = "excitation.amplitude_n", range = [0.05, 1.0] }]'
detail=excitation.amplitude_n=0.0999:0.10005
keep impact vary_1_excitation_amplitude_n_displacement curves_excitation_amplitude_n
detail=

# Beside the period doubling of BifurcationKit.
two_wells() {
    hammerbeam "$1" studies/two-wells.toml --out "$results/two-wells" --set response.period_doubling_depth=3 \
        --set 'excitation.frequency_hz=[0.20, 0.26]' --set continuation.max_step_hz=0.0005 --set search.frequencies=2 \
        $2
}
two_wells run ""
two_wells sweep "--from 0.2 --to 0.235 --step 0.0005 --down --initial mass.y=1"
keep two-wells response_acceleration
