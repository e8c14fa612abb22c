#!/usr/bin/env bash
# Sets up, builds, runs all tests and all checks; stops at the first that fails.
#   test.sh [--no-setup]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

jobs=$(nproc)
log="$root/build/release/ctest.log"
report="$root/build/release/ctest.xml"

# sources PATTERN...: the project's own C++ files with such names, zero-terminated.
sources() {
    local names=(-false)
    for pattern in "$@"; do
        names+=(-o -name "$pattern")
    done
    find "$root"/{include,engine,passes,tools,tests} -type f \( "${names[@]}" \) -print0 | sort -z
}

# The count of ctest's report with the given name.
reported() {
    sed -n "s/^\t$1=\"\([0-9]*\)\".*/\1/p" "$report" | head -n 1
}

print_counts() {
    local failed skipped
    failed=$(reported failures)
    skipped=$(($(reported skipped) + $(reported disabled)))
    ((skipped == 0)) || printf '%d skipped\n' "$skipped"
    printf '%d passed, %d failed\n' "$(($(reported tests) - failed - skipped))" "$failed"
}

run_tests() {
    rm -f "$report"
    ctest --test-dir "$root/build/release" --parallel "$jobs" --output-on-failure --no-tests=error \
        --output-junit "$report" 2>&1 | tee "$log" || {
        [[ ! -f $report ]] || print_counts
        return 1
    }
}

check_format() {
    sources '*.cpp' '*.hpp' | xargs -0 clang-format --dry-run -Werror
}

# clang-tidy reads each room of the product as one file, so that Eigen and the standard library are
# read once a room and not once a file.
check_tidy() {
    configure tidy -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 \
        -DNEARFIELD_BUILD_TESTS=OFF >/dev/null
    build tidy --target nearfield_spirv nearfield_embedded >/dev/null
    find "$root/build/tidy" -path '*/Unity/*.cxx' -print0 |
        xargs -0 -P "$jobs" -n 1 clang-tidy -p "$root/build/tidy" --quiet --extra-arg=-w
}

# configure_sanitized FOLDER SANITIZERS FLAGS: makes build/FOLDER. Warnings are not errors there: the
# sanitizers' own code sets off false ones. Rooms are compiled as few files, to save time.
configure_sanitized() {
    configure "$1" -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=$3" "-DNEARFIELD_SANITIZE=$2" \
        -DCMAKE_UNITY_BUILD=ON -DNEARFIELD_BUILD_TOOLS=OFF \
        -DNEARFIELD_WARNINGS_AS_ERRORS=OFF >/dev/null
}

# The rooms that need no driver, and whole queries on a mock one, with every memory access, leak and
# undefined operation watched. What runs graphs on a device is left out: drivers leak on their own
# account.
check_sanitized() {
    local test tests=(test_geometry test_localize test_exact test_graph test_driver)
    configure_sanitized sanitize address,undefined "-O1 -g1"
    build sanitize --target "${tests[@]}"
    for test in "${tests[@]}"; do
        "$root/build/sanitize/tests/$test" --gtest_brief=1 --gtest_filter='-GraphExecute.*'
    done
}

# Contexts on several threads, with every access to memory that two of them share watched.
check_threads() {
    configure_sanitized threads thread "-O1 -g0"
    build threads --target test_threads
    TSAN_OPTIONS="suppressions=$root/tests/threads/suppressions.txt halt_on_error=1" \
        "$root/build/threads/tests/threads/test_threads" --gtest_brief=1
}

# A host gives the Vulkan entry points at run time: the library defines none and asks for none.
check_symbols() {
    local symbols
    symbols=$(nm --format=just-symbols "$root/build/release/libnearfield.a" | grep '^vk[A-Z]' || true)
    [[ -z $symbols ]] || {
        printf 'libnearfield.a has Vulkan entry points of its own:\n%s\n' "$symbols"
        return 1
    }
}

if wants_setup "$@"; then
    step "Install what is missing" "$root/tools/scripts/setup.sh" test
fi
step "Configure" configure release -DCMAKE_BUILD_TYPE=Release -DNEARFIELD_BUILD_TESTS=ON
step "Build" build release
step "Tests" run_tests
step "No Vulkan symbols in the library" check_symbols
step "Format" check_format
step "clang-tidy" check_tidy
step "Sanitizers" check_sanitized
step "Threads" check_threads
printf '\n== All checks passed; the tests again\n'
tail -n 4 "$log"
print_counts
