#pragma once

#include <engine/narrowphase/closest_pair.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/simd/transformed_edges.hpp>
#include <engine/world/deepest_vertex.hpp>
#include <engine/world/instances.hpp>
#include <nearfield/world.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::world {

/// Queries of one shape at one pose after the other against the instances of a world. For one
/// thread; several objects may work on one world at the same time. Keeps its memory.
class PoseQueries {
public:
    /// The instances have to be prepared.
    void begin(const Instances& instances, const geometry::Polygon& shape,
               const WorldFilter& filter);

    [[nodiscard]] bool intersects(const Pose& pose);
    /// Appends the instances that the shape intersects, in any order.
    void find_intersecting(const Pose& pose, std::vector<std::uint32_t>& found);
    [[nodiscard]] Clearance clearance(const Pose& pose, const ClearanceQuery& query);
    /// Fills `nearest`, of which there are as many as are wanted.
    void find_nearest(const Pose& pose, double max_distance, std::span<Clearance> nearest);

private:
    /// Puts the shape at a pose.
    void place(const Pose& pose);
    /// The shape's edges at the pose, with or without the boxes over them.
    [[nodiscard]] const simd::TransformedEdges& edges() const { return shape_edges_[0]; }
    [[nodiscard]] const simd::TransformedEdges& complete_edges();
    [[nodiscard]] geometry::Box search_box() const;
    [[nodiscard]] bool intersects(std::uint32_t index);
    /// Takes an instance into account if it is nearer, or deeper, than the best so far.
    void measure(std::uint32_t index, const ClearanceQuery& query);
    [[nodiscard]] bool replaces(double distance, std::uint32_t index) const;
    void write_depth(std::uint32_t index);
    void write_distance(std::uint32_t index, double max_clearance);

    const Instances* instances_ = nullptr;
    const geometry::Polygon* shape_ = nullptr;
    WorldFilter filter_;
    simd::TransformedInstances shape_edges_;
    narrowphase::OverlapTest overlap_test_;
    narrowphase::ClosestPairFinder closest_pair_;
    DeepestVertex deepest_vertex_;
    Clearance best_;
    // The instance of best_, and an edge of each shape near the places where they are closest.
    std::uint32_t nearest_ = UINT32_MAX;
    std::uint32_t nearest_vertex_ = 0;
    std::uint32_t nearest_edge_ = 0;
    // Those of the pose before.
    std::uint32_t guess_ = UINT32_MAX;
    std::uint32_t guess_vertex_ = 0;
    std::uint32_t guess_edge_ = 0;
    std::vector<std::uint32_t> candidates_;
};

}  // namespace nearfield::world
