#pragma once

#include <engine/grid/field.hpp>
#include <engine/narrowphase/boundary.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/simplified_shapes.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::cpu {

/// Computes distance fields without the device (Technique::cpu). Reuses its memory between batches.
class ExactField {
public:
    /// Writes the result, except the rounding at large distances, which depends on the return
    /// value: the largest magnitude of a distance, in world units.
    double answer(const plan::Plan& plan, const plan::PlannedQuery& planned,
                  plan::SimplifiedShapes& shapes, DistanceFieldResult& result);

private:
    double solve_cells(const plan::PlannedQuery& planned, plan::SimplifiedShapes& shapes,
                       DistanceFieldResult& result);
    /// `border`: number of extra cells solved around the grid.
    void write_features(const DistanceFieldQuery& query, const geometry::TransformedPolygon& b,
                        std::size_t border, DistanceFieldResult& result) const;
    void take_differences(const DistanceFieldQuery& query, DistanceFieldResult& result) const;
    double solve_points(const plan::Plan& plan, const plan::PlannedQuery& planned,
                        DistanceFieldResult& result);

    /// The word the device would write for a point (shaders/layout.h). `guess`: an edge that may be
    /// near.
    [[nodiscard]] std::uint32_t word_at(const geometry::Vector& point, std::uint32_t guess,
                                        double cell);

    grid::FieldSolver solver_;
    narrowphase::Boundary boundary_;
    std::vector<float> distances_;      // in cells; includes a border of one cell around the grid
    std::vector<std::uint32_t> words_;  // by cell
};

}  // namespace nearfield::cpu
