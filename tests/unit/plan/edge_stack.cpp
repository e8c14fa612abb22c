#include <engine/plan/edge_stack.hpp>

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nearfield::plan {
namespace {

/// Restores the machine's instruction sets.
class PushNear : public testing::Test {
protected:
    template <class Check>
    static void on_every_instruction_set(const Check& check) {
        const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
        ASSERT_FALSE(targets.empty());
        for (const std::int64_t target : targets) {
            SCOPED_TRACE(hwy::TargetName(target));
            hwy::SetSupportedTargetsForTest(target);
            hwy::GetChosenTarget().Update(target);
            check();
        }
    }
    void TearDown() override {
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

struct StackedEdge {
    double x, y, along_x, along_y;

    [[nodiscard]] double distance(double to_x, double to_y) const {
        const double squared = along_x * along_x + along_y * along_y;
        const double t =
            squared > 0.0
                ? std::clamp(((to_x - x) * along_x + (to_y - y) * along_y) / squared, 0.0, 1.0)
                : 0.0;
        return std::hypot(to_x - x - t * along_x, to_y - y - t * along_y);
    }
};

/// Edges around a box of the size of a block, some of zero length, some long.
std::vector<StackedEdge> random_edges(test::Random& random, int count) {
    std::vector<StackedEdge> edges;
    const double far = random.scale(5.0, 300.0);
    const double longest = random.scale(0.3, 100.0);
    for (int i = 0; i < count; ++i) {
        const double length = random.whole(0, 9) == 0 ? 0.0 : random.between(0.0, longest);
        const double way = random.between(0.0, 7.0);
        edges.push_back({static_cast<float>(random.between(-far, far)),
                         static_cast<float>(random.between(-far, far)),
                         static_cast<float>(length * std::cos(way)),
                         static_cast<float>(length * std::sin(way))});
    }
    return edges;
}

void push_all(const std::vector<StackedEdge>& edges, EdgeStack& stack) {
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        const auto [x, y, along_x, along_y] = edges[i];
        const double squared = along_x * along_x + along_y * along_y;
        stack.push(
            {static_cast<float>(x), static_cast<float>(y), static_cast<float>(along_x),
             static_cast<float>(along_y), static_cast<float>(squared > 0.0 ? 1.0 / squared : 0.0)},
            i);
    }
}

/// The number of edges that were omitted.
std::size_t check_near(test::Random& random, int count) {
    constexpr float slack = 1e-3F;
    const std::vector<StackedEdge> edges = random_edges(random, count);
    EdgeStack stack;
    stack.push({1e9F, 1e9F, 0.0F, 0.0F, 0.0F}, 12345);  // belongs to an outer list
    push_all(edges, stack);
    const EdgeNode node{static_cast<float>(random.between(-9.0, 9.0)), 1.5F, 8.0F,
                        static_cast<float>(random.between(0.5, 8.0))};
    const std::size_t end = stack.size();
    push_near(stack, 1, end, node, slack);
    const std::vector<std::uint32_t> kept(stack.indices() + end, stack.indices() + stack.size());
    EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
    for (std::size_t i = 0; i < kept.size(); ++i) {
        EXPECT_EQ(stack.number(EdgeStack::start_x)[end + i], static_cast<float>(edges[kept[i]].x));
        EXPECT_EQ(stack.number(EdgeStack::along_y)[end + i],
                  static_cast<float>(edges[kept[i]].along_y));
    }
    for (int i = 0; i < 60; ++i) {
        // Includes corners and borders.
        const double across = i < 8 ? i % 2 * 2.0 - 1.0 : random.between(-1.0, 1.0);
        const double up = i < 4 ? i / 2 * 2.0 - 1.0 : random.between(-1.0, 1.0);
        const double x =
            static_cast<double>(node.x) + across * static_cast<double>(node.half_width);
        const double y = static_cast<double>(node.y) + up * static_cast<double>(node.half_height);
        const auto nearer = [&](const StackedEdge& a, const StackedEdge& b) {
            return a.distance(x, y) < b.distance(x, y);
        };
        const double nearest = std::min_element(edges.begin(), edges.end(), nearer)->distance(x, y);
        double nearest_kept = INFINITY;
        for (const std::uint32_t edge : kept) {
            nearest_kept = std::min(nearest_kept, edges[edge].distance(x, y));
        }
        EXPECT_EQ(nearest_kept, nearest) << "at " << x << ", " << y;
    }
    return edges.size() - kept.size();
}

TEST_F(PushNear, KeepsWhatIsNearestSomewhereOnEveryInstructionSet) {
    on_every_instruction_set([] {
        test::Random random(57);
        std::size_t dropped = 0;
        std::size_t all = 0;
        for (int count = 1; count < 80; ++count) {
            SCOPED_TRACE(count);
            dropped += check_near(random, count);
            all += static_cast<std::size_t>(count);
        }
        EXPECT_GT(dropped, all / 2) << "of " << all;
        EXPECT_LT(dropped, all);
    });
}

/// As measure_squared() does it, one edge at a time.
float squared_distance(const EdgeStack& edges, std::size_t i, float x, float y) {
    const float to_x = x - edges.number(EdgeStack::start_x)[i];
    const float to_y = y - edges.number(EdgeStack::start_y)[i];
    const float along_x = edges.number(EdgeStack::along_x)[i];
    const float along_y = edges.number(EdgeStack::along_y)[i];
    const float t = std::clamp(
        (to_x * along_x + to_y * along_y) * edges.number(EdgeStack::inverse)[i], 0.0F, 1.0F);
    const float away_x = to_x - t * along_x;
    const float away_y = to_y - t * along_y;
    return away_x * away_x + away_y * away_y;
}

TEST_F(PushNear, MeasuresAndKeepsWithinALimitBitForBitOnEveryInstructionSet) {
    on_every_instruction_set([] {
        test::Random random(58);
        for (int count = 1; count < 60; ++count) {
            SCOPED_TRACE(count);
            EdgeStack stack;
            push_all(random_edges(random, 3), stack);  // belong to an outer list
            const std::size_t first = stack.size();
            push_all(random_edges(random, count), stack);
            const std::size_t end = stack.size();
            const auto x = static_cast<float>(random.between(-20.0, 20.0));
            const auto y = static_cast<float>(random.between(-20.0, 20.0));
            std::vector<float> squared(stack.capacity());
            const float least = measure_squared(stack, first, end, x, y, squared.data());
            std::vector<float> expected;
            for (std::size_t i = first; i < end; ++i) {
                expected.push_back(squared_distance(stack, i, x, y));
                ASSERT_EQ(squared[i], expected.back());
            }
            ASSERT_EQ(least, *std::min_element(expected.begin(), expected.end()));
            // Of which some are exactly that far.
            const float limit = expected[static_cast<std::size_t>(random.whole(0, count - 1))];
            push_within(stack, first, end, squared.data(), limit);
            std::size_t place = end;
            for (std::size_t i = first; i < end; ++i) {
                if (squared[i] <= limit) {
                    ASSERT_LT(place, stack.size());
                    ASSERT_EQ(stack.indices()[place], stack.indices()[i]);
                    for (std::size_t number = 0; number < EdgeStack::numbers; ++number) {
                        ASSERT_EQ(stack.number(number)[place], stack.number(number)[i]);
                    }
                    ++place;
                }
            }
            ASSERT_EQ(place, stack.size());
        }
    });
}

TEST_F(PushNear, KeepsBothOfTwoWithinTheSlack) {
    // Seen from the box, one wall is 0.1 behind the other.
    for (const auto& [slack, kept] : {std::pair{0.2F, 2U}, std::pair{0.05F, 1U}}) {
        EdgeStack stack;
        push_all({{-100.0, 50.0, 200.0, 0.0}, {-100.0, 50.1, 200.0, 0.0}}, stack);
        push_near(stack, 0, 2, {0.0F, 0.0F, 8.0F, 8.0F}, slack);
        EXPECT_EQ(stack.size() - 2, kept) << slack;
    }
}

}  // namespace
}  // namespace nearfield::plan
