#pragma once

#include <engine/geometry/vertex_kernels.hpp>
#include <nearfield/shape.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace nearfield::geometry {

/// A Hilbert curve through the cells of a box: places that are close on it are close in the plane.
class HilbertCurve {
public:
    /// The box is divided `halvings` times along each axis: a multiple of 4, at most 16.
    explicit HilbertCurve(const Extent& box, std::uint32_t halvings = 16);

    /// The position on the curve of the cell that holds a point of the box.
    [[nodiscard]] std::uint32_t at(double x, double y) const;

private:
    Extent box_;
    std::uint32_t halvings_;
    std::uint32_t cells_;
    double cells_per_x_;
    double cells_per_y_;
};

/// Sorts places so that neighbours follow each other. Keeps its memory.
class HilbertOrder {
public:
    /// The numbers of the places at(0), ..., at(count - 1), in order along a curve. Valid until the
    /// next call.
    template <class At>
    [[nodiscard]] std::span<const std::uint32_t> sort(std::size_t count, const At& at) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Extent box{infinity, infinity, -infinity, -infinity};
        for (std::size_t i = 0; i < count; ++i) {
            const Vector2& place = at(i);
            box = {std::min(box.low_x, place.x), std::min(box.low_y, place.y),
                   std::max(box.high_x, place.x), std::max(box.high_y, place.y)};
        }
        const HilbertCurve curve(box, halvings);
        positions_.clear();
        for (std::size_t i = 0; i < count; ++i) {
            const Vector2& place = at(i);
            positions_.push_back(static_cast<std::uint16_t>(curve.at(place.x, place.y)));
        }
        return sort_positions();
    }

    /// Host memory, in bytes.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof(std::uint32_t) * (order_.capacity() + others_.capacity()) +
               sizeof(std::uint16_t) * positions_.capacity();
    }

private:
    // So few that two bytes tell the cells apart: smaller differences are ignored.
    static constexpr std::uint32_t halvings = 8;

    [[nodiscard]] std::span<const std::uint32_t> sort_positions();
    void sort_by_byte(std::uint32_t byte);

    std::vector<std::uint16_t> positions_;  // on the curve
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> others_;  // scratch for sorting
};

}  // namespace nearfield::geometry
