#pragma once

#include <engine/base/interruption.hpp>
#include <engine/geometry/simplify.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/solvers/near_edges.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::solvers {

/// The cells of a distance field.
struct FieldGrid {
    geometry::Vector origin = geometry::Vector::Zero();  ///< low corner of cell (0, 0)
    double cell = 1.0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// The requested outputs for every cell, row by row; either may be empty.
struct FieldOutput {
    std::span<float> distances;        ///< signed, negative inside, in cells times `scale`
    std::span<std::uint32_t> nearest;  ///< words as in near_edges.hpp
    double scale = 1.0;
    double margin = 0.0;  ///< two distances closer than this, in cells, count as equal
};

/// Computes the signed distance field of a polygon. Distances to edges are in single precision,
/// relative to an origin at most 64 cells away; signs come from the crossings of each row, in
/// double precision (even-odd, half open). A quadtree of cells passes down the edges that can be
/// nearest. Reuses its memory.
class CellSolver {
public:
    /// A distance is off by at most 2^-12 cells plus this fraction of it (docs/error_budget.md).
    static constexpr double relative_rounding = 0x1p-19;

    /// Returns the largest magnitude of a distance, or 0 if no distances are requested.
    /// `simplified`: the edges that distances are measured to and whose indices `nearest` reports;
    /// empty for the polygon's own edges. Signs are those of the polygon itself.
    double solve(const geometry::TransformedPolygon& polygon,
                 std::span<const geometry::SimplifiedEdge> simplified, const FieldGrid& grid,
                 const FieldOutput& output);

private:
    /// A square of cells from (column, row) on.
    struct Square {
        std::uint64_t column = 0;
        std::uint64_t row = 0;
        std::uint64_t side = 0;
    };
    /// The size of the part of a square that is in the grid.
    struct Extent {
        double width = 0.0;
        double height = 0.0;
    };

    void place(const geometry::TransformedPolygon& polygon,
               std::span<const geometry::SimplifiedEdge> simplified);
    void find_signs(const geometry::Polygon& shape);
    void add_crossings(const geometry::Vector& start, const geometry::Vector& end);
    void make_far_list();
    /// Visits the quarters of a square that reach into the grid.
    template <class Use>
    void for_quarters(const Square& square, const Use& use) const;
    [[nodiscard]] Extent extent(const Square& square) const;
    [[nodiscard]] Disc disc(const Square& square, const geometry::Vector& origin) const;
    void divide(const Square& square, std::size_t depth);
    void make_near_list(const Square& square, const EdgeList& far, double nearest, EdgeList& near);
    /// The distance of the nearest of some edges, in double precision.
    [[nodiscard]] double distance_from(const geometry::Vector& point, const EdgeList& edges) const;
    void divide_near(const Square& square, std::size_t depth);
    void solve_block_at(const Square& square, const EdgeList& edges);

    FieldGrid grid_;
    FieldOutput output_;
    double largest_ = 0.0;
    std::vector<geometry::Vector> vertices_;  // of the polygon, in cells of the grid
    /// The ends of an edge, in cells of the grid.
    struct Ends {
        geometry::Vector start;
        geometry::Vector end;
    };
    std::vector<Ends> edges_;            // edges to measure distances to
    std::vector<std::uint64_t> inside_;  // one bit per cell; each row starts at a new word
    std::size_t words_per_row_ = 0;
    geometry::Vector far_origin_ = geometry::Vector::Zero();  // of far edges, in cells of the grid
    double far_slack_ = 0.0;  // rounding of a single-precision distance there
    geometry::Vector near_origin_ = geometry::Vector::Zero();  // of near edges, likewise
    std::vector<EdgeList> levels_;                             // by depth of the quadtree
    std::vector<float> squared_;                               // scratch
    BlockScratch scratch_;
    SparseCheckpoint<16> checkpoint_;
};

}  // namespace nearfield::solvers
