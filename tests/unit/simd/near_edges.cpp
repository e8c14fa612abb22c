#include <engine/geometry/segment.hpp>
#include <engine/simd/nearest_kernels.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tests/unit/support/point_samples.hpp>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace nearfield::simd {
namespace {

using geometry::Polygon;
using geometry::Vector;
using samples::Points;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Calls `check()` once with each instruction set that this machine has.
template <class Check>
void for_each_instruction_set(const Check& check) {
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
        const std::int64_t target = left & ~(left - 1);
        SCOPED_TRACE("target " + std::to_string(target));
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().DeInit();
        check();
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().DeInit();
    }
}

/// The squared distances of a point from all edges, least first.
std::vector<double> squared_distances(const TransformedEdges& edges, const Vector& point) {
    std::vector<double> squared;
    for (std::uint32_t edge = 0; edge < edges.count; ++edge) {
        squared.push_back(geometry::nearest_on_segment(point, edges.start(edge), edges.end(edge))
                              .squared_distance);
    }
    std::sort(squared.begin(), squared.end());
    return squared;
}

/// Calls `check(edges)` for shapes of all sizes about the number of lanes, and assorted ones.
template <class Check>
void for_each_shape(const Check& check) {
    samples::Random random(301);
    std::vector<samples::NamedRings> shapes = samples::assorted_shapes(random);
    for (std::uint32_t size = 3; size <= 20; ++size) {
        shapes.push_back(
            {"star of " + std::to_string(size), {samples::star(random, size, 0.3, 1.0)}});
    }
    for (const samples::NamedRings& shape : shapes) {
        SCOPED_TRACE(shape.name);
        const Polygon polygon = samples::polygon(shape.rings);
        TransformedInstances instances;
        const std::uint32_t index = instances.place(polygon, {{0.3, -0.2}, 0.5});
        instances.complete(index);
        check(instances[index]);
    }
}

Points points_about(const TransformedEdges& edges, samples::Random& random) {
    Points points;
    const double steps[] = {1e-5, 0.01, 1.0};
    const double step = steps[random.below(3)];
    Vector at(random.between(-1.2, 1.2), random.between(-1.2, 1.2));
    for (int i = 0; i < 21; ++i) {
        points.push(edges.placed.to_world(at));
        at += step * Vector(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
    }
    return points;
}

/// Rounding of a squared distance.
double allowed(double squared) {
    return 1e-11 * (1.0 + squared);
}

TEST(NearEdges, TheSecondNearestIsThatOfBruteForceOnEveryInstructionSet) {
    for_each_instruction_set([] {
        samples::Random random(302);
        for_each_shape([&](const TransformedEdges& edges) {
            if (!is_small(edges)) {
                return;  // has no inverse lengths
            }
            const Points points = points_about(edges, random);
            for (std::uint32_t i = 0; i < points.count; ++i) {
                const Vector point(points.x[i], points.y[i]);
                const std::vector<double> truth = squared_distances(edges, point);
                const NearestOfEdges found = kernels::find_nearest(edges, point.x(), point.y());
                ASSERT_LT(found.edge, edges.count);
                EXPECT_NEAR(found.squared, truth[0], allowed(truth[0]));
                EXPECT_NEAR(found.second_squared, truth[1], allowed(truth[1]))
                    << "nearest edge " << found.edge << " of " << edges.count;
            }
        });
    });
}

/// What find_nearest_of() promises of the second and third nearest: no edge is nearer, and whatever
/// is within the margin is told.
void check_others(const TransformedEdges& edges, const Points& points, double margin,
                  const NearestArrays& found) {
    for (std::uint32_t i = 0; i < points.count; ++i) {
        const Vector point(points.x[i], points.y[i]);
        const std::vector<double> truth = squared_distances(edges, point);
        const double limit = std::sqrt(truth[0]) + margin;
        EXPECT_NEAR(found.distance[i], std::sqrt(truth[0]), 1e-7);
        const double others[] = {found.second_squared[i], found.third_squared[i]};
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_GE(others[k], truth[k + 1] - allowed(truth[k + 1])) << k << " of point " << i;
            if (truth[k + 1] <= limit * limit) {
                EXPECT_LE(others[k], truth[k + 1] + allowed(truth[k + 1])) << k << " of " << i;
            }
        }
        if (found.second_squared[i] < infinity) {
            ASSERT_LT(found.second[i], edges.count);
            EXPECT_NE(found.second[i], found.edge[i]);
            const auto second = geometry::nearest_on_segment(point, edges.start(found.second[i]),
                                                             edges.end(found.second[i]));
            EXPECT_NEAR(second.squared_distance, found.second_squared[i],
                        allowed(second.squared_distance));
        }
    }
}

/// find_nearest_of() for up to 64 points, against brute force.
void check_nearest(const TransformedEdges& edges, const Points& points, double margin) {
    std::vector<double> numbers(6 * 64);
    std::vector<std::uint32_t> indices(2 * 64);
    const NearestArrays found{numbers.data(),       numbers.data() + 64,  numbers.data() + 128,
                              numbers.data() + 192, numbers.data() + 256, numbers.data() + 320,
                              indices.data(),       indices.data() + 64};
    std::vector<std::uint32_t> near(padded(edges.count));
    if (is_small(edges)) {
        kernels::find_nearest_of(points.arrays(), edges, margin, near.data(), found);
    } else {
        DivisionMemory memory;
        kernels::find_nearest_of(points.arrays(), edges.tree(), margin, near.data(), memory, found);
    }
    check_others(edges, points, margin, found);
}

TEST(NearEdges, OfManyPointsTheOthersAreThoseOfBruteForceOnEveryInstructionSet) {
    for_each_instruction_set([] {
        samples::Random random(303);
        for_each_shape([&](const TransformedEdges& edges) {
            for (const double margin : {0.0, 1e-3, 0.2}) {
                check_nearest(edges, points_about(edges, random), margin);
            }
        });
    });
}

/// Squares around each other, which boxes over edges do not tell apart.
std::vector<std::vector<Vector2>> nested_squares() {
    std::vector<std::vector<Vector2>> rings;
    for (int i = 0; i < 1500; ++i) {
        const double half = 0.6 + 2e-4 * i;
        rings.push_back({{-half, -half}, {half, -half}, {half, half}, {-half, half}});
    }
    return rings;
}

TEST(NearEdges, OfCrowdedPointsWhatIsWithinTheMarginIsTold) {
    for_each_instruction_set([] {
        samples::Random random(304);
        const Polygon polygon = samples::polygon(nested_squares());
        TransformedInstances instances;
        const std::uint32_t index = instances.place(polygon, {{0.3, -0.2}, 0.5});
        instances.complete(index);
        const TransformedEdges& edges = instances[index];
        // Much closer to each other than edges are.
        Points points;
        for (int i = 0; i < 21; ++i) {
            points.push(edges.placed.to_world(
                {0.59 + 1e-6 * random.between(-1.0, 1.0), 1e-6 * random.between(-1.0, 1.0)}));
        }
        check_nearest(edges, points, 1e-3);
    });
}

}  // namespace
}  // namespace nearfield::simd
