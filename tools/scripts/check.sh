#!/usr/bin/env bash
# Sets up and runs the checks that the tests do not cover: the reference, the libraries' symbols, links,
# format, clang-tidy, the sanitizers, and that answers have the same bits by another compiler and on
# another processor. Stops at the first check that fails.
#   check.sh [--no-setup]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

jobs=$(nproc)

# sources PATTERN...: the project's own C++ files with matching names, zero-terminated.
sources() {
    local names=(-false)
    for pattern in "$@"; do
        names+=(-o -name "$pattern")
    done
    find "$root"/{include,engine,passes,tools,examples,tests} -type f \( "${names[@]}" \) -print0 | sort -z
}

check_format() {
    sources '*.cpp' '*.hpp' | xargs -0 clang-format --dry-run -Werror
    clang-format --dry-run -Werror "$root"/shaders/*.h
}

# clang-tidy reads each module as one file, so that Eigen and the standard library are parsed once
# per module and not once per file.
check_tidy() {
    configure tidy >/dev/null
    build tidy --target nearfield_passes_spirv nearfield_rendering_spirv nearfield_examples_spirv \
        nearfield_embedded >/dev/null
    find "$root/build/tidy" -path '*/Unity/*.cxx' -print0 |
        xargs -0 -P "$jobs" -n 1 clang-tidy -p "$root/build/tidy" --quiet --extra-arg=-w
}

# Runs the modules that need no driver, and whole queries on a mock driver, with checks of every
# memory access, leak and undefined operation. Tests that run graphs on a device are left out,
# because drivers leak.
check_sanitized() {
    # A program and its tests per line; they run in parallel, the longest first.
    local runs=(
        'driver/test_driver HostDeviceMemory.*' 'driver/test_driver HostMemory.*'
        'driver/test_driver DeviceQueriesOfDriver.*' 'driver/test_driver FailingCalls.*'
        'driver/test_driver -HostDeviceMemory.*:HostMemory.*:DeviceQueriesOfDriver.*:FailingCalls.*'
        'worlds/test_worlds *'
        'test_geometry *' 'test_outline *' 'test_simd *' 'test_narrowphase *' 'test_mtv *'
        'test_queries *' 'test_solvers *' 'test_device_input *' 'test_graph -GraphExecute.*'
    )
    configure sanitize >/dev/null
    build sanitize --target test_driver test_geometry test_outline test_simd \
        test_narrowphase test_queries test_solvers test_device_input test_graph test_mtv test_worlds \
        test_limits test_reload
    printf '%s\n' "${runs[@]}" | xargs -P "$jobs" -L 1 \
        bash -c '"$0/$1" --gtest_brief=1 --gtest_filter="$2"' "$root/build/sanitize/tests"
    # On a device, so without leak detection: calls that are ended at every stage, and shader reload,
    # which only debug builds have.
    printf '%s\n' limits/test_limits reload/test_reload | ASAN_OPTIONS=detect_leaks=0 \
        xargs -P "$jobs" -L 1 bash -c '"$0/$1" --gtest_brief=1' "$root/build/sanitize/tests"
}

# Runs contexts, and histories of worlds, on several threads, with a check of every shared memory
# access.
check_threads() {
    configure threads >/dev/null
    build threads --target test_threads test_worlds
    # TSAN_OPTIONS cannot contain a path with a space.
    (cd "$root" && export TSAN_OPTIONS="suppressions=tests/threads/suppressions.txt halt_on_error=1" &&
        printf '%s\n' 'threads/test_threads *' 'worlds/test_worlds WorldHistory.*' |
        xargs -P "$jobs" -L 1 bash -c '"build/threads/tests/$0" --gtest_brief=1 --gtest_filter="$1"')
}

# expect_none WHAT LINES: fails and shows the lines if there are any.
expect_none() {
    [[ -z $2 ]] || {
        printf '%s:\n%s\n' "$1" "$2"
        return 1
    }
}

# The functions of the public interface that the library has code for, according to the reference.
public_functions() {
    awk '/<memberdef /{wanted = /kind="function".* inline="no"/}
        /<templateparamlist>/{wanted = 0}
        /<definition>/{gsub(/ *<[^>]*>/, ""); while (gsub(/ ?&lt;[^&]*&gt;/, "")); name = $NF}
        /<argsstring>/ && wanted && !/=(default|delete)/{print name}' "$root"/build/reference/xml/*.xml
}

# A host supplies the Vulkan entry points at run time: the libraries neither define nor import them.
# The shared library exports exactly the public interface, of PairTable its instances (W), and no symbol
# that must be unique in a process (u), which would prevent unloading it.
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
        "$(grep --invert-match '^T nearfield::\|^W nearfield::PairTable<' <<<"$exported" || true)"
    expect_none 'libnearfield.so does not export these (NEARFIELD_EXPORT)' \
        "$(public_functions | sort --unique |
            comm -23 - <(sed 's/^[TW] //; s/[([].*//; s/<[^>]*>//' <<<"$exported" | sort --unique))"
    expect_none 'libnearfield.so exports what is not public' \
        "$(grep 'nearfield::[a-z_]*::\|Implementation::' <<<"$exported" || true)"
}

# The reference builds without a warning, so every public item is documented. Doxygen does not check
# enumerators, so they are looked up in its output.
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

# Links in Markdown files lead somewhere, in the repository and in what is installed.
check_links() {
    "$root/tools/scripts/check_links.py"
    rm -rf "$root/build/documents"
    DESTDIR='' cmake --install "$root/build/release" --component development \
        --prefix "$root/build/documents" >/dev/null
    "$root/tools/scripts/check_links.py" "$root/build/documents"
}

if wants_setup "$@"; then
    step "Install what is missing" "$root/tools/scripts/setup.sh" test
    step "Install other compilers" "$root/tools/scripts/setup.sh" bits
fi
step "Configure" configure release
step "Build" build release --target nearfield_static nearfield_shared
step "Reference" check_reference
step "Symbols of the libraries" check_symbols
step "Links" check_links
step "Includes" "$root/tools/scripts/check_includes.py"
step "Format" check_format
step "clang-tidy" check_tidy
step "Sanitizers" check_sanitized
step "Threads" check_threads
step "The same bits" "$root/tools/scripts/same_bits.sh" clang-O3 aarch64-O2
printf '\n== All checks passed\n'
print_test_counts
