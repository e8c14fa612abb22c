#include "scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace nearfield::test {
namespace {

/// What rounding of an instance's vertices, and of a place, can amount to.
double slack_of(const Scene& scene, std::size_t i, const Vector2& at) {
    return 4e-15 * (scene.truth(i).magnitude() + std::abs(at.x) + std::abs(at.y));
}

/// Grown on all sides, or shrunk as far as it can be.
Rectangle grown(const Rectangle& box, double by) {
    const double x = std::max(by, -0.5 * (box.max.x - box.min.x));
    const double y = std::max(by, -0.5 * (box.max.y - box.min.y));
    return {{box.min.x - x, box.min.y - y}, {box.max.x + x, box.max.y + y}};
}

/// Checks that list i holds, in order, what `meets(instance)` says; 2: either is right.
template <class Meets>
void check_list(const Scene& scene, const WorldFilter& filter, const InstanceLists& lists,
                std::size_t i, const Meets& meets) {
    std::vector<std::size_t> listed;
    for (std::uint32_t k = lists.offsets[i]; k < lists.offsets[i + 1]; ++k) {
        const auto here = scene.position(lists.instances[k]);
        ASSERT_TRUE(here.has_value());
        EXPECT_TRUE(listed.empty() || listed.back() < *here) << "not in the order of adding";
        listed.push_back(*here);
    }
    for (std::size_t instance = 0; instance < scene.size(); ++instance) {
        const bool is_listed = std::binary_search(listed.begin(), listed.end(), instance);
        const int expected = scene.passes(instance, filter) ? meets(instance) : 0;
        if (expected != 2) {
            EXPECT_EQ(is_listed ? 1 : 0, expected)
                << scene.placements()[instance].name << ' ' << instance;
        }
    }
}

Rectangle any_rectangle(Random& random, const Scene& scene, const Rectangle& box) {
    const Vector2 a = any_point(random, scene, box);
    const double size = random.scale(1e-4, 10.0);
    switch (random.whole(0, 5)) {
        case 0:
            return {a, a};
        case 1:
            return {a, {a.x + size, a.y}};
        case 2: {
            const Vector2 b = any_point(random, scene, box);
            return {{std::min(a.x, b.x), std::min(a.y, b.y)},
                    {std::max(a.x, b.x), std::max(a.y, b.y)}};
        }
        case 3:
            return {{std::round(a.x), std::round(a.y)}, {std::round(a.x) + 1, std::round(a.y) + 1}};
        default:
            return {{a.x - size, a.y - size}, {a.x + size, a.y + 0.3 * size}};
    }
}

using WorldOverlaps = ScenesTest;

TEST_P(WorldOverlaps, OfPointsAndRectanglesAreThoseOfTheBruteForce) {
    for_each_scene(6, 71, [](Scene& scene, Random& random) {
        const Rectangle box = scene.box();
        const WorldFilter filter = any_filter(random, scene);
        std::vector<Vector2> points(40);
        std::vector<Rectangle> rectangles(40);
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i] = any_point(random, scene, box);
            rectangles[i] = any_rectangle(random, scene, box);
        }
        InstanceLists of_points;
        InstanceLists of_rectangles;
        ASSERT_TRUE(scene.world().find_overlaps(points, of_points, {.filter = filter}).ok());
        ASSERT_TRUE(
            scene.world().find_overlaps(rectangles, of_rectangles, {.filter = filter}).ok());
        ASSERT_EQ(of_points.offsets.size(), points.size() + 1);
        ASSERT_EQ(of_rectangles.offsets.size(), rectangles.size() + 1);
        for (std::size_t i = 0; i < points.size() && !HasFailure(); ++i) {
            SCOPED_TRACE(i);
            check_list(scene, filter, of_points, i, [&](std::size_t instance) {
                const Wide distance = scene.truth(instance).signed_distance(wide(points[i]));
                const double slack = slack_of(scene, instance, points[i]);
                return std::abs(distance) <= slack ? 2 : distance < 0.0L ? 1 : 0;
            });
            check_list(scene, filter, of_rectangles, i, [&](std::size_t instance) {
                const Rectangle& rectangle = rectangles[i];
                const double slack = slack_of(scene, instance, rectangle.max);
                const bool least = scene.truth(instance).meets(grown(rectangle, -slack));
                const bool most = scene.truth(instance).meets(grown(rectangle, slack));
                return least == most ? (least ? 1 : 0) : 2;
            });
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Scenes, WorldOverlaps, testing::ValuesIn(all_scene_kinds()));

TEST(WorldOverlapsOfSquares, HoldTheirBoundaries) {
    Scene scene({{"square", rectangle({0, 0}, {10, 10}), {{1e6, -2e6}, 0.7}}});
    const PlacedRings& truth = scene.truth(0);
    std::vector<Vector2> points;
    std::vector<Rectangle> rectangles;
    for (const WideEdge& edge : truth.edges()) {
        for (const Wide part : {0.0L, 0.25L, 0.5L}) {
            points.push_back({static_cast<double>(edge.from.x + part * (edge.to.x - edge.from.x)),
                              static_cast<double>(edge.from.y + part * (edge.to.y - edge.from.y))});
            rectangles.push_back({points.back(), points.back()});
        }
    }
    const std::size_t on_boundary = points.size();
    points.push_back({points[1].x + 20.0, points[1].y});
    InstanceLists lists;
    ASSERT_TRUE(scene.world().find_overlaps(points, lists).ok());
    EXPECT_EQ(lists.instances.size(), on_boundary);
    EXPECT_EQ(lists.offsets.back(), lists.offsets[on_boundary]);
    ASSERT_TRUE(scene.world().find_overlaps(rectangles, lists).ok());
    EXPECT_EQ(lists.instances.size(), on_boundary);
}

TEST(WorldOverlapsOfSquares, CountTouching) {
    Scene scene({{"square", rectangle({0, 0}, {1, 1}), {{2.0, 0.0}}},
                 {"ring", {rectangle({0, 0}, {9, 9})[0], rectangle({1, 1}, {8, 8})[0]}, {}}});
    const std::vector<Rectangle> rectangles{
        {{3.0, 1.0}, {4.0, 2.0}},      // touches the square's corner, lies across the ring's inside
        {{2.0, 2.0}, {7.0, 7.0}},      // in the hole
        {{-5.0, -5.0}, {-1.0, 20.0}},  // outside
        {{-5.0, -5.0}, {20.0, 20.0}},  // around everything
        {{0.5, 5.0}, {0.5, 5.0}},      // a point in the ring
        {{2.25, 0.25}, {2.75, 0.75}},  // in both
    };
    InstanceLists lists;
    ASSERT_TRUE(scene.world().find_overlaps(rectangles, lists).ok());
    EXPECT_EQ(lists.offsets, (std::vector<std::uint32_t>{0, 2, 2, 2, 4, 5, 7}));
    EXPECT_EQ(lists.instances[0], scene.handle(0));
    EXPECT_EQ(lists.instances[4], scene.handle(1));
    const std::vector<Vector2> points{{2.5, 0.5}, {4.0, 4.0}, {0.5, 5.0}, {50.0, 50.0}};
    ASSERT_TRUE(scene.world().find_overlaps(points, lists).ok());
    EXPECT_EQ(lists.offsets, (std::vector<std::uint32_t>{0, 2, 2, 3, 3}));
}

// Far from the origin a box is rounded by more than the box of the instance that came last.
TEST(WorldOverlapsOfSquares, AreTheSameWhateverIsElsewhere) {
    Random random(17500);
    int touching = 0;
    for (int i = 0; i < 2000; ++i) {
        const Rings rings = star(random, 5, 0.5);
        const Pose pose{{random.between(1e6, 2e6), random.between(1e6, 2e6)},
                        random.between(-3.0, 3.0)};
        Vector2 right{};
        for (const Vector2& vertex : rings.front()) {
            const double x = pose.translation.x + vertex.x * std::cos(pose.angle) -
                             vertex.y * std::sin(pose.angle);
            const double y = pose.translation.y + vertex.x * std::sin(pose.angle) +
                             vertex.y * std::cos(pose.angle);
            right = x > right.x ? Vector2{x, y} : right;
        }
        std::vector<Rectangle> rectangles;
        for (int step = -4; step <= 4; ++step) {
            const double x = right.x + step * 0x1p-33;
            rectangles.push_back({{x, right.y - 1.0}, {x + 1.0, right.y + 1.0}});
        }
        Scene alone({{"far", rings, pose}});
        Scene both({{"far", rings, pose}, {"near", rectangle({0, 0}, {1, 1}), {}}});
        InstanceLists expected;
        InstanceLists found;
        ASSERT_TRUE(alone.world().find_overlaps(rectangles, expected).ok());
        ASSERT_TRUE(both.world().find_overlaps(rectangles, found).ok());
        EXPECT_EQ(found.offsets, expected.offsets);
        touching += expected.instances.empty() ? 0 : 1;
    }
    EXPECT_GT(touching, 0);
}

}  // namespace
}  // namespace nearfield::test
