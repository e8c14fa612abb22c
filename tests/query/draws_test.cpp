#include <nearfield/diagnostics.hpp>

#include <tests/query/frames.hpp>

#include <algorithm>
#include <numbers>
#include <set>
#include <vector>

namespace nearfield::test {
namespace {

constexpr int max_draws = 20;  // of a tile batch, whatever is asked of however many pairs

class Draws : public Frames {
protected:
    /// Everything that is drawn, for a number of pairs: points, fields by each encoding of the
    /// sign with blended gradients, intersections by each strategy that a bare device has.
    [[nodiscard]] Batch mixture(int pairs) const {
        Batch batch;
        for (int i = 0; i < pairs; ++i) {
            const Instance a{a_, {{0.0, 0.0}, 0.1 * i}};
            const Instance b{b_, {{0.3, 0.01 * i}, 0.2 * i}};
            batch.add(drawn(PenetrationQuery{a, b, 0.05}));
            batch.add(drawn(ContactQuery{a, b, 0.05, 0.05}));
            for (const SignEncoding sign :
                 {SignEncoding::stencil, SignEncoding::color, SignEncoding::feature_bit}) {
                DistanceFieldQuery field;
                field.technique = Technique::raster;
                field.a = a;
                field.b = b;
                field.tolerance = 0.1;
                field.sign = sign;
                field.gradients = true;
                field.gradient = GradientMethod::blended;
                batch.add(field);
            }
            for (const IntersectionStrategy strategy :
                 {IntersectionStrategy::stencil, IntersectionStrategy::blend,
                  IntersectionStrategy::depth}) {
                IntersectionQuery samples{a, b, 0.05};
                samples.technique = Technique::raster;
                samples.strategy = strategy;
                batch.add(samples);
                samples.kind = IntersectionKind::volume_volume;
                samples.summary_only = true;
                batch.add(samples);
            }
        }
        return batch;
    }

    /// The tile batches of the last batch.
    [[nodiscard]] int tile_batches() {
        const Expected<std::vector<TileReport>> tiles = list_tiles(counted());
        EXPECT_TRUE(tiles.has_value());
        std::set<std::uint32_t> numbers;
        for (const TileReport& tile : *tiles) {
            EXPECT_EQ(tile.technique, Technique::raster);
            numbers.insert(tile.tile_batch);
        }
        return static_cast<int>(numbers.size());
    }
};

TEST_F(Draws, OfATileBatchStayFewWhateverIsMixed) {
    make(Settings{});
    for (const int pairs : {1, 4, 40}) {
        SCOPED_TRACE(pairs);
        const Batch batch = mixture(pairs);
        static_cast<void>(run(batch));  // makes room for the samples
        calls = {};
        static_cast<void>(run(batch));
        ASSERT_EQ(calls.submissions, 1);
        EXPECT_GT(calls.draws, 3 * 7) << "not everything was drawn";
        EXPECT_LE(calls.draws, max_draws * tile_batches());
        EXPECT_LE(tile_batches(), 4) << "one for distances, one for each strategy";
    }
}

TEST_F(Draws, OfOneKindAreTheSameForAnyNumberOfPairs) {
    make(Settings{});
    std::set<int> draws;
    for (const int pairs : {2, 20, 200}) {
        Batch batch;
        for (int i = 0; i < pairs; ++i) {
            batch.add(drawn(PenetrationQuery{{a_, {}}, {b_, {{0.3, 0.0}, 0.01 * i}}, 0.1}));
        }
        calls = {};
        static_cast<void>(run(batch));
        EXPECT_EQ(tile_batches(), 1);
        draws.insert(calls.draws);
    }
    EXPECT_EQ(draws.size(), 1U);
    EXPECT_LE(*draws.rbegin(), max_draws);
}

}  // namespace
}  // namespace nearfield::test
