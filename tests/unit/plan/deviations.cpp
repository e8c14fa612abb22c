#include <engine/geometry/offset_mesh.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/error_budget.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace nearfield::plan {
namespace {

constexpr double d = 2.0;
const geometry::SubpixelGrid usual{256.0};

TEST(Deviations, ArePartOfTheBoundAndLeaveItWithinTheTolerance) {
    for (const double share : {0.0, 0.03, 0.125}) {
        const Deviations deviations{share * d, max_deviation * d - share * d};
        PenetrationQuery penetration;
        penetration.tolerance = d;
        EXPECT_DOUBLE_EQ(penetration_budget(penetration, deviations).bound,
                         penetration_budget(penetration).bound + deviations.a + deviations.b);
        EXPECT_LE(penetration_budget(penetration, deviations).bound, d);

        DistanceFieldQuery field;
        field.tolerance = d;
        EXPECT_DOUBLE_EQ(field_budget(field, usual, deviations).bound,
                         field_budget(field, usual).bound + deviations.b);
        EXPECT_LE(field_budget(field, usual, deviations).bound, d);
    }
}

TEST(Deviations, TakeTheirShareOfAnIntersectionsTolerance) {
    const Deviations deviations{0.1 * d, 0.15 * d};
    for (const double steps : {16.0, 256.0}) {
        const geometry::SubpixelGrid grid{steps};
        IntersectionQuery query;
        query.tolerance = d;
        for (const auto kind : {IntersectionKind::volume_volume, IntersectionKind::boundary_volume,
                                IntersectionKind::boundary_boundary}) {
            query.kind = kind;
            const ErrorBudget budget = intersection_budget(query, grid, deviations);
            const double move = grid.largest_move() * budget.cell;
            const double half_diagonal = budget.cell / std::numbers::sqrt2;
            EXPECT_GT(budget.cell, 0.0);
            EXPECT_EQ(budget.tessellation, deviations.b);
            if (kind == IntersectionKind::volume_volume) {
                EXPECT_NEAR(half_diagonal + budget.simplification + move + budget.tessellation, d,
                            1e-12);
            } else {
                EXPECT_NEAR(budget.offset,
                            half_diagonal + budget.simplification + budget.tessellation, 1e-12);
                EXPECT_NEAR(geometry::offset_overreach * budget.offset + 3.0 * move +
                                budget.simplification + budget.tessellation,
                            d, 1e-12);
            }
        }
    }
}

TEST(Deviations, OfMoreThanTheirShareAreRefused) {
    EXPECT_TRUE(check_deviations(d, {0.2, 0.3}, d).ok());
    EXPECT_EQ(check_deviations(d, {0.2, 0.4}, d).message(),
              "the shapes' rings may be off by 0.2 (A) and 0.4 (B), together more than 0.25 of the "
              "tolerance 2; tessellate finer, or ask for at least 2.4000000000000004");
    EXPECT_EQ(check_deviations(d, {0.0, 0.5}, 2.5).message(),
              "the shapes' rings may be off by 0 (A) and 0.5 (B), which with what this device's "
              "raster needs is 2.5, more than the tolerance 2; tessellate finer");
}

}  // namespace
}  // namespace nearfield::plan
