#!/usr/bin/env bash
# A host includes the sources in its own build through FetchContent and gets only the library. Only
# the host's own file is compiled here; ninja's commands show what else would be.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

work="$place/subproject"
mkdir "$work"
cp -r "$SOURCE/tests/package/consumer" "$work/host"
cmake -S "$work/host/subproject" -B "$work/build" -G Ninja "-DCMAKE_CXX_COMPILER=$CXX" \
    "-DNEARFIELD_SOURCE=$SOURCE" -DCMAKE_CXX_FLAGS=-Werror
cd "$work/build"
ninja -t targets all | sed -n 's/^\(.*main\.cpp\.o\): .*/\1/p' | xargs --delimiter='\n' ninja

commands=$(ninja -t commands all)
grep --quiet 'libnearfield\.a' <<<"$commands" || fail "the library would not be built"
! grep --extended-regexp "$SOURCE/(tests|tools)|libnearfield\.so" <<<"$commands" ||
    fail "more than the library would be built"
rules=$(cmake --install . --prefix "$work/installed" 2>&1 || true)
[[ ! -e $work/installed ]] || fail "nearfield would be installed with the host: $rules"
