#include <tests/query/host_table.hpp>

#include <fstream>
#include <sstream>
#include <utility>

namespace nearfield::test {
namespace {

using test_support::HostFrames;
using test_support::true_device_function;
using test_support::WatchedCall;

/// "State left behind in the command buffer" in docs/host_integration.md, which an engine that
/// skips redundant binds relies on.
class LeftBehind : public HostTable {
protected:
    void SetUp() override {
        begun.clear();
        ended.clear();
        changed.clear();
        make_host();
        test_support::Lies lies = test_support::watched(host(), note);
        lies.entry_points["vkCmdBindDescriptorSets"] =
            reinterpret_cast<PFN_vkVoidFunction>(&bind_sets);
        lies.entry_points["vkCmdBindVertexBuffers"] =
            reinterpret_cast<PFN_vkVoidFunction>(&bind_vertices);
        lies.entry_points["vkCmdBindPipeline"] = reinterpret_cast<PFN_vkVoidFunction>(&bind);
        loader_.emplace(host(), std::move(lies));
    }
    void TearDown() override {
        loader_.reset();
        HostTable::TearDown();
    }

    void record_everything() {
        Context context = make(loader_->host());
        const Scene scene(context);
        HostFrames frames(host(), 1);
        Batch all = scene.every();
        IntersectionQuery watched{{scene.a, {}}, {scene.b, {{0.5, 0.0}, 0.3}}, 0.005};
        watched.technique = Technique::raster;
        watched.summary_only = true;
        all.add(watched);
        static_cast<void>(scene.record(all, frames, 0));
    }

    static inline std::multiset<std::string> begun;
    static inline std::multiset<std::string> ended;
    static inline std::set<std::string> changed;

private:
    static void note(const WatchedCall& call) {
        const std::string name(call.name);
        if (name.starts_with("vkCmdBegin")) {
            begun.insert(name.substr(10));
        } else if (name.starts_with("vkCmdEnd")) {
            ended.insert(name.substr(8));
        } else if (name.starts_with("vkCmdSet") || name.starts_with("vkCmdBind") ||
                   name.starts_with("vkCmdPush")) {
            changed.insert(name);
        }
    }
    template <class Function>
    static Function driver(const char* name) {
        return reinterpret_cast<Function>(true_device_function(name));
    }
    static void VKAPI_CALL bind(VkCommandBuffer commands, VkPipelineBindPoint point,
                                VkPipeline pipeline) {
        changed.insert("pipeline of " + std::to_string(point));
        driver<PFN_vkCmdBindPipeline>("vkCmdBindPipeline")(commands, point, pipeline);
    }
    static void VKAPI_CALL bind_sets(VkCommandBuffer commands, VkPipelineBindPoint point,
                                     VkPipelineLayout layout, std::uint32_t first,
                                     std::uint32_t count, const VkDescriptorSet* sets,
                                     std::uint32_t offset_count, const std::uint32_t* offsets) {
        for (std::uint32_t i = 0; i < count; ++i) {
            changed.insert("set " + std::to_string(first + i) + " of " + std::to_string(point));
        }
        driver<PFN_vkCmdBindDescriptorSets>("vkCmdBindDescriptorSets")(
            commands, point, layout, first, count, sets, offset_count, offsets);
    }
    static void VKAPI_CALL bind_vertices(VkCommandBuffer commands, std::uint32_t first,
                                         std::uint32_t count, const VkBuffer* buffers,
                                         const VkDeviceSize* offsets) {
        for (std::uint32_t i = 0; i < count; ++i) {
            changed.insert("vertex buffer " + std::to_string(first + i));
        }
        driver<PFN_vkCmdBindVertexBuffers>("vkCmdBindVertexBuffers")(commands, first, count,
                                                                     buffers, offsets);
    }

    std::optional<test_support::FakeLoader> loader_;
};

TEST_F(LeftBehind, IsWhatTheDocumentsSay) {
    record_everything();
    const std::string graphics = std::to_string(VK_PIPELINE_BIND_POINT_GRAPHICS);
    const std::string compute = std::to_string(VK_PIPELINE_BIND_POINT_COMPUTE);
    EXPECT_EQ(changed,
              (std::set<std::string>{"pipeline of " + graphics, "pipeline of " + compute,
                                     "set 0 of " + graphics, "set 0 of " + compute,
                                     "vkCmdPushConstants", "vertex buffer 0", "vkCmdSetViewport",
                                     "vkCmdSetScissor", "vkCmdSetStencilCompareMask",
                                     "vkCmdSetStencilWriteMask", "vkCmdSetStencilReference"}));
    std::ifstream page(NEARFIELD_DOCUMENTS "/host_integration.md");
    std::stringstream text;
    text << page.rdbuf();
    EXPECT_NE(text.str().find("| changed | for both bind points (graphics and compute): pipeline, "
                              "descriptor set 0, push constants; vertex buffer binding 0; viewport "
                              "0, scissor 0; stencil compare mask, write mask and reference |"),
              std::string::npos);
}

TEST_F(LeftBehind, IsNothingOpen) {
    record_everything();
    EXPECT_EQ(begun, ended);
    EXPECT_GT(begun.count("RenderPass"), 0U);
    EXPECT_GT(begun.count("Query"), 0U);
}

}  // namespace
}  // namespace nearfield::test
