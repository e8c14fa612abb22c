#pragma once

#include <nearfield/vulkan.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#define NEARFIELD_HOST_FUNCTIONS(X)  \
    X(vkAllocateCommandBuffers)      \
    X(vkAllocateDescriptorSets)      \
    X(vkAllocateMemory)              \
    X(vkBeginCommandBuffer)          \
    X(vkBindBufferMemory)            \
    X(vkBindImageMemory)             \
    X(vkCmdBeginRenderPass)          \
    X(vkCmdBindDescriptorSets)       \
    X(vkCmdBindPipeline)             \
    X(vkCmdBindVertexBuffers)        \
    X(vkCmdClearColorImage)          \
    X(vkCmdCopyBuffer)               \
    X(vkCmdCopyImageToBuffer)        \
    X(vkCmdDraw)                     \
    X(vkCmdDrawIndirect)             \
    X(vkCmdEndRenderPass)            \
    X(vkCmdFillBuffer)               \
    X(vkCmdPipelineBarrier)          \
    X(vkCmdPushConstants)            \
    X(vkCreateBuffer)                \
    X(vkCreateCommandPool)           \
    X(vkCreateDescriptorPool)        \
    X(vkCreateDescriptorSetLayout)   \
    X(vkCreateFence)                 \
    X(vkCreateFramebuffer)           \
    X(vkCreateGraphicsPipelines)     \
    X(vkCreateImage)                 \
    X(vkCreateImageView)             \
    X(vkCreatePipelineLayout)        \
    X(vkCreateRenderPass)            \
    X(vkCreateSampler)               \
    X(vkCreateSemaphore)             \
    X(vkCreateShaderModule)          \
    X(vkDestroyBuffer)               \
    X(vkDestroyCommandPool)          \
    X(vkDestroyDescriptorPool)       \
    X(vkDestroyDescriptorSetLayout)  \
    X(vkDestroyFence)                \
    X(vkDestroyFramebuffer)          \
    X(vkDestroyImage)                \
    X(vkDestroyImageView)            \
    X(vkDestroyPipeline)             \
    X(vkDestroyPipelineLayout)       \
    X(vkDestroyRenderPass)           \
    X(vkDestroySampler)              \
    X(vkDestroySemaphore)            \
    X(vkDestroyShaderModule)         \
    X(vkEndCommandBuffer)            \
    X(vkFreeMemory)                  \
    X(vkGetBufferMemoryRequirements) \
    X(vkGetImageMemoryRequirements)  \
    X(vkMapMemory)                   \
    X(vkQueueSubmit)                 \
    X(vkResetFences)                 \
    X(vkUpdateDescriptorSets)        \
    X(vkWaitForFences)

namespace nearfield::test_support {

/// The host's side of its device, as far as tests draw and read back: entry points, one command
/// buffer, objects that live until the end. Throws std::runtime_error if a call fails.
class HostGpu {
public:
    explicit HostGpu(const HostDevice& host);
    ~HostGpu();
    HostGpu(const HostGpu&) = delete;
    HostGpu& operator=(const HostGpu&) = delete;

    struct Buffer {
        VkBuffer buffer = VK_NULL_HANDLE;
        const std::byte* data = nullptr;
    };
    struct Image {
        VkImage image = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
    };
    /// A mapped buffer, for copies from the device if nothing else is said.
    [[nodiscard]] Buffer make_buffer(std::uint64_t bytes,
                                     VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    /// The view is of the last level and layer.
    [[nodiscard]] Image make_image(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage,
                                   std::uint32_t levels = 1, std::uint32_t layers = 1);
    /// Registers a destruction for the end of the lifetime; they run in reverse order.
    void at_end(std::function<void()> destroy) { at_end_.push_back(std::move(destroy)); }

    /// A binary semaphore.
    [[nodiscard]] VkSemaphore make_semaphore();

    /// The next submission waits for this semaphore in all stages, or signals it.
    void wait_for(VkSemaphore semaphore) { wait_ = semaphore; }
    void signal(VkSemaphore semaphore) { signal_ = semaphore; }
    /// Records and submits to the host's queue; finish() waits for it. One at a time.
    void submit(const std::function<void(VkCommandBuffer)>& record);
    void finish();

    /// The contents of a resident image or buffer: copies it in the queue, with the barriers that a
    /// host needs for a use other than the declared one.
    [[nodiscard]] std::vector<std::uint32_t> read(const ImageOnDevice& image, VkExtent2D extent,
                                                  const OutputState& state);
    [[nodiscard]] std::vector<std::uint32_t> read(VkBuffer buffer, VkDeviceSize offset,
                                                  VkDeviceSize size, const OutputState& state);

    [[nodiscard]] VkDevice device() const { return host_.device; }

#define NEARFIELD_HOST_MEMBER(name) PFN_##name name = nullptr;
    NEARFIELD_HOST_FUNCTIONS(NEARFIELD_HOST_MEMBER)
#undef NEARFIELD_HOST_MEMBER

private:
    [[nodiscard]] VkDeviceMemory allocate(const VkMemoryRequirements& needs,
                                          VkMemoryPropertyFlags properties);

    HostDevice host_;
    VkPhysicalDeviceMemoryProperties memory_{};
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    VkSemaphore wait_ = VK_NULL_HANDLE;    // of the next submission, if any
    VkSemaphore signal_ = VK_NULL_HANDLE;  // the same
    std::vector<std::function<void()>> at_end_;
};

/// Throws std::runtime_error with the name of the call unless the result is a success.
void require(VkResult result, const char* call);

}  // namespace nearfield::test_support
