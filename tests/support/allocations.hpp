#pragma once

#include <cstdint>

namespace nearfield::test_support {

/// The number of heap allocations of this program so far, on all threads. A program that calls this
/// links counting replacements of operator new.
[[nodiscard]] std::uint64_t allocation_count() noexcept;
/// The same for the calling thread only.
[[nodiscard]] std::uint64_t allocation_count_of_this_thread() noexcept;

/// During its lifetime, a given number of this thread's heap allocations succeed, and all later
/// ones fail. One at a time.
class FailingAllocations {
public:
    explicit FailingAllocations(std::uint64_t successes) noexcept;
    ~FailingAllocations();
    FailingAllocations(const FailingAllocations&) = delete;
    FailingAllocations& operator=(const FailingAllocations&) = delete;

    /// True if at least one has failed, not counting those that may fail (std::nothrow).
    [[nodiscard]] static bool has_failed() noexcept;
};

/// During its lifetime, this thread's allocations are neither counted nor made to fail: for code
/// below the code under test.
class UnwatchedAllocations {
public:
    UnwatchedAllocations() noexcept;
    ~UnwatchedAllocations();
    UnwatchedAllocations(const UnwatchedAllocations&) = delete;
    UnwatchedAllocations& operator=(const UnwatchedAllocations&) = delete;
};

}  // namespace nearfield::test_support
