#include <engine/geometry/offset_mesh.hpp>
#include <engine/plan/error_budget.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace nearfield::plan {
namespace {

TEST(ErrorBudget, NeverStatesMoreThanTheTolerance) {
    for (const double d : {1e-6, 0.3, 7e5}) {
        for (const double steps : {16.0, 256.0}) {
            const geometry::SubpixelGrid grid{steps};
            for (const auto points : {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
                PenetrationQuery query;
                query.tolerance = d;
                query.points = points;
                EXPECT_LE(penetration_budget(query).bound, d);
            }
            DistanceFieldQuery field;
            field.tolerance = d;
            const double drawn = field_budget(field, grid).bound;
            EXPECT_LE(drawn, d);
            field.technique = Technique::cpu;
            EXPECT_LE(field_budget(field, grid).bound, drawn);
            field.features = true;
            EXPECT_LE(field_budget(field, grid).bound, 0.002 * d);
        }
    }
}

TEST(ErrorBudget, AnIntersectionsTermsAddUpToTheTolerance) {
    const double d = 3.0;
    for (const double steps : {16.0, 256.0}) {
        const geometry::SubpixelGrid grid{steps};
        IntersectionQuery query;
        query.tolerance = d;
        for (const auto kind : {IntersectionKind::volume_volume, IntersectionKind::boundary_volume,
                                IntersectionKind::boundary_boundary}) {
            query.kind = kind;
            const ErrorBudget budget = intersection_budget(query, grid);
            const double move = grid.largest_move() * budget.cell;
            const double half_diagonal = budget.cell / std::sqrt(2.0);
            if (kind == IntersectionKind::volume_volume) {
                EXPECT_NEAR(half_diagonal + budget.simplification + move, d, 1e-12);
            } else {
                EXPECT_NEAR(budget.offset, half_diagonal + budget.simplification, 1e-12);
                EXPECT_NEAR(
                    geometry::offset_overreach * budget.offset + 3.0 * move + budget.simplification,
                    d, 1e-12);
            }
            EXPECT_LE(budget.bound, d);
        }
    }
}

}  // namespace
}  // namespace nearfield::plan
