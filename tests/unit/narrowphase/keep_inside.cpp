#include <engine/narrowphase/boundary.hpp>

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tests/unit/support/point_samples.hpp>
#include <tests/unit/support/shape_samples.hpp>

#include <limits>
#include <vector>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using geometry::Vector;
using samples::Points;

/// Whether a point is inside by the even-odd rule, edge by edge, and how far it is from the
/// boundary.
struct PointTruth {
    bool inside = false;
    double squared = std::numeric_limits<double>::infinity();
};

PointTruth plain_truth_of(const simd::TransformedEdges& edges, const Vector& point) {
    PointTruth truth;
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        const Vector start = edges.start(i);
        const Vector end = edges.end(i);
        if ((start.y() > point.y()) != (end.y() > point.y())) {
            const double part = (point.y() - start.y()) / (end.y() - start.y());
            truth.inside ^= point.x() < start.x() + part * (end.x() - start.x());
        }
        truth.squared = std::min(truth.squared,
                                 geometry::nearest_on_segment(point, start, end).squared_distance);
    }
    return truth;
}

/// Walks, jumps, and points that stay where they are; off the boundary, where either is right.
Points points_off(const simd::TransformedEdges& edges, samples::Random& random) {
    Points points;
    const double step = random.below(3) == 0 ? 1.0 : 0.02;
    Vector at(random.between(-1.2, 1.2), random.between(-1.2, 1.2));
    for (int i = 0; i < 300; ++i) {
        const Vector point = edges.placed.to_world(at);
        if (plain_truth_of(edges, point).squared > 1e-16) {
            points.push(point);
        }
        if (random.below(5) > 0) {
            at += step * Vector(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        }
        if (at.cwiseAbs().maxCoeff() > 1.3) {
            at = {random.between(-1.2, 1.2), random.between(-1.2, 1.2)};
        }
    }
    return points;
}

TEST(KeepInside, KeepsThePointsInsideInOrderOnEveryInstructionSet) {
    for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
        hwy::SetSupportedTargetsForTest(left & ~(left - 1));
        hwy::GetChosenTarget().DeInit();
        samples::Random random(401);
        std::uint32_t kept_of_all = 0;
        std::uint32_t dropped = 0;
        for (const samples::NamedRings& shape : samples::assorted_shapes(random)) {
            SCOPED_TRACE(shape.name + ", target " + std::to_string(left & ~(left - 1)));
            const Polygon polygon = samples::polygon(shape.rings);
            simd::TransformedInstances instances;
            const std::uint32_t index = instances.place(polygon, {{3.0, -1.0}, 0.7});
            instances.complete(index);
            Boundary boundary;
            boundary.set(instances[index]);
            for (int i = 0; i < 2; ++i) {
                Points points = points_off(instances[index], random);
                std::vector<Vector> expected;
                for (std::uint32_t k = 0; k < points.count; ++k) {
                    const Vector point(points.x[k], points.y[k]);
                    if (plain_truth_of(instances[index], point).inside) {
                        expected.push_back(point);
                    }
                }
                const std::uint32_t kept =
                    boundary.keep_inside(points.count, {points.x.data(), points.y.data()});
                std::vector<Vector> found;
                for (std::uint32_t k = 0; k < kept; ++k) {
                    found.emplace_back(points.x[k], points.y[k]);
                }
                EXPECT_EQ(found, expected);
                kept_of_all += kept;
                dropped += points.count - kept;
            }
        }
        EXPECT_GT(kept_of_all, 1000U);
        EXPECT_GT(dropped, 1000U);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
}

/// Neither here nor there does an edge come near the points, but one lies in between.
TEST(KeepInside, SeesJumpsOverTheBoundary) {
    const Polygon square = samples::polygon({samples::rectangle(-1.0, -1.0, 1.0, 1.0)});
    simd::TransformedInstances instances;
    const std::uint32_t index = instances.place(square, {});
    instances.complete(index);
    Boundary boundary;
    boundary.set(instances[index]);
    // Points stay where they are for some time, first inside, then outside, and so on.
    for (std::uint32_t stay = 1; stay <= 20; ++stay) {
        Points points;
        std::uint32_t inside = 0;
        for (std::uint32_t i = 0; i < 6 * stay; ++i) {
            const bool is_inside = i / stay % 2 == 0;
            points.push({is_inside ? 0.5 : 1.5, 0.001 * i});
            inside += is_inside ? 1U : 0U;
        }
        EXPECT_EQ(boundary.keep_inside(points.count, {points.x.data(), points.y.data()}), inside)
            << stay << " at a time";
    }
}

TEST(KeepInside, OfNoPointsKeepsNone) {
    const Polygon square = samples::polygon({samples::rectangle(-1.0, -1.0, 1.0, 1.0)});
    simd::TransformedInstances instances;
    const std::uint32_t index = instances.place(square, {});
    instances.complete(index);
    Boundary boundary;
    boundary.set(instances[index]);
    Points points;
    points.push({0.0, 0.0});
    EXPECT_EQ(boundary.keep_inside(0, {points.x.data(), points.y.data()}), 0U);
    EXPECT_EQ(boundary.keep_inside(1, {points.x.data(), points.y.data()}), 1U);
}

}  // namespace
}  // namespace nearfield::narrowphase
