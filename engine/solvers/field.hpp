#pragma once

#include <engine/narrowphase/boundary.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/queries/field_grid.hpp>
#include <engine/queries/regions.hpp>
#include <engine/solvers/field_cells.hpp>
#include <engine/solvers/workspace.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::solvers {

/// Answers distance fields. Reuses its memory between batches.
class FieldSolver {
public:
    void answer(const queries::CheckedQuery& query, Workspace& workspace,
                DistanceFieldResult& result);
    /// The same, but counts what it needs as part of another budget, and leaves open whether the
    /// shapes intersect.
    void answer(const queries::CheckedQuery& query, Workspace& workspace,
                queries::MemoryBudget& memory, DistanceFieldResult& result);

private:
    // Each returns the largest magnitude of a distance, in world units.
    double solve_cells(const queries::CheckedQuery& query, queries::SimplifiedShapes& shapes,
                       DistanceFieldResult& result);
    double solve_points(const queries::CheckedQuery& query, DistanceFieldResult& result);
    /// `border`: number of extra cells solved around the grid.
    void write_features(const DistanceFieldQuery& query, const geometry::TransformedPolygon& b,
                        std::size_t border, DistanceFieldResult& result) const;
    void take_differences(const DistanceFieldQuery& query, DistanceFieldResult& result) const;

    /// The word the device would write for a point (shaders/layout.h). `guess`: an edge that may be
    /// near.
    [[nodiscard]] std::uint32_t word_at(const geometry::Vector& point, std::uint32_t guess,
                                        double cell);

    queries::FieldParts parts_;
    queries::Regions regions_;
    std::vector<queries::PlacedFieldPoint> points_;
    CellSolver solver_;
    narrowphase::Boundary boundary_;
    narrowphase::OverlapTest overlap_test_;
    std::vector<float> distances_;      // in cells; includes a border of one cell around the grid
    std::vector<std::uint32_t> words_;  // by cell
};

}  // namespace nearfield::solvers
