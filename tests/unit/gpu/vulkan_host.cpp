#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/submission.hpp>

#include <gtest/gtest.h>
#include <tests/support/environment.hpp>
#include <tests/support/vulkan_host.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace nearfield {
namespace {

using test_support::VulkanHost;

// Tests rely on a silent layer; these show that it reports errors.

bool mention(const std::vector<std::string>& messages, const std::string& text) {
    return std::any_of(messages.begin(), messages.end(), [&text](const std::string& message) {
        return message.find(text) != std::string::npos;
    });
}

TEST(GpuVulkanHost, HearsInvalidUse) {
    VulkanHost host;
    const gpu::Device device(host.device());
    EXPECT_TRUE(host.messages().empty());
    VkFenceCreateInfo wrong{};
    VkFence fence = VK_NULL_HANDLE;
    (void)device.functions().vkCreateFence(device.handle(), &wrong, nullptr, &fence);
    device.functions().vkDestroyFence(device.handle(), fence, nullptr);
    EXPECT_TRUE(mention(host.messages(), "VUID-VkFenceCreateInfo-sType-sType"));
    host.clear_messages();
    EXPECT_TRUE(host.close().empty());
}

TEST(GpuVulkanHost, HearsOfObjectsLeftBehind) {
    VulkanHost host;
    {
        const gpu::Device device(host.device());
        VkFenceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        VkFence fence = VK_NULL_HANDLE;
        (void)device.functions().vkCreateFence(device.handle(), &info, nullptr, &fence);
        device.name_object(VK_OBJECT_TYPE_FENCE, fence, "the forgotten fence");
    }
    EXPECT_TRUE(host.messages().empty());
    EXPECT_TRUE(mention(host.close(), "the forgotten fence"));
}

TEST(GpuVulkanHost, HearsOfMissingBarriers) {
    VulkanHost host;
    {
        const gpu::Device device(host.device());
        gpu::MappedBuffer buffer(
            device, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
            gpu::Direction::readback, "both source and target");
        buffer.reserve(1000);
        gpu::Submission submission(device);
        VkCommandBuffer commands = submission.begin();
        // The second copy reads what the first one writes.
        for (const VkDeviceSize from : {0U, 200U}) {
            const VkBufferCopy copy{from, from + 200, 200};
            device.functions().vkCmdCopyBuffer(commands, buffer.handle(), buffer.handle(), 1,
                                               &copy);
        }
        submission.submit();
        submission.wait();
    }
    EXPECT_TRUE(mention(host.close(), "SYNC-HAZARD-READ-AFTER-WRITE"));
}

TEST(GpuVulkanHost, ThrowsWhereThereIsNoDriver) {
    const test_support::OnlyDrivers none("/nonexistent.json");
    EXPECT_THROW(VulkanHost host, std::runtime_error);
}

}  // namespace
}  // namespace nearfield
