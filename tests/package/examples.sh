#!/usr/bin/env bash
# The example that is an independent project, built with only the installed package, shared and static, and run.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

for shared in ON OFF; do
    work="$place/example $shared"
    mkdir "$work"
    cp -r "$SOURCE/examples/hello" "$work/source"
    cmake -S "$work/source" -B "$work/build" -G Ninja "-DCMAKE_CXX_COMPILER=$CXX" \
        -DCMAKE_CXX_FLAGS='-Wall -Wextra -Wno-missing-field-initializers -Werror' -DBUILD_SHARED_LIBS=$shared \
        "-DCMAKE_PREFIX_PATH=$prefix" >/dev/null
    cmake --build "$work/build"
    names_nothing_of_the_project "$work"
    needs_shared "$work/build/hello" "$([[ $shared == ON ]] && echo yes || echo no)"
    output=$("$work/build/hello")
    [[ $output == '(8.5, 0.5) is 0.5 deep; out along (-1, 0)' ]] || fail "hello says: $output"
done
# It is the README's program, includes no header of Vulkan's, and opens no Vulkan loader.
[[ $(sed -n '/^```cpp$/,/^```$/p' "$SOURCE/README.md" | sed '1d; /^```$/,$d') == \
    "$(<"$SOURCE/examples/hello/main.cpp")" ]] || fail "the README has another program than hello"
! "$CXX" -std=c++20 -M "-I$prefix/include" "$SOURCE/examples/hello/main.cpp" | grep vulkan/ ||
    fail "hello includes headers of Vulkan's"
! LD_DEBUG=files "$place/example ON/build/hello" 2>&1 | grep libvulkan ||
    fail "hello opens a Vulkan loader"
