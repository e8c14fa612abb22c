#!/usr/bin/env bash
# Removes what install.sh installed.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

rm -r -- "$place" "$PLACE"
