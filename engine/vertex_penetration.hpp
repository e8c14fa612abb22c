#pragma once

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

/// Penetration of the vertices of A by Technique::cpu, from query to result: nothing is planned and
/// no tree is made for polygons of few edges, so that a batch of many small pairs costs little
/// more than placing its vertices. Keeps its memory from batch to batch.
class VertexPenetration {
public:
    /// Forgets the pair before: shapes may have moved or deformed since.
    void begin_batch() { last_ = {}; }

    /// Writes a result that says its bound already: its status, and if that is good the rest.
    void answer(const plan::PlannedQuery& query, exact::PlacedInstances& instances,
                PenetrationResult& result);

private:
    /// The pair last asked about. Who asks both ways asks so in turn, and whether shapes meet is
    /// the same both ways.
    struct Pair {
        InstancePairIndex index;
        bool intersects = false;
    };

    void find_penetrating(const exact::PlacedEdges& a, const exact::PlacedEdges& b,
                          PenetrationResult& result, bool keep_records);
    /// Lists A's vertices inside B, and finds what is nearest to them where B is small.
    [[nodiscard]] std::span<const std::uint32_t> find_inside(const exact::PlacedEdges& a,
                                                             const exact::PlacedEdges& b);
    /// Of the vertex that was listed as number i.
    [[nodiscard]] exact::NearestPoint find_nearest(const exact::PlacedEdges& b, std::size_t i,
                                                   const geometry::Vector& point);
    [[nodiscard]] ResolvedPoint resolve(const exact::PlacedEdges& b, const geometry::Vector& point,
                                        const exact::NearestPoint& nearest);
    [[nodiscard]] bool is_unique(const exact::PlacedEdges& b, const geometry::Vector& point,
                                 const exact::NearestPoint& nearest);

    exact::Boundary boundary_;  // of B, where it has many edges
    exact::MeetingFinder meeting_;
    std::vector<std::uint32_t> inside_;     // vertices of A
    std::vector<exact::NearEdge> nearest_;  // to them, of a small B
    std::array<std::uint32_t, exact::padded(exact::most_edges_one_by_one)> near_;  // edges of B
    double margin_ = 0.0;                                                          // of uniqueness
    Pair last_;
};

}  // namespace nearfield
