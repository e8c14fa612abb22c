#pragma once

#include <engine/geometry/vertex_kernels.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nearfield::world {

/// A Hilbert curve through 2^16 x 2^16 cells of a box: places that are close on it are close in the
/// plane.
class HilbertCurve {
public:
    explicit HilbertCurve(const geometry::Extent& box);

    /// The position on the curve of the cell that holds a point of the box.
    [[nodiscard]] std::uint32_t at(double x, double y) const;

private:
    geometry::Extent box_;
    double cells_per_x_;
    double cells_per_y_;
};

/// Sorts points so that neighbours follow each other. Keeps its memory.
class HilbertOrder {
public:
    /// The numbers of the points, in order along a curve. Valid until the next call.
    [[nodiscard]] std::span<const std::pair<std::uint32_t, std::uint32_t>> sort(
        std::span<const Vector2> points);

private:
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order_;  // position on the curve, number
};

}  // namespace nearfield::world
