#pragma once

#include <engine/exact/boundary.hpp>
#include <engine/exact/deepest_point.hpp>
#include <engine/exact/meeting.hpp>
#include <engine/exact/nearest_points.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/inside_samples.hpp>
#include <engine/placed_pair.hpp>
#include <engine/plan/plan.hpp>
#include <engine/point_list.hpp>
#include <nearfield/result.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace nearfield {

/// Penetration by Technique::cpu of the vertices of A, or of samples of its boundary where they are
/// not too many to keep, from query to result: nothing is planned and no boxes are made for
/// polygons of few edges, so that a batch of many small pairs costs little more than placing its
/// vertices and looking at the points found. Keeps its memory from batch to batch.
class PointPenetration {
public:
    /// Forgets the pair before: shapes may have moved or deformed since.
    void begin_batch() { last_ = {}; }

    /// Writes a result that says its bound already: its status, and if that is good the rest.
    void answer(const plan::PlannedQuery& query, exact::PlacedInstances& instances,
                PenetrationResult& result);

private:
    /// The pair asked about by the query before. Who asks both ways asks so in turn, and whether
    /// shapes meet is the same both ways.
    struct Pair {
        const plan::PlannedQuery* query = nullptr;
        InstancePairIndex index;
        bool intersects = false;
        bool is_sampled = false;  ///< where boundaries cross was found
    };

    /// Of A's vertices.
    void find_vertices_inside(const exact::PointArrays& vertices, const exact::PlacedEdges& b);
    /// From a point of A, and what is known of it.
    struct WayOut {
        geometry::Vector point;
        geometry::Vector exit;  ///< the point of B's boundary nearest to it
        double depth;
        std::uint32_t edge;  ///< of B
        double parameter;    ///< where on it
        bool unique;
    };

    // Points nearer to B's boundary than `touching` are on it.

    /// Where no more than the deepest point is asked for.
    void write_deepest(double touching, double margin, const exact::PlacedEdges& b,
                       PenetrationResult& result);
    [[nodiscard]] bool is_unique(const exact::PlacedEdges& b, const geometry::Vector& point,
                                 const exact::NearestPoint& nearest, double margin);
    /// Once what is nearest to the points was found.
    void write_records(double touching, const exact::PlacedEdges& b, PenetrationResult& result);
    static void write(const WayOut& way, const exact::PlacedEdges& b, PenetrationRecord& record);

    exact::Boundary boundary_;  // of B, where it has many edges
    exact::MeetingFinder meeting_;
    InsideSamples samples_;         // of A
    PointList inside_;              // points of A
    exact::NearestPoints nearest_;  // to them
    exact::DeepestPointFinder deepest_;
    // Edges of a small B, beside the points.
    std::array<std::uint32_t, exact::padded(exact::most_edges_one_by_one)> beside_{};
    Pair last_;
};

}  // namespace nearfield
