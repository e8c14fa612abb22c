#pragma once

#include <engine/exact/picked_edges.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/exact/stretches.hpp>
#include <engine/plan/boundary_points.hpp>
#include <engine/point_list.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nearfield {

/// The samples of a polygon's boundary that come close to the boundary of another polygon: first
/// the stretches of edges that do, by the edges that are near, then what samples lie there. Keeps
/// its memory from pair to pair.
class NearSamples {
public:
    /// Finds all that are no farther from B's boundary than `distance`, and hardly any others, in
    /// order along A's rings; consecutive samples of a boundary are at most `spacing` apart (see
    /// plan::sample_chains). Where either polygon is not small both are complete.
    void find(const exact::PlacedEdges& a, const exact::PlacedEdges& b, double distance,
              double spacing);

    [[nodiscard]] const PointList& points() const { return points_; }
    /// Where each of them is on A's boundary.
    [[nodiscard]] const plan::BoundaryPoint& place(std::size_t i) const { return places_[i]; }

private:
    /// Those of A that may come close to B.
    [[nodiscard]] std::span<const std::uint32_t> find_edges();
    [[nodiscard]] std::span<const exact::Stretch> find_stretches(std::uint32_t edge);
    void add(std::uint32_t edge, double parts);

    const exact::PlacedEdges* a_ = nullptr;
    const exact::PlacedEdges* b_ = nullptr;
    double reach_ = 0.0;
    geometry::Box near_b_;                // all that is no farther from B than that
    exact::PickedEdges picked_;           // of a small B
    std::optional<exact::BoxTree> tree_;  // over another
    std::vector<std::uint32_t> edges_;    // of A
    std::array<exact::Stretch, exact::most_stretches> stretches_;
    PointList points_;
    std::vector<plan::BoundaryPoint> places_;
};

}  // namespace nearfield
