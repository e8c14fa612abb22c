#include <engine/narrowphase/located_points.hpp>
#include <engine/solvers/inside_samples.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/awkward_shapes.hpp>
#include <tests/unit/support/boundary_samples.hpp>
#include <tests/unit/support/placed_shapes.hpp>

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
std::size_t check_each_in_other(const test::NamedRings& one, const Pose& pose_one,
                                const test::NamedRings& other, const Pose& pose_other,
                                double spacing, solvers::InsideSamples& finder) {
    const Polygon a = samples::polygon(one.rings);
    const Polygon b = samples::polygon(other.rings);
    const samples::PlacedPair pair(a, pose_one, b, pose_other);
    simd::PointList found;
    std::size_t inside = 0;
    for (const bool reversed : {false, true}) {
        SCOPED_TRACE(one.name + ", " + other.name + ", " + std::to_string(spacing));
        const simd::TransformedEdges& of = reversed ? pair.b() : pair.a();
        const simd::TransformedEdges& in = reversed ? pair.a() : pair.b();
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
    test::Random random(97);
    const std::vector<test::NamedRings> shapes = samples::assorted_shapes(random);
    solvers::InsideSamples finder;
    std::size_t inside = 0;
    for (const test::NamedRings& one : shapes) {
        for (const test::NamedRings& other : shapes) {
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
    test::Random random(98);
    const std::vector<test::NamedRings> shapes = samples::awkward_shapes(random);
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
    test::Random random(5);
    solvers::InsideSamples finder;
    simd::PointList found;
    for (const int vertices : {12, 400}) {
        SCOPED_TRACE(vertices);
        const Polygon a = samples::polygon(test::star(random, vertices, 0.3));
        const Polygon b = samples::polygon(test::star(random, vertices, 0.3));
        const samples::PlacedPair pair(a, {{0.2, 0.1}, 0.4}, b, {});
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
        finder.find(pair.a(), pair.b(), false, spacing, found, take);
        take();
        EXPECT_GE(lists, 2U);
        EXPECT_GE(finder.max_samples(pair.a(), pair.b(), spacing),
                  static_cast<double>(points.size()));
        EXPECT_EQ(off_boundary(points, pair.b()),
                  off_boundary(samples_inside(pair.a(), pair.b(), spacing), pair.b()));
    }
}

}  // namespace
}  // namespace nearfield
