#include <tests/query/device_pairs.hpp>
#include <tests/support/flush_tiles.hpp>
#include <tests/support/pair_tables.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

/// Tiles that touch up to rounding, whose pairs the device finds.
class DeviceFlushTiles : public DevicePairsTest {
protected:
    using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // indices of handles

    template <class Query>
    Pairs by_device(const Query& query, double reach = 0.0) {
        return pairs_of(PairTable<Query>(query, within(reach, on_device)));
    }
    template <class Query>
    Pairs by_cpu(const Query& query, double reach = 0.0) {
        return pairs_of(PairTable<Query>(query, within(reach, on_cpu)));
    }

private:
    template <class Query>
    Pairs pairs_of(PairTable<Query> table) {
        const Status status = world().update(table);
        EXPECT_TRUE(status.ok()) << status.message();
        Pairs pairs;
        for (const PairRow<Query>& row : table.rows()) {
            pairs.emplace_back(row.a.index, row.b.index);
        }
        return pairs;
    }
};

TEST_F(DeviceFlushTiles, AreThoseOfTheCpu) {
    std::size_t number = 0;
    for (const FlushTiles& tiles : many_flush_tiles()) {
        if (number++ % 7 != 0) {  // of every pitch, angle and offset
            continue;
        }
        SCOPED_TRACE(::testing::Message() << "pitch " << tiles.pitch << ", angle " << tiles.angle
                                          << ", offset " << tiles.offset.x);
        const ShapeHandle tile = add_shape(tiles.tile());
        std::vector<InstanceHandle> added;
        for (const Pose& pose : tiles.poses()) {
            added.push_back(add(tile, pose));
        }
        const double d = tiles.pitch / 16.0;
        const Pairs touching = by_cpu(IntersectionTestQuery{});
        EXPECT_EQ(touching.size(), tiles.neighbours().size());
        EXPECT_EQ(by_device(IntersectionTestQuery{}), touching);
        for (const double reach : {0.0, 0.5 * tiles.pitch, tiles.pitch}) {
            SCOPED_TRACE(::testing::Message() << "reach " << reach);
            const SeparationQuery separation{.tolerance = d};
            EXPECT_EQ(by_device(separation, reach), by_cpu(separation, reach));
            const ClosestPointQuery closest{.tolerance = d};
            EXPECT_EQ(by_device(closest, reach), by_cpu(closest, reach));
        }
        const ContactQuery contacts{.tolerance = d, .contact_distance = 1e-12 * d};
        EXPECT_EQ(by_device(contacts), by_cpu(contacts));
        remove(added);
        if (HasFailure()) {
            return;
        }
    }
}

}  // namespace
}  // namespace nearfield::test
