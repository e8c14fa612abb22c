#!/usr/bin/env bash
# Each installed header compiles alone, and all of them without Vulkan's prototypes, with GCC and
# Clang and more warnings than a host is likely to enable.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

compile() {
    printf '#include <nearfield/%s>\n' "$3" |
        "$1" -x c++ -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion \
            -Wshadow -Werror "$2" "-I$prefix/include" -
}
export prefix
export -f compile

clang=$(command -v clang++ || true)
[[ -n $clang ]] || fail "there is no clang++ (package clang)"
cd "$prefix/include/nearfield"
for compiler in "$CXX" "$clang"; do
    for header in *.hpp; do
        printf '%s\0' "$compiler" -UVK_NO_PROTOTYPES "$header"
    done
    printf '%s\0' "$compiler" -DVK_NO_PROTOTYPES nearfield.hpp
done | xargs -0 -n 3 -P 2 bash -c 'compile "$@"' _
printf '%s headers\n' "$(find . -name '*.hpp' | wc -l)"

# An older language version: the first error of each header names the one that it takes.
for compiler in "$CXX" "$clang"; do
    for header in *.hpp; do
        first=$(printf '#include <nearfield/%s>\n' "$header" |
            "$compiler" -x c++ -std=c++17 -fsyntax-only "-I$prefix/include" - 2>&1 |
            grep -m 1 'error:' || true)
        [[ $first == *'nearfield needs C++20'* ]] ||
            fail "$header under C++17: the first error is '$first'"
    done
done
