#include <engine/localize/broad_phase.hpp>
#include <engine/localize/hierarchy.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

namespace nearfield::localize {
namespace {

using geometry::Box;
using geometry::Vector;

std::vector<BroadPhase::Pair> brute_force(const std::vector<Box>& boxes, double reach) {
    std::vector<BroadPhase::Pair> pairs;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
            if (boxes_meet(boxes[i], boxes[j], reach)) {
                pairs.emplace_back(i, j);
            }
        }
    }
    return pairs;
}

TEST(BroadPhase, FindsWhatBruteForceFinds) {
    samples::Random random(12);
    BroadPhase broad_phase;
    std::vector<BroadPhase::Pair> pairs;
    for (int round = 0; round < 60; ++round) {
        const double wide = round % 2 == 0 ? 20.0 : 1.0;
        const double tall = round % 3 == 0 ? 20.0 : 1.0;
        std::vector<Box> boxes;
        for (int i = 0; i < round * 3; ++i) {
            // Coarse coordinates, so that many boxes just touch.
            const Vector low(std::floor(4.0 * random.between(0.0, wide)) / 4.0,
                             std::floor(4.0 * random.between(0.0, tall)) / 4.0);
            boxes.emplace_back(low, low + Vector(0.25 * random.below(4), 0.25 * random.below(4)));
        }
        for (const double reach : {0.0, 0.25, 1.1}) {
            broad_phase.find(boxes, reach, pairs);
            EXPECT_EQ(pairs, brute_force(boxes, reach)) << "round " << round;
        }
    }
}

}  // namespace
}  // namespace nearfield::localize
