#include "boundary_samples.hpp"
#include "shape_samples.hpp"

#include <engine/inside_samples.hpp>

#include <gtest/gtest.h>

namespace nearfield {
namespace {

using geometry::Polygon;
using geometry::Vector;

/// All samples of A's boundary, one by one.
std::vector<Vector> samples_inside(const exact::PlacedEdges& a, const exact::PlacedEdges& b,
                                   double spacing) {
    std::vector<Vector> inside;
    for (const plan::BoundaryPoint& sample : samples::of_boundary(a, spacing)) {
        const Vector point = plan::position(a.placed, sample);
        if (b.box.contains(point) && contains(b, point)) {
            inside.push_back(point);
        }
    }
    return inside;
}

/// Without those on B's boundary, which may be found or not.
std::vector<Vector> off_boundary(const std::vector<Vector>& points, const exact::PlacedEdges& b) {
    const double touching = 4.0 * b.rounding;
    std::vector<Vector> off;
    for (const Vector& point : points) {
        if (find_nearest(b, point).squared > touching * touching) {
            off.push_back(point);
        }
    }
    return off;
}

TEST(InsideSamples, AreAllSamplesThatLieInside) {
    samples::Random random(97);
    const std::vector<samples::NamedRings> shapes = samples::assorted_shapes(random);
    InsideSamples finder;
    PointList found;
    std::size_t inside = 0;
    for (const samples::NamedRings& one : shapes) {
        for (const samples::NamedRings& other : shapes) {
            const Polygon a = samples::polygon(one.rings);
            const Polygon b = samples::polygon(other.rings);
            const Pose pose{{random.between(-1.0, 1.0), random.between(-1.0, 1.0)}, 0.4};
            exact::PlacedInstances instances;
            const std::uint32_t index_a = instances.place(a, pose);
            const std::uint32_t index_b = instances.place(b, random.below(4) == 0 ? pose : Pose{});
            instances.complete(index_a);
            instances.complete(index_b);
            for (const double spacing : {0.3, 0.01}) {
                for (const bool reversed : {false, true}) {
                    SCOPED_TRACE(one.name + ", " + other.name + ", " + std::to_string(spacing));
                    const exact::PlacedEdges& of = instances[reversed ? index_b : index_a];
                    const exact::PlacedEdges& in = instances[reversed ? index_a : index_b];
                    found.clear();
                    finder.find(of, in, reversed, spacing, found);
                    std::vector<Vector> points;
                    for (std::uint32_t i = 0; i < found.size(); ++i) {
                        points.emplace_back(found.arrays().x[i], found.arrays().y[i]);
                    }
                    EXPECT_EQ(off_boundary(points, in),
                              off_boundary(samples_inside(of, in, spacing), in));
                    inside += points.size();
                }
            }
        }
    }
    EXPECT_GT(inside, 20000U);
}

}  // namespace
}  // namespace nearfield
