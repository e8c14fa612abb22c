#!/usr/bin/env bash
# Takes away what install.sh made.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

rm -r -- "$place" "$PLACE"
