#include <engine/geometry/segment.hpp>
#include <engine/simd/parameter_intervals.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace nearfield::simd {
namespace {

using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

/// All results of the kernels for two shapes, as numbers.
std::vector<double> said_of(const Polygon& a, const Polygon& b, const Pose& pose,
                            const std::vector<Vector>& points) {
    TransformedInstances instances;
    const std::uint32_t index_a = instances.place(a, {});
    const std::uint32_t index_b = instances.place(b, pose);
    instances.complete(index_a);
    instances.complete(index_b);
    const TransformedEdges& edges_a = instances[index_a];
    const TransformedEdges& edges_b = instances[index_b];
    const AabbTree tree = edges_a.tree();
    std::vector<double> said;
    for (std::uint32_t i = 0; i < edges_b.count; ++i) {
        said.insert(said.end(),
                    {edges_b.start_x[i], edges_b.start_y[i], edges_b.inverse_length[i]});
    }
    std::vector<std::uint32_t> found(simd::padded(edges_a.count) + simd::padded(edges_b.count));
    const auto add_found = [&](std::uint32_t count) {
        said.push_back(count);
        said.insert(said.end(), found.begin(), found.begin() + count);
    };
    const Extent box_b = extent_of(edges_b.box);
    std::vector<double> x(simd::padded(edges_a.count));
    std::vector<double> y(simd::padded(edges_a.count));
    const auto add_points = [&](std::uint32_t count) {
        said.insert(said.end(), x.begin(), x.begin() + count);
        said.insert(said.end(), y.begin(), y.begin() + count);
    };
    add_points(kernels::find_points_in(edges_a.starts(), box_b, {x.data(), y.data()}));
    std::vector<std::uint32_t> crossed(simd::padded(edges_b.count));
    add_points(kernels::find_points_inside(edges_a.starts(), box_b, edges_b, crossed.data(),
                                           {x.data(), y.data()}));
    add_found(kernels::find_edges_in(edges_a, box_b, found.data()));
    for (const Vector& point : points) {
        said.push_back(kernels::contain(edges_a, point.x(), point.y()) ? 1.0 : 0.0);
        const NearEdge nearest = kernels::find_nearest(edges_a, point.x(), point.y());
        said.insert(said.end(), {static_cast<double>(nearest.edge), nearest.squared});
        add_found(kernels::find_edges_within(edges_a, point.x(), point.y(), 0.3, found.data()));
        said.push_back(kernels::contain(tree, point.x(), point.y()) ? 1.0 : 0.0);
        const NearEdge nearer = kernels::find_nearer(tree, point.x(), point.y(), {0, 0.5});
        said.insert(said.end(), {static_cast<double>(nearer.edge), nearer.squared});
        add_found(kernels::find_edges_within(tree, point.x(), point.y(), 0.3, found.data()));
        said.push_back(kernels::meets(tree, {0.0, 0.0, point.x(), point.y()}) ? 1.0 : 0.0);
    }
    for (EdgePair pair; kernels::find_intersecting_pair(edges_a, edges_b, 1e-15, pair);
         ++pair.second) {
        said.insert(said.end(),
                    {static_cast<double>(pair.first), static_cast<double>(pair.second)});
    }
    add_found(kernels::find_edges_in(tree, box_b, found.data()));
    add_found(kernels::find_edges_near(tree, box_b, edges_b.tree(), 0.1, found.data()));
    std::vector<ParameterInterval> intervals(simd::max_intervals);
    const auto add_stretches = [&](std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            said.insert(said.end(), {intervals[i].from, intervals[i].to});
        }
    };
    for (std::uint32_t edge = 0; edge < edges_b.count; ++edge) {
        add_stretches(kernels::find_intervals_near(edges_b, edge, edges_a, 0.05, intervals.data()));
        VisitsLeft unlimited;
        add_stretches(
            kernels::find_intervals_near(edges_b, edge, tree, 0.05, unlimited, intervals.data()));
    }
    const auto say_pair = [&](const EdgePair& pair) {
        said.insert(said.end(),
                    {static_cast<double>(pair.first), static_cast<double>(pair.second)});
        return true;
    };
    VisitsLeft unlimited;
    kernels::for_candidate_pairs(tree, edges_b.tree(), 1e-15, say_pair, unlimited);
    return said;
}

/// Squares on a grid in any order, many of which touch: the nearest edge is one of several.
samples::Rings squares_on_a_grid(samples::Random& random) {
    samples::Rings squares;
    while (squares.size() < 40) {
        const double x = 0.25 * random.below(10) - 1.25;
        const double y = 0.25 * random.below(10) - 1.25;
        squares.push_back({{x, y}, {x + 0.25, y}, {x + 0.25, y + 0.25}, {x, y + 0.25}});
    }
    return squares;
}

TEST(EdgeKernels, SayTheSameOnEveryInstructionSet) {
    samples::Random random(91);
    std::vector<std::int64_t> targets;
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
        targets.push_back(left & ~(left - 1));
    }
    for (int i = 0; i < 60; ++i) {
        const auto size = [&] { return static_cast<std::uint32_t>(random.between(3.0, 120.0)); };
        const Polygon a =
            samples::polygon(i % 4 == 0 ? squares_on_a_grid(random)
                                        : samples::Rings{samples::star(random, size(), 0.3, 1.0)});
        const Polygon b = samples::polygon({samples::star(random, size(), 0.1, 0.9)});
        const Pose pose{{random.between(-1.5, 1.5), random.between(-1.5, 1.5)}, 0.4};
        std::vector<Vector> points;
        for (int k = 0; k < 20; ++k) {
            points.emplace_back(random.between(-1.2, 1.2), random.between(-1.2, 1.2));
            points.emplace_back(0.125 * random.below(20) - 1.25, 0.125 * random.below(20) - 1.25);
        }
        const std::vector<double> expected = said_of(a, b, pose, points);
        for (const std::int64_t target : targets) {
            hwy::SetSupportedTargetsForTest(target);
            hwy::GetChosenTarget().DeInit();
            EXPECT_EQ(said_of(a, b, pose, points), expected) << "target " << target;
        }
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().DeInit();
    }
}

TEST(EdgeKernels, SayOfManyPointsWhatTheySayOfEach) {
    samples::Random random(93);
    std::uint32_t several = 0;
    for (int i = 0; i < 200; ++i) {
        const auto size = [&] { return static_cast<std::uint32_t>(random.between(3.0, 120.0)); };
        const Polygon a = samples::polygon({samples::star(random, size(), 0.3, 1.0)});
        const Polygon b = samples::polygon({samples::star(random, size(), 0.1, 0.9)});
        TransformedInstances instances;
        const std::uint32_t index_a = instances.place(a, {});
        const std::uint32_t index_b =
            instances.place(b, {{random.between(-1.0, 1.0), random.between(-1.0, 1.0)}, 0.4});
        const TransformedEdges& points = instances[index_a];
        const TransformedEdges& edges = instances[index_b];
        std::vector<double> x(simd::padded(points.count));
        std::vector<double> y(simd::padded(points.count));
        std::vector<std::uint32_t> crossed(simd::padded(edges.count));
        const std::uint32_t count = kernels::find_points_inside(
            points.starts(), extent_of(edges.box), edges, crossed.data(), {x.data(), y.data()});
        std::vector<Vector> expected;
        for (std::uint32_t k = 0; k < points.count; ++k) {
            const Vector point = points.start(k);
            if (edges.box.contains(point) && kernels::contain(edges, point.x(), point.y())) {
                expected.push_back(point);
            }
        }
        std::vector<Vector> inside;
        for (std::uint32_t k = 0; k < count; ++k) {
            inside.emplace_back(x[k], y[k]);
        }
        EXPECT_EQ(inside, expected);
        several += count > 8 ? 1U : 0U;
    }
    EXPECT_GT(several, 50U);
}

TEST(EdgeKernels, MissNoPairOfEdgesThatMeet) {
    samples::Random random(92);
    int met = 0;
    for (int i = 0; i < 200; ++i) {
        const Polygon a = samples::polygon({samples::star(random, 15, 0.3, 1.0)});
        const Polygon b = samples::polygon({samples::star(random, 11, 0.1, 0.9)});
        TransformedInstances instances;
        const std::uint32_t index_a = instances.place(a, {});
        // Corner to corner every other time.
        const Vector corner =
            i % 2 == 0 ? Vector(a.vertices()[3] + a.centre() - b.centre() - b.vertices()[2])
                       : Vector(random.between(-1.5, 1.5), 0.3);
        const std::uint32_t index_b = instances.place(b, {{corner.x(), corner.y()}, 0.0});
        const TransformedEdges& edges_a = instances[index_a];
        const TransformedEdges& edges_b = instances[index_b];
        const double margin = edges_a.rounding + edges_b.rounding;
        std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
        for (EdgePair pair; kernels::find_intersecting_pair(edges_a, edges_b, margin, pair);
             ++pair.second) {
            found.emplace_back(pair.first, pair.second);
        }
        EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
        for (std::uint32_t e = 0; e < edges_a.count; ++e) {
            for (std::uint32_t f = 0; f < edges_b.count; ++f) {
                if (geometry::segments_meet(edges_a.start(e), edges_a.end(e), edges_b.start(f),
                                            edges_b.end(f), margin)) {
                    ++met;
                    EXPECT_TRUE(std::binary_search(found.begin(), found.end(), std::pair(e, f)))
                        << e << " and " << f;
                }
            }
        }
    }
    EXPECT_GT(met, 200);
}

}  // namespace
}  // namespace nearfield::simd
