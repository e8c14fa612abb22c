#include <tests/query/agreement.hpp>
#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>

#include <cmath>

namespace nearfield::test {
namespace {

/// More edges in one list than some drivers let a shader's loop have turns: 65,535.
class LongLists : public QueryTest {};

/// A square of side 2 whose sides have many collinear vertices.
Rings finely_divided_square(int edges_of_a_side) {
    Ring ring;
    for (int i = 0; i < edges_of_a_side; ++i) {
        ring.push_back({-1.0 + 2.0 * i / edges_of_a_side, -1.0});
    }
    for (int i = 0; i < edges_of_a_side; ++i) {
        ring.push_back({1.0, -1.0 + 2.0 * i / edges_of_a_side});
    }
    ring.insert(ring.end(), {{1.0, 1.0}, {-1.0, 1.0}});
    return {ring};
}

// The sides are straight within every tolerance, so each becomes one edge of a tile, or few.
TEST_F(LongLists, OfEdgesThatOneReplaces) {
    Random random(71);
    for (const Technique technique : device_techniques) {
        SCOPED_TRACE(to_string(technique));
        Pair pair;
        pair.a = {"star", scaled_and_moved(star(random, 30, 0.5), 0.1, {0.85, -0.88})};
        pair.b = {"square", finely_divided_square(70000)};
        pair.tolerance = 0.05;
        const PlacedPair placed(context(), pair, technique);
        PenetrationQuery query = placed.penetration(PenetrationPoints::vertices);
        const PenetrationResult found = run_alone(context(), query);
        query.technique = Technique::cpu;
        const PenetrationResult exact = run_alone(context(), query);
        ASSERT_EQ(found.points.size(), exact.points.size());
        EXPECT_GT(exact.points.size(), 20U);
        for (std::size_t i = 0; i < exact.points.size(); ++i) {
            EXPECT_EQ(found.points[i].position, exact.points[i].position);
            EXPECT_NEAR(found.points[i].depth, exact.points[i].depth, 1e-3 * pair.tolerance);
        }
    }
}

// Of a crowd within a few cells each edge is nearest somewhere; those in the last rows are at the
// end of the list.
TEST_F(LongLists, OfEdgesThatAreNearestInABlock) {
    Pair pair;
    pair.b.name = "crowd";
    constexpr int across = 188;
    for (int i = 0; i < across * across; ++i) {
        const Vector2 low{(i % across) / 200.0 - 0.5,
                          static_cast<double>(i / across) / 200.0 - 0.5};
        pair.b.rings.push_back(
            {low, {low.x + 1e-4, low.y}, {low.x + 1e-4, low.y + 1e-4}, {low.x, low.y + 1e-4}});
    }
    pair.a = {"a point, nearly", rectangle({3.0, 3.0}, {3.001, 3.001})};
    pair.tolerance = 0.05;
    const PlacedPair placed(context(), pair, Technique::compute);
    DistanceFieldQuery query;
    query.b = placed.instance_b();
    query.tolerance = pair.tolerance;
    query.rectangle = Rectangle{{-0.5, -0.5}, {0.5, 0.5}};
    query.technique = Technique::compute;
    const DistanceFieldResult found = run_alone(context(), query);
    query.technique = Technique::cpu;
    const DistanceFieldResult exact = run_alone(context(), query);
    ASSERT_TRUE(found.status.ok()) << found.status.text();
    ASSERT_EQ(found.values.size(), exact.values.size());
    EXPECT_GT(exact.values.size(), 100U);
    Report report("values");
    for (std::size_t i = 0; i < exact.values.size(); ++i) {
        const double difference =
            std::abs(static_cast<double>(exact.values[i]) - static_cast<double>(found.values[i]));
        report.require(difference <= found.error_bound + exact.error_bound, "cell ", i, ": ",
                       exact.values[i], " and ", found.values[i]);
    }
}

}  // namespace
}  // namespace nearfield::test
