#include <engine/simd/box_hierarchy.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nearfield::simd {
namespace {

using geometry::Box;
using geometry::Vector;

/// Coarse coordinates, so that many boxes just touch.
Box random_box(samples::Random& random, double wide, double tall) {
    const Vector low(std::floor(4.0 * random.between(0.0, wide)) / 4.0,
                     std::floor(4.0 * random.between(0.0, tall)) / 4.0);
    return {low, low + Vector(0.25 * random.below(4), 0.25 * random.below(4))};
}

/// Empty boxes are never found.
void expect_brute_force(const BoxHierarchy& hierarchy, const std::vector<Box>& boxes,
                        const Box& at) {
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i].isEmpty() && boxes[i].intersects(at)) {
            expected.push_back(i);
        }
    }
    std::vector<std::uint32_t> found;
    hierarchy.for_meeting(at, [&](std::uint32_t i) { found.push_back(i); });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    std::vector<std::uint32_t> near;
    hierarchy.for_near(
        at, [] { return 0.0; }, [&](std::uint32_t i, double) { near.push_back(i); });
    std::sort(near.begin(), near.end());
    EXPECT_EQ(near, expected);
}

TEST(BoxHierarchy, FindsWhatBruteForceFinds) {
    samples::Random random(12);
    for (int round = 0; round < 40; ++round) {
        const double wide = round % 2 == 0 ? 20.0 : 1.0;
        const double tall = round % 3 == 0 ? 20.0 : 1.0;
        BoxHierarchy hierarchy;
        std::vector<Box> boxes;
        for (int change = 0; change < 5; ++change) {
            for (int i = 0; i < round; ++i) {
                boxes.push_back(random_box(random, wide, tall));
                hierarchy.set(static_cast<std::uint32_t>(boxes.size()) - 1, boxes.back());
            }
            for (std::uint32_t i = 0; i < boxes.size(); i += 3) {
                boxes[i] = random_box(random, wide, tall);
                hierarchy.set(i, boxes[i]);
            }
            for (std::uint32_t i = 0; i < boxes.size(); i += 7) {
                boxes[i].setEmpty();
                hierarchy.remove(i);
            }
            hierarchy.prepare();
            for (int i = 0; i < 20; ++i) {
                expect_brute_force(hierarchy, boxes, random_box(random, wide, tall));
            }
        }
    }
}

}  // namespace
}  // namespace nearfield::simd
