#include <tests/oracle/overlap.hpp>
#include <tests/query/check.hpp>
#include <tests/query/device_offers.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/outlines.hpp>
#include <tests/support/vulkan_host.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <deque>

namespace nearfield::test {
namespace {

constexpr std::uint64_t strategies_seed = 4711;

/// A validated device, with the feature logicOp if available, and contexts on it.
class Strategies : public testing::Test {
protected:
    static void SetUpTestSuite() {
        test_support::Enabled wanted;
        wanted.features.logicOp = VK_TRUE;
        host_ = new test_support::VulkanHost(wanted);
        context_ = new Context(make({}));
    }
    static void TearDownTestSuite() {
        delete context_;
        EXPECT_EQ(host_->close(), std::vector<std::string>{});
        delete host_;
    }
    void TearDown() override {
        EXPECT_EQ(host_->messages(), std::vector<std::string>{});
        host_->clear_messages();
    }
    static Context make(const Settings& settings) {
        Expected<Context> made = Context::create(host_->device(), on_demand(settings));
        EXPECT_TRUE(made.has_value()) << made.error().text();
        return std::move(*made);
    }

    /// Otherwise the query is rejected.
    static bool is_available(IntersectionStrategy strategy) {
        return strategy != IntersectionStrategy::logic_op || host_->device().logic_op;
    }

    /// All strategies of each kind must give the same samples, which the oracle allows, and those
    /// of the CPU if the device has its grid.
    static void check(const PlacedPair& pair, Context& context);

    static test_support::VulkanHost* host_;
    static Context* context_;
};
test_support::VulkanHost* Strategies::host_ = nullptr;
Context* Strategies::context_ = nullptr;

void expect_same(const IntersectionResult& a, const IntersectionResult& b) {
    ASSERT_TRUE(b.status.ok()) << b.status.text();
    EXPECT_EQ(a.count, b.count);
    EXPECT_EQ(a.area, b.area);
    EXPECT_EQ(a.intersects, b.intersects);
    EXPECT_EQ(a.box.min, b.box.min);
    EXPECT_EQ(a.box.max, b.box.max);
    ASSERT_EQ(a.samples.size(), b.samples.size());
    Report report(std::string("samples by ") + to_string(a.strategy) + " and " +
                  to_string(b.strategy));
    for (std::size_t i = 0; i < a.samples.size(); ++i) {
        report.require(a.samples[i].position == b.samples[i].position &&
                           a.samples[i].edge == b.samples[i].edge,
                       "sample ", i, " of edge ", a.samples[i].edge, " and ", b.samples[i].edge);
    }
}

/// The query without its list of samples.
void expect_same_count(Context& context, IntersectionQuery query,
                       const IntersectionResult& listed) {
    query.summary_only = true;
    const IntersectionResult counted = run_alone(context, query);
    EXPECT_EQ(counted.count, listed.count);
    EXPECT_EQ(counted.area, listed.area);
    EXPECT_EQ(counted.box.min, listed.box.min);
    EXPECT_EQ(counted.box.max, listed.box.max);
    EXPECT_TRUE(counted.samples.empty());
}

void Strategies::check(const PlacedPair& pair, Context& context) {
    SCOPED_TRACE(describe(pair.pair()));
    for (const IntersectionKind kind : every_kind) {
        SCOPED_TRACE("kind " + std::to_string(static_cast<int>(kind)));
        IntersectionQuery query = pair.intersection(kind);
        IntersectionResult first;
        for (const IntersectionStrategy strategy : every_strategy) {
            SCOPED_TRACE(to_string(strategy));
            query.strategy = strategy;
            const IntersectionResult result = run_alone(context, query);
            EXPECT_EQ(result.strategy, strategy);
            if (!is_available(strategy)) {
                expect_logic_op_refused(result);
                continue;
            }
            if (strategy == every_strategy.front()) {
                first = result;
                check_intersection(pair, kind, first);
            }
            expect_same(first, result);
            expect_same_count(context, query, result);
        }
        query.technique = Technique::cpu;
        const IntersectionResult exact = run_alone(context, query);
        EXPECT_EQ(exact.technique, Technique::cpu);
        check_intersection(pair, kind, exact);
        if (has_grid_of_cpu(host_->device())) {
            expect_same(exact, first);
        }
        EXPECT_EQ(exact.intersects, first.intersects);
        expect_same_count(context, query, exact);
    }
}

TEST_F(Strategies, AgreeOnRandomPairs) {
    const int cases = random_cases(12);
    for (int i = 0; i < cases; ++i) {
        SCOPED_TRACE("seed " + std::to_string(strategies_seed) + " case " + std::to_string(i));
        Random random(strategies_seed + static_cast<std::uint64_t>(i));
        check(PlacedPair(*context_, any_pair(random)), *context_);
    }
}

TEST_F(Strategies, AgreeOnEveryFamily) {
    for (Pair& pair : family_pairs(strategies_seed)) {
        check(PlacedPair(*context_, std::move(pair)), *context_);
    }
}

/// All outlines of a folder at several overlaps, with `cells` along the longer side of the
/// intersection. The environment variable NEARFIELD_TEST_OUTLINES replaces the default folder.
TEST_F(Strategies, AgreeOnOutlines) {
    const char* const folder = std::getenv("NEARFIELD_TEST_OUTLINES");
    const auto outlines = read_outlines(folder != nullptr ? folder : NEARFIELD_TEST_DATA);
    const double cells = 64;
    int checked = 0;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        const NamedRings& other = outlines[(i + 1) % outlines.size()];
        const oracle::ShapeOracle a(outlines[i].rings);
        for (const double share : {0.01, 0.1, 0.5}) {
            const auto pose = oracle::pose_for_overlap(a, other.rings, 0.8, {1.0, 0.35}, share);
            if (!pose) {
                continue;
            }
            const Rectangle common =
                oracle::overlap(a, oracle::ShapeOracle(other.rings, *pose)).box;
            const double side = std::max(common.max.x - common.min.x, common.max.y - common.min.y);
            check(PlacedPair(*context_, {outlines[i], other, {}, *pose, side / cells}), *context_);
            ++checked;
        }
    }
    EXPECT_GE(checked, 12);
}

TEST_F(Strategies, AgreeOverManyTilesAndRounds) {
    // So little memory that an atlas has 256 x 256 cells: four tiles, one per tile batch.
    Settings settings;
    settings.memory_limit = 12U << 20U;
    Context context = make(settings);
    Random random(strategies_seed);
    const Rings a = scaled_and_moved(with_holes(random, 5), 10.0, {});
    const Rings b = scaled_and_moved(star(random, 40, 0.6), 10.0, {});
    const PlacedPair pair(context, {{"A", a}, {"B", b}, {}, {{1.0, 0.5}, 0.2}, 0.052});
    check(pair, context);
    const auto result = run_alone(context, pair.intersection(IntersectionKind::volume_volume));
    ASSERT_EQ(result.regions.size(), 1U);
    EXPECT_GT(result.regions[0].width, 256U);
}

TEST_F(Strategies, MixInOneBatch) {
    std::deque<PlacedPair> pairs;
    Batch batch;
    std::vector<QueryHandle<IntersectionQuery>> handles;
    std::vector<IntersectionResult> alone;
    for (Pair& pair : family_pairs(strategies_seed + 1)) {
        const PlacedPair& placed = pairs.emplace_back(*context_, std::move(pair));
        IntersectionQuery query = placed.intersection(every_kind[handles.size() % 3]);
        query.strategy = every_strategy[(handles.size() / 3) % 4];
        query.summary_only = handles.size() % 2 != 0;
        query.technique = handles.size() % 5 < 2 ? Technique::compute : Technique::raster;
        handles.push_back(batch.add(query));
        batch.add(placed.penetration());
        alone.push_back(run_alone(*context_, query));
    }
    Results results;
    const Status status = context_->run(batch, results);
    ASSERT_TRUE(status.ok()) << status.text();
    for (std::size_t i = 0; i < handles.size(); ++i) {
        const IntersectionResult& result = results[handles[i]];
        SCOPED_TRACE("query " + std::to_string(i));
        if (result.technique == Technique::raster && !is_available(result.strategy)) {
            expect_logic_op_refused(result);
            continue;
        }
        EXPECT_TRUE(result.status.ok()) << result.status.text();
        EXPECT_EQ(result.count, alone[i].count);
        EXPECT_EQ(result.box.min, alone[i].box.min);
        EXPECT_EQ(result.box.max, alone[i].box.max);
        ASSERT_EQ(result.samples.size(), alone[i].samples.size());
        for (std::size_t j = 0; j < result.samples.size(); ++j) {
            ASSERT_EQ(result.samples[j].position, alone[i].samples[j].position);
            ASSERT_EQ(result.samples[j].edge, alone[i].samples[j].edge);
        }
    }
}

TEST_F(Strategies, FindOneSampleAndNone) {
    const double d = 0.05;
    const Rings small = rectangle({0, 0}, {1, 1});
    struct Case {
        Rings b;
        IntersectionKind kind;
        std::uint64_t count;
    };
    // Volumes that share a corner less than two cells wide; two crescents whose boxes overlap.
    const Case cases[] = {
        {rectangle({0.94, 0.94}, {2, 2}), IntersectionKind::volume_volume, 1},
        {{{{0.2, 1.8}, {1.8, 0.2}, {1.8, 1.8}}}, IntersectionKind::volume_volume, 0},
        {{{{0.4, 1.8}, {1.8, 0.4}, {1.8, 1.8}}}, IntersectionKind::boundary_boundary, 0},
    };
    for (const Case& test : cases) {
        const PlacedPair pair(*context_, {{"A", small}, {"B", test.b}, {}, {}, d});
        check(pair, *context_);
        for (const IntersectionStrategy strategy : every_strategy) {
            IntersectionQuery query = pair.intersection(test.kind);
            query.strategy = strategy;
            const IntersectionResult result = run_alone(*context_, query);
            if (!is_available(strategy)) {
                expect_logic_op_refused(result);
                continue;
            }
            EXPECT_EQ(result.regions.size(), 1U);
            EXPECT_EQ(result.count, test.count) << to_string(strategy);
            if (test.count == 1) {
                EXPECT_EQ(result.box.min, result.box.max);
            }
        }
    }
}

/// Tiles so large that an occlusion query decides whether they are searched at all.
TEST_F(Strategies, SearchLargeTilesWhereverASamplePasses) {
    const Rings lower{{{0, 0}, {1, 0}, {0, 1}}};
    // Its long side is beside A's, and a spike from it reaches A or nearly does.
    const auto upper = [](double tip) {
        return Rings{
            {{1.05, 1.05}, {0.03, 1.05}, {0.53, 0.55}, {tip, tip}, {0.55, 0.53}, {1.05, 0.03}}};
    };
    const double d = 0.004;
    for (const double tip : {0.52, 0.4999, 0.497, 0.49, 0.3}) {
        SCOPED_TRACE(tip);
        const PlacedPair pair(*context_, {{"A", lower}, {"B", upper(tip)}, {}, {}, d});
        check(pair, *context_);
        const auto result = run_alone(*context_, pair.intersection(every_kind[2]));
        ASSERT_EQ(result.regions.size(), 1U);
        EXPECT_GE(result.regions[0].width * result.regions[0].height, 128U * 128U);
        // A tip about d inside may lie between samples: check() has verified whether it does.
        if (tip > 0.499 || tip < 0.495) {
            EXPECT_EQ(result.count == 0, tip > 0.499) << result.count;
        }
    }
}

class MissingStrategies : public QueryTest {};

TEST_F(MissingStrategies, AreRefusedByNameAndTheRestAnswered) {
    Random random(strategies_seed);
    const PlacedPair pair(context(), any_pair(random));
    Batch batch;
    IntersectionQuery query = pair.intersection(IntersectionKind::boundary_volume);
    const auto before = batch.add(query);
    query.strategy = IntersectionStrategy::logic_op;
    const auto refused = batch.add(query);
    query.strategy = IntersectionStrategy::depth;
    const auto after = batch.add(query);
    Results results;
    const Status status = context().run(batch, results);
    ASSERT_TRUE(status.ok()) << status.text();
    expect_logic_op_refused(results[refused]);
    EXPECT_TRUE(results[before].status.ok());
    EXPECT_TRUE(results[after].status.ok());
    EXPECT_EQ(results[before].count, results[after].count);
    // The strategy's device requirements apply to drawing only.
    query.strategy = IntersectionStrategy::logic_op;
    query.technique = Technique::compute;
    const IntersectionResult computed = run_alone(context(), query);
    check_intersection(pair, IntersectionKind::boundary_volume, computed);
}

TEST_F(MissingStrategies, TheCpuNeedsNone) {
    Random random(strategies_seed);
    const PlacedPair pair(context(), any_pair(random), Technique::cpu);
    IntersectionQuery query = pair.intersection(IntersectionKind::boundary_volume);
    const IntersectionResult by_stencil = run_alone(context(), query);
    query.strategy = IntersectionStrategy::logic_op;
    const IntersectionResult result = run_alone(context(), query);
    ASSERT_TRUE(result.status.ok()) << result.status.text();
    EXPECT_GT(result.count, 0U);
    expect_same(by_stencil, result);
}

TEST_F(MissingStrategies, AreNoEnumerators) {
    Random random(strategies_seed);
    const PlacedPair pair(context(), any_pair(random));
    IntersectionQuery query = pair.intersection(IntersectionKind::volume_volume);
    query.strategy = static_cast<IntersectionStrategy>(4);
    EXPECT_EQ(run_alone(context(), query).status.code(), StatusCode::invalid_query);
}

TEST_F(MissingStrategies, CountingAloneNeedsNoMemoryForCells) {
    const PlacedPair pair(
        context(),
        {{"A", rectangle({0, 0}, {10, 10})}, {"B", rectangle({5, 5}, {20, 20})}, {}, {}, 0.008});
    IntersectionQuery query = pair.intersection(IntersectionKind::volume_volume);
    Expected<Context> small =
        Context::create(host_device(), on_demand({.memory_limit = 10U << 20U}));
    ASSERT_TRUE(small.has_value());
    const PlacedPair in_small(*small, pair.pair());
    query = in_small.intersection(IntersectionKind::volume_volume);
    EXPECT_EQ(run_alone(*small, query).status.code(), StatusCode::too_large);
    query.summary_only = true;
    const IntersectionResult result = run_alone(*small, query);
    ASSERT_TRUE(result.status.ok()) << result.status.text();
    EXPECT_NEAR(result.area, 25.0, 20.0 * result.error_bound);
}

}  // namespace
}  // namespace nearfield::test
