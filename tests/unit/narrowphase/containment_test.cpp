#include <engine/narrowphase/containment_test.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using samples::Rings;

Ring box(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Rings joined(Rings rings, const Rings& more) {
    rings.insert(rings.end(), more.begin(), more.end());
    return rings;
}

/// Whether A is inside B where both are moved and turned alike.
bool is_inside_at(const Rings& a, const Rings& b, const Pose& pose) {
    const Polygon polygon_a = samples::polygon(a);
    const Polygon polygon_b = samples::polygon(b);
    simd::TransformedInstances instances;
    const std::uint32_t index_a = instances.place(polygon_a, pose);
    const std::uint32_t index_b = instances.place(polygon_b, pose);
    instances.complete(index_a);
    instances.complete(index_b);
    ContainmentTest test;
    return test.is_inside(instances[index_a], instances[index_b]);
}

/// Whether A is inside B; the same wherever both are.
bool is_inside(const Rings& a, const Rings& b) {
    const bool answer = is_inside_at(a, b, {});
    for (const Pose& pose :
         {Pose{{3.0, -7.0}, 0.3}, Pose{{1e5, 2e5}, 2.0}, Pose{{0.1, 0.7}, std::numbers::pi}}) {
        EXPECT_EQ(is_inside_at(a, b, pose), answer) << "turned by " << pose.angle;
    }
    return answer;
}

const Ring room = box(0, 0, 10, 10);
const Ring hole = box(4, 4, 6, 6);
const Ring island = box(4.5, 4.5, 5.5, 5.5);

TEST(ContainmentTest, OfRectangles) {
    EXPECT_TRUE(is_inside({box(1, 1, 2, 2)}, {room}));
    EXPECT_FALSE(is_inside({room}, {box(1, 1, 2, 2)}));
    EXPECT_FALSE(is_inside({box(11, 1, 12, 2)}, {room}));
    EXPECT_FALSE(is_inside({box(8, 1, 12, 2)}, {room}));
    EXPECT_FALSE(is_inside({box(-1, 4, 11, 5)}, {room}));
}

TEST(ContainmentTest, TouchingFromInsideIsInside) {
    EXPECT_TRUE(is_inside({room}, {room}));
    EXPECT_TRUE(is_inside({box(0, 0, 10, 5)}, {room}));
    EXPECT_TRUE(is_inside({box(0, 2, 3, 5)}, {room}));
    EXPECT_TRUE(is_inside({{{0, 3}, {5, 5}, {5, 1}}}, {room}));          // a vertex on an edge
    EXPECT_TRUE(is_inside({{{0, 0}, {10, 0}, {10, 10}}}, {room}));       // half of it
    EXPECT_FALSE(is_inside({box(10, 2, 12, 5)}, {room}));                // from outside
    EXPECT_FALSE(is_inside({{{10, 3}, {12, 5}, {12, 1}}}, {room}));      // likewise
    EXPECT_FALSE(is_inside({{{0, 0}, {10, 0}, {10.001, 10}}}, {room}));  // a little too far
}

TEST(ContainmentTest, HolesOfBAreOutside) {
    const Rings frame{room, hole};
    EXPECT_FALSE(is_inside({box(1, 1, 9, 9)}, frame));
    EXPECT_FALSE(is_inside({room}, frame));
    EXPECT_FALSE(is_inside({hole}, frame));             // A fills the hole exactly
    EXPECT_FALSE(is_inside({island}, frame));           // within the hole
    EXPECT_FALSE(is_inside({box(4, 4, 6, 5)}, frame));  // part of the hole, along its boundary
    EXPECT_FALSE(is_inside({box(4, 1, 6, 9)}, frame));  // along two sides of the hole
    EXPECT_TRUE(is_inside({box(1, 4, 4, 6)}, frame));   // touches the hole from outside
    EXPECT_TRUE(is_inside(frame, frame));
    EXPECT_TRUE(is_inside({box(1, 1, 9, 9), box(3, 3, 7, 7)}, frame));  // A's hole is larger
    EXPECT_TRUE(is_inside({box(1, 1, 9, 9), hole}, frame));             // just as large
    EXPECT_FALSE(is_inside({box(1, 1, 9, 9), island}, frame));          // smaller
    const Rings clockwise{room, Ring(hole.rbegin(), hole.rend())};
    EXPECT_FALSE(is_inside({box(1, 1, 9, 9)}, clockwise));
    EXPECT_FALSE(is_inside({hole}, clockwise));
    EXPECT_TRUE(is_inside(frame, clockwise));
    // A hole so small that no vertex of A is anywhere near.
    EXPECT_FALSE(is_inside({box(1, 1, 9, 9)}, {room, box(5, 5, 5 + 1e-6, 5 + 1e-6)}));
}

TEST(ContainmentTest, IslandsAndParts) {
    const Rings target{room, hole, island};
    EXPECT_TRUE(is_inside({island}, target));
    EXPECT_TRUE(is_inside({box(1, 1, 2, 2), box(4.6, 4.6, 5, 5)}, target));
    EXPECT_FALSE(is_inside({box(1, 1, 2, 2), box(4.1, 4.1, 4.2, 4.2)}, target));
    EXPECT_FALSE(is_inside({hole}, target));
    EXPECT_FALSE(is_inside({room, hole}, {island}));
    const Rings parts{box(0, 0, 1, 1), box(5, 0, 6, 1)};
    EXPECT_TRUE(is_inside(parts, {box(-1, -1, 7, 2)}));
    EXPECT_FALSE(is_inside(parts, {box(-1, -1, 3, 2)}));
    EXPECT_TRUE(is_inside({box(5.1, 0.1, 5.2, 0.2)}, parts));
    EXPECT_FALSE(is_inside({box(0.5, 0.2, 5.5, 0.8)}, parts));
}

TEST(ContainmentTest, EdgesThatPartsOfBShareAreNoGap) {
    const Rings parcels{box(0, 0, 5, 10), box(5, 0, 10, 10)};
    EXPECT_TRUE(is_inside({box(3, 3, 7, 7)}, parcels));
    EXPECT_TRUE(is_inside({room}, parcels));
    EXPECT_TRUE(is_inside(parcels, {room}));
    // The second of three parcels along the first is missing.
    const Rings with_gap{box(0, 0, 5, 9), box(5, 0, 10, 3), box(5, 6, 10, 9)};
    EXPECT_FALSE(is_inside({box(0, 0, 10, 9)}, with_gap));
    EXPECT_FALSE(is_inside({box(3, 1, 7, 8)}, with_gap));
    EXPECT_TRUE(is_inside({box(3, 1, 7, 2.5)}, with_gap));
    EXPECT_TRUE(is_inside({box(3, 1, 7, 8)}, joined(with_gap, {box(5, 3, 10, 6)})));
    // A gap that A fills exactly, and a ring that is there twice, which is none.
    EXPECT_FALSE(is_inside({box(5, 3, 10, 6)}, with_gap));
    EXPECT_TRUE(is_inside({box(1, 1, 9, 9)}, {room, hole, hole}));
    // Around this gap each parcel's long edge passes first along another parcel, in its middle too.
    const Rings pinwheel{box(0, 0, 6, 4), box(6, 0, 10, 6), box(4, 6, 10, 10), box(0, 4, 4, 10)};
    EXPECT_FALSE(is_inside({box(1, 1, 9, 9)}, pinwheel));
    EXPECT_FALSE(is_inside({hole}, pinwheel));
    EXPECT_TRUE(is_inside({box(1, 1, 9, 9)}, joined(pinwheel, {hole})));
}

TEST(ContainmentTest, SelfCrossingRingsFollowTheOddEvenRule) {
    const Ring bow_tie{{0, 0}, {10, 10}, {10, 0}, {0, 10}};
    EXPECT_TRUE(is_inside({box(1, 4, 2, 6)}, {bow_tie}));
    EXPECT_FALSE(is_inside({box(4, 1, 6, 2)}, {bow_tie}));
    EXPECT_TRUE(is_inside({bow_tie}, {room}));
    EXPECT_FALSE(is_inside({room}, {bow_tie}));
    Ring pentagram;
    for (int i = 0; i < 5; ++i) {
        const double angle = 4.0 * std::numbers::pi * i / 5.0;
        pentagram.push_back({10.0 * std::cos(angle), 10.0 * std::sin(angle)});
    }
    EXPECT_FALSE(is_inside({box(-1, -1, 1, 1)}, {pentagram}));  // its middle is outside
    EXPECT_TRUE(is_inside({box(6, -0.1, 7, 0.1)}, {pentagram}));
    EXPECT_FALSE(is_inside({box(2, -0.1, 7, 0.1)}, {pentagram}));
}

TEST(ContainmentTest, LinesWithoutAreaCountAsPointsOfTheirShape) {
    const Ring spiked{{1, 1}, {9, 1}, {9, 5}, {12, 5}, {9, 5}, {9, 9}, {1, 9}};
    EXPECT_FALSE(is_inside({spiked}, {room}));  // the spike reaches out of the room
    EXPECT_TRUE(is_inside({spiked}, {spiked}));
    EXPECT_TRUE(is_inside({box(1, 1, 9, 9)}, {spiked}));
    // Along the lower sides of two parcels, across the gap between them.
    const Ring along{{1, 0}, {7, 0}, {3, 0}, {3, 5}, {1, 5}};
    EXPECT_FALSE(is_inside({along}, {box(0, 0, 4, 6), box(6, 0, 10, 6)}));
    EXPECT_TRUE(is_inside({along}, {box(0, 0, 4, 6), box(4, 0, 10, 6)}));
    const Ring inward{{0, 0}, {10, 0}, {10, 5}, {5, 5}, {10, 5}, {10, 10}, {0, 10}};
    EXPECT_TRUE(is_inside({box(1, 1, 9, 9)}, {inward}));  // both sides of the spike are inside
}

TEST(ContainmentTest, ManyEdgesAreThoseOfFew) {
    // Each edge divided, so that trees decide; divisions that coincide, and others.
    const auto divided = [](const Rings& rings, int pieces) {
        Rings result;
        for (const Ring& ring : rings) {
            Ring finer;
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vector2 from = ring[i];
                const Vector2 to = ring[(i + 1) % ring.size()];
                for (int k = 0; k < pieces; ++k) {
                    const double at = static_cast<double>(k) / pieces;
                    finer.push_back({from.x + at * (to.x - from.x), from.y + at * (to.y - from.y)});
                }
            }
            result.push_back(finer);
        }
        return result;
    };
    const Rings frame{room, hole};
    const Rings fine = divided(frame, 64);
    ASSERT_GT(64U * 8U, simd::max_edges_one_by_one);
    for (const int pieces : {1, 7, 64}) {
        SCOPED_TRACE(pieces);
        EXPECT_TRUE(is_inside(divided(frame, pieces), fine));
        EXPECT_TRUE(is_inside(divided({box(0, 0, 4, 10)}, pieces), fine));
        EXPECT_FALSE(is_inside(divided({hole}, pieces), fine));
        EXPECT_FALSE(is_inside(divided({room}, pieces), fine));
        EXPECT_FALSE(is_inside(divided({box(0, 0, 5, 10)}, pieces), fine));
        EXPECT_TRUE(is_inside(fine, divided({room}, pieces)));
    }
}

TEST(ContainmentTest, RoundingMayTurnTheAnswerOnlyNearBy) {
    for (const double scale : {1e-3, 1.0, 1e6}) {
        const Rings b{box(0, 0, scale, scale)};
        const auto reaching = [scale](double by) {
            return Rings{box(0.2 * scale, 0.2 * scale, scale + by, 0.8 * scale)};
        };
        EXPECT_TRUE(is_inside(reaching(0.0), b));
        EXPECT_TRUE(is_inside(reaching(-1e-12 * scale), b));
        EXPECT_FALSE(is_inside_at(reaching(1e-12 * scale), b, {}));
    }
}

TEST(ContainmentTest, EveryShapeIsInsideItself) {
    samples::Random random(5);
    for (const samples::NamedRings& shape : samples::assorted_shapes(random)) {
        SCOPED_TRACE(shape.name);
        EXPECT_TRUE(is_inside(shape.rings, shape.rings));
    }
}

}  // namespace
}  // namespace nearfield::narrowphase
