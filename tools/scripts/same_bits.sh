#!/usr/bin/env bash
# Compares the hashes of the answers of technique cpu with the committed ones, for other compilers,
# other optimisation and another processor. Builds the library and the hashes alone, for each.
#   same_bits.sh [--quick] [NAME...]     default all: gcc-O1 gcc-O3 clang-O1 clang-O3 aarch64-O2
# Needs what setup.sh bits installs. Highway for aarch64 is downloaded by apt and not installed; the
# emulated program takes the quick sections alone.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

jobs=${JOBS:-$(nproc)}
committed="$root/tests/data/hashes.txt"

# Highway for arm64, from Debian, unpacked beside the build and not installed.
unpack_highway() {
    local folder=$1 options
    [[ ! -e $folder/root/usr ]] || return 0
    mkdir -p "$folder"/{lists/partial,archives/partial,root}
    : >"$folder/status"
    options=(-o APT::Architecture=arm64 -o APT::Architectures=arm64
        -o Dir::State::lists="$folder/lists" -o Dir::State::status="$folder/status"
        -o Dir::Cache="$folder" -o APT::Sandbox::User=root)
    apt-get "${options[@]}" -qq update
    (cd "$folder" && apt-get "${options[@]}" -qq download libhwy1 libhwy-dev)
    for package in "$folder"/*.deb; do
        dpkg-deb --extract "$package" "$folder/root"
    done
}

# hash_program NAME: builds the library and the program for a name of the list above.
hash_program() {
    local name=$1 folder="$root/build/same_bits/$1" flags="-${1##*-} -DNDEBUG" compiler
    local options=() libraries=(-lhwy)
    case "$name" in
        gcc-*) compiler=g++ ;;
        clang-*) compiler=clang++ ;;
        aarch64-*)
            compiler=aarch64-linux-gnu-g++
            unpack_highway "$root/build/same_bits/highway"
            local arm="$root/build/same_bits/highway/root/usr"
            options=(-DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64
                -Dhwy_DIR="$arm/lib/aarch64-linux-gnu/cmake/hwy")
            libraries=("-L$arm/lib/aarch64-linux-gnu" -lhwy)
            ;;
        *) die "usage: same_bits.sh [--quick] [gcc-O1|gcc-O3|clang-O1|clang-O3|aarch64-O2...]" ;;
    esac
    cmake -S "$root" -B "$folder" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" \
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="$flags" -DCMAKE_UNITY_BUILD=ON \
        -DNEARFIELD_BUILD_TOOLS=OFF -DNEARFIELD_BUILD_TESTS=OFF -DNEARFIELD_INSTALL=OFF \
        "${options[@]}" >/dev/null
    cmake --build "$folder" --parallel "$jobs" --target nearfield_static >"$folder/build.log" || {
        cat "$folder/build.log" >&2  # the compiler's errors stand there
        die "$name does not build"
    }
    mkdir -p "$folder/generated/embedded" "$folder/objects"
    for file in "$root"/tests/data/*.geojson; do
        local stem
        stem=$(basename "$file" .geojson)
        cmake -DINPUT="$file" -DOUTPUT="$folder/generated/embedded/$stem.hpp" -DSYMBOL="$stem" \
            -P "$root/cmake/embed_text.cmake"
    done
    # As nearfield_same_bits in cmake/modules.cmake.
    local same=(-ffp-contract=off)
    if [[ $name != clang-* ]] && (($("$compiler" -dumpversion) < 13)); then
        same+=(-fno-tree-slp-vectorize)
    fi
    find "$root"/tools/{hash,simulation} "$root"/tools/benchmark/workloads.cpp \
        "$root"/tools/common/library.cpp "$root"/tools/io/{json_document,simple_features,text_file,values}.cpp \
        -name '*.cpp' ! -name simulation_choice.cpp -print0 |
        xargs -0 -P "$jobs" -I FILE \
            sh -c 'file=$1 && shift && "$@" -o "$0/$(basename "$file" .cpp).o" -c "$file"' \
            "$folder/objects" FILE "$compiler" -std=c++20 $flags "${same[@]}" -I"$root" \
            -I"$root/include" -I"$folder/generated"
    "$compiler" -o "$folder/hashes" "$folder"/objects/*.o "$folder/libnearfield.a" \
        "${libraries[@]}" -ldl -lpthread
}

# Prints the hashes by the program of a name.
print_hashes() {
    local folder="$root/build/same_bits/$1"
    if [[ $1 == aarch64-* ]]; then
        qemu-aarch64 -L /usr/aarch64-linux-gnu \
            -E LD_LIBRARY_PATH="$root/build/same_bits/highway/root/usr/lib/aarch64-linux-gnu" \
            "$folder/hashes" --quick
    else
        "$folder/hashes" "${options_of_program[@]}"
    fi
}

options_of_program=()
if [[ ${1:-} == --quick ]]; then
    options_of_program=(--quick)
    shift
fi
names=("$@")
((${#names[@]} > 0)) || names=(gcc-O1 gcc-O3 clang-O1 clang-O3 aarch64-O2)
different=0
for name in "${names[@]}"; do
    hash_program "$name"
    while read -r section hash; do
        if grep -q "^$section  *$hash\$" "$committed"; then
            echo "$name: $section $hash"
        else
            echo "$name: $section $hash is not the committed one"
            different=1
        fi
    done < <(print_hashes "$name")
done
exit "$different"
