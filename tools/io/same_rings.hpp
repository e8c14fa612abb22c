#pragma once

#include <nearfield/shape.hpp>

#include <span>

namespace nearfield::tools {

/// True if each ring of the first list has a counterpart of its own in the second one and the other
/// way around: as many vertices in the same cyclic order, or in the reverse one, each no farther
/// than `distance` from its counterpart along x and along y.
[[nodiscard]] bool are_same_rings(std::span<const Ring> first, std::span<const Ring> second,
                                  double distance);

}  // namespace nearfield::tools
