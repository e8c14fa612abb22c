#include <gtest/gtest-spi.h>
#include <tests/query/agreement.hpp>
#include <tests/query/query_test.hpp>

#include <functional>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

/// The comparison of two drivers must detect differences: an answer agrees with itself, and no
/// longer after one member is corrupted.
class Agreement : public QueryTest {
protected:
    template <class Result>
    using Spoilings = std::vector<std::pair<const char*, std::function<void(Result&)>>>;

    static Pair pair() {
        Random random(5);
        return {{"A", star(random, 14, 0.5)},
                {"B", star(random, 20, 0.7)},
                {},
                {{0.7, 0.3}, 0.5},
                0.02};
    }

    template <class Query>
    static void expect_noticed(const PlacedPair& placed, const Query& query,
                               const Spoilings<typename Query::Result>& spoilings) {
        const AnyQuery any = query;
        const auto good = run_alone(context(), query);
        ASSERT_TRUE(good.status.ok()) << good.status.text();
        for (const SubPixelGrids grids : {SubPixelGrids::same, SubPixelGrids::apart}) {
            check_agreement({placed, any, grids}, good, good);
        }
        for (const auto& [what, spoil] : spoilings) {
            SCOPED_TRACE(what);
            auto spoilt = good;
            spoil(spoilt);
            EXPECT_NONFATAL_FAILURE(
                check_agreement({placed, any, SubPixelGrids::same}, good, spoilt), "violations");
        }
    }
};

TEST_F(Agreement, OfPenetrationIsMissed) {
    const PlacedPair placed(context(), pair());
    const double d = placed.tolerance();
    expect_noticed(
        placed, placed.penetration(),
        {
            {"status", [](auto& r) { r.status = Status(StatusCode::device_error, "spoilt"); }},
            {"intersects", [](auto& r) { r.intersects = !r.intersects; }},
            {"technique", [](auto& r) { r.technique = Technique::compute; }},
            {"cell", [](auto& r) { r.cell *= 1.0 + 1e-15; }},
            {"bound", [](auto& r) { r.error_bound *= 1.0 + 1e-5; }},
            {"regions", [](auto& r) { ++r.regions.at(0).height; }},
            {"a record", [](auto& r) { r.points.erase(r.points.begin() + 5); }},
            {"point", [](auto& r) { r.points[5].position.x += 1e-12; }},
            {"depth", [](auto& r) { r.points[5].depth += 1e-12; }},
            {"direction", [](auto& r) { r.points[5].direction.x += 1e-12; }},
            {"unique", [](auto& r) { r.points[5].unique = !r.points[5].unique; }},
            {"another wall, as near",
             [&](auto& r) {
                 r.points[5].feature.index ^= 8U;
                 r.points[5].nearest.x += 0.5 * r.points[5].depth + d;
             }},
            {"deepest", [](auto& r) { r.deepest.depth *= 0.99; }},
        });
}

TEST_F(Agreement, OfContactsIsMissed) {
    const PlacedPair placed(context(), pair());
    expect_noticed(placed, placed.contacts(0.04),
                   {
                       {"a record", [](auto& r) { r.points.erase(r.points.begin()); }},
                       {"side", [](auto& r) { r.points[3].on = Side::b; }},
                       {"inside", [](auto& r) { r.points[3].inside = !r.points[3].inside; }},
                       {"normal", [](auto& r) { r.points[3].normal.y += 1e-12; }},
                       {"distance", [](auto& r) { r.points[3].distance += 1e-12; }},
                       {"manifold", [](auto& r) { r.manifold[0].first.x += 1e-12; }},
                   });
}

TEST_F(Agreement, OfIntersectionsIsMissed) {
    const PlacedPair placed(context(), pair());
    expect_noticed(placed, placed.intersection(IntersectionKind::boundary_volume),
                   {
                       {"count", [](auto& r) { ++r.count; }},
                       {"area", [](auto& r) { r.area *= 1.0 + 1e-15; }},
                       {"box", [](auto& r) { r.box.max.x += 1e-12; }},
                       {"a sample", [](auto& r) { r.samples.pop_back(); }},
                       {"sample", [](auto& r) { r.samples[9].position.x += 1e-12; }},
                       {"edge", [](auto& r) { r.samples[9].edge ^= 1U; }},
                   });
}

TEST_F(Agreement, OfFieldsIsMissed) {
    const PlacedPair placed(context(), pair());
    const std::vector<Vector2> points{{0.7, 0.3}, {0.1, 0.2}};
    DistanceFieldQuery query{placed.instance_a(), placed.instance_b(), 0.04};
    query.technique = Technique::raster;
    query.features = query.gradients = true;
    query.points = points;
    expect_noticed(
        placed, query,
        {
            {"grid", [](auto& r) { ++r.width; }},
            {"value", [](auto& r) { r.values[40] += static_cast<float>(2.1 * r.error_bound); }},
            {"sign", [](auto& r) { r.values[40] = -r.values[40]; }},
            {"feature", [](auto& r) { r.features[40].index = (r.features[40].index + 7) % 20; }},
            {"unique", [](auto& r) { r.unique[40] = static_cast<std::uint8_t>(1 - r.unique[40]); }},
            {"gradient", [](auto& r) { r.gradients[80] += 1e-5F; }},
            {"no gradients", [](auto& r) { r.gradients.clear(); }},
            {"point", [](auto& r) { r.points[1].distance += 2.1 * r.points[1].error_bound; }},
            {"inside", [](auto& r) { r.points[1].inside += 0.25; }},
            {"point's feature", [](auto& r) { r.points[1].feature.index ^= 8U; }},
        });
}

TEST_F(Agreement, OfWhatIsFinishedExactlyIsMissed) {
    Pair apart = pair();
    apart.pose_b.translation = {3.0, 1.0};
    const PlacedPair placed(context(), apart);
    expect_noticed(placed, placed.separation(),
                   {
                       {"distance", [](auto& r) { r.distance += 1e-12; }},
                       {"place", [](auto& r) { r.point_a.x += 0.03; }},
                       {"unique", [](auto& r) { r.unique = !r.unique; }},
                       {"sampled", [](auto& r) { r.sampled_distance *= 1.001; }},
                   });
    expect_noticed(placed, SeparationVectorQuery{placed.instance_a(), placed.instance_b(), 0.02},
                   {{"work", [](auto& r) { ++r.work; }}});
}

}  // namespace
}  // namespace nearfield::test
