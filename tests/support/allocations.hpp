#pragma once

#include <cstdint>

namespace nearfield::test_support {

/// Heap allocations of this program so far, on all threads. A program that asks gets counting
/// operators new in place of the ordinary ones.
[[nodiscard]] std::uint64_t allocation_count() noexcept;
/// The same of the calling thread alone.
[[nodiscard]] std::uint64_t allocation_count_of_this_thread() noexcept;

}  // namespace nearfield::test_support
