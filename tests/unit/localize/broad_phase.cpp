#include <engine/localize/broad_phase.hpp>
#include <engine/localize/hierarchy.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

namespace nearfield::localize {
namespace {

using geometry::Vector;

std::vector<BroadPhase::Pair> brute_force(const std::vector<Bounds>& shapes, double reach) {
    std::vector<BroadPhase::Pair> pairs;
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        for (std::uint32_t j = i + 1; j < shapes.size(); ++j) {
            if (may_meet(shapes[i], shapes[j], reach)) {
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
        std::vector<Bounds> shapes;
        for (int i = 0; i < round * 3; ++i) {
            // Coarse coordinates, so that many boxes just touch, or are as far apart as rounding.
            const Vector low(std::floor(4.0 * random.between(0.0, wide)) / 4.0,
                             std::floor(4.0 * random.between(0.0, tall)) / 4.0);
            shapes.push_back({{low, low + Vector(0.25 * random.below(4), 0.25 * random.below(4))},
                              round % 5 == 0 ? 0.125 * random.below(3) : 0.0});
        }
        for (const double reach : {0.0, 0.25, 1.1}) {
            broad_phase.find(shapes, reach, pairs);
            EXPECT_EQ(pairs, brute_force(shapes, reach)) << "round " << round;
        }
    }
}

}  // namespace
}  // namespace nearfield::localize
