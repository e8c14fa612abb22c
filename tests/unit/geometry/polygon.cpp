#include <engine/geometry/containment.hpp>
#include <engine/geometry/number.hpp>
#include <engine/geometry/polygon.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace nearfield::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

const Ring square = test::rectangle({0.0, 0.0}, {1.0, 1.0}).front();

/// Expects that a shape is rejected with the message and that the polygon is unchanged.
void expect_refused(const test::Rings& rings, const std::string& message) {
    Polygon polygon = samples::polygon({{{0.0, 0.0}, {4.0, 0.0}, {0.0, 2.0}}});
    const Status status = polygon.assign(rings);
    EXPECT_EQ(status.code(), StatusCode::invalid_shape);
    EXPECT_EQ(status.message(), message);
    ASSERT_EQ(polygon.size(), 3U);
    EXPECT_EQ(polygon.ring_count(), 1U);
    EXPECT_EQ(polygon.centre(), Vector(2.0, 1.0));
    EXPECT_EQ(polygon.vertices()[1], Vector(2.0, -1.0));
}

Ring with(Ring ring, std::size_t vertex, Vector2 value) {
    ring.at(vertex) = value;
    return ring;
}

TEST(PolygonAssign, RefusesNotANumber) {
    expect_refused({square, square, with(square, 3, {not_a_number, 0.0})},
                   "ring 2, vertex 3: x is not a number");
    expect_refused({with(square, 0, {0.0, not_a_number})}, "ring 0, vertex 0: y is not a number");
}

TEST(PolygonAssign, RefusesInfinity) {
    expect_refused({square, with(square, 1, {infinity, 0.0})}, "ring 1, vertex 1: x is infinite");
    expect_refused({with(square, 2, {1.0, -infinity})}, "ring 0, vertex 2: y is infinite");
}

TEST(PolygonAssign, RefusesCoordinatesOutOfRange) {
    expect_refused({with(square, 2, {1.0, -2e12})},
                   "ring 0, vertex 2: y is -2e+12, more than 1e+12 from the origin");
    Polygon polygon;
    EXPECT_TRUE(polygon.assign(test::Rings{with(square, 2, {1e12, -1e12})}).ok());
}

TEST(PolygonAssign, RefusesNoRing) {
    expect_refused({}, "the shape has no ring");
}

TEST(PolygonAssign, RefusesFewerThanThreeDifferentVertices) {
    const Vector2 p{1.0, 2.0};
    const Vector2 q{3.0, 4.0};
    for (const Ring& ring : {Ring{}, Ring{p}, Ring{p, q}, Ring{p, q, p}, Ring{p, p, p, p},
                             Ring{p, q, q, p, q, p, p}}) {
        expect_refused({square, ring}, "ring 1 has fewer than three different vertices");
    }
}

TEST(PolygonAssign, RefusesRingsOnOneLine) {
    test::Random random(1);
    for (int round = 0; round < 200; ++round) {
        // Rounded coordinates: the vertices deviate from the line by the precision of a double.
        const double angle = random.between(0.0, 7.0);
        const Vector2 start{random.between(-1e6, 1e6), random.between(-1e6, 1e6)};
        const double scale = std::pow(10.0, random.between(-3.0, 6.0));
        Ring ring;
        for (int i = 0; i < 5; ++i) {
            const double along = scale * random.between(-1.0, 1.0);
            ring.push_back({start.x + along * std::cos(angle), start.y + along * std::sin(angle)});
        }
        expect_refused({ring}, "ring 0 lies on one line");
    }
    expect_refused({{{0.0, 0.0}, {1e-200, 1e-200}, {3e-200, 3e-200}}}, "ring 0 lies on one line");
}

TEST(PolygonAssign, RefusesShapesThatAreTooSmall) {
    for (const double extent : {0.999 * smallest_extent, 1e-100, 1e-150, 1e-200, 1e-310}) {
        const std::string message = "the shape spans " + number(extent) +
                                    " along its longer side; the least is 1e-20, since results "
                                    "that are smaller would underflow: use other units";
        expect_refused(test::rectangle({0.0, 0.0}, {extent, 0.5 * extent}), message);
        expect_refused(test::rectangle({-extent, 0.0}, {-0.5 * extent, extent}), message);
    }
    // A tiny ring in a sufficiently large shape vanishes in its rounding and does no harm.
    const std::vector<Ring> rings{test::rectangle({0.0, 0.0}, {1e-200, 1e-200}).front(), square};
    Polygon polygon;
    EXPECT_TRUE(polygon.assign(rings).ok());
}

TEST(PolygonAssign, AcceptsSmallAndThinRings) {
    const std::vector<Ring> rings{
        test::rectangle({1e6, 1e6}, {1e6 + 1e-3, 1e6 + 1e-3}).front(),
        test::rectangle({1e12, -1e12}, {1e12 - 1.0, 1.0 - 1e12}).front(),
        test::rectangle({0.0, 0.0}, {smallest_extent, smallest_extent}).front(),
        test::rectangle({0.0, 0.0}, {1e6, 1e-6}).front(),
        {{-1.0, -1.0}, {1.0, 1.0}, {1.0, -1.0}, {-1.0, 1.0}},  // no signed area
        {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}, {1.0, 1e-9}},
    };
    for (const Ring& ring : rings) {
        Polygon polygon;
        const Status status = polygon.assign(std::span(&ring, 1));
        EXPECT_TRUE(status.ok()) << status.message();
    }
}

TEST(PolygonAssign, DropsTheClosingVertexAndKeepsOtherRepeats) {
    Ring ring{{0.0, 0.0}, {0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {2.0, 2.0}, {0.0, 0.0}};
    const Polygon polygon = samples::polygon({ring});
    ASSERT_EQ(polygon.size(), 5U);
    EXPECT_EQ(polygon.centre(), Vector(1.0, 1.0));
    EXPECT_EQ(polygon.vertices()[4], Vector(1.0, 1.0));
    EXPECT_EQ(polygon.next(4), 0U);
}

TEST(PolygonAssign, CountsItsRevisions) {
    Polygon polygon;
    const std::uint64_t first = polygon.revision();
    ASSERT_TRUE(polygon.assign(test::Rings{square}).ok());
    const std::uint64_t second = polygon.revision();
    EXPECT_NE(second, first);
    // The same rings may be an update of something else that depends on them.
    ASSERT_TRUE(polygon.assign(test::Rings{square}).ok());
    EXPECT_NE(polygon.revision(), second);
    const std::uint64_t third = polygon.revision();
    ASSERT_FALSE(polygon.assign(test::Rings{}).ok());
    EXPECT_EQ(polygon.revision(), third) << "nothing was replaced";
}

TEST(Polygon, FindsRingsAndNextVertices) {
    test::Random random(3);
    test::Rings rings;
    for (std::uint32_t i = 0; i < 20; ++i) {
        rings.push_back(test::star(random, random.whole(3, 7), 0.5).front());
    }
    const Polygon polygon = samples::polygon(rings);
    std::uint32_t index = 0;
    for (std::uint32_t ring = 0; ring < rings.size(); ++ring) {
        const std::uint32_t begin = index;
        EXPECT_EQ(polygon.ring_begin(ring), begin);
        for (std::size_t i = 0; i < rings[ring].size(); ++i, ++index) {
            EXPECT_EQ(polygon.ring_of(index), ring);
            EXPECT_EQ(polygon.next(index), i + 1 < rings[ring].size() ? index + 1 : begin);
            EXPECT_NEAR(
                (polygon.vertices()[index] + polygon.centre() - to_vector(rings[ring][i])).norm(),
                0.0, 1e-15);
        }
        EXPECT_EQ(polygon.ring_end(ring), index);
    }
    EXPECT_EQ(polygon.size(), index);
}

TEST(TransformedPolygon, PlacesVerticesAndTakesPointsBack) {
    test::Random random(4);
    for (const test::NamedRings& shape : samples::assorted_shapes(random)) {
        const double offset = random.between(-1e6, 1e6);
        const test::Rings rings = test::scaled_and_moved(shape.rings, 1.0, {offset, -offset});
        const Polygon polygon = samples::polygon(rings);
        const Pose pose{{random.between(-1e6, 1e6), random.between(-9.0, 9.0)},
                        random.between(-9.0, 9.0)};
        const TransformedPolygon placed(polygon, pose);
        std::uint32_t index = 0;
        for (const Ring& ring : rings) {
            for (const Vector2& v : ring) {
                const long double c = std::cos(static_cast<long double>(pose.angle));
                const long double s = std::sin(static_cast<long double>(pose.angle));
                const Vector expected(static_cast<double>(c * v.x - s * v.y + pose.translation.x),
                                      static_cast<double>(s * v.x + c * v.y + pose.translation.y));
                EXPECT_LT((placed.vertex(index) - expected).norm(), 2e-9) << shape.name;
                EXPECT_LT(
                    (placed.to_local(placed.vertex(index)) - polygon.vertices()[index]).norm(),
                    2e-9);
                ++index;
            }
        }
    }
}

TEST(TransformedPolygon, ChainBoxesAreTheBoxesOfTheirVertices) {
    test::Random random(5);
    for (const test::NamedRings& shape : samples::assorted_shapes(random)) {
        const Polygon polygon = samples::polygon(shape.rings);
        const TransformedPolygon placed(polygon, {{3.0, 4.0}, random.between(0.0, 6.0)});
        for (int round = 0; round < 100; ++round) {
            const std::uint32_t ring = random.below(polygon.ring_count());
            const std::uint32_t size = polygon.ring_end(ring) - polygon.ring_begin(ring);
            const std::uint32_t first = polygon.ring_begin(ring) + random.below(size);
            const std::uint32_t count = 1 + random.below(size);
            Box expected;
            for (std::uint32_t i = 0, v = first; i <= count; ++i, v = polygon.next(v)) {
                expected.extend(placed.vertex(v));
            }
            const Box box = placed.chain_box(ring, first, count);
            EXPECT_EQ(box.min(), expected.min()) << shape.name;
            EXPECT_EQ(box.max(), expected.max()) << shape.name;
        }
        Box all;
        for (std::uint32_t i = 0; i < polygon.size(); ++i) {
            all.extend(placed.vertex(i));
        }
        EXPECT_EQ(placed.box().min(), all.min());
        EXPECT_EQ(placed.box().max(), all.max());
    }
}

/// Parity of the winding numbers: an independent method, by angles.
bool inside_by_angles(const TransformedPolygon& placed, const Vector& p) {
    double turns = 0.0;
    const Polygon& polygon = placed.polygon();
    for (std::uint32_t i = 0; i < polygon.size(); ++i) {
        const Vector a = placed.vertex(i) - p;
        const Vector b = placed.vertex(polygon.next(i)) - p;
        turns += std::atan2(cross(a, b), a.dot(b)) / (2.0 * std::numbers::pi);
    }
    return std::lround(turns) % 2 != 0;
}

TEST(Contains, AgreesWithWindingNumbers) {
    test::Random random(6);
    for (const test::NamedRings& shape : samples::assorted_shapes(random)) {
        const Polygon polygon = samples::polygon(shape.rings);
        for (const double far : {0.0, 1e6}) {
            const TransformedPolygon placed(polygon, {{far, -far}, random.between(0.0, 6.0)});
            std::vector<Vector> points(2000);
            Containment together;
            for (Vector& p : points) {
                p = {far + random.between(-1.2, 1.2), random.between(-1.2, 1.2) - far};
                together.ask(p);
            }
            together.answer(placed);
            int inside = 0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const bool expected = inside_by_angles(placed, points[i]);
                inside += expected ? 1 : 0;
                EXPECT_EQ(contains(placed, points[i]), expected)
                    << shape.name << " at " << points[i].transpose();
                EXPECT_EQ(together.inside(i), expected)
                    << shape.name << " at " << points[i].transpose();
            }
            if (shape.name != "sliver" && shape.name != "folding") {
                EXPECT_GT(inside, 0) << shape.name;
            }
        }
    }
}

}  // namespace
}  // namespace nearfield::geometry
