#include <gtest/gtest-spi.h>
#include <tests/query/agreement.hpp>
#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

/// Members of a result that are corrupted, one at a time.
template <class Result>
using Spoilings = std::vector<std::pair<const char*, std::function<void(Result&)>>>;

/// The checks must detect violations: a correct result passes, and fails after one member is
/// corrupted.
class Laws : public QueryTest {
protected:
    static Pair pair() {
        Random random(5);
        return {{"A", star(random, 14, 0.5)},
                {"B", star(random, 20, 0.7)},
                {},
                {{0.7, 0.3}, 0.5},
                0.02};
    }
    template <class Result, class Check>
    static void expect_noticed(const Result& good, const Check& check,
                               const Spoilings<Result>& spoilings) {
        check(good);
        for (const auto& [what, spoil] : spoilings) {
            SCOPED_TRACE(what);
            Result spoilt = good;
            spoil(spoilt);
            EXPECT_NONFATAL_FAILURE(check(spoilt), "violations");
        }
    }
};

/// The record nearest to half the maximum depth: not a special case for any check.
PenetratingPoint& ordinary(PenetrationResult& result) {
    return *std::min_element(result.points.begin(), result.points.end(),
                             [&](const PenetratingPoint& a, const PenetratingPoint& b) {
                                 const double half = result.deepest.depth / 2;
                                 return std::abs(a.depth - half) < std::abs(b.depth - half);
                             });
}

TEST_F(Laws, OfPenetrationNoticeEverySpoiling) {
    const PlacedPair placed(context(), pair());
    const auto points = PenetrationPoints::boundary;
    const PenetrationResult good = run_alone(context(), placed.penetration(points));
    ASSERT_GT(good.points.size(), 20U);
    const double d = placed.tolerance();
    const auto check = [&](const PenetrationResult& result) {
        check_penetration(placed, points, result);
    };
    expect_noticed<PenetrationResult>(
        good, check,
        {
            {"status", [](auto& r) { r.status = Status(StatusCode::device_error, "spoilt"); }},
            {"intersects", [](auto& r) { r.intersects = false; }},
            {"error bound", [&](auto& r) { r.error_bound = 1.01 * d; }},
            {"count", [](auto& r) { ++r.count; }},
            {"point", [&](auto& r) { ordinary(r).position.x += 1e-4 * d; }},
            {"depth", [&](auto& r) { ordinary(r).depth += 0.01 * d; }},
            {"nearest", [&](auto& r) { ordinary(r).nearest.y += 1e-4 * d; }},
            {"direction", [](auto& r) { ordinary(r).direction.x *= -1; }},
            {"feature",
             [](auto& r) { ordinary(r).feature.index = (ordinary(r).feature.index + 7) % 20; }},
            {"feature out of range", [](auto& r) { ordinary(r).feature.index = 20; }},
            {"unique", [](auto& r) { ordinary(r).unique = !ordinary(r).unique; }},
            {"deepest", [](auto& r) { r.deepest.depth *= 0.99; }},
            {"order", [](auto& r) { std::reverse(r.points.begin(), r.points.end()); }},
            {"completeness",
             [](auto& r) {
                 const auto middle = r.points.begin() + static_cast<long>(r.points.size() / 2);
                 r.points.erase(middle - 4, middle + 4);
                 r.count -= 8;
             }},
            {"region", [](auto& r) { ++r.regions.at(0).width; }},
        });
}

TEST_F(Laws, OfVerticesNoticeEverySpoiling) {
    const PlacedPair placed(context(), pair());
    const auto points = PenetrationPoints::vertices;
    const PenetrationResult good = run_alone(context(), placed.penetration(points));
    check_penetration(placed, points, good);
    ASSERT_GT(good.points.size(), 2U);
    PenetrationResult missing = good;
    missing.points.erase(missing.points.begin() + 1);
    --missing.count;
    EXPECT_NONFATAL_FAILURE(check_penetration(placed, points, missing), "has no record");
    PenetrationResult twice = good;
    twice.points.insert(twice.points.begin(), twice.points.front());
    ++twice.count;
    EXPECT_NONFATAL_FAILURE(check_penetration(placed, points, twice), "vertices are inside");
}

TEST_F(Laws, OfIntersectionNoticeEverySpoiling) {
    const PlacedPair placed(context(), pair());
    const auto kind = IntersectionKind::volume_volume;
    const IntersectionResult good = run_alone(context(), placed.intersection(kind));
    ASSERT_GT(good.samples.size(), 100U);
    const auto check = [&](const IntersectionResult& result) {
        check_intersection(placed, kind, result);
    };
    expect_noticed<IntersectionResult>(
        good, check,
        {
            {"kind", [](auto& r) { r.kind = IntersectionKind::boundary_volume; }},
            {"count", [](auto& r) { --r.count; }},
            {"area", [](auto& r) { r.area *= 1.001; }},
            {"sample off the grid", [](auto& r) { r.samples[50].position.x += r.cell / 3; }},
            {"edge", [](auto& r) { r.samples[50].edge = 0; }},
            {"order", [](auto& r) { std::swap(r.samples[20], r.samples[21]); }},
            {"completeness",
             [](auto& r) {
                 const auto middle = r.samples.begin() + static_cast<long>(r.samples.size() / 2);
                 r.samples.erase(middle, middle + 8);
                 r.count -= 8;
                 r.area = static_cast<double>(r.count) * r.cell * r.cell;
             }},
            {"sample outside both",
             [](auto& r) {
                 r.samples[0].position.y -= 3 * r.cell;
                 r.regions[0].min.y -= 3 * r.cell;
                 r.regions[0].height += 3;
             }},
        });
}

TEST_F(Laws, OfBoundariesNoticeAMissedCrossing) {
    const PlacedPair placed(context(), pair());
    const auto kind = IntersectionKind::boundary_boundary;
    IntersectionResult result = run_alone(context(), placed.intersection(kind));
    check_intersection(placed, kind, result);
    result.samples.clear();
    result.count = 0;
    result.area = 0.0;
    EXPECT_NONFATAL_FAILURE(check_intersection(placed, kind, result), "no sample within");
}

TEST_F(Laws, OfFieldsNoticeEverySpoiling) {
    const PlacedPair placed(context(), pair());
    DistanceFieldQuery query{placed.instance_a(), placed.instance_b(), 0.02, std::nullopt};
    const DistanceFieldResult good = run_alone(context(), query);
    const auto check = [&](const DistanceFieldResult& result) {
        check_field(placed.b(), 0.02, result);
    };
    expect_noticed<DistanceFieldResult>(
        good, check,
        {
            {"value", [](auto& r) { r.values[r.values.size() / 2] += 0.041F; }},
            {"not a number",
             [](auto& r) { r.values[3] = std::numeric_limits<float>::quiet_NaN(); }},
            {"signs",
             [](auto& r) {
                 for (float& value : r.values) {
                     value = -value;
                 }
             }},
            {"size", [](auto& r) { ++r.width; }},
            {"origin", [](auto& r) { r.origin.x += 3 * r.cell; }},
            {"cell", [](auto& r) { r.cell *= 1.001; }},
        });
}

TEST_F(Laws, OfContactsNoticeEverySpoiling) {
    const PlacedPair placed(context(), pair());
    const double near = 0.05;
    const ContactResult good = run_alone(context(), placed.contacts(near));
    ASSERT_GT(good.points.size(), 20U);
    ASSERT_GT(good.manifold.size(), 1U);
    const auto of_b = [](ContactResult& r) -> ContactPoint& { return r.points.back(); };
    const auto check = [&](const ContactResult& result) { check_contacts(placed, near, result); };
    expect_noticed<ContactResult>(
        good, check,
        {
            {"intersects", [](auto& r) { r.intersects = false; }},
            {"count", [](auto& r) { ++r.count; }},
            {"point", [](auto& r) { r.points[3].position.x += 1e-5; }},
            {"point of B", [&](auto& r) { of_b(r).position.x += 1e-5; }},
            {"side", [&](auto& r) { of_b(r).on = Side::a; }},
            {"distance", [](auto& r) { r.points[3].distance += 1e-4; }},
            {"too far", [&](auto& r) { of_b(r).distance = 1.01 * near; }},
            {"nearest", [](auto& r) { r.points[3].nearest.y += 1e-5; }},
            {"inside", [](auto& r) { r.points[3].inside = !r.points[3].inside; }},
            {"normal",
             [](auto& r) {
                 r.points[3].normal = {-r.points[3].normal.x, -r.points[3].normal.y};
             }},
            {"feature", [](auto& r) { r.points[3].feature.index = 1000; }},
            {"completeness",
             [](auto& r) {
                 r.points.erase(r.points.begin() + 2, r.points.begin() + 8);
                 r.count -= 6;
             }},
            {"no manifold", [](auto& r) { r.manifold.clear(); }},
            {"an end off A", [](auto& r) { r.manifold[0].first.x += 1e-4; }},
            {"extreme", [](auto& r) { r.manifold[0].extreme.distance = 0.0; }},
            {"mean normal", [](auto& r) { r.manifold[0].normal = {}; }},
        });
}

TEST_F(Laws, OfSeparationNoticeEverySpoiling) {
    Pair apart = pair();
    apart.pose_b.translation = {3.0, 1.0};
    const PlacedPair placed(context(), apart);
    const SeparationResult good = run_alone(context(), placed.separation());
    ASSERT_GT(good.distance, 0.5);
    const auto check = [&](const SeparationResult& result) { check_separation(placed, result); };
    expect_noticed<SeparationResult>(
        good, check,
        {
            {"intersects", [](auto& r) { r.intersects = true; }},
            {"distance", [](auto& r) { r.distance += 1e-12; }},
            {"point A", [](auto& r) { r.point_a.x += 1e-12; }},
            {"point B", [](auto& r) { r.point_b.x += 1e-12; }},
            {"direction", [](auto& r) { r.direction.x *= -1; }},
            {"feature A", [](auto& r) { r.feature_a.index = (r.feature_a.index + 3) % 14; }},
            {"feature B", [](auto& r) { r.feature_b.index = 1000; }},
            {"unique", [](auto& r) { r.unique = false; }},
            {"nothing rendered", [](auto& r) { r.sampled_distance = 1e9; }},
            {"rendered too near", [](auto& r) { r.sampled_distance = r.distance / 2; }},
        });
}

/// So must the comparison of two drivers.
class Agreement : public Laws {
protected:
    template <class Query>
    static void expect_missed(const PlacedPair& placed, const Query& query,
                              const Spoilings<typename Query::Result>& spoilings) {
        const AnyQuery any = query;
        const auto good = run_alone(context(), query);
        ASSERT_TRUE(good.status.ok()) << good.status.text();
        check_agreement({placed, any, SubPixelGrids::apart}, good, good);
        const auto check = [&](const auto& result) {
            check_agreement({placed, any, SubPixelGrids::same}, good, result);
        };
        expect_noticed(good, check, spoilings);
    }
};

TEST_F(Agreement, OfPenetrationIsMissed) {
    const PlacedPair placed(context(), pair());
    const double d = placed.tolerance();
    expect_missed(
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
    expect_missed(placed, placed.contacts(0.04),
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
    expect_missed(placed, placed.intersection(IntersectionKind::boundary_volume),
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
    expect_missed(
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
    expect_missed(placed, placed.separation(),
                  {
                      {"distance", [](auto& r) { r.distance += 1e-12; }},
                      {"place", [](auto& r) { r.point_a.x += 0.03; }},
                      {"unique", [](auto& r) { r.unique = !r.unique; }},
                      {"sampled", [](auto& r) { r.sampled_distance *= 1.001; }},
                  });
    expect_missed(placed, SeparationVectorQuery{placed.instance_a(), placed.instance_b(), 0.02},
                  {{"work", [](auto& r) { ++r.work; }}});
}

}  // namespace
}  // namespace nearfield::test
