#!/usr/bin/env bash
# Sets up, builds, and runs all tests.
#   test.sh [--no-setup]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

report="$root/build/release/ctest.xml"

# The count in ctest's report with the given name.
reported() {
    sed -n "s/^\t$1=\"\([0-9]*\)\".*/\1/p" "$report" | head -n 1
}

# Prints ctest's counts in the form that test runners use.
print_counts() {
    local failed skipped
    failed=$(reported failures)
    skipped=$(($(reported skipped) + $(reported disabled)))
    ((skipped == 0)) || printf '%d skipped\n' "$skipped"
    printf '%d passed, %d failed\n' "$(($(reported tests) - failed - skipped))" "$failed"
}

run_tests() {
    local status=0
    rm -f "$report" "$test_counts"
    ctest --test-dir "$root/build/release" --parallel "$(nproc)" --output-on-failure \
        --no-tests=error --output-junit "$report" || status=$?
    [[ ! -f $report ]] || print_counts >"$test_counts"
    ((status == 0)) || print_test_counts
    return "$status"
}

if wants_setup "$@"; then
    step "Install what is missing" "$root/tools/scripts/setup.sh" test
fi
step "Configure" configure release
step "Build" build release
step "Tests" run_tests
print_test_counts
