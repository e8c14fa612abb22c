#!/usr/bin/env bash
# Sets up, builds and starts the live viewer of simulations.
#   view.sh [--no-setup] [NAME] [OPTION...]
# NAME and everything after it are passed to nearfield_viewer: map, gears, links, cars, wavy,
# overlap or pour.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if [[ ${1-} == --no-setup ]]; then
    shift
else
    step "Install what is missing" "$root/tools/scripts/setup.sh" view
fi
step "Configure" configure view
step "Build" build run --target nearfield_viewer
exec "$root/build/run/tools/viewer/nearfield_viewer" "$@"
