# shellcheck shell=bash
# What the scripts of this folder share; sourced, never run.

# The top of the project, wherever the caller stands.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." >/dev/null && pwd)
readonly root

die() {
    printf '%s: %s\n' "$(basename "$0")" "$*" >&2
    exit 1
}

# step NAME COMMAND...: says what is being done, does it, and says how long it took. The command
# stands alone, not in an `if` or a `||`, so that the first failure inside it ends the script.
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

# wants_setup ARGUMENT...: whether the arguments leave the set-up in; refuses what it does not know.
wants_setup() {
    case "$*" in
        '') return 0 ;;
        --no-setup) return 1 ;;
        *) die "usage: $(basename "$0") [--no-setup]" ;;
    esac
}

# configure PRESET OPTION...: makes build/PRESET.
configure() {
    cmake -S "$root" --preset "$1" "${@:2}"
}

# build FOLDER OPTION...: brings build/FOLDER up to date.
build() {
    cmake --build "$root/build/$1" "${@:2}"
}

# Where test.sh leaves the counts of its last run.
readonly test_counts="$root/build/release/test_counts.txt"

# The counts of the last run of the tests, where there was one.
print_test_counts() {
    [[ ! -f $test_counts ]] || { printf '\n== The tests\n' && cat "$test_counts"; }
}
