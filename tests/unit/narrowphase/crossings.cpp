#include <engine/narrowphase/crossings.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>

namespace nearfield::narrowphase {
namespace {

using geometry::Polygon;
using geometry::Vector;

/// Calls `check(a, b)` for pairs of all kinds of shapes, disjoint and overlapping; in some B equals
/// A.
template <class Check>
void for_each_pair(const Check& check) {
    samples::Random random(96);
    const std::vector<samples::NamedRings> shapes = samples::assorted_shapes(random);
    for (const samples::NamedRings& one : shapes) {
        for (const samples::NamedRings& other : shapes) {
            const Polygon a = samples::polygon(one.rings);
            const Polygon b = samples::polygon(other.rings);
            for (const double far : {0.0, 1e6}) {
                const Pose pose_a{{far + random.between(-1.0, 1.0), random.between(-1.0, 1.0)},
                                  random.below(2) == 0 ? 0.0 : 0.4};
                const Pose pose_b = random.below(4) == 0 ? pose_a : Pose{{far, 0.0}, 0.0};
                SCOPED_TRACE(one.name + ", " + other.name + " at " + std::to_string(far));
                simd::TransformedInstances instances;
                const std::uint32_t index_a = instances.place(a, pose_a);
                const std::uint32_t index_b = instances.place(b, pose_b);
                instances.complete(index_a);
                instances.complete(index_b);
                check(instances[index_a], instances[index_b]);
            }
        }
    }
}

TEST(Crossings, BetweenThemNoEdgeChangesSides) {
    CrossingFinder finder;
    std::uint32_t changes = 0;
    std::uint32_t clear = 0;
    for_each_pair([&](const simd::TransformedEdges& a, const simd::TransformedEdges& b) {
        const std::span<const Crossing> found = finder.find(a, b);
        EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [](const auto& i, const auto& j) {
            return i.edge != j.edge ? i.edge < j.edge : i.from < j.from;
        }));
        for (std::uint32_t edge = 0; edge < a.count; ++edge) {
            const auto may_cross = [&](double from, double to) {
                return std::any_of(found.begin(), found.end(), [&](const Crossing& one) {
                    return one.edge == edge && one.from <= to && one.to >= from;
                });
            };
            constexpr int steps = 16;
            bool last = false;
            for (int i = 0; i <= steps; ++i) {
                const double at = static_cast<double>(i) / steps;
                const Vector point = a.start(edge) + at * (a.end(edge) - a.start(edge));
                const bool inside = contains(b, point);
                if (i > 0 && inside != last) {
                    ++changes;
                    EXPECT_TRUE(may_cross(at - 1.0 / steps, at)) << "edge " << edge << " at " << at;
                }
                clear += i > 0 && !may_cross(at - 1.0 / steps, at) ? 1U : 0U;
                last = inside;
            }
        }
    });
    EXPECT_GT(changes, 2000U);
    EXPECT_GT(clear, 100000U);
}

TEST(Crossings, AreFoundTheOtherWayRoundFromTheSamePairs) {
    CrossingFinder finder;
    CrossingFinder another;
    for_each_pair([&](const simd::TransformedEdges& a, const simd::TransformedEdges& b) {
        static_cast<void>(finder.find(a, b));
        const std::span<const Crossing> reversed = finder.find_reversed(b, a);
        const std::span<const Crossing> found = another.find(b, a);
        ASSERT_EQ(reversed.size(), found.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(reversed[i].edge, found[i].edge);
            EXPECT_EQ(reversed[i].from, found[i].from);
        }
    });
}

}  // namespace
}  // namespace nearfield::narrowphase
