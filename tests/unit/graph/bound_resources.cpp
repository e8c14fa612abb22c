#include <engine/base/status_exception.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bound_resources.hpp>
#include <engine/graph/recorded_graph.hpp>

#include <gtest/gtest.h>
#include <tests/support/allocations.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/support/mock_driver.hpp>
#include <tests/unit/graph/support.hpp>

#include <optional>
#include <span>

namespace nearfield::graph::testing {
namespace {

constexpr Access read = Access::storage_read_in_compute;
constexpr Access write = Access::storage_write_in_compute;

void use(Graph& graph, std::string name, std::initializer_list<Bound> bound) {
    graph.add_pass(std::move(name), PassKind::compute, [&](PassBuilder& pass) {
        pass.use({bound.begin(), bound.size()});
    });
}

TEST(GraphBindings, SayReadsAndWritesOnce) {
    Graph graph;
    Handle input = graph.import_buffer({.name = "input", .written_by_host = true});
    Handle output = graph.import_buffer({.name = "output"});
    Handle arguments = graph.import_buffer({.name = "arguments", .written_by_host = true});
    Handle none;
    const Handle before = output;
    use(graph, "search",
        {{0, input, read, 0},
         {1, input, read, 1},
         {4, none, Access::sampled_in_compute},
         {unbound, arguments, Access::indirect_arguments},
         {2, output, write, 0},
         {3, output, write, 1}});
    EXPECT_EQ(input.version, 0U);
    EXPECT_EQ(output, next(before));
    const Pass& pass = graph.passes().front();
    ASSERT_EQ(pass.uses.size(), 3U);
    EXPECT_EQ(pass.uses[0].handle, input);
    EXPECT_EQ(pass.uses[1].access, Access::indirect_arguments);
    EXPECT_EQ(pass.uses[2].handle, before);
    EXPECT_TRUE(pass.uses[2].write);
    EXPECT_EQ(pass.bindings.size(), 4U);
}

TEST(GraphBindings, ThatContradictEachOtherAreRefused) {
    Graph graph;
    Handle buffer = graph.import_buffer({.name = "buffer", .written_by_host = true});
    use(graph, "search", {{0, buffer, read}, {1, buffer, write}});
    const Expected<BakedGraph> baked = bake(graph);
    ASSERT_FALSE(baked.has_value());
    EXPECT_NE(baked.error().message().find("uses 'buffer' twice"), std::string::npos);
}

TEST(GraphBindings, ShareASetUnlessSomethingElseIsThere) {
    Graph graph;
    Handle shapes = graph.import_buffer({.name = "shapes", .written_by_host = true});
    Handle scratch = graph.import_buffer({.name = "scratch"});
    Handle field = graph.import_buffer({.name = "field"});
    use(graph, "clear", {{unbound, scratch, Access::transfer_write}});
    use(graph, "lists", {{0, shapes}, {1, scratch, write}});
    use(graph, "values", {{1, scratch}, {3, field, write}});    // beside them
    use(graph, "parts", {{0, shapes, read, 1}, {1, scratch}});  // another part
    use(graph, "two", {{0, shapes, read, 0, 0}, {0, field, read, 0, 1}, {1, scratch}});
    const SetPlan plan(graph);
    using Sets = std::vector<std::vector<std::size_t>>;
    EXPECT_EQ(plan.of_passes(), (Sets{{}, {0}, {0}, {1}, {0, 2}}));
    ASSERT_EQ(plan.sets().size(), 3U);
    EXPECT_EQ(plan.sets()[0].bindings.size(), 3U);
    EXPECT_EQ(plan.sets()[0].name, "nearfield set of lists");
    EXPECT_EQ(plan.sets()[2].name, "nearfield set of two");
}

std::vector<VkWriteDescriptorSet> last_writes;
int updates = 0;

void VKAPI_CALL note_writes(VkDevice, std::uint32_t count, const VkWriteDescriptorSet* writes,
                            std::uint32_t, const VkCopyDescriptorSet*) {
    ++updates;
    last_writes.assign(writes, writes + count);
}

void VKAPI_CALL no_barrier(VkCommandBuffer, VkPipelineStageFlags, VkPipelineStageFlags,
                           VkDependencyFlags, std::uint32_t, const VkMemoryBarrier*, std::uint32_t,
                           const VkBufferMemoryBarrier*, std::uint32_t,
                           const VkImageMemoryBarrier*) {}

/// Two passes: shapes at 0, scratch at 1, and the field at 3.
class BoundResourcesTest : public ::testing::Test {
protected:
    BoundResourcesTest() {
        test_support::Lies lies;
        lies.entry_points["vkUpdateDescriptorSets"] =
            reinterpret_cast<PFN_vkVoidFunction>(&note_writes);
        lies.entry_points["vkCmdPipelineBarrier"] =
            reinterpret_cast<PFN_vkVoidFunction>(&no_barrier);
        loader_.emplace(driver_.host(), lies);
        device_.emplace(loader_->host());
        layout_.emplace(*device_, 128U);
        const auto add = [this](const char* name, std::initializer_list<Bound> bound) {
            graph_.add_pass(
                name, PassKind::compute,
                [&](PassBuilder& pass) {
                    pass.use({bound.begin(), bound.size()});
                },
                [this](const PassCommands& commands, int) { sets_.push_back(commands.set()); });
        };
        Handle scratch = scratch_;
        Handle field = field_;
        add("lists", {{0, shapes_}, {1, scratch, write}});
        add("values", {{1, scratch}, {3, field, write}});
        graph_.compile(*device_);
        updates_.emplace(*device_);
        updates = 0;
    }

    static gpu::BufferPart part(std::uint64_t number) {
        return {reinterpret_cast<VkBuffer>(number), 16 * number, 32, VK_NULL_HANDLE, number};
    }

    int update(BoundResources& resources) {
        last_writes.clear();
        updates_->begin();
        updates_->add(resources);
        updates_->end();
        return static_cast<int>(last_writes.size());
    }

    test_support::MockDriver driver_;
    std::optional<test_support::FakeLoader> loader_;
    std::optional<gpu::Device> device_;
    std::optional<ComputeLayout> layout_;
    RecordedGraph<int> graph_;
    Handle shapes_ = graph_.import_buffer({.name = "shapes", .written_by_host = true});
    Handle scratch_ = graph_.import_buffer({.name = "scratch"});
    Handle field_ = graph_.import_buffer({.name = "field"});
    std::vector<VkDescriptorSet> sets_;
    std::optional<DescriptorUpdates> updates_;
};

TEST_F(BoundResourcesTest, WriteWhatHasChangedAndNothingElse) {
    BoundResources resources = graph_.make_resources(*layout_);
    resources.set(shapes_, part(1));
    resources.set(scratch_, part(2));
    resources.set(field_, part(3));
    EXPECT_EQ(update(resources), 3);  // in the one set of both passes
    EXPECT_EQ(updates, 1);
    EXPECT_EQ(last_writes[0].descriptorType, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);

    const std::uint64_t before = test_support::allocation_count();
    resources.set(shapes_, part(1));
    resources.set(scratch_, part(2));
    resources.set(field_, part(3));
    resources.set(Handle{}, part(4));
    EXPECT_EQ(update(resources), 0);
    EXPECT_EQ(updates, 1);
    EXPECT_EQ(test_support::allocation_count(), before);

    // Another buffer with the handle of one that is gone.
    gpu::BufferPart again = part(2);
    again.identity = 5;
    resources.set(scratch_, again);
    ASSERT_EQ(update(resources), 1);
    EXPECT_EQ(last_writes[0].dstBinding, 1U);
    EXPECT_EQ(updates, 2);
}

TEST_F(BoundResourcesTest, WriteTexelsWhereTheBufferHasThem) {
    BoundResources resources = graph_.make_resources(*layout_);
    gpu::BufferPart shapes = part(1);
    shapes.texels = reinterpret_cast<VkBufferView>(7);
    resources.set(shapes_, shapes);
    resources.set(scratch_, part(2));
    resources.set(field_, part(3));
    EXPECT_EQ(update(resources), 4);
    EXPECT_EQ(last_writes[1].dstBinding, ComputeLayout::first_texels);
    EXPECT_EQ(last_writes[1].descriptorType, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
}

TEST_F(BoundResourcesTest, AreUpdatedInOneCallAndHaveSetsOfTheirOwn) {
    BoundResources some = graph_.make_resources(*layout_);
    BoundResources others = graph_.make_resources(*layout_);
    updates_->begin();
    for (BoundResources* const each : {&some, &others}) {
        each->set(shapes_, part(1));
        each->set(scratch_, part(2));
        each->set(field_, part(3));
        updates_->add(*each);
    }
    updates_->end();
    EXPECT_EQ(updates, 1);
    EXPECT_EQ(last_writes.size(), 6U);
    EXPECT_NE(some.set_of(0, 0), others.set_of(0, 0));
    gpu::Timestamps timestamps(*device_, 0, false);
    gpu::Submission submission(*device_);
    graph_.execute(submission.begin(), timestamps, some, 0);
    EXPECT_EQ(sets_, (std::vector<VkDescriptorSet>{some.set_of(0, 0), some.set_of(1, 0)}));
}

TEST_F(BoundResourcesTest, ThatWereNotSetAreNamedAndNothingIsWritten) {
    BoundResources resources = graph_.make_resources(*layout_);
    resources.set(shapes_, part(1));
    resources.set(field_, part(3));
    try {
        update(resources);
        FAIL() << "no failure";
    } catch (const StatusException& failure) {
        EXPECT_NE(failure.status().message().find("'scratch'"), std::string::npos);
    }
    EXPECT_EQ(updates, 0);
    resources.set(scratch_, part(2));
    EXPECT_EQ(update(resources), 3);
}

}  // namespace
}  // namespace nearfield::graph::testing
