#pragma once

#include <nearfield/shape.hpp>

#include <span>
#include <vector>

namespace nearfield::geometry {

/// Rings read from a caller's numbers. Keeps its memory.
class GatheredRings {
public:
    /// The rings, until the next call. Throws StatusException (invalid_shape) that names the first
    /// ring whose numbers are no vertices.
    [[nodiscard]] std::span<const Ring> gather(std::span<const RingView> views);

private:
    std::vector<Ring> rings_;
};

}  // namespace nearfield::geometry
