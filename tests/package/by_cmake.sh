#!/usr/bin/env bash
# Hosts find the installed package through CMake, static and shared, and run.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

work="$place/by cmake"
mkdir "$work"
cp -r "$SOURCE/tests/package/consumer" "$work/host"
version=$(PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name nearfield.pc)") pkg-config --modversion nearfield)
cmake -S "$work/host" -B "$work/build" -G Ninja "-DCMAKE_CXX_COMPILER=$CXX" -DCMAKE_BUILD_TYPE=Debug \
    "-DCMAKE_PREFIX_PATH=$prefix" "-DEXPECTED_VERSION=$version" "-DGLSLANG=$GLSLANG"
cmake --build "$work/build"
names_nothing_of_the_project "$work"

for linkage in static shared; do
    printf '%s: ' "$linkage"
    "$work/build/$linkage/host"
done
needs_shared "$work/build/static/host" no
needs_shared "$work/build/shared/host" yes
