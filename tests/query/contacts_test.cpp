#include <tests/oracle/plane.hpp>
#include <tests/query/check.hpp>
#include <tests/query/corpus.hpp>
#include <tests/query/query_test.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::test {
namespace {

constexpr std::uint64_t contacts_seed = 577;

class Contacts : public QueryTest {
protected:
    static ContactResult check(Pair pair, double contact_distance) {
        const PlacedPair placed(context(), std::move(pair));
        const CorpusKeeper keeper(placed.pair(), contact_distance);
        SCOPED_TRACE(describe(placed.pair()) + "\ncontact distance " +
                     std::to_string(contact_distance));
        ContactResult result = run_alone(context(), placed.contacts(contact_distance));
        check_contacts(placed, contact_distance, result);
        return result;
    }
    static ContactResult check(const Rings& a, const Rings& b, double tolerance,
                               double contact_distance) {
        return check(Pair{{"A", a}, {"B", b}, {}, {}, tolerance}, contact_distance);
    }
};

void expect_near(const Vector2& value, const Vector2& expected) {
    EXPECT_LT(oracle::distance(value, expected), 1e-12) << value.x << ", " << value.y;
}

TEST_F(Contacts, ABoxOnAFloorHasTwoEndsAndOneNormal) {
    const Rings box = rectangle({-1, 0.05}, {1, 2});
    const Rings floor = rectangle({-10, -1}, {10, 0});
    const ContactResult on_floor = check(box, floor, 0.1, 0.2);
    ASSERT_EQ(on_floor.manifold.size(), 1U);
    const ContactCluster& cluster = on_floor.manifold.front();
    expect_near(cluster.first, {-1, 0.05});
    expect_near(cluster.last, {1, 0.05});
    expect_near(cluster.normal, {0, 1});
    EXPECT_NEAR(cluster.extreme.distance, 0.05, 1e-12);
    EXPECT_FALSE(cluster.extreme.inside);
    // Slightly penetrating: the corners are the deepest points.
    const ContactResult sunk = check(rectangle({-1, -0.05}, {1, 2}), floor, 0.1, 0.2);
    ASSERT_GE(sunk.manifold.size(), 1U);
    EXPECT_TRUE(sunk.manifold.front().extreme.inside);
    EXPECT_NEAR(sunk.manifold.front().extreme.distance, 0.05, 1e-12);
}

TEST_F(Contacts, AStretchStraightThroughAWallIsItsDeepestPoint) {
    const ContactResult result =
        check(rectangle({0, 0}, {10, 10}), rectangle({9, -5}, {20, 15}), 0.05, 0.4);
    ASSERT_EQ(result.manifold.size(), 2U);
    for (const ContactCluster& cluster : result.manifold) {
        // No extent along the wall.
        EXPECT_EQ(cluster.first, cluster.last);
    }
}

TEST_F(Contacts, NormalsByTheGradientFarApartCostNoField) {
    const Rings a{rectangle({0, 0}, {1, 1})[0], rectangle({1e5, 1e5}, {1e5 + 1, 1e5 + 1})[0]};
    const Rings b{rectangle({1.1, 0}, {2, 1})[0],
                  rectangle({1e5 + 1.1, 1e5}, {1e5 + 2, 1e5 + 1})[0]};
    const PlacedPair placed(context(), {{"A", a}, {"B", b}, {}, {}, 0.01});
    ContactQuery query = placed.contacts(0.2);
    query.normals = ContactNormals::gradient;
    const ContactResult result = run_alone(context(), query);
    ASSERT_TRUE(result.status.ok()) << result.status.text();
    EXPECT_GT(result.count, 200U);
}

TEST_F(Contacts, ACornerInACornerHasTwoStretches) {
    const Rings corner{{{0, 0}, {10, 0}, {10, 1}, {1, 1}, {1, 10}, {0, 10}}};
    const ContactResult result = check(rectangle({1.05, 1.05}, {4, 4}), corner, 0.1, 0.15);
    ASSERT_EQ(result.manifold.size(), 2U);
    for (const ContactCluster& cluster : result.manifold) {
        EXPECT_NEAR(std::max(cluster.normal.x, cluster.normal.y), 1.0, 1e-3);
    }
}

TEST_F(Contacts, ATipBetweenTwoSamplesIsFound) {
    // Closer than a quarter of a cell to a long edge of A, midway between two samples of it.
    const Rings edge = rectangle({0, -1}, {10, 0});
    const ContactResult result = check(edge, {{{5.05, 0.01}, {6, 2}, {4, 2}}}, 0.2, 0.03);
    ASSERT_EQ(result.manifold.size(), 1U);
    EXPECT_NEAR(result.manifold.front().extreme.distance, 0.01, 1e-12);
}

TEST_F(Contacts, SharedEdgesTouchAtDistanceZero) {
    const ContactResult result =
        check(rectangle({-2, -1}, {0, 1}), rectangle({0, -1}, {2, 1}), 0.1, 0.05);
    ASSERT_FALSE(result.points.empty());
    for (const ContactPoint& contact : result.points) {
        if (std::abs(contact.position.y) < 0.9) {
            EXPECT_NEAR(contact.distance, 0.0, 1e-12);
            EXPECT_FALSE(contact.inside);
            EXPECT_NEAR(contact.normal.x, -1.0, 1e-12);
        }
    }
}

TEST_F(Contacts, NormalsByTheGradientPointOutOfRandomShapes) {
    std::size_t compared = 0;
    std::size_t close = 0;
    for_each_case(contacts_seed, 30, [&](Random& random) {
        const Pair pair = any_pair(random);
        SCOPED_TRACE(describe(pair));
        for (const Technique technique : every_technique) {
            SCOPED_TRACE(to_string(technique));
            const PlacedPair placed(context(), pair, technique);
            ContactQuery query = placed.contacts(3.0 * placed.tolerance());
            const ContactResult analytic = run_alone(context(), query);
            query.normals = ContactNormals::gradient;
            const ContactResult gradient = run_alone(context(), query);
            ASSERT_TRUE(gradient.status.ok()) << gradient.status.text();
            ASSERT_EQ(gradient.points.size(), analytic.points.size());
            for (std::size_t i = 0; i < gradient.points.size(); ++i) {
                const Vector2& normal = gradient.points[i].normal;
                EXPECT_NEAR(oracle::length(normal), 1.0, 1e-9);
                ++compared;
                close += oracle::dot(normal, analytic.points[i].normal) > 0.9 ? 1U : 0U;
            }
        }
    });
    // Central differences are wrong at thin features and corners.
    EXPECT_GT(compared, 500U);
    EXPECT_GT(close, compared / 2);
}

}  // namespace
}  // namespace nearfield::test
