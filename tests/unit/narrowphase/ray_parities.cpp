#include <engine/geometry/segment.hpp>
#include <engine/narrowphase/ray_parities.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/awkward_shapes.hpp>
#include <tests/unit/support/placed_shapes.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace nearfield::narrowphase {
namespace {

using geometry::Vector;

/// As they are and far from the origin; calls `check(edges, random)`.
template <class Check>
void for_each_awkward_shape(const Check& check) {
    test::Random random(211);
    samples::for_each_placed(samples::awkward_shapes(random), {{1e6, -3e5}, 0.3},
                             [&](const simd::TransformedEdges& edges) { check(edges, random); });
}

/// Whether a point is inside by the even-odd rule, edge by edge, and how far it is from the
/// boundary.
struct Truth {
    bool inside = false;
    double squared = std::numeric_limits<double>::infinity();
};

Truth truth_of(const simd::TransformedEdges& edges, const Vector& point) {
    Truth truth;
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        const Vector start = edges.start(i);
        const Vector end = edges.end(i);
        if ((start.y() > point.y()) != (end.y() > point.y())) {
            const long double part = (static_cast<long double>(point.y()) - start.y()) /
                                     (static_cast<long double>(end.y()) - start.y());
            truth.inside ^= point.x() < start.x() + part * (end.x() - start.x());
        }
        truth.squared = std::min(truth.squared,
                                 geometry::nearest_on_segment(point, start, end).squared_distance);
    }
    return truth;
}

/// Anywhere about the shape, level with vertices or above them, and beside edges.
Vector any_point(const simd::TransformedEdges& edges, test::Random& random) {
    const auto between = [&](double low, double high) {
        return random.between(low - 0.1 * (high - low), high + 0.1 * (high - low));
    };
    Vector point(between(edges.box.min().x(), edges.box.max().x()),
                 between(edges.box.min().y(), edges.box.max().y()));
    const std::uint32_t edge = random.below(edges.count);
    switch (random.below(4)) {
        case 0:
            return point;
        case 1:
            return {point.x(), edges.start(edge).y()};
        case 2:
            return {edges.start(edge).x(), point.y()};
        default: {
            const Vector along = edges.end(edge) - edges.start(edge);
            const Vector aside(-along.y(), along.x());
            const double size = std::pow(10.0, random.between(-9.0, -2.0));
            return edges.at(edge, random.between(0.0, 1.0)) +
                   (random.below(2) == 0 ? size : -size) * aside;
        }
    }
}

/// Asks for many points, then answers; returns how many were not known at once.
int check_points(const simd::TransformedEdges& edges, test::Random& random, RayParities& parities) {
    const simd::AabbTree tree = edges.tree();
    parities.begin(tree);
    std::vector<Vector> points;
    std::vector<RayParities::Ticket> tickets;
    int late = 0;
    for (int i = 0; i < 3000; ++i) {
        points.push_back(any_point(edges, random));
        tickets.push_back(parities.ask(points.back().x(), points.back().y()));
        late += tickets.back() > RayParities::odd ? 1 : 0;
    }
    parities.answer();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Truth truth = truth_of(edges, points[i]);
        if (truth.squared > edges.rounding * edges.rounding) {
            EXPECT_EQ(parities.is_odd(tickets[i]), truth.inside)
                << i << ": " << points[i].transpose() << ", " << std::sqrt(truth.squared);
        }
    }
    return late;
}

TEST(RayParities, OfPointsAreThoseOfEdgeByEdge) {
    RayParities parities;
    int late = 0;
    for_each_awkward_shape([&](const simd::TransformedEdges& edges, test::Random& random) {
        late += check_points(edges, random, parities);
    });
    EXPECT_GT(late, 10000);
}

/// Also for places at vertices, on edges that lie on each other, and where rounding decides.
TEST(RayParities, OfPlacesOnEdgesAreThoseOfOneRay) {
    RayParities parities;
    int late = 0;
    for_each_awkward_shape([&](const simd::TransformedEdges& edges, test::Random& random) {
        const simd::AabbTree tree = edges.tree();
        parities.begin(tree);
        std::vector<RayParities::Ticket> tickets;
        std::vector<bool> expected;
        for (int i = 0; i < 3000; ++i) {
            const std::uint32_t edge = random.below(edges.count);
            const Vector along = edges.end(edge) - edges.start(edge);
            const Vector place = edges.at(
                edge, random.below(4) == 0 ? 0.25 * random.below(4) : random.between(0.0, 1.0));
            const simd::kernels::Ray ray{place.x(), place.y(),
                                         std::abs(along.y()) < std::abs(along.x())};
            const simd::kernels::LineOfEdge line{along.x(), along.y(), edges.rounding};
            simd::VisitsLeft unlimited;
            expected.push_back(
                simd::kernels::crossings_of_others_are_odd(tree, ray, line, unlimited));
            tickets.push_back(parities.ask(ray, line));
            late += tickets.back() > RayParities::odd ? 1 : 0;
        }
        parities.answer();
        for (std::size_t i = 0; i < tickets.size(); ++i) {
            EXPECT_EQ(parities.is_odd(tickets[i]), expected[i]) << i;
        }
    });
    EXPECT_GT(late, 10000);
}

}  // namespace
}  // namespace nearfield::narrowphase
