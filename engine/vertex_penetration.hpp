#pragma once

#include <engine/exact/boundary.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/plan/plan.hpp>
#include <engine/point_resolver.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <vector>

namespace nearfield {

/// Penetration of the vertices of A by Technique::cpu, from query to result: nothing is planned and
/// no tree is made for polygons of few edges, so that a batch of many small pairs costs little
/// more than placing its vertices. Keeps its memory from batch to batch.
class VertexPenetration {
public:
    /// Forgets where the shapes were: they may have moved or deformed since.
    void begin_batch() { instances_.clear(); }

    /// Writes a result that says its bound already: its status, and if that is good the rest.
    void answer(const plan::PlannedQuery& query, PenetrationResult& result);

private:
    void find_penetrating(const exact::PlacedEdges& a, const exact::PlacedEdges& b,
                          PenetrationResult& result, bool keep_records);
    [[nodiscard]] ResolvedPoint resolve(const exact::PlacedEdges& b, const geometry::Vector& point);
    /// Of the point last resolved.
    [[nodiscard]] bool is_unique(const exact::PlacedEdges& b, const ResolvedPoint& resolved);

    exact::PlacedInstances instances_;
    exact::Boundary boundary_;               // of B, where it has many edges
    std::vector<double> squared_distances_;  // of the point last resolved, by edge of a small B
    double margin_ = 0.0;                    // of uniqueness
};

}  // namespace nearfield
