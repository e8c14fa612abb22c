#include <engine/gpu/submission.hpp>

#include <cstdint>
#include <thread>

namespace nearfield::gpu {

Submission::Submission(const Device& device) : device_(&device) {
    const Functions& functions = device.functions();
    VkCommandPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool_info.queueFamilyIndex = device.queue_family();
    VkCommandPool pool = VK_NULL_HANDLE;
    check(functions.vkCreateCommandPool(device.handle(), &pool_info, nullptr, &pool),
          "vkCreateCommandPool", "a submission");
    pool_ = Owned<VkCommandPool>(device, pool);

    VkCommandBufferAllocateInfo commands_info{};
    commands_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    commands_info.commandPool = pool;
    commands_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commands_info.commandBufferCount = 1;
    check(functions.vkAllocateCommandBuffers(device.handle(), &commands_info, &commands_),
          "vkAllocateCommandBuffers", "a submission");

    // Signalled, so that waiting before the first submission returns at once.
    VkFenceCreateInfo fence_info{};
    fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    fence_info.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    VkFence fence = VK_NULL_HANDLE;
    check(functions.vkCreateFence(device.handle(), &fence_info, nullptr, &fence), "vkCreateFence",
          "a submission");
    fence_ = Owned<VkFence>(device, fence);
}

VkCommandBuffer Submission::begin() {
    const Functions& functions = device_->functions();
    check(functions.vkResetCommandPool(device_->handle(), pool_.get(), 0), "vkResetCommandPool",
          "a submission");
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(functions.vkBeginCommandBuffer(commands_, &info), "vkBeginCommandBuffer", "a submission");
    return commands_;
}

void Submission::submit() {
    const Functions& functions = device_->functions();
    check(functions.vkEndCommandBuffer(commands_), "vkEndCommandBuffer", "a submission");
    const VkFence fence = fence_.get();
    check(functions.vkResetFences(device_->handle(), 1, &fence), "vkResetFences", "a submission");
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    check(functions.vkQueueSubmit(device_->queue(), 1, &info, fence), "vkQueueSubmit",
          "a submission");
}

bool Submission::is_done() const {
    return device_->functions().vkGetFenceStatus(device_->handle(), fence_.get()) != VK_NOT_READY;
}

void Submission::wait() {
    const VkFence fence = fence_.get();
    check(device_->functions().vkWaitForFences(device_->handle(), 1, &fence, VK_TRUE, UINT64_MAX),
          "vkWaitForFences", "a submission");
}

void Submission::wait_to_the_end() noexcept {
    const Functions& functions = device_->functions();
    const VkFence fence = fence_.get();
    const auto out_of_memory = [](VkResult result) {
        return result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
    };
    // A driver without the memory to wait may have enough to be asked. One that has neither for so
    // long will not have it later.
    constexpr int most_refusals = 1000;
    int refusals = 0;
    while (refusals < most_refusals && out_of_memory(functions.vkWaitForFences(
                                           device_->handle(), 1, &fence, VK_TRUE, UINT64_MAX))) {
        const VkResult status = functions.vkGetFenceStatus(device_->handle(), fence);
        if (out_of_memory(status)) {
            ++refusals;
        } else if (status != VK_NOT_READY) {
            return;
        }
        std::this_thread::yield();
    }
}

}  // namespace nearfield::gpu
