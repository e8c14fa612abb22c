#include <engine/graph/bake.hpp>
#include <engine/graph/print.hpp>

#include <gtest/gtest.h>
#include <tests/unit/graph/simulation.hpp>
#include <tests/unit/graph/support.hpp>

#include <bit>
#include <map>
#include <set>

namespace nearfield::graph::testing {
namespace {

constexpr unsigned baked_graphs = 400;

/// Calls `law` with random graphs and their baked versions.
template <class Law>
void for_random_graphs(Law&& law) {
    for (unsigned seed = 0; seed < baked_graphs && !::testing::Test::HasFatalFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const RandomGraph random(seed);
        const Expected<BakedGraph> baked = bake(random.graph());
        ASSERT_TRUE(baked.has_value()) << baked.error().text();
        law(random.graph(), *baked);
    }
}

BakedGraph bake_valid(const Graph& graph) {
    Expected<BakedGraph> baked = bake(graph);
    EXPECT_TRUE(baked.has_value()) << baked.error().text();
    return baked.has_value() ? *baked : BakedGraph{};
}

/// True if `before` must run before `after`, according to the handles of the two.
bool must_precede(const Pass& before, const Pass& after) {
    for (const Use& first : before.uses) {
        for (const Use& second : after.uses) {
            const bool same = first.handle.resource == second.handle.resource;
            const bool output_needed =
                first.write && second.handle.version == first.handle.version + 1;
            const bool replaced =
                !first.write && second.write && second.handle.version == first.handle.version;
            if (same && (output_needed || replaced)) {
                return true;
            }
        }
    }
    return false;
}

TEST(GraphBake, OrderFollowsVersionsAndThenDeclaration) {
    for_random_graphs([](const Graph& graph, const BakedGraph& baked) {
        std::set<std::uint32_t> waiting;
        for (std::uint32_t i = 0; i < graph.passes().size(); ++i) {
            waiting.insert(i);
        }
        for (const BakedPass& pass : baked.passes) {
            const auto is_ready = [&](std::uint32_t candidate) {
                return std::none_of(waiting.begin(), waiting.end(), [&](std::uint32_t other) {
                    return must_precede(graph.passes()[other], graph.passes()[candidate]);
                });
            };
            const auto expected = std::find_if(waiting.begin(), waiting.end(), is_ready);
            ASSERT_NE(expected, waiting.end());
            ASSERT_EQ(pass.pass, *expected) << print_text(graph, baked);
            waiting.erase(expected);
        }
        ASSERT_TRUE(waiting.empty());
    });
}

TEST(GraphBake, SameGraphBakesTheSame) {
    for_random_graphs([](const Graph& graph, const BakedGraph& baked) {
        ASSERT_EQ(print_text(graph, baked), print_text(graph, bake_valid(graph)));
    });
}

TEST(GraphBake, LifetimesSpanTheUses) {
    for_random_graphs([](const Graph& graph, const BakedGraph& baked) {
        std::vector<std::set<std::uint32_t>> positions(graph.resources().size());
        for (std::uint32_t position = 0; position < baked.passes.size(); ++position) {
            for (const Use& use : graph.passes()[baked.passes[position].pass].uses) {
                positions[use.handle.resource].insert(position);
            }
        }
        ASSERT_EQ(baked.lifetimes.size(), positions.size());
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const Lifetime& lifetime = baked.lifetimes[i];
            ASSERT_EQ(lifetime.used, !positions[i].empty());
            if (lifetime.used) {
                ASSERT_EQ(lifetime.first, *positions[i].begin());
                ASSERT_EQ(lifetime.last, *positions[i].rbegin());
            }
            const bool has_memory = lifetime.memory_slot != no_memory_slot;
            ASSERT_EQ(has_memory, lifetime.used && graph.resources()[i].is_image);
            ASSERT_TRUE(!has_memory || lifetime.memory_slot < baked.memory_slots);
        }
    });
}

/// Formats whose images may be bound to the same memory type on every device.
int memory_class(const Resource& resource) {
    const VkFormat format = resource.image.format;
    return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D24_UNORM_S8_UINT
               ? static_cast<int>(format)
               : 0;
}

TEST(GraphBake, NoTwoLiveImagesInOneSlotAndNoSlotTooMany) {
    std::size_t shared = 0;
    for_random_graphs([&](const Graph& graph, const BakedGraph& baked) {
        std::map<std::uint32_t, int> class_of_slot;
        std::map<int, std::size_t> max_alive;
        std::size_t images = 0;
        for (std::uint32_t position = 0; position < baked.passes.size(); ++position) {
            std::set<std::uint32_t> occupied;
            std::map<int, std::size_t> alive;
            for (std::size_t i = 0; i < baked.lifetimes.size(); ++i) {
                const Lifetime& lifetime = baked.lifetimes[i];
                if (lifetime.memory_slot == no_memory_slot || position < lifetime.first ||
                    position > lifetime.last) {
                    continue;
                }
                const int kind = memory_class(graph.resources()[i]);
                ASSERT_TRUE(occupied.insert(lifetime.memory_slot).second)
                    << print_text(graph, baked);
                ASSERT_EQ(class_of_slot.try_emplace(lifetime.memory_slot, kind).first->second,
                          kind);
                max_alive[kind] = std::max(max_alive[kind], ++alive[kind]);
                images += lifetime.first == position ? 1 : 0;
            }
        }
        std::size_t fewest = 0;
        for (const auto& [kind, count] : max_alive) {
            fewest += count;
        }
        ASSERT_EQ(baked.memory_slots, fewest) << print_text(graph, baked);
        shared += images - fewest;
    });
    EXPECT_GT(shared, baked_graphs / 4) << "the graphs hardly share memory and test nothing";
}

TEST(GraphBake, BarriersKeepEveryRuleOfTheSimulation) {
    for_random_graphs([](const Graph& graph, const BakedGraph& baked) {
        ASSERT_EQ(simulate(graph, baked), "") << print_text(graph, baked);
    });
}

/// Every barrier of a baked graph, for removal.
std::vector<Barrier*> barriers_of(BakedGraph& baked) {
    std::vector<Barrier*> barriers;
    for (BakedPass& pass : baked.passes) {
        for (Barrier& barrier : pass.barriers) {
            barriers.push_back(&barrier);
        }
    }
    for (Barrier& barrier : baked.to_host) {
        barriers.push_back(&barrier);
    }
    return barriers;
}

/// Removes one bit of `mask` after the other; the simulation must detect each.
void expect_every_bit_needed(const Graph& graph, const BakedGraph& baked, std::uint32_t& mask,
                             const char* what) {
    const std::uint32_t whole = mask;
    for (std::uint32_t bit = 1; bit != 0; bit <<= 1) {
        if ((whole & bit) != 0) {
            mask = whole & ~bit;
            ASSERT_NE(simulate(graph, baked), "") << what << " " << bit << " is not needed\n"
                                                  << print_text(graph, baked);
        }
    }
    mask = whole;
}

TEST(GraphBake, NoBarrierWaitsForMoreThanItMust) {
    for_random_graphs([](const Graph& graph, const BakedGraph& original) {
        BakedGraph baked = original;
        for (Barrier* const barrier : barriers_of(baked)) {
            expect_every_bit_needed(graph, baked, barrier->destination_stages, "destination stage");
            // A buffer is read in two stages; one read's barrier may have waited for the other read
            // already, or may have made the contents available or visible already.
            const bool is_image = graph.resources()[barrier->resource].is_image;
            // The first use of an image that shares memory also names its own last write.
            const bool exact = is_image && barrier->old_layout != VK_IMAGE_LAYOUT_UNDEFINED;
            if (exact || (!is_image && std::has_single_bit(barrier->source_stages))) {
                expect_every_bit_needed(graph, baked, barrier->source_stages, "source stage");
            }
            if (exact) {
                expect_every_bit_needed(graph, baked, barrier->source_access, "source access");
            }
            if (is_image) {
                expect_every_bit_needed(graph, baked, barrier->destination_access,
                                        "destination access");
            }
        }
    });
}

TEST(GraphBake, MemoryIsTakenOverWithBarriersOnMemory) {
    std::size_t needed = 0;
    for_random_graphs([&](const Graph& graph, const BakedGraph& original) {
        BakedGraph baked = original;
        for (Barrier* const barrier : barriers_of(baked)) {
            if (barrier->takes_over_memory) {
                barrier->takes_over_memory = false;
                ASSERT_NE(simulate(graph, baked), "") << print_text(graph, original);
                barrier->takes_over_memory = true;
                ++needed;
            }
        }
    });
    EXPECT_GT(needed, 0U);
}

TEST(GraphBake, AttachmentsLoadAndStoreWhatIsNeeded) {
    for_random_graphs([](const Graph& graph, const BakedGraph& baked) {
        std::set<std::uint32_t> needed_later;
        for (auto pass = baked.passes.rbegin(); pass != baked.passes.rend(); ++pass) {
            const Pass& declared = graph.passes()[pass->pass];
            std::vector<Use> expected;
            for (const Access access :
                 {Access::color_attachment, Access::depth_stencil_attachment}) {
                std::copy_if(declared.uses.begin(), declared.uses.end(),
                             std::back_inserter(expected),
                             [access](const Use& use) { return use.access == access; });
            }
            ASSERT_EQ(pass->attachments.size(), expected.size());
            for (std::size_t i = 0; i < expected.size(); ++i) {
                const Attachment& attachment = pass->attachments[i];
                const std::uint32_t resource = expected[i].handle.resource;
                ASSERT_EQ(attachment.resource, resource);
                ASSERT_EQ(attachment.access, expected[i].access);
                ASSERT_EQ(attachment.load, expected[i].handle.version > 0);
                ASSERT_EQ(attachment.store, needed_later.contains(resource));
                ASSERT_EQ(pass->extent.width, graph.resources()[resource].image.extent.width);
                ASSERT_EQ(pass->extent.height, graph.resources()[resource].image.extent.height);
            }
            for (const Use& use : declared.uses) {
                needed_later.insert(use.handle.resource);
            }
        }
    });
}

TEST(GraphBake, EmptyGraph) {
    const BakedGraph baked = bake_valid(Graph{});
    EXPECT_TRUE(baked.passes.empty());
    EXPECT_EQ(baked.memory_slots, 0U);
}

TEST(GraphBake, WriteAfterReadWaitsAndMakesNothingAvailable) {
    Graph graph;
    const Handle edges = graph.import_buffer({.name = "edges", .written_by_host = true});
    add_pass(graph, "look", PassKind::compute, {reads(edges, Access::storage_read_in_compute)});
    add_pass(graph, "sort", PassKind::compute, {writes(edges, Access::storage_write_in_compute)});
    const BakedGraph baked = bake_valid(graph);
    ASSERT_EQ(baked.passes[1].barriers.size(), 1U);
    const Barrier& barrier = baked.passes[1].barriers[0];
    EXPECT_EQ(barrier.source_stages, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
    EXPECT_EQ(barrier.destination_stages, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
    EXPECT_EQ(barrier.source_access, 0U);
}

TEST(GraphBake, ImportedResourcesWaitForWhatIsOutsideAndAreExported) {
    Graph graph;
    const Handle words =
        graph.import_buffer({.name = "words"}, {.before = Access::storage_write_in_compute});
    const Handle image =
        graph.import_image({.name = "distance", .format = VK_FORMAT_R32_SFLOAT},
                           {.before = Access::exported_image, .after = Access::exported_image});
    add_pass(graph, "export", PassKind::compute,
             {reads(words, Access::storage_read_in_compute),
              writes(image, Access::storage_image_in_compute)});
    const BakedGraph baked = bake_valid(graph);
    EXPECT_EQ(simulate(graph, baked), "");
    EXPECT_EQ(baked.memory_slots, 0U);
    ASSERT_EQ(baked.passes[0].barriers.size(), 2U);
    const Barrier& of_words = baked.passes[0].barriers[0];
    EXPECT_EQ(of_words.source_stages, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
    EXPECT_EQ(of_words.source_access, VK_ACCESS_SHADER_WRITE_BIT);
    const Barrier& of_image = baked.passes[0].barriers[1];
    EXPECT_EQ(of_image.old_layout, VK_IMAGE_LAYOUT_UNDEFINED);
    EXPECT_EQ(of_image.new_layout, VK_IMAGE_LAYOUT_GENERAL);
    EXPECT_NE(of_image.source_stages & VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0U);
    ASSERT_EQ(baked.to_host.size(), 1U);
    EXPECT_EQ(baked.to_host[0].new_layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    EXPECT_NE(baked.to_host[0].destination_stages & VK_PIPELINE_STAGE_VERTEX_SHADER_BIT, 0U);

    // The simulation detects the omission.
    BakedGraph without_wait = baked;
    without_wait.passes[0].barriers.erase(without_wait.passes[0].barriers.begin());
    EXPECT_NE(simulate(graph, without_wait), "");
    BakedGraph not_exported = baked;
    not_exported.to_host.clear();
    EXPECT_NE(simulate(graph, not_exported), "");
}

TEST(GraphBake, FirstUseOfAnImageWaitsForTheExecutionBefore) {
    Graph graph;
    const Handle sign = color(graph, "sign");
    add_pass(graph, "fill", PassKind::graphics, {writes(sign, Access::color_attachment)});
    add_pass(graph, "resolve", PassKind::compute, {reads(next(sign), Access::sampled_in_compute)});
    const BakedGraph baked = bake_valid(graph);
    ASSERT_EQ(baked.passes[0].barriers.size(), 1U);
    const Barrier& barrier = baked.passes[0].barriers[0];
    EXPECT_EQ(barrier.old_layout, VK_IMAGE_LAYOUT_UNDEFINED);
    EXPECT_EQ(barrier.source_stages, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
    EXPECT_EQ(barrier.source_access, 0U);
}

}  // namespace
}  // namespace nearfield::graph::testing
