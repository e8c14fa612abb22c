#include <gtest/gtest-spi.h>
#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

#include <cmath>
#include <functional>
#include <limits>

namespace nearfield::test {
namespace {

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
};

template <class Result>
struct Spoiling {
    const char* what;
    std::function<void(Result&)> spoil;
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
    check_penetration(placed, points, good);
    ASSERT_GT(good.points.size(), 20U);
    const double d = placed.tolerance();
    const Spoiling<PenetrationResult> spoilings[] = {
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
    };
    for (const auto& [what, spoil] : spoilings) {
        SCOPED_TRACE(what);
        PenetrationResult spoilt = good;
        spoil(spoilt);
        EXPECT_NONFATAL_FAILURE(check_penetration(placed, points, spoilt), "violations");
    }
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
    check_intersection(placed, kind, good);
    ASSERT_GT(good.samples.size(), 100U);
    const Spoiling<IntersectionResult> spoilings[] = {
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
    };
    for (const auto& [what, spoil] : spoilings) {
        SCOPED_TRACE(what);
        IntersectionResult spoilt = good;
        spoil(spoilt);
        EXPECT_NONFATAL_FAILURE(check_intersection(placed, kind, spoilt), "violations");
    }
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
    check_field(placed.b(), 0.02, good);
    const Spoiling<DistanceFieldResult> spoilings[] = {
        {"value", [](auto& r) { r.values[r.values.size() / 2] += 0.041F; }},
        {"not a number", [](auto& r) { r.values[3] = std::numeric_limits<float>::quiet_NaN(); }},
        {"signs",
         [](auto& r) {
             for (float& value : r.values) {
                 value = -value;
             }
         }},
        {"size", [](auto& r) { ++r.width; }},
        {"origin", [](auto& r) { r.origin.x += 3 * r.cell; }},
        {"cell", [](auto& r) { r.cell *= 1.001; }},
    };
    for (const auto& [what, spoil] : spoilings) {
        SCOPED_TRACE(what);
        DistanceFieldResult spoilt = good;
        spoil(spoilt);
        EXPECT_NONFATAL_FAILURE(check_field(placed.b(), 0.02, spoilt), "violations");
    }
}

TEST_F(Laws, OfContactsNoticeEverySpoiling) {
    const PlacedPair placed(context(), pair());
    const double near = 0.05;
    const ContactResult good = run_alone(context(), placed.contacts(near));
    check_contacts(placed, near, good);
    ASSERT_GT(good.points.size(), 20U);
    ASSERT_GT(good.manifold.size(), 1U);
    const auto of_b = [](ContactResult& r) -> ContactPoint& { return r.points.back(); };
    const Spoiling<ContactResult> spoilings[] = {
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
    };
    for (const auto& [what, spoil] : spoilings) {
        SCOPED_TRACE(what);
        ContactResult spoilt = good;
        spoil(spoilt);
        EXPECT_NONFATAL_FAILURE(check_contacts(placed, near, spoilt), "violations");
    }
}

TEST_F(Laws, OfSeparationNoticeEverySpoiling) {
    Pair apart = pair();
    apart.pose_b.translation = {3.0, 1.0};
    const PlacedPair placed(context(), apart);
    const SeparationResult good = run_alone(context(), placed.separation());
    check_separation(placed, good);
    ASSERT_GT(good.distance, 0.5);
    const Spoiling<SeparationResult> spoilings[] = {
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
    };
    for (const auto& [what, spoil] : spoilings) {
        SCOPED_TRACE(what);
        SeparationResult spoilt = good;
        spoil(spoilt);
        EXPECT_NONFATAL_FAILURE(check_separation(placed, spoilt), "violations");
    }
}

}  // namespace
}  // namespace nearfield::test
