#pragma once

#include <engine/cpu/inside_samples.hpp>
#include <engine/cpu/transformed_pair.hpp>
#include <engine/narrowphase/boundary.hpp>
#include <engine/narrowphase/deepest_point.hpp>
#include <engine/narrowphase/nearest_points.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/plan/plan.hpp>
#include <engine/simd/point_list.hpp>
#include <engine/simd/transformed_edges.hpp>
#include <nearfield/result.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace nearfield::cpu {

/// Answers penetration queries by Technique::cpu, from query to result, for A's vertices or for
/// samples of its boundary that are few enough to keep. Plans nothing and builds no tree for
/// polygons of few edges, so a batch of many small pairs costs little more than transforming the
/// vertices and testing the points found. Reuses its memory between batches.
class PointPenetration {
public:
    /// Forgets the previous pair: shapes may have moved or deformed since.
    void begin_batch() { last_ = {}; }

    /// Writes a result whose bound is set: its status and, if that is good, the rest.
    void answer(const plan::PlannedQuery& query, simd::TransformedInstances& instances,
                PenetrationResult& result);

    /// What is known from the same pair in the opposite order, if that was answered just before.
    struct Reverse {
        bool intersects = false;
        bool is_sampled = false;  ///< the crossings were found
    };
    /// The same for shapes in their places, which permit the tolerance and, unless both are small,
    /// are complete if their boxes intersect. `reverse`: null if nothing is known.
    void answer(const PenetrationQuery& query, const simd::TransformedEdges& a,
                const simd::TransformedEdges& b, const Reverse* reverse, PenetrationResult& result);

private:
    /// The pair of the previous query. Queries in both directions usually follow each other, and
    /// both share the answer to whether the shapes intersect.
    struct Pair {
        const plan::PlannedQuery* query = nullptr;
        InstancePairIndex index;
        Reverse known;
    };

    /// Finds the vertices of A inside B.
    void find_vertices_inside(const simd::PointArrays& vertices, const simd::TransformedEdges& b);
    /// A point of A and its way out of B.
    struct WayOut {
        geometry::Vector point;
        geometry::Vector exit;  ///< the point of B's boundary nearest to `point`
        double depth;
        std::uint32_t edge;  ///< of B
        double parameter;    ///< position on the edge
        bool unique;
    };

    // Points of at most the depth `touching` touch B (plan::touching_depth).

    /// Writes the summary if only the deepest point is requested.
    void write_deepest(double touching, double margin, const simd::TransformedEdges& b,
                       PenetrationResult& result);
    [[nodiscard]] bool is_unique(const simd::TransformedEdges& b, const geometry::Vector& point,
                                 const narrowphase::NearestPoint& nearest, double margin);
    /// Writes the records. Precondition: nearest_ has the points nearest to inside_.
    void write_records(double touching, const simd::TransformedEdges& b, PenetrationResult& result);
    static void write(const WayOut& way, const simd::TransformedEdges& b, PenetratingPoint& record);

    narrowphase::Boundary boundary_;  // of B, if it has many edges
    narrowphase::OverlapTest overlap_test_;
    InsideSamples samples_;               // of A
    simd::PointList inside_;              // points of A
    narrowphase::NearestPoints nearest_;  // to them
    narrowphase::DeepestPointFinder deepest_;
    // Edges of a small B near the points.
    std::array<std::uint32_t, simd::padded(simd::max_edges_one_by_one)> beside_{};
    Pair last_;
};

}  // namespace nearfield::cpu
