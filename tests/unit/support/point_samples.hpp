#pragma once

#include <engine/geometry/vector.hpp>
#include <engine/simd/edge_kernels.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace nearfield::samples {

/// Points with the padding that kernels need.
struct Points {
    std::vector<double> x;
    std::vector<double> y;
    std::uint32_t count = 0;

    void push(const geometry::Vector& point) {
        x.resize(count + 1 + 2 * simd::max_lanes, std::numeric_limits<double>::quiet_NaN());
        y.resize(count + 1 + 2 * simd::max_lanes, std::numeric_limits<double>::quiet_NaN());
        x[count] = point.x();
        y[count] = point.y();
        ++count;
    }
    [[nodiscard]] simd::PointArrays arrays() const { return {count, x.data(), y.data()}; }
};

}  // namespace nearfield::samples
