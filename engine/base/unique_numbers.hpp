#pragma once

#include <cstdint>

namespace nearfield {

/// The number of a new context or world, from 1, which its handles carry: no other one in the
/// process has it. (The numbers start again after four billion.)
[[nodiscard]] std::uint32_t next_owner_number() noexcept;

/// A number that no earlier call in the process has returned, never 0: what is marked with it has
/// changed since.
[[nodiscard]] std::uint64_t next_revision() noexcept;

}  // namespace nearfield
