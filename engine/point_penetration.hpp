#pragma once

#include <engine/edge_samples.hpp>
#include <engine/edges_near_points.hpp>
#include <engine/exact/boundary.hpp>
#include <engine/exact/meeting.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/placed_pair.hpp>
#include <engine/plan/plan.hpp>
#include <engine/point_resolver.hpp>
#include <nearfield/result.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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
    };

    /// Of points of A. Those nearer to B's boundary than `touching` are on it.
    void find_penetrating(const exact::PointArrays& points, double touching,
                          const exact::PlacedEdges& b, PenetrationResult& result,
                          bool keep_records);
    /// Lists the points inside B, and finds what is nearest to them where B is small.
    [[nodiscard]] std::span<const std::uint32_t> find_inside(const exact::PointArrays& points,
                                                             const exact::PlacedEdges& b);
    /// Of the point that was listed as number i; in order, so that each is near the one before.
    [[nodiscard]] exact::NearestPoint find_nearest(const exact::PlacedEdges& b, std::size_t i,
                                                   const geometry::Vector& point);
    /// Likewise.
    [[nodiscard]] ResolvedPoint resolve(const exact::PlacedEdges& b, std::size_t i,
                                        const geometry::Vector& point,
                                        const exact::NearestPoint& nearest);
    [[nodiscard]] bool is_unique(const exact::PlacedEdges& b, std::size_t i,
                                 const geometry::Vector& point, const exact::NearestPoint& nearest);

    exact::Boundary boundary_;  // of B, where it has many edges
    exact::MeetingFinder meeting_;
    EdgeSamples samples_;     // of A
    EdgesNearPoints near_b_;  // of a small B, near the points inside
    // Edges of a small B, beside the points.
    std::array<std::uint32_t, exact::padded(exact::most_edges_one_by_one)> beside_{};
    std::vector<std::uint32_t> inside_;         // points of A
    std::vector<exact::NearestEdges> nearest_;  // to them, of near_b_
    std::uint32_t near_last_ = 0;               // an edge of B near the last point
    double margin_ = 0.0;                       // of uniqueness
    Pair last_;
};

}  // namespace nearfield
