#include <tests/query/pair.hpp>
#include <tests/query/query_test.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t tiles_seed = 1944;

std::vector<TileReport> tiles_of(const Context& context) {
    const Expected<std::vector<TileReport>> tiles = list_tiles(context);
    EXPECT_TRUE(tiles.has_value()) << tiles.error().text();
    return *tiles;
}

bool holds(const TileReport& tile, const Vector2& point) {
    const double slack = 1e-9 * (1.0 + std::abs(tile.max.x) + std::abs(tile.max.y));
    return point.x >= tile.min.x - slack && point.x <= tile.max.x + slack &&
           point.y >= tile.min.y - slack && point.y <= tile.max.y + slack;
}

bool overlap_in_atlas(const TileReport& i, const TileReport& j) {
    return i.x < j.x + j.width && j.x < i.x + i.width && i.y < j.y + j.height &&
           j.y < i.y + i.height;
}

class Tiles : public QueryTest {
protected:
    static bool any_holds(const std::vector<TileReport>& tiles, std::uint32_t query, Side side,
                          const Vector2& point) {
        return std::any_of(tiles.begin(), tiles.end(), [&](const TileReport& tile) {
            return tile.query == query && tile.side == side && holds(tile, point);
        });
    }

    /// Properties of all tiles, whatever their purpose.
    static void check(const std::vector<TileReport>& tiles, const Results& results) {
        for (const TileReport& tile : tiles) {
            ASSERT_LT(tile.query, results.results.size());
            std::visit(
                [&tile](const auto& result) {
                    EXPECT_EQ(tile.technique, result.technique);
                    EXPECT_NEAR(tile.max.x - tile.min.x, result.cell * tile.width,
                                1e-6 * result.cell);
                    EXPECT_NEAR(tile.max.y - tile.min.y, result.cell * tile.height,
                                1e-6 * result.cell);
                    const double halo = 2.0 * result.cell;
                    EXPECT_TRUE(std::any_of(result.regions.begin(), result.regions.end(),
                                            [&](const Region& region) {
                                                return tile.min.x >= region.min.x - halo &&
                                                       tile.min.y >= region.min.y - halo &&
                                                       tile.max.x <= region.max.x + halo &&
                                                       tile.max.y <= region.max.y + halo;
                                            }));
                },
                results.results[tile.query]);
            for (const TileReport& other : tiles) {
                const bool drawn_together = &other != &tile &&
                                            other.tile_batch == tile.tile_batch &&
                                            tile.technique == Technique::raster;
                EXPECT_FALSE(drawn_together && overlap_in_atlas(tile, other));
            }
        }
    }
};

TEST_F(Tiles, HoldWhatTheyWereMadeFor) {
    for (const Technique technique : device_techniques) {
        SCOPED_TRACE(to_string(technique));
        std::size_t records = 0;
        for (const Pair& pair : family_pairs(tiles_seed)) {
            SCOPED_TRACE(describe(pair));
            const PlacedPair placed(context(), pair, technique);
            Batch batch;
            const auto test =
                batch.add(IntersectionTestQuery{placed.instance_a(), placed.instance_b()});
            const auto penetration = batch.add(placed.penetration());
            const auto contacts = batch.add(placed.contacts(0.3));
            const auto samples = batch.add(placed.intersection(IntersectionKind::volume_volume));
            Results results;
            ASSERT_TRUE(context().run(batch, results).ok());
            const std::vector<TileReport> tiles = tiles_of(context());
            check(tiles, results);
            EXPECT_TRUE(std::none_of(tiles.begin(), tiles.end(), [&](const TileReport& tile) {
                return tile.query == test.index;
            }));
            // By compute, the device searches for points without tiles.
            const bool have_tiles = technique == Technique::raster;
            for (const PenetratingPoint& record : results[penetration].points) {
                EXPECT_EQ(any_holds(tiles, penetration.index, Side::a, record.position),
                          have_tiles);
            }
            for (const ContactPoint& record : results[contacts].points) {
                EXPECT_EQ(any_holds(tiles, contacts.index, record.on, record.position), have_tiles);
            }
            for (const IntersectionSample& sample : results[samples].samples) {
                EXPECT_TRUE(any_holds(tiles, samples.index, Side::a, sample.position));
            }
            records += results[penetration].points.size() + results[contacts].points.size();
        }
        EXPECT_GT(records, 100U);
    }
}

TEST_F(Tiles, AFieldIsCoveredWhole) {
    const PlacedPair placed(context(), family_pairs(tiles_seed)[2]);
    DistanceFieldQuery query;
    query.b = placed.instance_b();
    query.tolerance = 0.05;
    query.rectangle = Rectangle{{-6.0, -4.0}, {5.0, 7.0}};
    query.features = true;  // in small tiles
    query.technique = Technique::raster;
    Batch batch;
    const auto field = batch.add(query);
    Results results;
    ASSERT_TRUE(context().run(batch, results).ok());
    const std::vector<TileReport> tiles = tiles_of(context());
    check(tiles, results);
    EXPECT_GT(tiles.size(), 4U);
    double cells = 0.0;
    for (const TileReport& tile : tiles) {
        cells += static_cast<double>(tile.width) * tile.height;
    }
    const DistanceFieldResult& result = results[field];
    EXPECT_EQ(cells, static_cast<double>(result.width) * result.height);
}

TEST_F(Tiles, ThereAreNoneWhereNothingIsDrawn) {
    Expected<Context> fresh = Context::create(host_device(), on_demand());
    ASSERT_TRUE(fresh.has_value()) << fresh.error().text();
    EXPECT_TRUE(tiles_of(*fresh).empty());
    const Pair pair = family_pairs(tiles_seed)[3];
    const PlacedPair drawn(*fresh, pair);
    const PlacedPair by_cpu(*fresh, pair, Technique::cpu);
    ASSERT_TRUE(run_alone(*fresh, drawn.penetration()).status.ok());
    EXPECT_FALSE(tiles_of(*fresh).empty());
    ASSERT_TRUE(run_alone(*fresh, by_cpu.penetration()).status.ok());
    EXPECT_TRUE(tiles_of(*fresh).empty());
    // The tiles of the last of several batches in flight.
    Batch first;
    first.add(drawn.penetration());
    Batch second;
    second.add(by_cpu.penetration());
    second.add(drawn.intersection(IntersectionKind::volume_volume));
    const Expected<Ticket> one = fresh->submit(first);
    const Expected<Ticket> two = fresh->submit(second);
    ASSERT_TRUE(one.has_value() && two.has_value());
    const std::vector<TileReport> in_flight = tiles_of(*fresh);
    ASSERT_FALSE(in_flight.empty());
    EXPECT_EQ(in_flight.front().query, 1U);
    Results results;
    ASSERT_TRUE(fresh->collect(*two, results).ok());
    EXPECT_EQ(tiles_of(*fresh).size(), in_flight.size());
    ASSERT_TRUE(fresh->collect(*one, results).ok());
    // A batch that is too large as a whole.
    PenetrationQuery fine = drawn.penetration();
    fine.tolerance = 1e-9;
    EXPECT_EQ(run_alone(*fresh, fine).status.code(), StatusCode::too_large);
    EXPECT_TRUE(tiles_of(*fresh).empty());
}

}  // namespace
}  // namespace nearfield::test
