#include <engine/geometry/overlap.hpp>
#include <engine/geometry/simplify.hpp>

#include <gtest/gtest.h>
#include <tests/support/allocations.hpp>
#include <tests/unit/support/shape_samples.hpp>

#include <vector>

namespace nearfield::geometry {
namespace {

TEST(SteadyState, AFrameLikeTheOneBeforeAllocatesNothing) {
    samples::Random random(1);
    const samples::Rings rings_a{samples::coast(random, 500, 1.0)};
    const samples::Rings rings_b{samples::coast(random, 400, 1.0), samples::tangle(random, 30)};
    Polygon a;
    Polygon b;
    std::vector<Chain> chains;
    std::vector<Box> boxes;
    std::vector<SimplifiedEdge> edges;
    bool assigned = false;
    const auto frame = [&] {
        chains.clear();
        boxes.clear();
        edges.clear();
        assigned = a.assign(rings_a).ok() && b.assign(rings_b).ok();
        const TransformedPolygon transformed_a(a, {{0.5, 0.2}, 1.0});
        const TransformedPolygon transformed_b(b, {});
        chains_in_volume(transformed_a, transformed_b, {8, 0.01}, chains);
        chains_near_boundary(transformed_b, transformed_a, {8, 0.01}, chains);
        for (const Chain& chain : chains) {
            boxes.push_back(chain.box);
        }
        join_boxes(boxes);
        simplify(a, 0.01, 1.0, edges);
    };
    frame();
    const std::uint64_t before = test_support::allocation_count();
    EXPECT_GT(before, 0U);
    frame();
    const std::uint64_t after = test_support::allocation_count();
    EXPECT_EQ(after, before);
    EXPECT_TRUE(assigned);
    EXPECT_FALSE(chains.empty());
    EXPECT_FALSE(edges.empty());
}

}  // namespace
}  // namespace nearfield::geometry
