#pragma once

#include <engine/exact/boundary.hpp>
#include <engine/exact/field.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/simplified_shapes.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <vector>

namespace nearfield {

/// Distance fields without the device (Technique::cpu). Keeps its memory from batch to batch.
class ExactField {
public:
    /// Fills in everything but the rounding at large distances, which depends on the return value:
    /// the largest magnitude of a distance, world units.
    double answer(const plan::Plan& plan, const plan::PlannedQuery& planned,
                  plan::SimplifiedShapes& shapes, DistanceFieldResult& result);

private:
    double solve_cells(const plan::PlannedQuery& planned, plan::SimplifiedShapes& shapes,
                       DistanceFieldResult& result);
    /// `border`: cells around the grid that were solved too.
    void write_features(const DistanceFieldQuery& query, const geometry::PlacedPolygon& b,
                        std::size_t border, DistanceFieldResult& result) const;
    void take_differences(const DistanceFieldQuery& query, DistanceFieldResult& result) const;
    double solve_points(const plan::Plan& plan, const plan::PlannedQuery& planned,
                        DistanceFieldResult& result);

    /// What the device would say of a point (gpu_layout.hpp). `guess`: an edge that may be near.
    [[nodiscard]] std::uint32_t word_at(const geometry::Vector& point, std::uint32_t guess,
                                        double cell);

    exact::FieldSolver solver_;
    exact::Boundary boundary_;
    std::vector<float> distances_;      // in cells, of the grid and a border of one cell around it
    std::vector<std::uint32_t> words_;  // by cell
};

}  // namespace nearfield
