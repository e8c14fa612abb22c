#include <tests/oracle/boundary.hpp>
#include <tests/oracle/overlap.hpp>
#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

#include <cmath>

namespace nearfield::test {
namespace {

constexpr std::uint64_t intersection_seed = 815;

class Intersection : public QueryTest {};

TEST_F(Intersection, AreaConvergesUnderRefinement) {
    Random random(intersection_seed);
    for (int i = 0; i < 6; ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        Pair pair{{"A", with_holes(random, 5)},
                  {"B", coast(random, 300, 0.4)},
                  {{}, random.between(0.0, 6.0)},
                  {{random.between(-0.8, 0.8), 0.3}, random.between(0.0, 6.0)},
                  0.04};
        for (int halving = 0; halving < 3; ++halving, pair.tolerance /= 2) {
            const PlacedPair placed(context(), pair);
            const auto kind = IntersectionKind::volume_volume;
            const auto result = run_alone(context(), placed.intersection(kind));
            check_intersection(placed, kind, result);
            // Counting cells is far more accurate than its bound: the errors of single cells
            // cancel.
            const double truth = oracle::overlap(placed.a(), placed.b()).area;
            EXPECT_NEAR(result.area, truth, pair.tolerance) << describe(pair);
        }
    }
}

TEST_F(Intersection, NamesAnEdgeNearbyOnARunOfCollinearOnes) {
    // A's lower side consists of twenty edges on one line.
    Rings a = rectangle({0, 0}, {10, 5});
    for (int i = 1; i < 20; ++i) {
        a[0].insert(a[0].begin() + i, {i / 2.0, 0.0});
    }
    const PlacedPair pair(context(),
                          {{"A", a}, {"B", rectangle({1.3, -1}, {9.8, 1})}, {}, {}, 0.05});
    const auto kind = IntersectionKind::boundary_volume;
    const auto result = run_alone(context(), pair.intersection(kind));
    check_intersection(pair, kind, result);
    EXPECT_GT(result.count, 0U);
}

TEST_F(Intersection, IsSymmetricUpToTheBound) {
    for (const Pair& pair : family_pairs(intersection_seed + 3)) {
        const PlacedPair one(context(), pair);
        const PlacedPair other(context(), {pair.b, pair.a, pair.pose_b, pair.pose_a, 0.15});
        SCOPED_TRACE(describe(pair));
        for (const auto kind :
             {IntersectionKind::volume_volume, IntersectionKind::boundary_boundary}) {
            const auto ab = run_alone(context(), one.intersection(kind));
            const auto ba = run_alone(context(), other.intersection(kind));
            ASSERT_TRUE(ab.status.ok() && ba.status.ok());
            check_intersection(one, kind, ab);
            check_intersection(other, kind, ba);
            EXPECT_EQ(ab.intersects, ba.intersects);
            // Both samplings find the same crossings (checked above), but for boundaries a cell's
            // centre may be in one and not in the other.
            if (kind == IntersectionKind::volume_volume) {
                EXPECT_EQ(ab.count, ba.count);
            }
        }
    }
}

TEST_F(Intersection, IntersectsCountsTouching) {
    const NamedRings square{"square", rectangle({0, 0}, {2, 2})};
    const std::pair<Rings, bool> others[] = {
        {rectangle({2, 0}, {3, 2}), true},            // an edge
        {rectangle({2, 2}, {3, 3}), true},            // a vertex
        {rectangle({0.5, 0.5}, {1, 1}), true},        // contained
        {rectangle({-1, -1}, {3, 3}), true},          // containing
        {rectangle({2.0001, 0}, {3, 2}), false},      // close
        {{{{2, 1}, {3, 0.5}, {3, 1.5}}}, true},       // a vertex on an edge
        {{{{2.001, 1}, {3, 0.5}, {3, 1.5}}}, false},  // a vertex before an edge
    };
    for (const auto& [rings, expected] : others) {
        const PlacedPair pair(context(), {square, {"other", rings}, {}, {}, 0.1});
        SCOPED_TRACE(to_text(rings));
        for (const IntersectionKind kind : every_kind) {
            EXPECT_EQ(run_alone(context(), pair.intersection(kind)).intersects, expected);
        }
        EXPECT_EQ(run_alone(context(), pair.penetration()).intersects, expected);
    }
}

}  // namespace
}  // namespace nearfield::test
