#include <nearfield/vulkan.hpp>

#include <gtest/gtest.h>
#include <tests/support/mock_driver.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace nearfield::test {
namespace {

constexpr auto strategies = {IntersectionStrategy::stencil, IntersectionStrategy::blend,
                             IntersectionStrategy::logic_op, IntersectionStrategy::depth};
constexpr auto kinds = {IntersectionKind::boundary_boundary, IntersectionKind::boundary_volume,
                        IntersectionKind::volume_volume};
constexpr auto encodings = {SignEncoding::stencil, SignEncoding::color, SignEncoding::feature_bit};

/// How often a batch is drawn, and what it takes to draw it.
struct Counts {
    std::ptrdiff_t draws = 0;
    std::ptrdiff_t push_constants = 0;  ///< of draws and dispatches
    std::ptrdiff_t scissors = 0;
    std::ptrdiff_t dispatches = 0;
    std::ptrdiff_t render_passes = 0;
};

class DrawCount : public ::testing::Test {
protected:
    DrawCount() {
        Expected<Context> context = Context::create(driver_.host());
        EXPECT_TRUE(context.has_value());
        context_.emplace(std::move(*context));
        const std::vector<Ring> square{{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}};
        shape_ = *context_->add_shape(square);
    }

    /// Adds queries about a pair of squares.
    using Add = std::function<void(Batch& batch, const Instance& a, const Instance& b)>;

    Counts count(int pairs, const Add& add, std::uint32_t expected_tile_batches) {
        Batch batch;
        for (int i = 0; i < pairs; ++i) {
            add(batch, {shape_, {}}, {shape_, {{1.0, 1.0 - 0.001 * i}, 0.0}});
        }
        driver_.forget_calls();
        Results results;
        const Status status = context_->run(batch, results);
        EXPECT_TRUE(status.ok()) << status.text();
        for (const AnyResult& result : results.results) {
            const Status& own =
                std::visit([](const auto& one) -> const Status& { return one.status; }, result);
            EXPECT_TRUE(own.ok()) << own.text();
        }
        EXPECT_EQ(tile_batches(), expected_tile_batches);
        const std::vector<std::string_view>& calls = driver_.calls();
        const auto of = [&](std::string_view name) {
            return std::count(calls.begin(), calls.end(), name);
        };
        return {of("vkCmdDraw"), of("vkCmdPushConstants"), of("vkCmdSetScissor"),
                of("vkCmdDispatch"), of("vkCmdBeginRenderPass")};
    }

    /// As many draws for a hundred pairs as for two, and at most 20 for each tile batch.
    void expect_few(const Add& add, std::uint32_t tile_batches = 1) {
        const Counts few = count(2, add, tile_batches);
        const Counts many = count(100, add, tile_batches);
        EXPECT_GT(few.draws, 0);
        EXPECT_EQ(many.draws, few.draws);
        EXPECT_LE(many.draws, 20 * static_cast<std::ptrdiff_t>(tile_batches));
        EXPECT_EQ(many.render_passes, few.render_passes);
        EXPECT_EQ(many.scissors, many.render_passes);
        // One for each draw, three for those of gradients, one for each dispatch.
        EXPECT_LE(many.push_constants, many.draws + 3 + many.dispatches);
        if (!with_gradients_) {
            EXPECT_EQ(many.dispatches, few.dispatches);
        }
    }

    static void add_overlaps(Batch& batch, const Instance& a, const Instance& b,
                             IntersectionStrategy strategy) {
        for (const IntersectionKind kind : kinds) {
            IntersectionQuery query{a, b, 0.05, kind};
            query.strategy = strategy;
            query.technique = Technique::raster;
            batch.add(query);
        }
    }
    void add_field(Batch& batch, const Instance& b, SignEncoding sign) const {
        DistanceFieldQuery query{{}, b, 0.1};
        query.rectangle = Rectangle{{-0.5, -0.5}, {0.5, 0.5}};
        query.sign = sign;
        query.features = true;
        query.gradients = with_gradients_;
        query.gradient = GradientMethod::blended;
        query.technique = Technique::raster;
        batch.add(query);
    }
    static void add_points(Batch& batch, const Instance& a, const Instance& b) {
        PenetrationQuery query{a, b, 0.1};
        query.technique = Technique::raster;
        batch.add(query);
    }

    [[nodiscard]] std::uint32_t tile_batches() const {
        const Expected<std::vector<TileReport>> tiles = list_tiles(*context_);
        std::uint32_t count = 0;
        for (const TileReport& tile : *tiles) {
            count = std::max(count, tile.tile_batch + 1);
        }
        return count;
    }

    test_support::MockDriver driver_;
    std::optional<Context> context_;
    ShapeHandle shape_;
    bool with_gradients_ = false;  ///< blended ones, which are collected tile by tile
};

TEST_F(DrawCount, OfPointsDoesNotGrowWithThePairs) {
    expect_few([](Batch& batch, const Instance& a, const Instance& b) { add_points(batch, a, b); });
}

TEST_F(DrawCount, OfFieldsDoesNotGrowWithThePairs) {
    for (const bool with_gradients : {false, true}) {
        with_gradients_ = with_gradients;
        for (const SignEncoding sign : encodings) {
            SCOPED_TRACE(static_cast<int>(sign));
            expect_few([&](Batch& batch, const Instance&, const Instance& b) {
                add_field(batch, b, sign);
            });
        }
    }
}

TEST_F(DrawCount, OfIntersectionsDoesNotGrowWithThePairs) {
    for (const IntersectionStrategy strategy : strategies) {
        SCOPED_TRACE(to_string(strategy));
        expect_few([=](Batch& batch, const Instance& a, const Instance& b) {
            add_overlaps(batch, a, b, strategy);
        });
    }
}

TEST_F(DrawCount, OfWatchedTilesIsLimited) {
    expect_few([](Batch& batch, const Instance& a, const Instance& b) {
        // Six tiles are large enough for an occlusion query, in either number of pairs.
        const bool is_first = batch.queries().empty();
        for (int i = 0; i < (is_first ? 6 : 1); ++i) {
            IntersectionQuery query{a, b, is_first ? 0.005 : 0.05};
            query.technique = Technique::raster;
            batch.add(query);
        }
    });
}

TEST_F(DrawCount, OfAMixtureDoesNotGrowWithThePairs) {
    with_gradients_ = true;
    const Add with_one_strategy = [this](Batch& batch, const Instance& a, const Instance& b) {
        add_points(batch, a, b);
        add_field(batch, b, SignEncoding::stencil);
        add_overlaps(batch, a, b, IntersectionStrategy::stencil);
    };
    expect_few(with_one_strategy, 2);
    const Add with_everything = [this](Batch& batch, const Instance& a, const Instance& b) {
        add_points(batch, a, b);
        for (const SignEncoding sign : encodings) {
            add_field(batch, b, sign);
        }
        for (const IntersectionStrategy strategy : strategies) {
            add_overlaps(batch, a, b, strategy);
        }
    };
    expect_few(with_everything, 5);  // distances, and each strategy
}

}  // namespace
}  // namespace nearfield::test
