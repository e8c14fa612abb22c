#pragma once

#include <engine/narrowphase/closest_pair.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/simd/transformed_edges.hpp>
#include <engine/world/deepest_vertex.hpp>
#include <engine/world/instances.hpp>
#include <engine/world/nearest_list.hpp>
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

    // `placed`: the shape at a pose.

    [[nodiscard]] bool intersects(const geometry::TransformedPolygon& placed);
    /// Appends the instances that the shape intersects, in any order.
    void find_intersecting(const geometry::TransformedPolygon& placed,
                           std::vector<std::uint32_t>& found);
    [[nodiscard]] Clearance clearance(const geometry::TransformedPolygon& placed,
                                      const ClearanceQuery& query);
    /// Fills `nearest`, of which there are as many as are wanted.
    void find_nearest(const geometry::TransformedPolygon& placed, double max_distance,
                      std::span<Clearance> nearest);

private:
    /// What is known of the pose before, a first bound for the next one.
    struct Guess {
        std::uint32_t instance = UINT32_MAX;  // that was nearest, or intersected
        // Edges of the shape and the instance near the places where they were closest.
        std::uint32_t vertex = 0;
        std::uint32_t edge = 0;
        bool vertex_of_shape = true;  // where the edge starts; otherwise one of the instance
        VertexGuess deep;             // of the shape
        // From the instance; minus the depth of a vertex; 0: unknown.
        double distance = 0.0;
        geometry::Vector axis = geometry::Vector::Zero();  // of the shape, in the world
        geometry::Vector centre = geometry::Vector::Zero();
        double rounding = 0.0;  // of the shape's vertices
    };

    struct Found : NearInstanceEdge {
        Clearance clearance;
    };

    /// The shape's edges at the pose, with or without the boxes over them.
    [[nodiscard]] const simd::TransformedEdges& edges() const { return shape_edges_[0]; }
    [[nodiscard]] const simd::TransformedEdges& prepared_edges();
    /// The shape's edges, prepared unless they are few enough to do without.
    [[nodiscard]] const simd::TransformedEdges& searched_edges();
    /// Lists the instances that the shape may intersect, in any order.
    void find_candidates(const geometry::TransformedPolygon& placed);
    [[nodiscard]] bool intersects(std::uint32_t index);
    /// The same for the instance of the guess, quickly if the shape has moved less than it was
    /// distant or deep.
    [[nodiscard]] bool intersects_guess();
    /// From a point of the shape to one of the instance of the guess that is near it.
    [[nodiscard]] geometry::Vector way_to_guess();
    /// Takes an instance into account if it is nearer, or deeper, than the best so far.
    void measure(std::uint32_t index, bool intersects, const ClearanceQuery& query);
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
    bool nearest_is_vertex_of_shape_ = true;
    VertexGuess nearest_deep_;
    Guess guess_;
    std::vector<std::uint32_t> candidates_;
    NearestList<Found> found_;
};

}  // namespace nearfield::world
