#pragma once

#include <engine/simd/transformed_edges.hpp>
#include <engine/world/instances.hpp>
#include <engine/world/nearest_list.hpp>
#include <nearfield/world.hpp>

#include <cstdint>
#include <span>

namespace nearfield::world {

/// Finds the edges nearest to a shape at one pose after the other. For one thread; several objects
/// may work on one world at the same time. Keeps its memory.
class ShapeEdgeQueries {
public:
    /// The instances have to be prepared.
    void begin(const Instances& instances, const WorldFilter& filter);

    /// Fills `hits`, of which there are as many as are wanted. `placed`: the shape at a pose.
    void find(const geometry::TransformedPolygon& placed, double max_distance,
              std::span<ShapeEdgeHit> hits);

private:
    struct Found : NearInstanceEdge {
        geometry::Vector point;    // of the shape
        geometry::Vector nearest;  // of the edge
    };

    [[nodiscard]] const simd::TransformedEdges& shape() const { return shape_edges_[0]; }
    void find_edges_of(std::uint32_t index);
    void measure(std::uint32_t index, std::uint32_t edge);
    [[nodiscard]] ShapeEdgeHit hit_of(const Found& found) const;

    const Instances* instances_ = nullptr;
    WorldFilter filter_;
    simd::TransformedInstances shape_edges_;
    NearestList<Found> nearest_;
};

}  // namespace nearfield::world
