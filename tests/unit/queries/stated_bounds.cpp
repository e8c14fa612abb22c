#include <engine/queries/check_query.hpp>
#include <engine/queries/error_budget.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace nearfield::queries {
namespace {

constexpr double root = std::numbers::sqrt2;
constexpr double precise = 1e-14;

/// Of A and B, in units of the tolerance: none, one alone, one larger than the other.
const std::vector<Deviations> deviations_of_one{{},           {0.2, 0.0},   {0.0, 0.2},
                                                {0.15, 0.05}, {0.05, 0.15}, {0.125, 0.125}};

/// Calls `check(d, deviations)` for each of them at several tolerances.
template <class Check>
void for_each_pair_of_deviations(const Check& check) {
    for (const double d : {1e-4, 0.3, 7e3}) {
        for (const Deviations& of_one : deviations_of_one) {
            SCOPED_TRACE(testing::Message()
                         << "d " << d << ", A " << of_one.a << " d, B " << of_one.b << " d");
            check(d, Deviations{of_one.a * d, of_one.b * d});
        }
    }
}

/// What a raster's rounding of vertices moves them by, in cells.
double snapping(double steps) {
    return root / 2.0 / steps;
}

// All expected values are those that docs/error_budget.md derives.

TEST(StatedBounds, PenetrationAddsSamplingRoundingAndBothDeviations) {
    for_each_pair_of_deviations([](double d, const Deviations& deviations) {
        PenetrationQuery query;
        query.tolerance = d;
        ErrorBudget budget = penetration_budget(query, deviations);
        EXPECT_NEAR(budget.bound, d * (root / 2.0 + 1.0 / 1024.0) + deviations.a + deviations.b,
                    precise * d);
        EXPECT_NEAR(budget.cell, root * d, precise * d);
        query.points = PenetrationPoints::vertices;
        budget = penetration_budget(query, deviations);
        EXPECT_NEAR(budget.bound, d / 1024.0 + deviations.a + deviations.b, precise * d);
        EXPECT_NEAR(budget.tessellation, deviations.a + deviations.b, precise * d);
    });
}

TEST(StatedBounds, ContactsAddSamplingRoundingAndBothDeviations) {
    for_each_pair_of_deviations([](double d, const Deviations& deviations) {
        const ErrorBudget budget = contact_budget(d, deviations);
        EXPECT_NEAR(budget.bound, d * (root / 2.0 + 1.0 / 1024.0) + deviations.a + deviations.b,
                    precise * d);
        EXPECT_NEAR(budget.tessellation, deviations.a + deviations.b, precise * d);
    });
}

TEST(StatedBounds, FieldsByTheDeviceAddSimplificationMeshSnappingAndTheDeviationOfB) {
    for_each_pair_of_deviations([](double d, const Deviations& deviations) {
        DistanceFieldQuery query;
        query.tolerance = d;
        for (const Technique technique : {Technique::raster, Technique::compute}) {
            query.technique = technique;
            const ErrorBudget budget =
                field_budget(query, geometry::SubpixelGrid{256.0}, deviations);
            const double cell = root * d;
            const double rest = cell * (1.0 / 8.0 + 2.0 * snapping(256.0) + 1.0 / 1024.0);
            EXPECT_NEAR(budget.bound, d / 4.0 + rest + deviations.b, precise * d);
            EXPECT_LE(budget.bound, d);
            EXPECT_NEAR(budget.simplification, d / 4.0, precise * d);
            EXPECT_NEAR(budget.mesh, cell / 8.0, precise * d);
        }
    });
}

TEST(StatedBounds, FieldsOfACoarseRasterHaveALargerMeshAndLessSimplification) {
    for_each_pair_of_deviations([](double d, const Deviations& deviations) {
        DistanceFieldQuery query;
        query.tolerance = d;
        query.technique = Technique::raster;
        const ErrorBudget budget = field_budget(query, geometry::SubpixelGrid{16.0}, deviations);
        const double rest = root * d * (12.0 * snapping(16.0) + 1.0 / 1024.0);
        EXPECT_NEAR(budget.mesh, root * d * 10.0 * snapping(16.0), precise * d);
        EXPECT_NEAR(budget.simplification, 0.9 * (d - rest - deviations.b), precise * d);
        EXPECT_NEAR(budget.bound, budget.simplification + rest + deviations.b, precise * d);
        EXPECT_LE(budget.bound, d);
    });
}

TEST(StatedBounds, FieldsOnTheCpuSimplifyOnlyWhereNoFeatureIsRequested) {
    for_each_pair_of_deviations([](double d, const Deviations& deviations) {
        DistanceFieldQuery query;
        query.tolerance = d;
        query.technique = Technique::cpu;
        const geometry::SubpixelGrid grid{256.0};
        EXPECT_NEAR(field_budget(query, grid, deviations).bound,
                    d * (0.25 + 1.0 / 1024.0) + deviations.b, precise * d);
        query.features = true;
        EXPECT_NEAR(field_budget(query, grid, deviations).bound, d / 1024.0 + deviations.b,
                    precise * d);
    });
}

TEST(StatedBounds, IntersectionsGiveTheLargerDeviationRoomInTheCell) {
    for_each_pair_of_deviations([](double d, const Deviations& deviations) {
        const double larger = std::fmax(deviations.a, deviations.b);
        for (const double steps : {16.0, 256.0}) {
            const double m = root * snapping(steps);  // in units of half a cell's diagonal
            const double s = d / 16.0;
            IntersectionQuery query;
            query.tolerance = d;
            query.kind = IntersectionKind::volume_volume;
            ErrorBudget budget =
                intersection_budget(query, geometry::SubpixelGrid{steps}, deviations);
            EXPECT_EQ(budget.bound, d);
            EXPECT_NEAR(budget.cell, root * (d - s - larger) / (1.0 + m), precise * d);
            for (const auto kind :
                 {IntersectionKind::boundary_volume, IntersectionKind::boundary_boundary}) {
                query.kind = kind;
                budget = intersection_budget(query, geometry::SubpixelGrid{steps}, deviations);
                const double k = 1.0 / std::cos(std::numbers::pi / 8.0);
                const double h = (d - (k + 1.0) * (s + larger)) / (k + 3.0 * m);
                EXPECT_EQ(budget.bound, d);
                EXPECT_NEAR(budget.cell, root * h, precise * d);
                EXPECT_NEAR(budget.offset, h + s + larger, precise * d);
            }
        }
    });
}

TEST(StatedBounds, LeaveAQuarterOfTheToleranceToBothDeviations) {
    EXPECT_TRUE(check_deviations(1.0, {max_deviation, 0.0}, 1.0).ok());
    EXPECT_TRUE(check_deviations(1.0, {0.0, max_deviation}, 1.0).ok());
    const double more = std::nextafter(max_deviation, 1.0);
    EXPECT_FALSE(check_deviations(1.0, {more, 0.0}, 1.0).ok());
    EXPECT_FALSE(check_deviations(1.0, {0.0, more}, 1.0).ok());
    EXPECT_FALSE(check_deviations(1.0, {max_deviation / 2.0, more / 2.0 + 1e-9}, 1.0).ok());
    EXPECT_EQ(check_deviations(2.0, {0.2, 0.4}, 2.0).message(),
              "the shapes' rings may be off by 0.2 (A) and 0.4 (B), together more than 0.25 of the "
              "tolerance 2; tessellate finer, or ask for at least 2.4000000000000004");
    EXPECT_EQ(check_deviations(2.0, {0.0, 0.5}, 2.5).message(),
              "the shapes' rings may be off by 0 (A) and 0.5 (B), which with what this device's "
              "raster needs is 2.5, more than the tolerance 2; tessellate finer");
}

}  // namespace
}  // namespace nearfield::queries
