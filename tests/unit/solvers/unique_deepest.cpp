#include <engine/queries/error_budget.hpp>
#include <engine/solvers/penetration.hpp>

#include <gtest/gtest.h>
#include <tests/unit/solvers/test_workspace.hpp>
#include <tests/unit/support/awkward_shapes.hpp>

#include <cmath>
#include <vector>

namespace nearfield::solvers {
namespace {

using geometry::Polygon;

constexpr double d = 0.02;

/// The answer for A's vertices in B, with records or the summary alone.
PenetrationResult answer(const Polygon& a, const Polygon& b, const Pose& pose_a, bool records) {
    PenetrationQuery query;
    query.a.pose = pose_a;
    query.tolerance = d;
    query.points = PenetrationPoints::vertices;
    query.summary_only = !records;
    const AnyQuery asked = query;
    queries::CheckedQuery checked;
    checked.query = &asked;
    checked.a = &a;
    checked.b = &b;
    checked.pose_a = pose_a;
    checked.budget = queries::penetration_budget(query);
    PenetrationResult result;
    result.tolerance = d;
    result.cell = checked.budget.cell;
    TestWorkspace workspace;
    PenetrationSolver penetration;
    penetration.begin_batch();
    penetration.answer(checked, workspace, result);
    EXPECT_TRUE(result.status.ok()) << result.status.text();
    return result;
}

/// A triangle with its tip at the origin.
Polygon tip() {
    return samples::polygon({{{0.0, 0.0}, {1.0, 9.0}, {-1.0, 9.0}}});
}

/// A ring with its long sides cut into many edges, so that it is or is not of few edges.
Ring bar(double half_width, std::uint32_t pieces) {
    Ring ring;
    for (std::uint32_t i = 0; i <= pieces; ++i) {
        ring.push_back({half_width, -4.0 + 8.0 * i / pieces});
    }
    for (std::uint32_t i = 0; i <= pieces; ++i) {
        ring.push_back({-half_width, 4.0 - 8.0 * i / pieces});
    }
    return ring;
}

TEST(UniqueDeepest, WithoutRecordsItIsThatOfTheRecords) {
    test::Random random(611);
    const std::vector<test::NamedRings> awkward = samples::awkward_shapes(random);
    std::uint32_t unique = 0;
    std::uint32_t several = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        const bool walls = i % 2 == 0;
        const auto any_b = [&]() -> test::Rings {
            if (walls) {
                return {bar(1.0, 1 + random.below(300))};
            }
            // A tree of boxes does not tell which edge of these is near.
            return i % 100 == 1 ? awkward[i / 100 % awkward.size()].rings
                                : test::star(random, random.whole(3, 302), 0.4);
        };
        const Polygon a = walls ? tip()
                                : samples::polygon(test::scaled_and_moved(
                                      test::star(random, random.whole(3, 62), 0.125), 0.8, {}));
        const Polygon b = samples::polygon(any_b());
        const Pose pose =
            walls ? Pose{{random.between(-1e-3, 1e-3) * d, random.between(-1.0, 1.0)}, 0.0}
                  : Pose{{random.between(-0.5, 0.5), random.between(-0.5, 0.5)}, 0.4};
        const PenetrationResult with = answer(a, b, pose, true);
        const PenetrationResult without = answer(a, b, pose, false);
        ASSERT_EQ(without.count, with.count);
        if (with.count > 0) {
            EXPECT_NEAR(without.deepest.depth, with.deepest.depth, 1e-12);
            EXPECT_EQ(without.deepest.position, with.deepest.position);
            EXPECT_EQ(without.deepest.unique, with.deepest.unique);
            ++(with.deepest.unique ? unique : several);
        }
    }
    EXPECT_GT(unique, 500U);
    EXPECT_GT(several, 200U);
}

}  // namespace
}  // namespace nearfield::solvers
