#pragma once

#include <engine/narrowphase/boundary.hpp>
#include <engine/narrowphase/deepest_point.hpp>
#include <engine/narrowphase/nearest_points.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/narrowphase/vertices_inside.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/simd/point_list.hpp>
#include <engine/simd/transformed_edges.hpp>
#include <engine/solvers/inside_samples.hpp>
#include <engine/solvers/workspace.hpp>
#include <nearfield/result.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace nearfield::solvers {

/// Answers penetration queries, for A's vertices or for samples of its boundary. Builds no tree for
/// polygons of few edges, so a batch of many small pairs costs little more than transforming the
/// vertices and testing the points found. Reuses its memory between batches.
class PenetrationSolver {
public:
    /// Forgets the previous pair: shapes may have moved or deformed since.
    void begin_batch() { before_ = {}; }

    void answer(const queries::CheckedQuery& query, Workspace& workspace,
                PenetrationResult& result);

    /// The same for shapes in their places, `a` and `b`, which permit the tolerance and, unless
    /// both are small, are ready if their boxes intersect: prepared for vertices, else complete.
    void answer(const PenetrationQuery& query, const queries::ShapePair& shapes,
                const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                PenetrationResult& result);

private:
    /// The pair answered last. Queries in both directions usually follow each other, and both share
    /// the answer to whether the shapes intersect.
    struct Before : queries::ShapePair {
        bool intersects = false;
        bool is_sampled = false;       // the crossings were found
        queries::PlacedPair placed{};  // of a workspace
    };

    /// Throws StatusException (too_large) if there may be more points than the batch has memory
    /// for.
    void require_room(const queries::CheckedQuery& query, const simd::TransformedEdges& a,
                      const simd::TransformedEdges& b, queries::QueryMemory& memory);
    /// Finds the vertices of A inside B, or those that may be the deepest, and returns how many
    /// others are deeper than `touching`.
    [[nodiscard]] std::uint32_t find_vertices_inside(const simd::TransformedEdges& a,
                                                     const simd::TransformedEdges& b,
                                                     bool summary_only, double touching);
    /// A point of A and its way out of B.
    struct WayOut {
        geometry::Vector point;
        geometry::Vector exit;  ///< the point of B's boundary nearest to `point`
        double depth;
        std::uint32_t edge;  ///< of B
        double parameter;    ///< position on the edge
        bool unique;
    };

    // Points of at most the depth `touching` touch B (shaders::touching_depth).

    /// Adds the points of inside_ to the summary if only the deepest point is requested.
    void add_deepest(double tolerance, const simd::TransformedEdges& b, PenetrationResult& result);
    [[nodiscard]] bool is_unique(const simd::TransformedEdges& b, const geometry::Vector& point,
                                 const narrowphase::NearestPoint& nearest, double margin);
    /// Adds the records of the points of inside_.
    void add_records(double tolerance, const simd::TransformedEdges& b, PenetrationResult& result);
    static void write(const WayOut& way, const simd::TransformedEdges& b, PenetratingPoint& record);

    narrowphase::Boundary boundary_;  // of B, if it has many edges
    narrowphase::OverlapTest overlap_test_;
    InsideSamples samples_;  // of A
    narrowphase::VerticesInside vertices_;
    simd::PointList inside_;              // points of A, some of them
    narrowphase::NearestPoints nearest_;  // to them
    narrowphase::DeepestPointFinder deepest_;
    // Edges of a small B near the points.
    std::array<std::uint32_t, simd::padded(simd::max_edges_one_by_one)> beside_{};
    Before before_;
};

}  // namespace nearfield::solvers
