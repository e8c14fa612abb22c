#include <engine/narrowphase/located_points.hpp>
#include <engine/solvers/inside_samples.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/awkward_shapes.hpp>
#include <tests/unit/support/boundary_samples.hpp>

namespace nearfield {
namespace {

using geometry::Polygon;
using geometry::Vector;

/// All samples of A's boundary by brute force.
std::vector<Vector> samples_inside(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                   double spacing) {
    std::vector<Vector> inside;
    for (const queries::BoundaryPoint& sample : samples::of_boundary(a, spacing)) {
        const Vector point = queries::position(a.placed, sample);
        if (b.box.contains(point) && contains(b, point)) {
            inside.push_back(point);
        }
    }
    return inside;
}

/// Without those on B's boundary, which may or may not be found.
std::vector<Vector> off_boundary(const std::vector<Vector>& points,
                                 const simd::TransformedEdges& b) {
    const double touching = 4.0 * b.rounding;
    std::vector<Vector> off;
    for (const Vector& point : points) {
        if (simd::find_nearest(b, point).squared > touching * touching) {
            off.push_back(point);
        }
    }
    return off;
}

/// Compares the samples of each in the other with brute force; returns how many are inside.
std::size_t check_each_in_other(const samples::NamedRings& one, const Pose& pose_one,
                                const samples::NamedRings& other, const Pose& pose_other,
                                double spacing, solvers::InsideSamples& finder) {
    const Polygon a = samples::polygon(one.rings);
    const Polygon b = samples::polygon(other.rings);
    simd::TransformedInstances instances;
    const std::uint32_t index_a = instances.place(a, pose_one);
    const std::uint32_t index_b = instances.place(b, pose_other);
    instances.complete(index_a);
    instances.complete(index_b);
    simd::PointList found;
    std::size_t inside = 0;
    for (const bool reversed : {false, true}) {
        SCOPED_TRACE(one.name + ", " + other.name + ", " + std::to_string(spacing));
        const simd::TransformedEdges& of = instances[reversed ? index_b : index_a];
        const simd::TransformedEdges& in = instances[reversed ? index_a : index_b];
        std::vector<Vector> points;
        const auto take = [&] {
            for (std::uint32_t i = 0; i < found.size(); ++i) {
                points.emplace_back(found.arrays().x[i], found.arrays().y[i]);
            }
        };
        finder.find(of, in, reversed, spacing, found, take);
        take();
        EXPECT_EQ(off_boundary(points, in), off_boundary(samples_inside(of, in, spacing), in));
        inside += points.size();
    }
    return inside;
}

TEST(InsideSamples, AreAllSamplesThatLieInside) {
    samples::Random random(97);
    const std::vector<samples::NamedRings> shapes = samples::assorted_shapes(random);
    solvers::InsideSamples finder;
    std::size_t inside = 0;
    for (const samples::NamedRings& one : shapes) {
        for (const samples::NamedRings& other : shapes) {
            const Pose pose{{random.between(-1.0, 1.0), random.between(-1.0, 1.0)}, 0.4};
            const Pose of_other = random.below(4) == 0 ? pose : Pose{};
            for (const double spacing : {0.3, 0.01}) {
                inside += check_each_in_other(one, pose, other, of_other, spacing, finder);
            }
        }
    }
    EXPECT_GT(inside, 20000U);
}

/// The boxes of so many edges meet that pairs are not listed.
TEST(InsideSamples, OfCrowdedShapesAreAllOfThemToo) {
    samples::Random random(98);
    const std::vector<samples::NamedRings> shapes = samples::awkward_shapes(random);
    solvers::InsideSamples finder;
    std::size_t inside = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const Pose pose{{random.between(-0.3, 0.3), random.between(-0.3, 0.3)}, 0.4};
        inside +=
            check_each_in_other(shapes[i], pose, shapes[(i + 1) % shapes.size()], {}, 0.3, finder);
    }
    EXPECT_GT(inside, 2000U);
}

TEST(InsideSamples, OfManyComeInListsOfBoundedLength) {
    samples::Random random(5);
    solvers::InsideSamples finder;
    simd::PointList found;
    for (const std::uint32_t vertices : {12U, 400U}) {
        SCOPED_TRACE(vertices);
        const Polygon a = samples::polygon({samples::star(random, vertices, 0.3, 1.0)});
        const Polygon b = samples::polygon({samples::star(random, vertices, 0.3, 1.0)});
        simd::TransformedInstances instances;
        const std::uint32_t index_a = instances.place(a, {{0.2, 0.1}, 0.4});
        const std::uint32_t index_b = instances.place(b, {});
        instances.complete(index_a);
        instances.complete(index_b);
        const double spacing = 1e-5 * a.length_along_axes() / 5.0;
        std::vector<Vector> points;
        std::size_t lists = 0;
        const auto take = [&] {
            EXPECT_LE(found.size(), narrowphase::points_at_once(b.size()));
            for (std::uint32_t i = 0; i < found.size(); ++i) {
                points.emplace_back(found.arrays().x[i], found.arrays().y[i]);
            }
            ++lists;
        };
        finder.find(instances[index_a], instances[index_b], false, spacing, found, take);
        take();
        EXPECT_GE(lists, 2U);
        EXPECT_GE(finder.max_samples(instances[index_a], instances[index_b], spacing),
                  static_cast<double>(points.size()));
        EXPECT_EQ(off_boundary(points, instances[index_b]),
                  off_boundary(samples_inside(instances[index_a], instances[index_b], spacing),
                               instances[index_b]));
    }
}

}  // namespace
}  // namespace nearfield
