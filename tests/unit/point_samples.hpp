#pragma once

#include <engine/exact/edge_kernels.hpp>
#include <engine/geometry/vector.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace nearfield::samples {

/// Points with the room that kernels need.
struct Points {
    std::vector<double> x;
    std::vector<double> y;
    std::uint32_t count = 0;

    void push(const geometry::Vector& point) {
        x.resize(count + 1 + 2 * exact::most_lanes, std::numeric_limits<double>::quiet_NaN());
        y.resize(count + 1 + 2 * exact::most_lanes, std::numeric_limits<double>::quiet_NaN());
        x[count] = point.x();
        y[count] = point.y();
        ++count;
    }
    [[nodiscard]] exact::PointArrays arrays() const { return {count, x.data(), y.data()}; }
};

}  // namespace nearfield::samples
