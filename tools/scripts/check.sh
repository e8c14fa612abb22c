#!/usr/bin/env bash
# Sets up and checks what tests do not: the reference, the libraries' symbols, format, clang-tidy, and
# the sanitizers. Stops at the first check that fails.
#   check.sh [--no-setup]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

jobs=$(nproc)

# sources PATTERN...: the project's own C++ files with such names, zero-terminated.
sources() {
    local names=(-false)
    for pattern in "$@"; do
        names+=(-o -name "$pattern")
    done
    find "$root"/{include,engine,passes,tools,examples,tests} -type f \( "${names[@]}" \) -print0 | sort -z
}

check_format() {
    sources '*.cpp' '*.hpp' | xargs -0 clang-format --dry-run -Werror
}

# clang-tidy reads each room of the product as one file, so that Eigen and the standard library are
# read once a room and not once a file.
check_tidy() {
    configure tidy >/dev/null
    build tidy --target nearfield_engine_spirv nearfield_render_spirv nearfield_examples_spirv \
        nearfield_embedded >/dev/null
    find "$root/build/tidy" -path '*/Unity/*.cxx' -print0 |
        xargs -0 -P "$jobs" -n 1 clang-tidy -p "$root/build/tidy" --quiet --extra-arg=-w
}

# The rooms that need no driver, and whole queries on a mock one, with every memory access, leak and
# undefined operation watched. What runs graphs on a device is left out: drivers leak on their own
# account.
check_sanitized() {
    # A program and the tests it runs, a line each, side by side; the longest first.
    local runs=(
        'driver/test_driver HostMemory.*' 'driver/test_driver -HostMemory.*'
        'test_geometry *' 'test_localize *' 'test_exact *' 'test_graph -GraphExecute.*'
    )
    configure sanitize >/dev/null
    build sanitize --target test_driver test_geometry test_localize test_exact test_graph test_reload
    printf '%s\n' "${runs[@]}" | xargs -P "$jobs" -L 1 \
        bash -c '"$0/$1" --gtest_brief=1 --gtest_filter="$2"' "$root/build/sanitize/tests"
    # Shaders that are reloaded, which debug builds alone can; on a device, so without its leaks.
    ASAN_OPTIONS=detect_leaks=0 "$root/build/sanitize/tests/reload/test_reload" --gtest_brief=1
}

# Contexts on several threads, with every access to memory that two of them share watched.
check_threads() {
    configure threads >/dev/null
    build threads --target test_threads
    # TSAN_OPTIONS cannot have a path with a space.
    (cd "$root" && TSAN_OPTIONS="suppressions=tests/threads/suppressions.txt halt_on_error=1" \
        build/threads/tests/threads/test_threads --gtest_brief=1)
}

# expect_none WHAT LINES: fails where there are lines, and shows them.
expect_none() {
    [[ -z $2 ]] || {
        printf '%s:\n%s\n' "$1" "$2"
        return 1
    }
}

# The functions of the public interface that the library has code for, as the reference has them.
public_functions() {
    awk '/<memberdef /{wanted = /kind="function".* inline="no"/}
        /<templateparamlist>/{wanted = 0}
        /<definition>/{gsub(/ *<[^>]*>/, ""); name = $NF}
        /<argsstring>/ && wanted && !/=(default|delete)/{print name}' "$root"/build/reference/xml/*.xml
}

# A host gives the Vulkan entry points at run time: the libraries define none and ask for none. The
# shared one exports the public interface, all of it and nothing else, nor anything that can be there
# only once in a process (u), which would keep it from being unloaded.
check_symbols() {
    local archive="$root/build/release/libnearfield.a" shared="$root/build/release/libnearfield.so"
    local exported
    expect_none 'libnearfield.a has Vulkan entry points of its own' \
        "$(nm --format=just-symbols "$archive" | grep '^vk[A-Z]' || true)"
    expect_none 'libnearfield.so has Vulkan entry points of its own' \
        "$(nm --dynamic --format=just-symbols "$shared" | grep '^vk[A-Z]' || true)"
    expect_none 'libnearfield.a has a part of what reloads shaders in debug builds' \
        "$(nm --demangle --format=just-symbols "$archive" |
            grep 'nearfield::reload::\|posix_spawn' || true)"
    exported=$(nm --dynamic --defined-only --demangle "$shared" | cut --delimiter=' ' --fields=2-)
    expect_none 'libnearfield.so exports more than functions of nearfield' \
        "$(grep --invert-match '^T nearfield::' <<<"$exported" || true)"
    expect_none 'libnearfield.so does not export these (NEARFIELD_EXPORT)' \
        "$(public_functions | sort --unique |
            comm -23 - <(sed 's/^T //; s/[([].*//' <<<"$exported" | sort --unique))"
    expect_none 'libnearfield.so exports what is not public' \
        "$(grep 'nearfield::[a-z_]*::\|Implementation::' <<<"$exported" || true)"
}

# The reference is made without a warning, so every public item is documented; what Doxygen does not
# look at, enumerators, is looked for in what it wrote.
check_reference() {
    local undocumented
    rm -rf "$root/build/reference"
    mkdir -p "$root/build"
    (cd "$root" && doxygen docs/Doxyfile)
    undocumented=$(awk '/<enumvalue /{name = ""; said = 0} /<para>/{said = 1}
        name == "" && /<name>/{gsub(/ *<[^>]*>/, ""); name = $0}
        /<\/enumvalue>/ && !said {print FILENAME ": " name}' "$root"/build/reference/xml/*.xml)
    expect_none 'These enumerators are not documented' "$undocumented"
}

if wants_setup "$@"; then
    step "Install what is missing" "$root/tools/scripts/setup.sh" test
fi
step "Configure" configure release
step "Build" build release --target nearfield_static nearfield_shared
step "Reference" check_reference
step "Symbols of the libraries" check_symbols
step "Format" check_format
step "clang-tidy" check_tidy
step "Sanitizers" check_sanitized
step "Threads" check_threads
printf '\n== All checks passed\n'
print_test_counts
