#include <engine/geometry/overlap.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace nearfield::narrowphase {
namespace {

using geometry::Box;
using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

/// Every sample shape at a pose, and stars with few edges, so that the last lanes are full and not
/// full.
template <class Check>
void for_each_shape_of_any_size(const Check& check) {
    samples::Random random(77);
    std::vector<samples::NamedRings> shapes = samples::assorted_shapes(random);
    for (const std::uint32_t size : {3U, 4U, 5U, 6U, 7U, 8U, 9U, 63U, 64U, 65U, 511U, 520U}) {
        shapes.push_back(
            {std::to_string(size) + " vertices", {samples::star(random, size, 0.4, 1.0)}});
    }
    for (const samples::NamedRings& shape : shapes) {
        SCOPED_TRACE(shape.name);
        const Polygon polygon = samples::polygon(shape.rings);
        const Pose pose{{30.0, -3.0}, 0.7};
        simd::TransformedInstances instances;
        const std::uint32_t index = instances.place(polygon, pose);
        instances.complete(index);
        check(instances[index], TransformedPolygon(polygon, pose), random);
    }
}

Vector any_point_near(const TransformedPolygon& placed, samples::Random& random) {
    return placed.to_world({random.between(-1.5, 1.5), random.between(-1.5, 1.5)});
}

TEST(TransformedEdges, AreThePolygonsOwn) {
    for_each_shape_of_any_size([](const simd::TransformedEdges& edges,
                                  const TransformedPolygon& placed, samples::Random&) {
        ASSERT_EQ(edges.count, placed.polygon().size());
        for (std::uint32_t i = 0; i < edges.count; ++i) {
            EXPECT_EQ(edges.start(i), placed.vertex(i));
            EXPECT_EQ(edges.end(i), placed.vertex(placed.polygon().next(i)));
        }
        EXPECT_TRUE(edges.box.isApprox(placed.box()));
    });
}

/// Checks one point against all edges of a shape. `edges`: EdgeArrays or an AabbTree over them;
/// `nearest`: the feature found as nearest.
template <class Edges>
void check_point(const simd::TransformedEdges& placed, const Edges& edges, const Vector& point,
                 double limit, const simd::NearEdge& nearest) {
    EXPECT_EQ(simd::kernels::contain(edges, point.x(), point.y()),
              geometry::contains(placed.placed, point));
    ASSERT_LT(nearest.edge, placed.count);
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::uint32_t> expected;
    const auto squared_to = [&](std::uint32_t edge) {
        return geometry::nearest_on_segment(point, placed.start(edge), placed.end(edge))
            .squared_distance;
    };
    for (std::uint32_t edge = 0; edge < placed.count; ++edge) {
        least = std::min(least, squared_to(edge));
        if (squared_to(edge) <= limit) {
            expected.push_back(edge);
        }
    }
    EXPECT_NEAR(nearest.squared, least, 1e-12);
    EXPECT_NEAR(squared_to(nearest.edge), least, 1e-12);
    std::vector<std::uint32_t> near(simd::padded(placed.count));
    near.resize(simd::kernels::find_edges_within(edges, point.x(), point.y(), limit, near.data()));
    EXPECT_EQ(near, expected);
}

/// Every leaf box must contain its edges, and every edge must be in one of them.
void check_lowest_boxes(const simd::TransformedEdges& edges) {
    const simd::AabbTree tree = edges.tree();
    const simd::BoxArrays& boxes = tree.level(0);
    std::vector<int> times(edges.count);
    for (std::uint32_t box = 0; box < boxes.count; ++box) {
        const simd::EdgeRange some = tree.edges_of(box);
        ASSERT_LT(some.first, some.end);
        ASSERT_LE(some.end, std::min(some.first + simd::AabbTree::fan_out, edges.count));
        Box around;
        for (std::uint32_t i = some.first; i < some.end; ++i) {
            around.extend(edges.start(i)).extend(edges.end(i));
            ++times[i];
        }
        EXPECT_EQ(around.min(), Vector(boxes.low_x[box], boxes.low_y[box]));
        EXPECT_EQ(around.max(), Vector(boxes.high_x[box], boxes.high_y[box]));
    }
    EXPECT_EQ(times, std::vector<int>(edges.count, 1));
}

TEST(TransformedEdges, HaveLowestBoxesAroundEachOnce) {
    int in_pieces = 0;
    for_each_shape_of_any_size(
        [&](const simd::TransformedEdges& edges, const TransformedPolygon&, samples::Random&) {
            check_lowest_boxes(edges);
            in_pieces += edges.tree().is_in_order() ? 0 : 1;
        });
    EXPECT_GT(in_pieces, 0);
}

/// For a lattice of squares in any order, neighbouring leaf boxes are near each other: those above
/// them are hardly larger than their contents require.
TEST(TransformedEdges, HaveSmallBoxesWhateverTheOrderOfRings) {
    constexpr std::uint32_t side = 40;
    samples::Rings squares;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const std::uint32_t row = i / side;
        const double x = i % side;
        const double y = row;
        squares.push_back({{x, y}, {x + 0.5, y}, {x + 0.5, y + 0.5}, {x, y + 0.5}});
    }
    samples::Random random(3);
    for (std::uint32_t i = side * side - 1; i > 0; --i) {
        std::swap(squares[i], squares[random.below(i + 1)]);
    }
    const Polygon polygon = samples::polygon(squares);
    simd::TransformedInstances instances;
    const std::uint32_t index = instances.place(polygon, {});
    instances.complete(index);
    const simd::AabbTree tree = instances[index].tree();
    const simd::BoxArrays& boxes = tree.level(1);
    ASSERT_EQ(boxes.count, side * side / simd::AabbTree::fan_out);
    double area = 0.0;
    for (std::uint32_t i = 0; i < boxes.count; ++i) {
        area += (boxes.high_x[i] - boxes.low_x[i]) * (boxes.high_y[i] - boxes.low_y[i]);
    }
    EXPECT_LT(area, 3.0 * side * side);
}

/// Instances keep their parts when others are completed.
TEST(TransformedEdges, KeepTheirPiecesWhereOthersGetSome) {
    samples::Random random(5);
    samples::Rings triangles;
    for (int i = 0; i < 60; ++i) {
        triangles.push_back(samples::moved({samples::star(random, 3, 0.05, 0.2)},
                                           random.between(-0.9, 0.9), random.between(-0.9, 0.9))
                                .front());
    }
    const Polygon polygon = samples::polygon(triangles);
    simd::TransformedInstances instances;
    constexpr std::uint32_t many = 20;
    for (std::uint32_t i = 0; i < many; ++i) {
        instances.complete(instances.place(polygon, {{3.0 * i, 0.0}, 0.1 * i}));
    }
    for (std::uint32_t i = 0; i < many; ++i) {
        ASSERT_FALSE(instances[i].tree().is_in_order());
        check_lowest_boxes(instances[i]);
    }
}

TEST(TransformedEdges, ContainAndFindTheNearestAsOneByOne) {
    int small = 0;
    for_each_shape_of_any_size([&](const simd::TransformedEdges& edges,
                                   const TransformedPolygon& placed, samples::Random& random) {
        int inside = 0;
        for (int i = 0; i < 200; ++i) {
            const Vector point = any_point_near(placed, random);
            const double limit = random.between(0.0, 2.0);
            inside += geometry::contains(placed, point) ? 1 : 0;
            const auto guess = static_cast<std::uint32_t>(random.between(0.0, edges.count - 0.01));
            const double to_guess =
                geometry::nearest_on_segment(point, edges.start(guess), edges.end(guess))
                    .squared_distance;
            check_point(
                edges, edges.tree(), point, limit,
                simd::kernels::find_nearer(edges.tree(), point.x(), point.y(), {guess, to_guess}));
            if (simd::is_small(edges)) {
                check_point(edges, edges, point, limit,
                            simd::kernels::find_nearest(edges, point.x(), point.y()));
                ++small;
            }
        }
        EXPECT_LT(inside, 200);
    });
    EXPECT_GT(small, 1000);
}

TEST(TransformedEdges, AreListedByTheBoxesTheyMeet) {
    for_each_shape_of_any_size([](const simd::TransformedEdges& edges,
                                  const TransformedPolygon& placed, samples::Random& random) {
        for (int i = 0; i < 20; ++i) {
            Box box(any_point_near(placed, random));
            box.extend(any_point_near(placed, random));
            std::vector<std::uint32_t> expected;
            for (std::uint32_t edge = 0; edge < edges.count; ++edge) {
                Box own(edges.start(edge));
                own.extend(edges.end(edge));
                if (own.intersects(box)) {
                    expected.push_back(edge);
                }
            }
            std::vector<std::uint32_t> found(simd::padded(edges.count));
            found.resize(
                simd::kernels::find_edges_in(edges, geometry::extent_of(box), found.data()));
            EXPECT_EQ(found, expected);
            found.resize(simd::padded(edges.count));
            found.resize(
                simd::kernels::find_edges_in(edges.tree(), geometry::extent_of(box), found.data()));
            EXPECT_EQ(found, expected);
        }
    });
}

TEST(TransformedEdges, SelectTheVerticesInABox) {
    for_each_shape_of_any_size([](const simd::TransformedEdges& edges,
                                  const TransformedPolygon& placed, samples::Random& random) {
        for (int i = 0; i < 20; ++i) {
            Box box(any_point_near(placed, random));
            box.extend(any_point_near(placed, random));
            std::vector<double> x(simd::padded(edges.count));
            std::vector<double> y(simd::padded(edges.count));
            const std::uint32_t count = simd::kernels::find_points_in(
                edges.starts(), geometry::extent_of(box), {x.data(), y.data()});
            std::vector<Vector> expected;
            for (std::uint32_t v = 0; v < edges.count; ++v) {
                if (box.contains(edges.start(v))) {
                    expected.push_back(edges.start(v));
                }
            }
            std::vector<Vector> found;
            for (std::uint32_t v = 0; v < count; ++v) {
                found.emplace_back(x[v], y[v]);
            }
            EXPECT_EQ(found, expected);
        }
    });
}

/// Every edge against every edge; if none meet, one vertex of each tells the rest.
bool intersect_by_force(const simd::TransformedEdges& a, const simd::TransformedEdges& b) {
    for (std::uint32_t i = 0; i < a.count; ++i) {
        for (std::uint32_t j = 0; j < b.count; ++j) {
            if (geometry::segments_meet(a.start(i), a.end(i), b.start(j), b.end(j),
                                        a.rounding + b.rounding)) {
                return true;
            }
        }
    }
    return contains(a, b.start(0)) || contains(b, a.start(0));
}

TEST(TransformedEdges, MeetAsBruteForceSays) {
    samples::Random random(78);
    OverlapTest finder;
    int met = 0;
    int tried = 0;
    while (tried < 1000) {
        const auto size_a =
            static_cast<std::uint32_t>(random.between(3.0, tried % 8 == 0 ? 400.0 : 90.0));
        const auto size_b = static_cast<std::uint32_t>(random.between(3.0, 40.0));
        const Polygon a = samples::polygon({samples::star(random, size_a, 0.3, 1.0)});
        const Polygon b = samples::polygon({samples::star(random, size_b, 0.1, 0.6)});
        const Pose pose{{random.between(-1.1, 1.1), random.between(-1.1, 1.1)}, 0.3};
        simd::TransformedInstances instances;
        const std::uint32_t index_a = instances.place(a, {});
        const std::uint32_t index_b = instances.place(b, pose);
        instances.complete(index_a);
        instances.complete(index_b);
        const simd::TransformedEdges& edges_a = instances[index_a];
        const simd::TransformedEdges& edges_b = instances[index_b];
        const bool meets = intersect_by_force(edges_a, edges_b);
        EXPECT_EQ(finder.intersect(edges_a, edges_b), meets);
        EXPECT_EQ(finder.intersect(edges_b, edges_a), meets);
        bool vertex_inside = false;
        for (std::uint32_t v = 0; v < edges_a.count; ++v) {
            vertex_inside = vertex_inside ||
                            simd::kernels::contain(edges_b, edges_a.start_x[v], edges_a.start_y[v]);
        }
        if (vertex_inside) {
            continue;
        }
        EXPECT_EQ(finder.intersect_without_vertex_inside(edges_a, edges_b), meets);
        met += meets ? 1 : 0;
        ++tried;
    }
    EXPECT_GT(met, 40);
    EXPECT_LT(met, 960);
}

TEST(TransformedInstances, ArePlacedOncePerPose) {
    samples::Random random(79);
    const Polygon polygon = samples::polygon({samples::star(random, 12, 0.3, 1.0)});
    simd::TransformedInstances instances;
    for (int round = 0; round < 2; ++round) {
        instances.clear();
        for (int turn = 0; turn < 2; ++turn) {
            for (std::uint32_t i = 0; i < 500; ++i) {
                ASSERT_EQ(instances.place(polygon, {{0.5 * i, 0.0}, 0.1 * round}), i);
            }
        }
        EXPECT_EQ(instances[300].start(5),
                  TransformedPolygon(polygon, {{150.0, 0.0}, 0.1 * round}).vertex(5));
    }
}

/// Any sequence of batches in which shapes, poses or neither change: what is kept is what would be
/// made, and what is kept is bounded.
TEST(TransformedInstances, AreTheSameHoweverManyAreKept) {
    samples::Random random(81);
    std::vector<Polygon> polygons(6);
    const auto change = [&](Polygon& polygon) {
        const std::uint32_t size = 3 + random.below(298);
        const std::vector<Ring> rings{samples::star(random, size, 0.4, 1.0)};
        ASSERT_TRUE(polygon.assign(rings).ok());
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
    samples::Random random(82);
    const Polygon polygon = samples::polygon({samples::star(random, 12, 0.3, 1.0)});
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
