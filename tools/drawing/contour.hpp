#pragma once

#include <nearfield/shape.hpp>

#include <cstddef>
#include <vector>

namespace nearfield::tools {

/// Values at the nodes of a lattice, row by row.
struct Lattice {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<float> values;

    [[nodiscard]] double at(std::size_t column, std::size_t row) const {
        return static_cast<double>(values[row * width + column]);
    }
};

/// The contour lines of a lattice at a value (marching squares, linear between nodes), in node
/// units: node (column, row) is the point (column, row). Closed lines end where they begin.
[[nodiscard]] std::vector<std::vector<Vector2>> contour_lines(const Lattice& lattice, double level);

}  // namespace nearfield::tools
