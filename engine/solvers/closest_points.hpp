#pragma once

#include <engine/narrowphase/closest_pair.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/solvers/nearest_feature.hpp>
#include <engine/solvers/workspace.hpp>
#include <nearfield/result.hpp>

namespace nearfield::solvers {

/// Answers closest points and separations, by an exact search for the closest pair.
class ClosestSolver {
public:
    void answer(const queries::CheckedQuery& query, Workspace& workspace,
                ClosestPointResult& result);
    void answer(const queries::CheckedQuery& query, Workspace& workspace, SeparationResult& result);

    /// What is known before the search.
    struct Known {
        bool intersect = false;
        double at_most = 0.0;  ///< an upper bound on the distance of shapes that do not
    };
    /// The same for complete shapes that permit the tolerance.
    void answer(const queries::CheckedQuery& query, const simd::TransformedEdges& a,
                const simd::TransformedEdges& b, const Known& known, SeparationResult& result);

private:
    /// Precondition: complete, separate shapes.
    void answer_apart(const queries::CheckedQuery& query, const simd::TransformedEdges& a,
                      const simd::TransformedEdges& b, double at_most, SeparationResult& result);

    narrowphase::ClosestPairFinder finder_;
    narrowphase::OverlapTest overlap_test_;
};

/// Writes the closest points of two shapes, the direction between them and the features that they
/// are on.
template <class Result>
void write_closest(const geometry::TransformedPolygon& a, const geometry::TransformedPolygon& b,
                   const narrowphase::ClosestPair& pair, double distance, Result& result) {
    result.point_a = geometry::to_public(pair.point_a);
    result.point_b = geometry::to_public(pair.point_b);
    if (distance > 0.0) {
        result.direction = geometry::to_public((pair.point_b - pair.point_a) / distance);
    }
    result.feature_a = feature_at(a, pair.edge_a, pair.parameter_a);
    result.feature_b = feature_at(b, pair.edge_b, pair.parameter_b);
}

/// A's side of a separation: its closest point to B.
void take_closest_point(SeparationResult&& separation, ClosestPointResult& result);

}  // namespace nearfield::solvers
