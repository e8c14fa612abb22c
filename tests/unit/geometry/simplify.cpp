#include <engine/geometry/segment.hpp>
#include <engine/geometry/simplify.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace nearfield::geometry {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

struct Run {
    std::vector<Vector> vertices;  ///< from the first to the last, both included
};

Run run_of(const Polygon& polygon, const SimplifiedEdge& edge) {
    Run run{{polygon.vertices()[edge.first]}};
    for (std::uint32_t i = 0, v = edge.first; i < edge.count; ++i) {
        v = polygon.next(v);
        run.vertices.push_back(polygon.vertices()[v]);
    }
    return run;
}

double distance_to_run(const Vector& p, const Run& run) {
    double least = endless;
    for (std::size_t i = 0; i + 1 < run.vertices.size(); ++i) {
        least = std::min(
            least, nearest_on_segment(p, run.vertices[i], run.vertices[i + 1]).squared_distance);
    }
    return std::sqrt(least);
}

/// The two-sided distance of a run and its straight edge, by dense samples.
double sampled_deviation(const Run& run) {
    const Vector a = run.vertices.front();
    const Vector b = run.vertices.back();
    double most = 0.0;
    for (std::size_t i = 0; i + 1 < run.vertices.size(); ++i) {
        for (int k = 0; k < 8; ++k) {
            const Vector p = run.vertices[i] + k / 8.0 * (run.vertices[i + 1] - run.vertices[i]);
            most = std::max(most, std::sqrt(nearest_on_segment(p, a, b).squared_distance));
        }
    }
    for (int k = 0; k <= 50; ++k) {
        most = std::max(most, distance_to_run(a + k / 50.0 * (b - a), run));
    }
    return most;
}

/// Checks all properties of simplify() at once.
void expect_lawful(const Polygon& polygon, double deviation, double longest_run,
                   const std::string& what) {
    std::vector<SimplifiedEdge> edges;
    simplify(polygon, deviation, longest_run, edges);
    const double slack = 2e-15 * TransformedPolygon(polygon, {}).box().diagonal().norm();
    std::size_t next_edge = 0;
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const std::uint32_t size = polygon.ring_end(ring) - polygon.ring_begin(ring);
        std::uint32_t covered = 0;
        std::uint32_t at = polygon.ring_begin(ring);
        std::uint32_t kept = 0;
        for (; covered < size; ++next_edge, ++kept) {
            ASSERT_LT(next_edge, edges.size()) << what;
            const SimplifiedEdge& edge = edges[next_edge];
            ASSERT_EQ(edge.first, at) << what;
            ASSERT_GE(edge.count, 1U) << what;
            for (std::uint32_t i = 0; i < edge.count; ++i) {
                at = polygon.next(at);
            }
            ASSERT_EQ(edge.last, at) << what;
            covered += edge.count;

            const Run run = run_of(polygon, edge);
            EXPECT_LE(edge.deviation, deviation) << what;
            EXPECT_LE(sampled_deviation(run), edge.deviation + slack) << what;
            if (edge.count == 1) {
                EXPECT_EQ(edge.deviation, 0.0) << what;
                continue;
            }
            for (std::size_t i = 1; i < run.vertices.size(); ++i) {
                EXPECT_LE((run.vertices[i] - run.vertices[0]).norm(), longest_run + slack) << what;
                EXPECT_LE((run.vertices[i] - run.vertices[i - 1]).norm(), longest_run + slack)
                    << what;
            }
        }
        EXPECT_EQ(covered, size) << what;
        EXPECT_EQ(at, polygon.ring_begin(ring)) << what;
        EXPECT_GE(kept, 2U) << what;
    }
    EXPECT_EQ(next_edge, edges.size()) << what;
}

TEST(Simplify, KeepsItsLawsOnAllShapes) {
    test::Random random(1);
    for (int round = 0; round < 4; ++round) {
        for (const test::NamedRings& shape : samples::assorted_shapes(random)) {
            const Polygon polygon = samples::polygon(shape.rings);
            const Polygon far =
                samples::polygon(test::scaled_and_moved(shape.rings, 1.0, {1e6, -1e6}));
            for (const double deviation : {0.0, 1e-17, 1e-12, 1e-5, 1e-3, 0.03, 0.3, 5.0}) {
                for (const double longest_run : {endless, 0.5, 0.01, 0.0}) {
                    const std::string what = shape.name + ", deviation " +
                                             std::to_string(deviation) + ", longest run " +
                                             std::to_string(longest_run);
                    expect_lawful(polygon, deviation, longest_run, what);
                    expect_lawful(far, deviation, longest_run, what + ", far");
                }
            }
        }
    }
}

TEST(Simplify, KeepsItsLawsOnWanderingLines) {
    // Steps of the size of the deviation, in directions that often fold back.
    test::Random random(2);
    for (int round = 0; round < 200; ++round) {
        Ring ring;
        Vector2 at{0.0, 0.0};
        const double drift = random.between(0.0, 0.5);
        for (int i = 0; i < 300; ++i) {
            const double step = std::pow(10.0, random.between(-2.0, 0.5));
            at = {at.x + drift + step * random.between(-1.0, 1.0),
                  at.y + step * random.between(-1.0, 1.0) * (round % 3 == 0 ? 0.1 : 1.0)};
            ring.push_back(at);
        }
        expect_lawful(samples::polygon({ring}), 1.0, round % 2 == 0 ? endless : 10.0,
                      "round " + std::to_string(round));
    }
}

/// Checks block by block that simplification in a window equals simplification everywhere.
void expect_same_in_window(const TransformedPolygon& placed, const Box& window, double deviation,
                           const std::string& what) {
    const Polygon& polygon = placed.polygon();
    const Box everywhere(Vector(-endless, -endless), Vector(endless, endless));
    std::vector<SimplifiedEdge> all;
    std::vector<SimplifiedEdge> found;
    simplify_near(placed, everywhere, deviation, endless, all);
    simplify_near(placed, window, deviation, endless, found);
    auto next = all.begin();
    for (const SimplifiedEdge& edge : found) {
        ASSERT_EQ(edge.first, next->first) << what;
        const std::uint32_t ring = polygon.ring_of(edge.first);
        const std::uint32_t block = (edge.first - polygon.ring_begin(ring)) / edges_of_a_block;
        if (edge.deviation < endless) {
            ASSERT_EQ(edge.last, next->last) << what;
            ASSERT_EQ(edge.count, next->count) << what;
            const std::uint32_t last = edge.first + edge.count - 1 - polygon.ring_begin(ring);
            ASSERT_EQ(last / edges_of_a_block, block) << what << ": a run goes on";
            ++next;
            continue;
        }
        ASSERT_FALSE(window.intersects(placed.chain_box(ring, edge.first, edge.count))) << what;
        std::uint32_t left = edge.count;
        for (; left > 0; left -= next->count, ++next) {
            ASSERT_LE(next->count, left) << what;
        }
        ASSERT_EQ(edge.last, std::prev(next)->last) << what;
    }
    EXPECT_TRUE(next == all.end()) << what;
}

TEST(Simplify, IsTheSameInEveryWindow) {
    test::Random random(5);
    for (int round = 0; round < 200; ++round) {
        test::Rings rings = test::coast(random, random.whole(3, 702), 0.5);
        if (round % 2 == 0) {
            rings.push_back(
                test::scaled_and_moved(test::star(random, random.whole(3, 202), 0.3), 0.3, {})
                    .front());
        }
        const Polygon polygon = samples::polygon(rings);
        const TransformedPolygon placed(polygon, {{random.between(-1.0, 1.0), 0.0}, 1.0 * round});
        const Vector low(random.between(-2.0, 1.0), random.between(-2.0, 1.0));
        const Vector size(random.between(0.0, 1.0), random.between(0.0, 1.0));
        for (const double deviation : {0.0, 1e-3, 0.05}) {
            expect_same_in_window(placed, Box(low, low + size), deviation,
                                  "round " + std::to_string(round));
        }
    }
}

TEST(Simplify, MergesWhatItMay) {
    const Polygon circle = samples::polygon(test::regular(4000));
    for (const double deviation : {1e-2, 1e-3, 1e-4}) {
        std::vector<SimplifiedEdge> edges;
        simplify(circle, deviation, endless, edges);
        // A chord of a circle with this sagitta spans 2 acos(1 - deviation): no fewer chords
        // suffice, and one greedy pass should not need twice as many.
        const double fewest = 2.0 * std::numbers::pi / (2.0 * std::acos(1.0 - deviation));
        EXPECT_LE(static_cast<double>(edges.size()), 2.0 * fewest + 1.0);
    }
}

TEST(Simplify, MergesEdgesOfNoLength) {
    const Ring ring{{0.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}, {1.0, 0.0},
                    {1.0, 0.0}, {1.0, 1.0}, {0.3, 0.7}, {0.3, 0.7}};
    const Polygon polygon = samples::polygon({ring});
    std::vector<SimplifiedEdge> edges;
    simplify(polygon, 0.0, endless, edges);
    ASSERT_EQ(edges.size(), 4U);
    for (const SimplifiedEdge& edge : edges) {
        EXPECT_NE(polygon.vertices()[edge.first], polygon.vertices()[edge.last]);
        EXPECT_EQ(edge.deviation, 0.0);
    }
}

}  // namespace
}  // namespace nearfield::geometry
