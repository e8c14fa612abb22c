#include <engine/geometry/segment.hpp>
#include <engine/narrowphase/located_points.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/awkward_shapes.hpp>
#include <tests/unit/support/point_samples.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using geometry::Vector;
using samples::Points;

/// Calls `check(edges, random)` for all kinds of shapes, small, large and crowded.
template <class Check>
void for_each_crowded_shape(const Check& check) {
    samples::Random random(317);
    std::vector<samples::NamedRings> shapes = samples::assorted_shapes(random);
    for (samples::NamedRings& shape : samples::awkward_shapes(random)) {
        shapes.push_back(std::move(shape));
    }
    for (const samples::NamedRings& shape : shapes) {
        SCOPED_TRACE(shape.name);
        const Polygon polygon = samples::polygon(shape.rings);
        simd::TransformedInstances instances;
        const std::uint32_t index = instances.place(polygon, Pose{{0.3, -2.0}, 0.7});
        instances.complete(index);
        check(instances[index], random);
    }
}

/// Points along lines across the shape, and on the boundary.
Points points_about(const simd::TransformedEdges& edges, samples::Random& random) {
    Points points;
    const auto anywhere = [&] {
        return Vector(random.between(edges.box.min().x(), edges.box.max().x()),
                      random.between(edges.box.min().y(), edges.box.max().y()));
    };
    for (int line = 0; line < 10; ++line) {
        const Vector from = anywhere();
        const Vector to = anywhere();
        for (int i = 0; i < 40; ++i) {
            points.push(from + i / 40.0 * (to - from));
        }
        points.push(edges.at(random.below(edges.count), random.below(2) == 0 ? 0.0 : 0.4));
    }
    return points;
}

/// By the even-odd rule, edge by edge.
bool is_inside(const simd::TransformedEdges& edges, const Vector& point) {
    bool inside = false;
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        const Vector start = edges.start(i);
        const Vector end = edges.end(i);
        if ((start.y() > point.y()) != (end.y() > point.y())) {
            const long double part = (static_cast<long double>(point.y()) - start.y()) /
                                     (static_cast<long double>(end.y()) - start.y());
            inside ^= point.x() < start.x() + part * (end.x() - start.x());
        }
    }
    return inside;
}

double distance_to(const simd::TransformedEdges& edges, const Vector& point) {
    double squared = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        squared = std::min(
            squared,
            geometry::nearest_on_segment(point, edges.start(i), edges.end(i)).squared_distance);
    }
    return std::sqrt(squared);
}

TEST(LocatedPoints, AreWhereBruteForceFindsThem) {
    LocatedPoints located;
    int inside = 0;
    int touching = 0;
    for_each_crowded_shape([&](const simd::TransformedEdges& edges, samples::Random& random) {
        const Points points = points_about(edges, random);
        const double touch = 1e-9;
        const double reach = 0.5 * edges.box.sizes().minCoeff();
        located.find(points.arrays(), edges, {.margin = 1e-3, .touching = touch, .reach = reach});
        for (std::uint32_t i = 0; i < points.count; ++i) {
            const Vector point(points.x[i], points.y[i]);
            const double distance = located.nearest().distance[i];
            ASSERT_NEAR(distance, distance_to(edges, point), 1e-11);
            if (distance > reach) {
                continue;
            }
            const bool touches = distance <= touch;
            EXPECT_EQ(located.is_inside(i), !touches && is_inside(edges, point))
                << "point " << i << " at a distance of " << distance;
            inside += located.is_inside(i) ? 1 : 0;
            touching += touches ? 1 : 0;
        }
    });
    EXPECT_GT(inside, 500);
    EXPECT_GT(touching, 50);
}

}  // namespace
}  // namespace nearfield::narrowphase
