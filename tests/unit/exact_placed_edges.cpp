#include "shape_samples.hpp"

#include <engine/exact/meeting.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/localize/overlap.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace nearfield::exact {
namespace {

using geometry::Box;
using geometry::PlacedPolygon;
using geometry::Polygon;
using geometry::Vector;

/// Every shape of the samples at a pose, and stars of few edges, so that the last lanes are full
/// and not full.
template <class Check>
void for_each_shape(const Check& check) {
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
        PlacedInstances instances;
        const std::uint32_t index = instances.place(polygon, pose);
        instances.complete(index);
        check(instances[index], PlacedPolygon(polygon, pose), random);
    }
}

Vector any_point(const PlacedPolygon& placed, samples::Random& random) {
    return placed.to_world({random.between(-1.5, 1.5), random.between(-1.5, 1.5)});
}

TEST(PlacedEdges, AreThePolygonsOwn) {
    for_each_shape([](const PlacedEdges& edges, const PlacedPolygon& placed, samples::Random&) {
        ASSERT_EQ(edges.count, placed.polygon().size());
        for (std::uint32_t i = 0; i < edges.count; ++i) {
            EXPECT_EQ(edges.start(i), placed.vertex(i));
            EXPECT_EQ(edges.end(i), placed.vertex(placed.polygon().next(i)));
        }
        EXPECT_TRUE(edges.box.isApprox(placed.box()));
    });
}

/// Checks one point against all edges of a shape. `edges`: EdgeArrays or a BoxTree over them;
/// `nearest`: what was found the nearest.
template <class Edges>
void check_point(const PlacedEdges& placed, const Edges& edges, const Vector& point, double limit,
                 const NearEdge& nearest) {
    EXPECT_EQ(kernels::contain(edges, point.x(), point.y()),
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
    std::vector<std::uint32_t> near(padded(placed.count));
    near.resize(kernels::find_edges_within(edges, point.x(), point.y(), limit, near.data()));
    EXPECT_EQ(near, expected);
}

/// Every lowest box is around its edges, and every edge under one of them.
void check_lowest_boxes(const PlacedEdges& edges) {
    const BoxTree tree = edges.tree();
    const BoxArrays& boxes = tree.level(0);
    std::vector<int> times(edges.count);
    for (std::uint32_t box = 0; box < boxes.count; ++box) {
        const EdgeRange some = tree.edges_of(box);
        ASSERT_LT(some.first, some.end);
        ASSERT_LE(some.end, std::min(some.first + BoxTree::fan_out, edges.count));
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

TEST(PlacedEdges, HaveLowestBoxesAroundEachOnce) {
    int in_pieces = 0;
    for_each_shape([&](const PlacedEdges& edges, const PlacedPolygon&, samples::Random&) {
        check_lowest_boxes(edges);
        in_pieces += edges.tree().is_in_order() ? 0 : 1;
    });
    EXPECT_GT(in_pieces, 0);
}

/// Of a lattice of squares that come in any order the lowest boxes next to each other are near each
/// other: those above them are hardly larger than what they have to hold.
TEST(PlacedEdges, HaveSmallBoxesWhateverTheOrderOfRings) {
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
    PlacedInstances instances;
    const std::uint32_t index = instances.place(polygon, {});
    instances.complete(index);
    const BoxTree tree = instances[index].tree();
    const BoxArrays& boxes = tree.level(1);
    ASSERT_EQ(boxes.count, side * side / BoxTree::fan_out);
    double area = 0.0;
    for (std::uint32_t i = 0; i < boxes.count; ++i) {
        area += (boxes.high_x[i] - boxes.low_x[i]) * (boxes.high_y[i] - boxes.low_y[i]);
    }
    EXPECT_LT(area, 3.0 * side * side);
}

/// Instances keep their pieces while others are completed.
TEST(PlacedEdges, KeepTheirPiecesWhereOthersGetSome) {
    samples::Random random(5);
    samples::Rings triangles;
    for (int i = 0; i < 60; ++i) {
        triangles.push_back(samples::moved({samples::star(random, 3, 0.05, 0.2)},
                                           random.between(-0.9, 0.9), random.between(-0.9, 0.9))
                                .front());
    }
    const Polygon polygon = samples::polygon(triangles);
    PlacedInstances instances;
    constexpr std::uint32_t many = 20;
    for (std::uint32_t i = 0; i < many; ++i) {
        instances.complete(instances.place(polygon, {{3.0 * i, 0.0}, 0.1 * i}));
    }
    for (std::uint32_t i = 0; i < many; ++i) {
        ASSERT_FALSE(instances[i].tree().is_in_order());
        check_lowest_boxes(instances[i]);
    }
}

TEST(PlacedEdges, ContainAndFindTheNearestAsOneByOne) {
    int small = 0;
    for_each_shape([&](const PlacedEdges& edges, const PlacedPolygon& placed,
                       samples::Random& random) {
        int inside = 0;
        for (int i = 0; i < 200; ++i) {
            const Vector point = any_point(placed, random);
            const double limit = random.between(0.0, 2.0);
            inside += geometry::contains(placed, point) ? 1 : 0;
            const auto guess = static_cast<std::uint32_t>(random.between(0.0, edges.count - 0.01));
            const double to_guess =
                geometry::nearest_on_segment(point, edges.start(guess), edges.end(guess))
                    .squared_distance;
            check_point(
                edges, edges.tree(), point, limit,
                kernels::find_nearer(edges.tree(), point.x(), point.y(), {guess, to_guess}));
            if (is_small(edges)) {
                check_point(edges, edges, point, limit,
                            kernels::find_nearest(edges, point.x(), point.y()));
                ++small;
            }
        }
        EXPECT_LT(inside, 200);
    });
    EXPECT_GT(small, 1000);
}

TEST(PlacedEdges, AreListedByTheBoxesTheyMeet) {
    for_each_shape(
        [](const PlacedEdges& edges, const PlacedPolygon& placed, samples::Random& random) {
            for (int i = 0; i < 20; ++i) {
                Box box(any_point(placed, random));
                box.extend(any_point(placed, random));
                std::vector<std::uint32_t> expected;
                for (std::uint32_t edge = 0; edge < edges.count; ++edge) {
                    Box own(edges.start(edge));
                    own.extend(edges.end(edge));
                    if (own.intersects(box)) {
                        expected.push_back(edge);
                    }
                }
                std::vector<std::uint32_t> found(padded(edges.count));
                found.resize(kernels::find_edges_in(edges, extent_of(box), found.data()));
                EXPECT_EQ(found, expected);
                found.resize(padded(edges.count));
                found.resize(kernels::find_edges_in(edges.tree(), extent_of(box), found.data()));
                EXPECT_EQ(found, expected);
            }
        });
}

TEST(PlacedEdges, SelectTheVerticesInABox) {
    for_each_shape(
        [](const PlacedEdges& edges, const PlacedPolygon& placed, samples::Random& random) {
            for (int i = 0; i < 20; ++i) {
                Box box(any_point(placed, random));
                box.extend(any_point(placed, random));
                std::vector<double> x(padded(edges.count));
                std::vector<double> y(padded(edges.count));
                const std::uint32_t count =
                    kernels::find_points_in(edges.starts(), extent_of(box), {x.data(), y.data()});
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

TEST(PlacedEdges, MeetAsTheHierarchySays) {
    samples::Random random(78);
    MeetingFinder finder;
    int met = 0;
    int tried = 0;
    while (tried < 1000) {
        const auto size_a =
            static_cast<std::uint32_t>(random.between(3.0, tried % 8 == 0 ? 400.0 : 90.0));
        const auto size_b = static_cast<std::uint32_t>(random.between(3.0, 40.0));
        const Polygon a = samples::polygon({samples::star(random, size_a, 0.3, 1.0)});
        const Polygon b = samples::polygon({samples::star(random, size_b, 0.1, 0.6)});
        const Pose pose{{random.between(-1.1, 1.1), random.between(-1.1, 1.1)}, 0.3};
        PlacedInstances instances;
        const std::uint32_t index_a = instances.place(a, {});
        const std::uint32_t index_b = instances.place(b, pose);
        instances.complete(index_a);
        instances.complete(index_b);
        const PlacedEdges& edges_a = instances[index_a];
        const PlacedEdges& edges_b = instances[index_b];
        const bool meets = localize::intersects(edges_a.placed, edges_b.placed);
        EXPECT_EQ(finder.intersect(edges_a, edges_b), meets);
        EXPECT_EQ(finder.intersect(edges_b, edges_a), meets);
        bool vertex_inside = false;
        for (std::uint32_t v = 0; v < edges_a.count; ++v) {
            vertex_inside =
                vertex_inside || kernels::contain(edges_b, edges_a.start_x[v], edges_a.start_y[v]);
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

TEST(PlacedInstances, ArePlacedOncePerPose) {
    samples::Random random(79);
    const Polygon polygon = samples::polygon({samples::star(random, 12, 0.3, 1.0)});
    PlacedInstances instances;
    for (int round = 0; round < 2; ++round) {
        instances.clear();
        for (int turn = 0; turn < 2; ++turn) {
            for (std::uint32_t i = 0; i < 500; ++i) {
                ASSERT_EQ(instances.place(polygon, {{0.5 * i, 0.0}, 0.1 * round}), i);
            }
        }
        EXPECT_EQ(instances[300].start(5),
                  PlacedPolygon(polygon, {{150.0, 0.0}, 0.1 * round}).vertex(5));
    }
}

}  // namespace
}  // namespace nearfield::exact
