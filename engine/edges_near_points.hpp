#pragma once

#include <engine/exact/picked_edges.hpp>

#include <cstdint>
#include <span>

namespace nearfield {

/// Of the edges of a small polygon those that can be nearest to any of some points: of many points
/// close together, each needs to be held against a few edges only.
class EdgesNearPoints {
public:
    /// Leaves out no edge that is as near to one of the listed points as the nearest edge is, and
    /// farther by no more than `margin`.
    void pick(const exact::PointArrays& points, std::span<const std::uint32_t> listed,
              const exact::PlacedEdges& edges, double margin);

    [[nodiscard]] const exact::EdgeArrays& edges() const { return edges_; }
    /// Its index in the polygon.
    [[nodiscard]] std::uint32_t index(std::uint32_t edge) const {
        return is_picked_ ? picked_.index(edge) : edge;
    }

private:
    exact::PickedEdges picked_;
    exact::EdgeArrays edges_;  // picked_'s, or all
    bool is_picked_ = false;
};

}  // namespace nearfield
