#include <engine/geometry/edge_list_kernels.hpp>

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nearfield::geometry {
namespace {

/// Restores the machine's instruction sets.
class EdgeLists : public testing::Test {
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

struct ListedEdge {
    double x, y, along_x, along_y;
};

/// Edges around a box of the size of a block, some of zero length, some long.
std::vector<ListedEdge> random_edges(test::Random& random, int count) {
    std::vector<ListedEdge> edges;
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

void push_all(const std::vector<ListedEdge>& edges, EdgeList& list) {
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
        const auto [x, y, along_x, along_y] = edges[i];
        push_edge({x, y}, {x + along_x, y + along_y}, i, list);
    }
}

/// As measure_squared() does it, one edge at a time.
float squared_distance(const EdgeList& edges, std::size_t i, float x, float y) {
    const float to_x = x - edges.number(EdgeList::start_x)[i];
    const float to_y = y - edges.number(EdgeList::start_y)[i];
    const float along_x = edges.number(EdgeList::along_x)[i];
    const float along_y = edges.number(EdgeList::along_y)[i];
    const float t = std::clamp(
        to_x * edges.number(EdgeList::inverse_x)[i] + to_y * edges.number(EdgeList::inverse_y)[i],
        0.0F, 1.0F);
    const float away_x = to_x - t * along_x;
    const float away_y = to_y - t * along_y;
    return away_x * away_x + away_y * away_y;
}

TEST_F(EdgeLists, MeasuresAndKeepsWithinALimitBitForBitOnEveryInstructionSet) {
    on_every_instruction_set([] {
        test::Random random(58);
        for (int count = 1; count < 60; ++count) {
            SCOPED_TRACE(count);
            EdgeList list;
            push_all(random_edges(random, 3), list);  // belong to an outer list
            const std::size_t first = list.size();
            push_all(random_edges(random, count), list);
            const std::size_t end = list.size();
            const auto x = static_cast<float>(random.between(-20.0, 20.0));
            const auto y = static_cast<float>(random.between(-20.0, 20.0));
            std::vector<float> squared(list.capacity());
            const float least = measure_squared(list, first, end, x, y, squared.data());
            std::vector<float> expected;
            for (std::size_t i = first; i < end; ++i) {
                expected.push_back(squared_distance(list, i, x, y));
                ASSERT_EQ(squared[i], expected.back());
            }
            ASSERT_EQ(least, *std::min_element(expected.begin(), expected.end()));
            // Of which some are exactly that far.
            const float limit = expected[static_cast<std::size_t>(random.whole(0, count - 1))];
            push_within(list, first, end, squared.data(), limit, list);
            std::size_t place = end;
            for (std::size_t i = first; i < end; ++i) {
                if (squared[i] <= limit) {
                    ASSERT_LT(place, list.size());
                    ASSERT_EQ(list.indices()[place], list.indices()[i]);
                    for (std::size_t number = 0; number < EdgeList::numbers; ++number) {
                        ASSERT_EQ(list.number(number)[place], list.number(number)[i]);
                    }
                    ++place;
                }
            }
            ASSERT_EQ(place, list.size());
        }
    });
}

}  // namespace
}  // namespace nearfield::geometry
