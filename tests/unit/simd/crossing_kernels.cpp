#include <engine/geometry/segment.hpp>
#include <engine/simd/crossing_kernels.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace nearfield::simd {
namespace {

using geometry::Polygon;
using geometry::Vector;

/// True if the ray from `point` in the direction of growing coordinate `along` crosses the edge.
/// Half open across, so that a vertex on the ray counts once.
bool crosses(const Vector& start, const Vector& end, const Vector& point, int along) {
    const int across = 1 - along;
    if ((start[across] > point[across]) == (end[across] > point[across])) {
        return false;
    }
    const double side = geometry::cross(end - start, point - start);
    const bool upward = end[across] > start[across];
    // Left of an upward edge means before it on the x axis, but after it on the y axis.
    return along == 0 ? (side > 0.0) == upward : (side < 0.0) == upward;
}

template <class Counts>
bool are_odd_one_by_one(const TransformedEdges& edges, const Vector& point, int along,
                        const Counts& counts) {
    bool odd = false;
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        odd ^= counts(i) && crosses(edges.start(i), edges.end(i), point, along);
    }
    return odd;
}

/// Rings with integer coordinates and arbitrary crossings, some far apart and some longer than
/// others: rays pass through vertices and along edges, and no number is rounded.
test::Rings rings_on_a_grid(test::Random& random, std::uint32_t count, std::uint32_t most) {
    test::Rings rings;
    while (rings.size() < count) {
        const double x = random.below(40);
        const double y = random.below(40);
        Ring ring;
        for (std::uint32_t i = 0, size = 3 + random.below(most); i < size; ++i) {
            ring.push_back({x + random.below(12), y + random.below(12)});
        }
        const std::vector<Ring> alone{ring};
        if (Polygon polygon; polygon.assign(alone).ok()) {
            rings.push_back(ring);
        }
    }
    return rings;
}

template <class Check>
void for_each_grid_shape(const Check& check) {
    test::Random random(19);
    for (const std::uint32_t count : {1U, 2U, 3U, 7U, 40U, 300U}) {
        for (const std::uint32_t most : {1U, 9U, 100U}) {
            SCOPED_TRACE(std::to_string(count) + " rings of at most " + std::to_string(most + 2));
            const Polygon polygon = samples::polygon(rings_on_a_grid(random, count, most));
            TransformedInstances instances;
            const std::uint32_t index = instances.place(polygon, {});
            instances.complete(index);
            check(instances[index], random);
        }
    }
}

/// The axis that is more perpendicular to a direction than parallel.
int across(const Vector& direction) {
    return std::abs(direction.y()) >= std::abs(direction.x()) ? 0 : 1;
}

TEST(CrossingKernels, CountFromAPlaceOnAnEdgeAllButThoseAlongIt) {
    int more_left_out = 0;
    for_each_grid_shape([&](const TransformedEdges& edges, test::Random& random) {
        for (int i = 0; i < 400; ++i) {
            const std::uint32_t edge = random.below(edges.count);
            const Vector direction = edges.end(edge) - edges.start(edge);
            if (direction.isZero()) {
                continue;
            }
            const Vector point = edges.at(edge, 0.25 * random.below(4));  // where nothing is
                                                                          // rounded
            const int along = across(direction);
            int left_out = 0;
            const bool expected = are_odd_one_by_one(edges, point, along, [&](std::uint32_t other) {
                const Vector along_other = edges.end(other) - edges.start(other);
                const bool on_line =
                    geometry::cross(direction, along_other) == 0.0 &&
                    geometry::cross(along_other, point - edges.start(other)) == 0.0;
                left_out += on_line ? 1 : 0;
                return !on_line;
            });
            more_left_out += left_out > 1 ? 1 : 0;
            VisitsLeft unlimited;
            EXPECT_EQ(kernels::crossings_of_others_are_odd(
                          edges.tree(), {point.x(), point.y(), along == 1},
                          {direction.x(), direction.y(), 1e-12}, unlimited),
                      expected)
                << "edge " << edge << " at " << point.transpose();
        }
    });
    EXPECT_GT(more_left_out, 100);
}

/// A point on an edge is rounded: it may lie beyond everything in the edge's own box.
TEST(CrossingKernels, LeaveOutWhatSeemsToLieAhead) {
    Ring comb{{0.0, -1.0}, {200.0, -1.0}};
    for (int i = 99; i >= 0; --i) {
        comb.insert(comb.end(), {{2.0 * i + 1.5, 0.0}, {2.0 * i + 1.0, 5.0}, {2.0 * i, 0.0}});
    }
    const Polygon polygon = samples::polygon({comb});
    TransformedInstances instances;
    const std::uint32_t index = instances.place(polygon, {});
    instances.complete(index);
    const TransformedEdges& edges = instances[index];
    for (std::uint32_t edge = 0; edge < edges.count; ++edge) {
        const Vector direction = edges.end(edge) - edges.start(edge);
        if (across(direction) != 0) {
            continue;
        }
        constexpr double rounding = 1e-3;
        const Vector on_edge = edges.at(edge, 0.5);
        VisitsLeft unlimited;
        EXPECT_EQ(kernels::crossings_of_others_are_odd(
                      edges.tree(), {on_edge.x() - 2.0 * rounding, on_edge.y()},
                      {direction.x(), direction.y(), rounding}, unlimited),
                  are_odd_one_by_one(edges, on_edge, 0,
                                     [edge](std::uint32_t other) { return other != edge; }))
            << "edge " << edge;
    }
}

}  // namespace
}  // namespace nearfield::simd
