#include "scene.hpp"

#include <gtest/gtest.h>
#include <tests/support/flush_tiles.hpp>
#include <tests/support/pair_tables.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace nearfield::test {
namespace {

using Pairs = std::set<std::pair<std::size_t, std::size_t>>;

Pairs both_ways(const Pairs& pairs) {
    Pairs both = pairs;
    for (const auto& [a, b] : pairs) {
        both.emplace(b, a);
    }
    return both;
}

/// A world of tiles, and the ways to ask which of them touch.
class TouchingTiles {
public:
    explicit TouchingTiles(const FlushTiles& tiles)
        : tiles_(tiles), scene_([&] {
              std::vector<Placement> placements;
              for (const Pose& pose : tiles.poses()) {
                  placements.push_back({"tile", tiles.tile(), pose});
              }
              return placements;
          }()) {}

    /// Each pair of neighbours by itself.
    Pairs one_by_one() {
        Pairs touching;
        for (const auto& [a, b] : tiles_.neighbours()) {
            const auto result = scene_.context().answer(
                IntersectionTestQuery{scene_.instance(a), scene_.instance(b)});
            EXPECT_TRUE(result.has_value());
            if (result->intersects) {
                touching.emplace(a, b);
            }
        }
        return touching;
    }

    Pairs by_list() {
        std::vector<InstanceHandle> a;
        std::vector<InstanceHandle> b;
        for (const auto& [first, second] : tiles_.neighbours()) {
            a.push_back(scene_.handle(first));
            b.push_back(scene_.handle(second));
        }
        PairTable table(IntersectionTestQuery{}, of_list);
        EXPECT_TRUE(scene_.world().update(table, {.a = a, .b = b}).ok());
        Pairs touching;
        for (std::size_t i = 0; i < table.rows().size(); ++i) {
            if (table.rows()[i].intersects) {
                touching.insert(tiles_.neighbours()[i]);
            }
        }
        return touching;
    }

    /// By the broad phase of a context: candidates.
    Pairs by_find_pairs() {
        std::vector<Instance> instances;
        for (std::size_t i = 0; i < scene_.size(); ++i) {
            instances.push_back(scene_.instance(i));
        }
        Pairs found;
        const auto pairs = scene_.context().find_overlapping_boxes(instances, 0.0);
        EXPECT_TRUE(pairs.has_value());
        for (const InstancePair& pair : *pairs) {
            found.emplace(pair.first, pair.second);
        }
        return found;
    }

    /// The rows of a table.
    template <class Query>
    Pairs by_table(const Query& query, bool hits_only = true) {
        PairTable<Query> table(query, {.hits_only = hits_only});
        EXPECT_TRUE(scene_.world().update(table).ok());
        Pairs rows;
        for (const PairRow<Query>& row : table.rows()) {
            EXPECT_EQ(row.status, StatusCode::ok);
            rows.emplace(*scene_.position(row.a), *scene_.position(row.b));
        }
        return rows;
    }

    /// Of each tile as a shape at a pose, those it meets besides itself.
    Pairs by_overlaps() {
        const std::vector<Pose> poses = tiles_.poses();
        InstanceLists lists;
        EXPECT_TRUE(scene_.world().find_overlaps(scene_.shape(0), poses, lists).ok());
        Pairs found;
        for (std::size_t i = 0; i < poses.size(); ++i) {
            for (std::uint32_t k = lists.offsets[i]; k < lists.offsets[i + 1]; ++k) {
                const std::size_t other = *scene_.position(lists.instances[k]);
                if (other != i) {
                    found.emplace(i, other);
                }
            }
        }
        return found;
    }

private:
    FlushTiles tiles_;
    Scene scene_;
};

bool are_among(const Pairs& some, const Pairs& all) {
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

/// Boxes must not lose a pair that counts as touching.
TEST(FlushTiles, TouchHoweverTheyAreAskedFor) {
    for (const FlushTiles& tiles : many_flush_tiles()) {
        SCOPED_TRACE(::testing::Message() << "pitch " << tiles.pitch << ", angle " << tiles.angle
                                          << ", offset " << tiles.offset.x);
        TouchingTiles ask(tiles);
        const Pairs touching = ask.one_by_one();
        ASSERT_EQ(touching.size(), tiles.neighbours().size());
        const double d = tiles.pitch / 16.0;
        EXPECT_EQ(ask.by_list(), touching);
        EXPECT_EQ(ask.by_overlaps(), both_ways(touching));
        EXPECT_EQ(ask.by_table(IntersectionTestQuery{}), touching);
        EXPECT_EQ(ask.by_table(SeparationQuery{.tolerance = d}), touching);
        EXPECT_EQ(ask.by_table(ClosestPointQuery{.tolerance = d}), both_ways(touching));
        EXPECT_EQ(ask.by_table(SeparationVectorQuery{.tolerance = d}), both_ways(touching));
        EXPECT_EQ(ask.by_table(ContactQuery{.tolerance = d, .contact_distance = 1e-12 * d}),
                  both_ways(touching));
        EXPECT_EQ(ask.by_table(TimeOfImpactQuery{.tolerance = d}), touching);
        // What touches has no penetrating point, so only the candidates are told.
        EXPECT_TRUE(
            are_among(both_ways(touching), ask.by_table(PenetrationQuery{.tolerance = d}, false)));
        EXPECT_TRUE(are_among(both_ways(touching), ask.by_table(ContainmentQuery{}, false)));
        EXPECT_TRUE(are_among(touching, ask.by_find_pairs()));
        if (::testing::Test::HasFailure()) {
            return;
        }
    }
}

}  // namespace
}  // namespace nearfield::test
