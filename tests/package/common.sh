# shellcheck shell=bash
# Shared by the tests of this folder; sourced, never run. ctest sets SOURCE, BUILD and CXX to the
# sources, the build folder and the compiler, and PLACE to the file that names the folder that the
# package was installed below.
set -euo pipefail

fail() {
    printf '%s: %s\n' "$(basename "$0" .sh)" "$*" >&2
    exit 1
}

# names_nothing_of_the_project FOLDER: no file below it contains the path of the sources or of the
# build, so nothing built from it can refer to either.
names_nothing_of_the_project() {
    local files
    files=$(grep --recursive --files-with-matches --fixed-strings -e "$SOURCE" -e "$BUILD" "$1" || true)
    [[ -z $files ]] || fail "these name a folder of the project: $files"
}

# needs_shared PROGRAM yes|no: whether the program was linked with the shared library.
needs_shared() {
    local found=no
    ! readelf --dynamic "$1" | grep --quiet 'NEEDED.*libnearfield\.so\.' || found=yes
    [[ $found == "$2" ]] || fail "$1: linked with the shared library: $found; expected: $2"
}

if [[ -f $PLACE ]]; then
    place=$(<"$PLACE")
    prefix="$place/the prefix"
fi
