#!/usr/bin/env bash
# Sets up, builds the command line and draws how deep Iceland's coast lies inside Ireland.
#   run.sh [--no-setup]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

query_penetration() {
    mkdir -p "$root/out"
    "$root/build/run/tools/nearfield" query penetration \
        "$root/tests/data/iceland_10m.geojson" "$root/tests/data/ireland_10m.geojson" \
        -d 0.8 --pose-b 120,20,30 --image "$root/out/penetration.png"
}

if wants_setup "$@"; then
    step "Install what is missing" "$root/tools/scripts/setup.sh" run
fi
step "Configure" configure run
step "Build" build run --target nearfield_program
step "Penetration of two coast lines" query_penetration
printf '\nThe picture: %s\nThe program: %s --help\n' \
    "$root/out/penetration.png" "$root/build/run/tools/nearfield"
