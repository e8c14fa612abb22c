#pragma once

#include <engine/simd/transformed_edges.hpp>
#include <engine/world/instances.hpp>
#include <nearfield/world.hpp>

#include <cstdint>
#include <span>
#include <vector>

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
    /// One of the nearest found so far.
    struct Found {
        double distance;
        std::uint64_t number;  // of the instance
        std::uint32_t instance;
        std::uint32_t edge;
        geometry::Vector point;    // of the shape
        geometry::Vector nearest;  // of the edge

        [[nodiscard]] bool operator<(const Found& other) const {
            return distance != other.distance ? distance < other.distance
                   : number != other.number   ? number < other.number
                                              : edge < other.edge;
        }
    };

    [[nodiscard]] const simd::TransformedEdges& shape() const { return shape_edges_[0]; }
    /// Slightly more than the square of the distance beyond which edges are of no interest.
    [[nodiscard]] double squared_reach(double rounding) const;
    void find_edges_of(std::uint32_t index);
    void measure(std::uint32_t index, std::uint32_t edge);
    void take(const Found& found);
    [[nodiscard]] ShapeEdgeHit hit_of(const Found& found) const;

    const Instances* instances_ = nullptr;
    WorldFilter filter_;
    simd::TransformedInstances shape_edges_;
    std::size_t wanted_ = 0;
    double max_distance_ = 0.0;
    std::vector<Found> nearest_;  // in ascending order
};

}  // namespace nearfield::world
