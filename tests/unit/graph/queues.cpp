#include <engine/graph/access.hpp>
#include <engine/graph/bake.hpp>
#include <engine/graph/print.hpp>

#include <gtest/gtest.h>
#include <tests/unit/graph/simulation.hpp>
#include <tests/unit/graph/support.hpp>

#include <string>

// Graphs on a queue family that computes and does not draw, and results that another family reads.

namespace nearfield::graph::testing {
namespace {

constexpr unsigned divided_graphs = 300;
constexpr VkQueueFlags compute_only = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;

/// Calls `law` with random graphs that export, baked for a family that does not draw.
template <class Law>
void for_exporting_graphs(const Law& law) {
    for (unsigned seed = 0; seed < divided_graphs && !::testing::Test::HasFatalFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const RandomGraph random = RandomGraph::that_exports(seed);
        const Expected<BakedGraph> baked = bake(random.graph(), compute_only);
        ASSERT_TRUE(baked.has_value()) << baked.error().text();
        law(random.graph(), *baked);
    }
}

/// Something was written that is exported.
bool exports(const Graph& graph, const BakedGraph& baked) {
    for (std::size_t i = 0; i < graph.resources().size(); ++i) {
        if (graph.resources()[i].outside.after && baked.lifetimes[i].used) {
            return true;
        }
    }
    return false;
}

TEST(GraphQueues, ThatDoNotDrawGetOnlyBarriersThatTheyHave) {
    std::size_t refused = 0;
    for_exporting_graphs([&](const Graph& graph, const BakedGraph& baked) {
        ASSERT_EQ(simulate(graph, baked, {.queue = compute_only}), "") << print_text(graph, baked);
        const std::string breach = simulate(graph, *bake(graph), {.queue = compute_only});
        ASSERT_EQ(breach.find("stages that the queue family does not have") != std::string::npos,
                  exports(graph, baked))
            << breach;
        refused += breach.empty() ? 0U : 1U;
    });
    EXPECT_GT(refused, divided_graphs / 2);
}

TEST(GraphQueues, ThatDoNotDrawRefusePassesThatDo) {
    for (unsigned seed = 0; seed < divided_graphs; ++seed) {
        const RandomGraph random(seed);
        const BakedGraph baked = *bake(random.graph());
        for (const BakedPass& pass : baked.passes) {
            if (random.graph().passes()[pass.pass].kind == PassKind::graphics) {
                const Expected<BakedGraph> refused = bake(random.graph(), compute_only);
                ASSERT_FALSE(refused.has_value());
                EXPECT_NE(refused.error().message().find("is a graphics pass, and the queue family "
                                                         "does not draw"),
                          std::string::npos)
                    << refused.error().text();
                break;
            }
        }
    }
}

TEST(GraphQueues, OfAnotherFamilyReadAfterASemaphoreWhatBothShare) {
    std::size_t exporting = 0;
    for_exporting_graphs([&](const Graph& graph, const BakedGraph& baked) {
        Execution execution{.queue = compute_only, .read_by_other_family = true};
        const auto breach = [&] { return simulate(graph, baked, execution); };
        const auto expect_breach = [&](const char* words) {
            EXPECT_EQ(breach().find(words) != std::string::npos, exports(graph, baked)) << breach();
        };
        execution.concurrent = true;
        ASSERT_EQ(breach(), "") << print_text(graph, baked);
        execution.waits = false;
        expect_breach("is read by a queue that does not wait");
        execution.waits = true;

        // Nothing is read that the execution before left, so ownership need not come back.
        execution.concurrent = false;
        expect_breach("is read by a family that does not own it");
        execution.transferred = true;
        ASSERT_EQ(breach(), "") << print_text(graph, baked);
        exporting += exports(graph, baked) ? 1U : 0U;
    });
    EXPECT_GT(exporting, divided_graphs / 2);
}

TEST(GraphQueues, OfAnotherFamilyFindTheLayoutThatTheLastBarrierMakes) {
    std::size_t images = 0;
    for_exporting_graphs([&](const Graph& graph, const BakedGraph& original) {
        BakedGraph baked = original;
        for (auto barrier = baked.to_host.begin(); barrier != baked.to_host.end(); ++barrier) {
            if (graph.resources()[barrier->resource].is_image) {
                baked.to_host.erase(barrier);
                const Execution execution{
                    .queue = compute_only, .read_by_other_family = true, .concurrent = true};
                EXPECT_NE(simulate(graph, baked, execution).find("exported in another layout"),
                          std::string::npos);
                ++images;
                break;
            }
        }
    });
    EXPECT_GT(images, 100U);
}

/// Ownership that was transferred for a reader does not come back, so nothing may be kept from one
/// execution for the next.
TEST(GraphQueues, OfAnotherFamilyKeepWhatTheNextExecutionWouldRead) {
    Graph graph;
    const Handle kept = graph.import_buffer(
        {.name = "kept"},
        {.before = Access::storage_write_in_compute, .after = Access::exported_buffer});
    add_pass(graph, "read", PassKind::compute, {reads(kept, Access::storage_read_in_compute)});
    const BakedGraph baked = *bake(graph, compute_only);
    Execution execution{.queue = compute_only, .read_by_other_family = true, .transferred = true};
    EXPECT_NE(simulate(graph, baked, execution).find("read reads what another family owns"),
              std::string::npos);
    execution.concurrent = true;
    EXPECT_EQ(simulate(graph, baked, execution), "");
}

}  // namespace
}  // namespace nearfield::graph::testing
