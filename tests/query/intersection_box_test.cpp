#include <tests/query/pair.hpp>
#include <tests/query/query_test.hpp>

#include <algorithm>

namespace nearfield::test {
namespace {

class IntersectionBox : public QueryTest {};

TEST_F(IntersectionBox, IsThatOfTheSamplesWithThemAndWithout) {
    std::size_t found = 0;
    for_each_case(910, 8, [&](Random& random) {
        const Pair pair = any_pair(random);
        SCOPED_TRACE(describe(pair));
        for (const Technique technique : every_technique) {
            const PlacedPair placed(context(), pair, technique);
            for (const auto kind :
                 {IntersectionKind::volume_volume, IntersectionKind::boundary_volume,
                  IntersectionKind::boundary_boundary}) {
                SCOPED_TRACE(std::string(to_string(technique)) + ", kind " +
                             std::to_string(static_cast<int>(kind)));
                IntersectionQuery query = placed.intersection(kind);
                const IntersectionResult with = run_alone(context(), query);
                ASSERT_TRUE(with.status.ok()) << with.status.text();
                query.summary_only = true;
                const IntersectionResult without = run_alone(context(), query);
                ASSERT_TRUE(without.status.ok()) << without.status.text();
                EXPECT_EQ(without.count, with.count);
                if (with.count == 0) {
                    continue;
                }
                ++found;
                const Rectangle expected = box_of(with.samples);
                for (const Rectangle& box : {with.box, without.box}) {
                    EXPECT_NEAR(box.min.x, expected.min.x, 1e-9 * with.cell);
                    EXPECT_NEAR(box.min.y, expected.min.y, 1e-9 * with.cell);
                    EXPECT_NEAR(box.max.x, expected.max.x, 1e-9 * with.cell);
                    EXPECT_NEAR(box.max.y, expected.max.y, 1e-9 * with.cell);
                }
            }
        }
    });
    EXPECT_GT(found, 20U);
}

}  // namespace
}  // namespace nearfield::test
