#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

namespace nearfield::test {
namespace {

class Localization : public QueryTest {};

/// Results stay correct for all bounding volumes and heights of the hierarchies.
TEST_F(Localization, NoSettingChangesWhatIsTrue) {
    for (const auto volume : {BoundingVolume::axis_aligned, BoundingVolume::oriented}) {
        for (const std::uint32_t height : {0U, 3U, 16U}) {
            Settings settings;
            settings.bounding_volume = volume;
            settings.hierarchy_height = height;
            auto made = Context::create(host_device(), on_demand(settings));
            ASSERT_TRUE(made.has_value()) << made.error().text();
            const std::uint64_t seed = 40 + height;
            std::vector<Pair> pairs = family_pairs(seed);
            Random random(seed);
            for (int i = 0; i < random_cases(1); ++i) {
                pairs.push_back(any_pair(random));
            }
            for (Pair& one : pairs) {
                SCOPED_TRACE("height " + std::to_string(height) + '\n' + describe(one));
                const double near = 2.0 * one.tolerance;
                const PlacedPair pair(*made, std::move(one));
                for (const PenetrationPoints points : both_ways) {
                    check_penetration(pair, points, run_alone(*made, pair.penetration(points)));
                }
                check_contacts(pair, near, run_alone(*made, pair.contacts(near)));
                check_separation(pair, run_alone(*made, pair.separation()));
                for (const IntersectionKind kind : every_kind) {
                    check_intersection(pair, kind, run_alone(*made, pair.intersection(kind)));
                }
            }
        }
    }
}

/// A thin band along a slanted line, with many vertices.
Ring slanted_band(double x, double y) {
    constexpr int steps = 64;
    Ring ring;
    for (int i = 0; i <= steps; ++i) {
        ring.push_back({x + 0.1 * i, y + 0.1 * i});
    }
    for (int i = steps; i >= 0; --i) {
        ring.push_back({x + 0.1 * i - 0.05, y + 0.1 * i + 0.05});
    }
    return ring;
}

TEST_F(Localization, StatisticsCountAndOrientedBoxesNeedLess) {
    std::vector<LocalizationStatistics> statistics;
    const Ring band = slanted_band(0.0, 0.0);
    const Ring beside = slanted_band(0.1, -0.1);
    for (const auto volume : {BoundingVolume::axis_aligned, BoundingVolume::oriented}) {
        Settings settings;
        settings.bounding_volume = volume;
        settings.hierarchy_height = 3;
        auto made = Context::create(host_device(), on_demand(settings));
        ASSERT_TRUE(made.has_value()) << made.error().text();
        const auto a = made->add_shape({&band, 1});
        const auto b = made->add_shape({&beside, 1});
        ASSERT_TRUE(a.has_value() && b.has_value());
        PenetrationQuery query;
        query.technique = Technique::raster;
        query.a = {*a, {}};
        query.b = {*b, {}};
        query.tolerance = 0.05;
        const PenetrationResult result = run_alone(*made, query);
        ASSERT_TRUE(result.status.ok()) << result.status.text();
        EXPECT_EQ(result.count, 0U);
        EXPECT_FALSE(result.intersects);
        statistics.push_back(result.localization);
    }
    EXPECT_GT(statistics[0].edges_kept, 0U);
    EXPECT_GT(statistics[0].pairs_rejected, 0U);
    EXPECT_EQ(statistics[1].edges_kept, 0U);
    EXPECT_LT(statistics[1].nodes_evaluated, statistics[0].nodes_evaluated);
}

TEST_F(Localization, FarShapesCostTheirTopLevelBoxes) {
    const Ring square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const auto shape = context().add_shape({&square, 1});
    ASSERT_TRUE(shape.has_value());
    PenetrationQuery query;
    query.technique = Technique::raster;
    query.a = {*shape, {}};
    query.b = {*shape, {{5, 0}, 0.0}};
    query.tolerance = 0.1;
    const LocalizationStatistics statistics = run_alone(context(), query).localization;
    EXPECT_EQ(statistics.nodes_evaluated, 2U);
    EXPECT_EQ(statistics.pairs_rejected, 1U);
    EXPECT_EQ(statistics.edges_kept, 0U);
    EXPECT_TRUE(context().remove_shape(*shape).ok());
}

}  // namespace
}  // namespace nearfield::test
