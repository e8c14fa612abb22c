#include <tests/query/device_offers.hpp>
#include <tests/query/host_table.hpp>

#include <algorithm>
#include <map>

namespace nearfield::test {
namespace {

using test_support::HostFrames;
using test_support::WatchedCall;

// Collects object names and labels.

struct Debugging {
    std::set<std::uint64_t> named;
    std::vector<std::string> labels;
    int open = 0;
};
Debugging debugging;

TEST_F(HostTable, Debugging) {
    make_host();
    debugging = {};
    std::map<std::uint64_t, std::string> made;
    test_support::Lies lies = test_support::watched(host(), [&](const WatchedCall& call) {
        if (call.makes() && call.made != 0) {
            made[call.made] = call.name;
        }
    });
    static PFN_vkSetDebugUtilsObjectNameEXT name_below = nullptr;
    static PFN_vkCmdBeginDebugUtilsLabelEXT begin_below = nullptr;
    static PFN_vkCmdEndDebugUtilsLabelEXT end_below = nullptr;
    const auto lie = [&lies](const char* name, auto& below, auto instead) {
        below = reinterpret_cast<std::remove_reference_t<decltype(below)>>(lies.entry_points[name]);
        lies.entry_points[name] =
            reinterpret_cast<PFN_vkVoidFunction>(std::remove_reference_t<decltype(below)>(instead));
    };
    lie("vkSetDebugUtilsObjectNameEXT", name_below,
        [](VkDevice device, const VkDebugUtilsObjectNameInfoEXT* info) {
            EXPECT_NE(std::string(info->pObjectName), "");
            debugging.named.insert(info->objectHandle);
            return name_below(device, info);
        });
    lie("vkCmdBeginDebugUtilsLabelEXT", begin_below,
        [](VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label) {
            debugging.labels.emplace_back(label->pLabelName);
            ++debugging.open;
            begin_below(commands, label);
        });
    lie("vkCmdEndDebugUtilsLabelEXT", end_below, [](VkCommandBuffer commands) {
        --debugging.open;
        end_below(commands);
    });
    const test_support::FakeLoader loader(host(), lies);
    Context context = make(loader.host());
    const Scene scene(context);
    HostFrames frames(host(), 1);
    Results results;
    ASSERT_TRUE(context.run(scene.every(), results).ok());
    const bool timed = offers(host(), "timestamps");
    EXPECT_TRUE(timed ? results.timings.passes.size() > 10U : results.timings.passes.empty());
    for (const PassTime& pass : results.timings.passes) {
        EXPECT_GE(pass.milliseconds, 0.0) << pass.name;
        EXPECT_NE(std::find(debugging.labels.begin(), debugging.labels.end(), pass.name),
                  debugging.labels.end())
            << pass.name;
    }
    debugging.labels.clear();
    (void)scene.record(scene.every(), frames, 0);
    ASSERT_FALSE(debugging.labels.empty());
    EXPECT_EQ(debugging.labels.front(), "nearfield");  // around all commands in the host's buffer
    EXPECT_EQ(debugging.open, 0);
    for (const auto& [object, call] : made) {
        EXPECT_TRUE(debugging.named.contains(object)) << call << " made an object without a name";
    }
    EXPECT_GT(made.size(), 100U);
}

// Makes the device fail as lost on request.

bool device_is_lost = false;

VkResult VKAPI_CALL submit_or_lose(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                   VkFence fence) {
    return device_is_lost ? VK_ERROR_DEVICE_LOST
                          : reinterpret_cast<PFN_vkQueueSubmit>(test_support::true_device_function(
                                "vkQueueSubmit"))(queue, count, infos, fence);
}

TEST_F(HostTable, Errors) {
    make_host();
    test_support::Lies lies;
    lies.entry_points["vkQueueSubmit"] = reinterpret_cast<PFN_vkVoidFunction>(&submit_or_lose);
    const test_support::FakeLoader loader(host(), lies);
    std::vector<std::string> said;
    HostDevice device = loader.host();
    device.log.user = &said;
    device.log.write = [](void* user, LogLevel level, const char* message) {
        if (level == LogLevel::error) {
            static_cast<std::vector<std::string>*>(user)->emplace_back(message);
        }
    };
    for (int life = 0; life < 2; ++life) {
        device_is_lost = false;
        Context context = make(device);
        const Scene scene(context);
        HostFrames frames(host(), 1);
        const std::vector<double> expected = scene.run(scene.small());
        const Expected<Ticket> recorded =
            context.record(scene.small(), {.commands = frames.begin(0), .frame = 0});
        frames.abandon(0);
        device_is_lost = true;
        Results results;
        for (int i = 0; i < 2; ++i) {
            EXPECT_EQ(context.run(scene.small(), results).code(), StatusCode::device_lost);
        }
        EXPECT_EQ(context.submit(scene.small()).error().code(), StatusCode::device_lost);
        EXPECT_EQ(
            context.record(scene.small(), {.commands = frames.begin(1), .frame = 1}).error().code(),
            StatusCode::device_lost);
        frames.abandon(1);
        ASSERT_TRUE(recorded.has_value());
        EXPECT_TRUE(context.is_ready(*recorded));
        EXPECT_EQ(context.collect(*recorded, results).code(), StatusCode::device_lost);
        EXPECT_EQ(context.collect(*recorded, results).code(), StatusCode::unknown_ticket);
        ASSERT_EQ(said.size(), 1U) << "once";
        EXPECT_NE(said[0].find("vkQueueSubmit"), std::string::npos) << said[0];
        said.clear();
    }
}

}  // namespace
}  // namespace nearfield::test
