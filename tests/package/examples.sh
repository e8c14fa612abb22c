#!/usr/bin/env bash
# The examples that are independent projects, built with only the installed package and run: the
# first with both libraries, the others with the static one.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# build_and_run EXAMPLE PATTERN SHARED...: for each SHARED (ON or OFF); the output must match.
build_and_run() {
    local work shared output
    for shared in "${@:3}"; do
        work="$place/example $1 $shared"
        mkdir "$work"
        cp -r "$SOURCE/examples/$1" "$work/source"
        cmake -S "$work/source" -B "$work/build" -G Ninja "-DCMAKE_CXX_COMPILER=$CXX" \
            -DCMAKE_CXX_FLAGS='-Wall -Wextra -Wno-missing-field-initializers -Werror' -DBUILD_SHARED_LIBS=$shared \
            "-DCMAKE_PREFIX_PATH=$prefix" >/dev/null
        cmake --build "$work/build"
        names_nothing_of_the_project "$work"
        needs_shared "$work/build/$1" "$([[ $shared == ON ]] && echo yes || echo no)"
        output=$("$work/build/$1")
        printf '%s\n' "$output"
        [[ $output =~ $2 ]] || fail "$1 says something else"
    done
}

build_and_run hello '^\(8\.5, 0\.5\) is 0\.5 deep; out along \(-1, 0\)$' ON OFF
build_and_run host '[0-9]+ points inside, the deepest by (1|0\.9)' OFF
build_and_run vulkan_hpp 'frame 5: [1-9][0-9]* contacts, [1-9][0-9]* inside.device and CPU agree$' OFF
# It is the README's program, includes no header of Vulkan's, and opens no Vulkan loader.
[[ $(sed -n '/^```cpp$/,/^```$/p' "$SOURCE/README.md" | sed '1d; /^```$/,$d') == \
    "$(<"$SOURCE/examples/hello/main.cpp")" ]] || fail "the README has another program than hello"
! "$CXX" -std=c++20 -M "-I$prefix/include" "$SOURCE/examples/hello/main.cpp" | grep vulkan/ ||
    fail "hello includes headers of Vulkan's"
! LD_DEBUG=files "$place/example hello ON/build/hello" 2>&1 | grep libvulkan ||
    fail "hello opens a Vulkan loader"
