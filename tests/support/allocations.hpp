#pragma once

#include <cstdint>

namespace nearfield::test_support {

/// Heap allocations of this program so far, on all threads. A program that asks gets counting
/// operators new in place of the ordinary ones.
[[nodiscard]] std::uint64_t allocation_count() noexcept;
/// The same of the calling thread alone.
[[nodiscard]] std::uint64_t allocation_count_of_this_thread() noexcept;

/// While it lives, this thread's heap allocations succeed so many times, and all after them fail.
/// One at a time.
class FailingAllocations {
public:
    explicit FailingAllocations(std::uint64_t successes) noexcept;
    ~FailingAllocations();
    FailingAllocations(const FailingAllocations&) = delete;
    FailingAllocations& operator=(const FailingAllocations&) = delete;

    /// At least one has failed, not counting those that may (std::nothrow).
    [[nodiscard]] static bool has_failed() noexcept;
};

/// While it lives, nothing that this thread allocates is counted or fails: for what stands below
/// the code that is watched.
class UnwatchedAllocations {
public:
    UnwatchedAllocations() noexcept;
    ~UnwatchedAllocations();
    UnwatchedAllocations(const UnwatchedAllocations&) = delete;
    UnwatchedAllocations& operator=(const UnwatchedAllocations&) = delete;
};

}  // namespace nearfield::test_support
