# shellcheck shell=bash
# What the tests of this folder share; sourced, never run. ctest says by SOURCE, BUILD and CXX where
# the sources are, where they were built and by which compiler, and by PLACE which file names the
# folder that the package was installed below.
set -euo pipefail

fail() {
    printf '%s: %s\n' "$(basename "$0" .sh)" "$*" >&2
    exit 1
}

# names_nothing_of_the_project FOLDER: no file below it holds the path of the sources or of the
# build, so nothing made from it can reach either.
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
