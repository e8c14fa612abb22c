#include <engine/simd/transformed_edges.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <vector>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;

/// For a lattice of squares in any order, neighbouring leaf boxes are near each other: those above
/// them are hardly larger than their contents require.
TEST(TransformedEdges, HaveSmallBoxesWhateverTheOrderOfRings) {
    constexpr std::uint32_t side = 40;
    test::Rings squares;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const std::uint32_t row = i / side;
        const double x = i % side;
        const double y = row;
        squares.push_back({{x, y}, {x + 0.5, y}, {x + 0.5, y + 0.5}, {x, y + 0.5}});
    }
    test::Random random(3);
    for (std::uint32_t i = side * side - 1; i > 0; --i) {
        std::swap(squares[i], squares[random.below(i + 1)]);
    }
    const Polygon polygon = samples::polygon(squares);
    simd::TransformedInstances instances;
    const std::uint32_t index = instances.place(polygon, {});
    instances.complete(index);
    const simd::AabbTree tree = instances[index].tree();
    const simd::BoxArrays& boxes = tree.boxes(1, 0);
    ASSERT_EQ(boxes.count, side * side / simd::AabbTree::fan_out);
    double area = 0.0;
    for (std::uint32_t i = 0; i < boxes.count; ++i) {
        area += (boxes.high_x[i] - boxes.low_x[i]) * (boxes.high_y[i] - boxes.low_y[i]);
    }
    EXPECT_LT(area, 3.0 * side * side);
}

/// Rings of many vertices in one or several parts, some closed by an edge that begins or ends a run
/// of eight.
std::vector<test::Rings> large_shapes() {
    test::Random random(17);
    std::vector<test::Rings> shapes{test::regular(2048), test::coast(random, 2049, 0.3),
                                    test::coast(random, 5000, 0.2)};
    test::Rings parts = test::coast(random, 3001, 0.2);
    for (int i = 1; i < 9; ++i) {
        parts.push_back(test::scaled_and_moved(test::regular(5 * i), 0.05, {0.1 * i, 0.0}).front());
    }
    shapes.push_back(parts);
    const std::size_t count = shapes.size();
    for (std::size_t i = 0; i < count; ++i) {
        shapes.push_back(test::scaled_and_moved(shapes[i], 1.0, {3e5, -1e6}));
    }
    return shapes;
}

/// What is found by a polygon's own boxes, at any pose, is what is found without them.
TEST(TransformedEdges, AreTheSameByBoxesOfTheShape) {
    test::Random random(18);
    for (const test::Rings& rings : large_shapes()) {
        const Polygon polygon = samples::polygon(rings);
        ASSERT_EQ(polygon.find_boxes(geometry::BoxSearch::extent), nullptr);
        ASSERT_EQ(polygon.find_boxes(geometry::BoxSearch::edges), nullptr);
        ASSERT_NE(polygon.find_boxes(geometry::BoxSearch::edges), nullptr);
        for (int i = 0; i < 50; ++i) {
            const Pose pose{{random.between(-9.0, 9.0), random.scale(1.0, 1e6)},
                            i < 5 ? 0.5 * 3.141592653589793 * i : random.between(-4.0, 4.0)};
            const geometry::TransformedPolygon placed(polygon, pose);
            const Polygon fresh = polygon;
            simd::TransformedInstances all;
            all.place_alone(geometry::TransformedPolygon(fresh, pose));
            all.complete(0);
            ASSERT_EQ(placed.box().min(), all[0].box.min());
            ASSERT_EQ(placed.box().max(), all[0].box.max());
            simd::TransformedInstances searched;
            searched.place_alone(placed);
            searched.prepare(0);
            ASSERT_NE(searched[0].on_demand, nullptr);
            const double x = pose.translation.x + random.between(-1.0, 1.0);
            const double y = pose.translation.y + random.between(-1.0, 1.0);
            const simd::Extent box{x, y, x + 0.1, y + 0.1};
            std::vector<std::uint32_t> found(simd::padded(polygon.size()));
            std::vector<std::uint32_t> expected(found.size());
            found.resize(simd::kernels::find_edges_in(searched[0].tree(), box, found.data()));
            expected.resize(simd::kernels::find_edges_in(all[0].tree(), box, expected.data()));
            ASSERT_EQ(found, expected);
            ASSERT_EQ(simd::kernels::contain(searched[0].tree(), x, y),
                      simd::kernels::contain(all[0].tree(), x, y));
            ASSERT_EQ(simd::find_nearest(searched[0], {x, y}).squared,
                      simd::find_nearest(all[0], {x, y}).squared);
            for (std::uint32_t edge = 0; edge < polygon.size(); ++edge) {
                ASSERT_EQ(searched[0].start(edge), all[0].start(edge));
                ASSERT_EQ(searched[0].end(edge), all[0].end(edge));
            }
        }
    }
}

/// Any sequence of batches in which shapes, poses or neither change: what is kept is what would be
/// made, and what is kept is bounded.
TEST(TransformedInstances, AreTheSameHoweverManyAreKept) {
    test::Random random(81);
    std::vector<Polygon> polygons(6);
    const auto change = [&](Polygon& polygon) {
        ASSERT_TRUE(polygon.assign(test::star(random, random.whole(3, 300), 0.4)).ok());
    };
    std::for_each(polygons.begin(), polygons.end(), change);
    struct Placed {
        std::size_t polygon;
        Pose pose;
    };
    const auto any = [&]() -> Placed {
        return {random.below(6), {{random.between(-9.0, 9.0), 0.0}, random.between(-4.0, 4.0)}};
    };
    std::vector<Placed> known(60);
    std::generate(known.begin(), known.end(), any);
    simd::TransformedInstances kept;
    std::size_t most_bytes = 0;
    for (int number = 0; number < 600; ++number) {
        SCOPED_TRACE(number);
        kept.begin_batch();
        for (std::uint32_t i = random.below(random.below(5) == 0 ? 61 : 4); i > 0; --i) {
            known[random.below(60)] = any();
        }
        if (random.below(10) == 0) {
            change(polygons[random.below(6)]);
        }
        // Some are left out, and come back later.
        const std::uint32_t left_out = random.below(8);
        simd::TransformedInstances fresh;
        for (const Placed& one : known) {
            if (random.below(10) < left_out) {
                continue;
            }
            const Polygon& polygon = polygons[one.polygon];
            const std::uint32_t in_kept = kept.place(polygon, one.pose);
            const std::uint32_t in_fresh = fresh.place(polygon, one.pose);
            const bool is_complete = random.below(2) == 0;
            if (is_complete) {
                kept.complete(in_kept);
                fresh.complete(in_fresh);
            }
            const simd::TransformedEdges& found = kept[in_kept];
            const simd::TransformedEdges& truth = fresh[in_fresh];
            ASSERT_EQ(&found.placed.polygon(), &polygon);
            ASSERT_EQ(found.count, truth.count);
            ASSERT_TRUE(found.box.isApprox(truth.box, 0.0));
            ASSERT_EQ(found.rounding, truth.rounding);
            ASSERT_EQ(found.magnitude, truth.magnitude);
            const bool has_arrays = simd::is_small(found) || is_complete;
            for (std::uint32_t edge = 0; has_arrays && edge < found.count; ++edge) {
                ASSERT_EQ(found.start(edge), truth.start(edge));
                ASSERT_EQ(found.end(edge), truth.end(edge));
            }
        }
        if (number == 20) {
            most_bytes = 4 * kept.bytes();
        }
    }
    EXPECT_LT(kept.bytes(), most_bytes);
}

TEST(TransformedInstances, AreKeptWhileHalfOfThemAreUsed) {
    test::Random random(82);
    const Polygon polygon = samples::polygon(test::star(random, 12, 0.3));
    simd::TransformedInstances instances;
    const auto place = [&](std::uint32_t first, std::uint32_t count) {
        instances.begin_batch();
        std::uint32_t index = 0;
        for (std::uint32_t i = first; i < first + count; ++i) {
            index = instances.place(polygon, {{0.5 * i, 0.0}, 0.0});
        }
        return index;
    };
    EXPECT_EQ(place(0, 100), 99U);
    EXPECT_EQ(place(49, 51), 99U);
    EXPECT_EQ(place(0, 100), 99U);  // the first ones are still there
    EXPECT_EQ(place(50, 50), 99U);
    EXPECT_EQ(place(98, 2), 1U);  // half is too few: they are made anew
}

}  // namespace
}  // namespace nearfield::narrowphase
