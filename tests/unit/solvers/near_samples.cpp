#include <engine/narrowphase/located_points.hpp>
#include <engine/solvers/near_samples.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/boundary_samples.hpp>
#include <tests/unit/support/placed_shapes.hpp>

#include <cmath>

namespace nearfield {
namespace {

using geometry::Polygon;
using geometry::Vector;
using Place = std::pair<std::uint32_t, double>;

/// All samples of A's boundary within `distance` of B, by brute force.
std::vector<Place> samples_near(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                                double distance, double spacing) {
    std::vector<Place> near;
    for (const queries::BoundaryPoint& sample : samples::of_boundary(a, spacing)) {
        if (simd::find_nearest(b, queries::position(a.placed, sample)).squared <=
            distance * distance) {
            near.emplace_back(sample.edge, sample.parameter);
        }
    }
    return near;
}

struct Counts {
    std::size_t found = 0;
    std::size_t near = 0;
};

/// Compares the results with brute force; A and B are complete.
Counts check(solvers::NearSamples& finder, const simd::TransformedEdges& a,
             const simd::TransformedEdges& b, double distance, double spacing) {
    std::vector<Place> found;
    finder.find(a, b, distance, spacing, [&] {
        const simd::PointArrays points = finder.points().arrays();
        for (std::size_t i = 0; i < points.count; ++i) {
            const queries::BoundaryPoint& place = finder.place(i);
            const Vector point = queries::position(a.placed, place);
            EXPECT_EQ(Vector(points.x[i], points.y[i]), point);
            EXPECT_TRUE(found.empty() || found.back() < Place(place.edge, place.parameter));
            found.emplace_back(place.edge, place.parameter);
        }
    });
    Counts counts{found.size(), 0};
    const std::vector<Place> near = samples_near(a, b, distance, spacing);
    counts.near = near.size();
    EXPECT_TRUE(std::includes(found.begin(), found.end(), near.begin(), near.end()));
    return counts;
}

/// Calls `use(A, B)` for all pairs of assorted shapes, complete, at random poses.
template <class Use>
void for_each_pair(std::uint32_t seed, const Use& use) {
    test::Random random(seed);
    const std::vector<test::NamedRings> shapes = samples::assorted_shapes(random);
    for (const test::NamedRings& one : shapes) {
        for (const test::NamedRings& other : shapes) {
            SCOPED_TRACE(one.name + ", " + other.name);
            const Polygon a = samples::polygon(one.rings);
            const Polygon b = samples::polygon(other.rings);
            const Pose pose{{random.between(-2.0, 2.0), random.between(-2.0, 2.0)}, 0.4};
            const samples::PlacedPair pair(a, pose, b, random.below(4) == 0 ? pose : Pose{});
            use(pair.a(), pair.b());
        }
    }
}

TEST(NearSamples, AreAllSamplesThatAreNear) {
    solvers::NearSamples finder;
    std::size_t near = 0;
    for_each_pair(131, [&](const simd::TransformedEdges& a, const simd::TransformedEdges& b) {
        for (const double spacing : {0.3, 0.01}) {
            for (const double distance : {1e-300, 1e-9, 0.02, 0.5, 3.0, 1e300}) {
                SCOPED_TRACE(std::to_string(spacing) + ", " + std::to_string(distance));
                near += check(finder, a, b, distance, spacing).near;
                near += check(finder, b, a, distance, spacing).near;
            }
        }
    });
    EXPECT_GT(near, 300000U);
}

TEST(NearSamples, AreHardlyAnyOthers) {
    solvers::NearSamples finder;
    Counts all;
    for_each_pair(137, [&](const simd::TransformedEdges& a, const simd::TransformedEdges& b) {
        const Counts counts = check(finder, a, b, 0.02, 0.002);
        all = {all.found + counts.found, all.near + counts.near};
    });
    EXPECT_GT(all.near, 10000U);
    EXPECT_LT(all.found, all.near + all.near / 2);
}

TEST(NearSamples, OfShapesFarFromTheOriginAreAllThatAreNear) {
    // Parallel edges exactly at the requested distance.
    const Polygon a = samples::polygon(test::rectangle({0.0, 0.0}, {1.0, 1.0}));
    solvers::NearSamples finder;
    for (const double angle : {0.0, 0.7, 2.0}) {
        const Pose pose{{1e6, -3e6}, angle};
        const Polygon b = samples::polygon(test::rectangle({1.25, 0.0}, {2.0, 1.0}));
        const samples::PlacedPair pair(a, pose, b, pose);
        std::size_t count = 0;
        finder.find(pair.a(), pair.b(), 0.25, 0.01, [&] { count += finder.points().size(); });
        EXPECT_GE(count, 101U);
    }
}

TEST(NearSamples, OfManyComeInListsOfBoundedLength) {
    const Polygon a = samples::polygon(test::rectangle({0.0, 0.0}, {1.0, 1.0}));
    const Polygon b = samples::polygon(test::rectangle({1.25, 0.0}, {2.0, 1.0}));
    solvers::NearSamples finder;
    const samples::PlacedPair pair(a, {}, b, {});
    std::size_t lists = 0;
    std::size_t count = 0;
    finder.find(pair.a(), pair.b(), 0.26, 1e-6, [&] {
        EXPECT_LE(finder.points().size(), narrowphase::points_at_once(b.size()));
        count += finder.points().size();
        ++lists;
    });
    EXPECT_GT(lists, 10U);
    EXPECT_GE(count, 1'000'000U);
    EXPECT_LT(count, 1'100'000U);
    EXPECT_GE(finder.max_samples(pair.a(), pair.b(), 0.26, 1e-6), static_cast<double>(count));
}

}  // namespace
}  // namespace nearfield
