#!/usr/bin/env bash
# Each installed header compiles alone, and all of them together with Clang and without Vulkan's
# prototypes, with more warnings than a host is likely to enable.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

compile() {
    printf '#include <nearfield/%s>\n' "${@:3}" |
        "$1" -x c++ -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion \
            -Wshadow -Werror "$2" "-I$prefix/include" -
}
export prefix
export -f compile

clang=$(command -v clang++ || true)
[[ -n $clang ]] || fail "there is no clang++ (package clang)"
cd "$prefix/include/nearfield"
printf '%s\0' *.hpp | xargs -0 -n 1 -P 2 bash -c 'compile "$CXX" -UVK_NO_PROTOTYPES "$1"' _
for compiler in "$CXX" "$clang"; do
    compile "$compiler" -DVK_NO_PROTOTYPES *.hpp
done
compile "$clang" -UVK_NO_PROTOTYPES *.hpp
printf '%s headers\n' "$(find . -name '*.hpp' | wc -l)"

# An older language version: the first error of each header names the one that it takes.
for compiler in "$CXX" "$clang"; do
    for header in *.hpp; do
        first=$(printf '#include <nearfield/%s>\n' "$header" |
            "$compiler" -x c++ -std=c++17 -Wfatal-errors -fsyntax-only "-I$prefix/include" - 2>&1 |
            grep -m 1 'error:' || true)
        [[ $first == *'nearfield needs C++20'* ]] ||
            fail "$header under C++17: the first error is '$first'"
    done
done
