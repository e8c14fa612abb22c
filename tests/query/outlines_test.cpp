#include <tests/oracle/overlap.hpp>
#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <optional>

namespace nearfield::test {
namespace {

class Outlines : public QueryTest {};

/// B's pose for an overlap of `share` of the smaller area. Long outlines may need rotation to reach
/// that overlap.
std::optional<Pose> overlapping_pose(const oracle::ShapeOracle& a, const Rings& b, double share) {
    for (const double angle : {0.0, 0.8, 1.6, 2.4}) {
        const auto pose = oracle::pose_for_overlap(a, b, angle, {1.0, 0.35}, share);
        if (pose) {
            return pose;
        }
    }
    return std::nullopt;
}

TEST_F(Outlines, PenetrateByEveryShare) {
    const std::vector<NamedRings> outlines = read_outlines(NEARFIELD_TEST_DATA);
    ASSERT_EQ(outlines.size(), 6U);
    int checked = 0;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const oracle::ShapeOracle a(outlines[i].rings);
        for (std::size_t j = i + 1; j < outlines.size(); ++j) {
            for (const double share : {0.01, 0.1, 0.5}) {
                const auto pose = overlapping_pose(a, outlines[j].rings, share);
                if (!pose) {
                    continue;
                }
                const Rectangle common =
                    oracle::overlap(a, oracle::ShapeOracle(outlines[j].rings, *pose)).box;
                const double side =
                    std::max(common.max.x - common.min.x, common.max.y - common.min.y);
                // Every other pair is swapped, so that each outline serves as A and as B.
                Pair pair{outlines[i], outlines[j], {}, *pose, side / 256};
                if ((i + j) % 2 == 0) {
                    std::swap(pair.a, pair.b);
                    std::swap(pair.pose_a, pair.pose_b);
                }
                const PlacedPair placed(context(), std::move(pair));
                SCOPED_TRACE(describe(placed.pair()) + "\noverlap " + std::to_string(share));
                for (const auto points :
                     {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
                    const auto result = run_alone(context(), placed.penetration(points));
                    check_penetration(placed, points, result);
                    EXPECT_GT(result.count, 0U);
                }
                ++checked;
            }
        }
    }
    EXPECT_GE(checked, 40);
}

}  // namespace
}  // namespace nearfield::test
