#pragma once

#include <engine/geometry/transformed_polygon.hpp>
#include <engine/geometry/vector.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <limits>

namespace nearfield::queries {

/// The grid of a region: cell (0, 0) has its low corner at `origin`.
struct Grid {
    geometry::Vector origin = geometry::Vector::Zero();
    double cell = 1.0;
    std::uint64_t width = 0;
    std::uint64_t height = 0;

    /// The smallest grid that starts at the low corner of `box` and covers it; at least one cell.
    static Grid covering(const geometry::Box& box, double cell);

    [[nodiscard]] double cells() const {
        return static_cast<double>(width) * static_cast<double>(height);
    }
};

/// A grid as results report it.
[[nodiscard]] Region region_of(const Grid& grid);

/// A rectangle of cells of a grid.
struct Tile {
    std::uint32_t region = 0;  ///< the query's region that it belongs to
    Grid grid;                 ///< of that region
    std::uint64_t column = 0;  ///< in that grid, of the tile's low corner without its halo
    std::uint64_t row = 0;
    std::uint32_t width = 0;  ///< drawn, the halo included
    std::uint32_t height = 0;
    std::uint32_t halo = 0;  ///< cells drawn around the tile's own cells, on every side

    /// Centre of the drawn cells, in cells of the tile.
    [[nodiscard]] geometry::Vector centre() const { return {0.5 * width, 0.5 * height}; }
    /// Low corner of the drawn cells, in the world.
    [[nodiscard]] geometry::Vector origin() const {
        return grid.origin + grid.cell * geometry::Vector(static_cast<double>(column) - halo,
                                                          static_cast<double>(row) - halo);
    }
};
/// Host memory for a tile, at most, with all that a technique keeps of it.
inline constexpr double bytes_of_tile = 240.0;

/// Transforms coordinates relative to a polygon's centre to cells of a tile. Composed in double
/// precision, so that no precision is lost far from the world's origin.
class ToCells {
public:
    ToCells(const geometry::TransformedPolygon& polygon, const geometry::Vector& origin,
            double cell)
        : matrix_(polygon.rotation() / cell),
          offset_((polygon.translation() - origin) / cell),
          cell_(cell) {}

    /// A length in cells.
    [[nodiscard]] double cells(double length) const { return length / cell_; }

    geometry::Vector operator()(const geometry::Vector& v) const { return matrix_ * v + offset_; }
    /// A box that encloses all of `box`, up to rounding.
    [[nodiscard]] geometry::Box operator()(const geometry::Box& box) const {
        const geometry::Vector centre = (*this)(box.center());
        const geometry::Vector half = matrix_.cwiseAbs() * (0.5 * box.sizes());
        return {centre - half, centre + half};
    }
    /// Transforms back to coordinates relative to the polygon's centre.
    [[nodiscard]] geometry::Vector inverse(const geometry::Vector& cells) const {
        return matrix_.transpose() * (cells - offset_) * (cell_ * cell_);
    }
    /// Generous upper bound, in cells, on how far rounding moves anything in `box`.
    [[nodiscard]] double rounding(const geometry::Box& box) const {
        return 64.0 * std::numeric_limits<double>::epsilon() *
               (offset_.norm() + cells(box.max().norm() + box.min().norm()) + 1.0);
    }

private:
    Eigen::Matrix2d matrix_;
    geometry::Vector offset_;
    double cell_;
};

}  // namespace nearfield::queries
