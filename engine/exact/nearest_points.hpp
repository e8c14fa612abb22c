#pragma once

#include <engine/exact/boundary.hpp>
#include <engine/exact/box_tree.hpp>
#include <engine/exact/placed_edges.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield::exact {

/// What is nearest to each of some points, an array for each number. How far other edges are is
/// known up to rounding, the rest is as geometry::nearest_on_segment() has it.
struct NearestArrays {
    double* x = nullptr;  ///< of the nearest point
    double* y = nullptr;
    double* distance = nullptr;
    double* parameter = nullptr;       ///< where the nearest point is on its edge
    double* second_squared = nullptr;  ///< of the next edge, if that is near
    double* third_squared = nullptr;   ///< no other is nearer than its root
    std::uint32_t* edge = nullptr;     ///< the nearest; of equally near ones the first
    std::uint32_t* second = nullptr;   ///< the next
};

namespace kernels {

/// Finds the edges nearest to each point; of other edges those that are as near up to `margin`,
/// and some more. The closer together points that follow each other lie, the less is looked at. The
/// arrays of points and of what is nearest to them need room for most_lanes more than there are
/// points. `near`: scratch with room for padded(edges.count) entries.
void find_nearest_of(const PointArrays& points, const EdgeArrays& edges, double margin,
                     std::uint32_t* near, const NearestArrays& nearest);
void find_nearest_of(const PointArrays& points, const BoxTree& tree, double margin,
                     std::uint32_t* near, const NearestArrays& nearest);

}  // namespace kernels

/// The points of a placed polygon's boundary nearest to some points, and whether they are unique.
/// Keeps its memory.
class NearestPoints {
public:
    /// `margin`: of uniqueness, see Boundary::is_unique(). Points, with room as above, and edges,
    /// which are small or complete, must stay as long as there are questions.
    void find(const PointArrays& points, const PlacedEdges& edges, double margin);

    /// By the number of the point.
    [[nodiscard]] const NearestArrays& arrays() const { return arrays_; }
    /// Of point number i: Boundary::is_unique().
    [[nodiscard]] bool is_unique(std::size_t i) {
        const double limit = arrays_.distance[i] + margin_;
        return arrays_.second_squared[i] > beyond_rounding(limit) || has_no_rival(i, limit);
    }

private:
    void make_room(std::size_t points, std::size_t edges);
    [[nodiscard]] bool has_no_rival(std::size_t i, double limit);

    PointArrays points_;
    const PlacedEdges* edges_ = nullptr;
    double margin_ = 0.0;
    NearestArrays arrays_;
    std::vector<double> numbers_;         // of arrays_
    std::vector<std::uint32_t> indices_;  // likewise
    std::vector<std::uint32_t> near_;     // edges; scratch
    Boundary boundary_;                   // of edges that are not small
};

}  // namespace nearfield::exact
