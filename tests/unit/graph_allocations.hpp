#pragma once

#include <cstdint>

namespace nearfield::graph::testing {

/// How often this program has allocated memory with `new` so far.
[[nodiscard]] std::uint64_t allocation_count() noexcept;

}  // namespace nearfield::graph::testing
