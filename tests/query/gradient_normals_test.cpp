#include <tests/oracle/plane.hpp>
#include <tests/query/pair.hpp>
#include <tests/query/query_test.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::test {
namespace {

class GradientNormals : public QueryTest {
protected:
    static ContactResult ask(const PlacedPair& placed, double contact_distance,
                             ContactNormals normals) {
        ContactQuery query = placed.contacts(contact_distance);
        query.normals = normals;
        ContactResult result = run_alone(context(), query);
        EXPECT_TRUE(result.status.ok()) << result.status.text();
        return result;
    }
};

TEST_F(GradientNormals, OnAPlateThinnerThanACellVanishAndAreOneOfSeveral) {
    // B's field falls towards the plate from both sides alike: it is its own medial axis.
    for (const Technique technique : every_technique) {
        SCOPED_TRACE(to_string(technique));
        const PlacedPair placed(context(),
                                {{"A", rectangle({-1, 0.05}, {1, 2})},
                                 {"B", rectangle({-10, -1e-6}, {10, 1e-6})},
                                 {},
                                 {},
                                 0.1},
                                technique);
        const ContactResult analytic = ask(placed, 0.1, ContactNormals::analytic);
        const ContactResult gradient = ask(placed, 0.1, ContactNormals::gradient);
        ASSERT_EQ(gradient.points.size(), analytic.points.size());
        std::size_t on_b = 0;
        for (std::size_t i = 0; i < gradient.points.size(); ++i) {
            const ContactPoint& record = gradient.points[i];
            EXPECT_EQ(record.position, analytic.points[i].position);
            if (record.on == Side::b && std::abs(record.position.x) < 0.9) {
                ++on_b;
                EXPECT_TRUE(analytic.points[i].unique) << record.position.x;
                EXPECT_FALSE(record.unique) << record.position.x;
                EXPECT_EQ(record.normal, analytic.points[i].normal);
            } else if (record.on == Side::a && record.position.y < 0.06 &&
                       std::abs(record.position.x) < 0.9) {
                // A third of a cell off, the gradient is short and says where to.
                EXPECT_TRUE(record.unique) << record.position.x;
                EXPECT_GT(record.normal.y, 0.99);
            }
        }
        EXPECT_GT(on_b, 10U);
    }
}

TEST_F(GradientNormals, NearARoundShapeAreRadial) {
    // No corner and no medial axis is within three cells of a contact. Edges that are simplified to
    // a quarter of the tolerance turn by this much to either side of their middles.
    constexpr double tolerance = 0.01;
    const double turned = 1.06 * std::acos(1.0 - tolerance / 4.0);
    const Rings disc = regular(720);
    for (const Technique technique : every_technique) {
        for_each_case(700, 3, [&](Random& random) {
            SCOPED_TRACE(to_string(technique));
            const double size = random.between(0.5, 2.0);
            const PlacedPair placed(
                context(),
                {{"A", rectangle({-size, 0.0}, {size, 1.0})},
                 {"B", disc},
                 {{random.between(-0.2, 0.2), random.between(-1.1, 1.1)}, random.between(-3, 3)},
                 {},
                 tolerance},
                technique);
            const ContactResult result = ask(placed, 0.05, ContactNormals::gradient);
            std::size_t compared = 0;
            for (const ContactPoint& record : result.points) {
                const double from_centre = oracle::length(record.position);
                const Vector2 radial = oracle::times(record.position, 1.0 / from_centre);
                EXPECT_GT(oracle::dot(record.normal, radial), std::cos(turned))
                    << record.position.x << ", " << record.position.y << ": normal "
                    << record.normal.x << ", " << record.normal.y;
                EXPECT_TRUE(record.unique || from_centre < 0.9);
                ++compared;
            }
            EXPECT_GT(compared, 5U);
        });
    }
}

}  // namespace
}  // namespace nearfield::test
