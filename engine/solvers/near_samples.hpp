#pragma once

#include <engine/base/function_ref.hpp>
#include <engine/queries/boundary_points.hpp>
#include <engine/simd/edge_subset.hpp>
#include <engine/simd/parameter_intervals.hpp>
#include <engine/simd/point_list.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nearfield::solvers {

/// Finds the samples of a polygon's boundary that are close to the boundary of another polygon:
/// first the close intervals of its edges, then the samples within them, in lists of bounded
/// length. Reuses its memory between pairs.
class NearSamples {
public:
    /// Finds all samples at most `distance` from B's boundary, and hardly any others, in order
    /// along A's rings; consecutive samples of a boundary are at most `spacing` apart (see
    /// queries::sample_chains). Calls `use()` for each list of samples, at most as many as are
    /// located at once. Precondition: unless both polygons are small, both are complete.
    void find(const simd::TransformedEdges& a, const simd::TransformedEdges& b, double distance,
              double spacing, FunctionRef<void()> use);

    /// Upper bound on the number of samples that find() examines. A double, since it may be huge.
    /// The same precondition.
    [[nodiscard]] double max_samples(const simd::TransformedEdges& a,
                                     const simd::TransformedEdges& b, double distance,
                                     double spacing);

    /// The samples of the list that is to be used.
    [[nodiscard]] const simd::PointList& points() const { return points_; }
    /// The position of sample i on A's boundary.
    [[nodiscard]] const queries::BoundaryPoint& place(std::size_t i) const { return places_[i]; }

private:
    using Part = std::int64_t;  // of an edge; there may be more than 32 bits count

    void begin(const simd::TransformedEdges& a, const simd::TransformedEdges& b, double distance);
    /// Hands the list over, and starts over.
    void hand_over();
    /// The edges of A that may come close to B.
    [[nodiscard]] std::span<const std::uint32_t> find_edges();
    [[nodiscard]] std::span<const simd::ParameterInterval> find_intervals(std::uint32_t edge);
    [[nodiscard]] std::uint32_t find_intervals_by_tree(std::uint32_t edge);
    void add(std::uint32_t edge, double parts);

    const simd::TransformedEdges* a_ = nullptr;
    const simd::TransformedEdges* b_ = nullptr;
    std::size_t at_once_ = 0;                   // samples of a list
    const FunctionRef<void()>* use_ = nullptr;  // what the caller does with a list
    double reach_ = 0.0;
    geometry::Box near_b_;                // contains all points within reach_ of B
    simd::EdgeSubset picked_;             // of a small B
    std::optional<simd::AabbTree> tree_;  // of a B that is not small
    simd::SearchTrials trials_;           // of the tree
    std::vector<std::uint32_t> edges_;    // of A
    std::array<simd::ParameterInterval, simd::max_intervals> intervals_;
    simd::PointList points_;
    std::vector<queries::BoundaryPoint> places_;
};

}  // namespace nearfield::solvers
