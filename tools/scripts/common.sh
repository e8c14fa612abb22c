# shellcheck shell=bash
# Shared by the scripts of this folder; sourced, never run.

# The root of the project, whatever the current directory.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." >/dev/null && pwd)
readonly root

die() {
    printf '%s: %s\n' "$(basename "$0")" "$*" >&2
    exit 1
}

# step NAME COMMAND...: announces and runs the command, then reports how long it took. The command
# is not part of an `if` or a `||`, so that the first failure inside it ends the script.
step() {
    local start=$SECONDS
    current_step=$1
    printf '\n== %s\n' "$1"
    "${@:2}"
    printf -- '-- %s: %d s\n' "$1" "$((SECONDS - start))"
    current_step=
}

current_step=
trap '[[ -z $current_step ]] || printf "\n** FAILED: %s\n" "$current_step" >&2' EXIT

# wants_setup ARGUMENT...: whether the arguments ask for the set-up; rejects unknown ones with the
# script's usage, which is the first indented line of its head.
wants_setup() {
    case "$*" in
        '') return 0 ;;
        --no-setup) return 1 ;;
        *) die "usage: $(sed --quiet '/^#   /{s///p;q}' "$0")" ;;
    esac
}

# configure PRESET OPTION...: configures build/PRESET.
configure() {
    cmake -S "$root" --preset "$1" "${@:2}"
}

# build FOLDER OPTION...: brings build/FOLDER up to date.
build() {
    cmake --build "$root/build/$1" "${@:2}"
}

# Where test.sh stores the counts of its last run.
readonly test_counts="$root/build/release/test_counts.txt"

# Prints the counts of the last test run, if there was one.
print_test_counts() {
    [[ ! -f $test_counts ]] || { printf '\n== The tests\n' && cat "$test_counts"; }
}
