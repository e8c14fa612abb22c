#include <tests/query/resident_test.hpp>

#include <cmath>

namespace nearfield::test {
namespace {

/// As in shaders/export.h.
constexpr std::uint32_t points_per_block = 64;

/// How many records have the greatest depth, in how many blocks of points, and the first of them.
struct Deepest {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t blocks = 0;
};

Deepest deepest_of(const RecordsContents& contents) {
    Deepest deepest;
    std::uint32_t last_block = UINT32_MAX;
    for (std::uint32_t i = 0; i < contents.records.size(); ++i) {
        const double depth = contents.records[i].depth();
        const double most = contents.records[deepest.first].depth();
        if (depth > most) {
            deepest = {i, 0, 0};
            last_block = UINT32_MAX;
        }
        if (depth >= most) {
            ++deepest.count;
            const std::uint32_t block = i / points_per_block;
            deepest.blocks += block != last_block ? 1U : 0U;
            last_block = block;
        }
    }
    return deepest;
}

class ResidentTies : public Resident {
protected:
    template <class Query>
    void expect_the_first(const Query& query) {
        const RecordsContents contents = keep(context(), query).contents;
        const Deepest deepest = deepest_of(contents);
        // Or this would test nothing.
        EXPECT_GT(deepest.count, points_per_block);
        EXPECT_GT(deepest.blocks, 2U);
        EXPECT_EQ(contents.summary.deepest, deepest.first);
        EXPECT_EQ(static_cast<double>(contents.summary.depth),
                  contents.records[deepest.first].depth());
    }
};

TEST_F(ResidentTies, OfEquallyDeepPointsInSeveralBlocksTheSummaryNamesTheFirst) {
    // Its lower side is 0.5 below B's upper side, from one end to the other.
    const PlacedPair pair(context(),
                          {{"A", rectangle({-4.0, -0.5}, {4.0, 3.0})},
                           {"B", rectangle({-8.0, -4.0}, {8.0, 0.0})},
                           {},
                           {},
                           0.03125},
                          Technique::compute);
    expect_the_first(pair.penetration());
}

TEST_F(ResidentTies, OfEquallyCloseContactsInSeveralBlocksTheSummaryNamesTheFirst) {
    const PlacedPair pair(context(),
                          {{"A", rectangle({-4.0, 0.0625}, {4.0, 3.0})},
                           {"B", rectangle({-8.0, -4.0}, {8.0, 0.0})},
                           {},
                           {},
                           0.03125},
                          Technique::compute);
    expect_the_first(pair.contacts(0.125));
}

}  // namespace
}  // namespace nearfield::test
