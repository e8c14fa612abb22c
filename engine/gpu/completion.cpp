#include <engine/gpu/completion.hpp>

namespace nearfield::gpu {
namespace {

Owned<VkSemaphore> make_timeline_semaphore(const Device& device) {
    VkSemaphoreTypeCreateInfo type{};
    type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    info.pNext = &type;
    return make_object(device, info, "a submission", "nearfield completion");
}

/// Signalled, so that waiting before the first submission returns at once.
Owned<VkFence> make_fence(const Device& device) {
    VkFenceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    info.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    return make_object(device, info, "a submission", "nearfield fence");
}

}  // namespace

Completion::Completion(const Device& device) : device_(&device) {
    if (device.completion_by_timeline()) {
        semaphore_ = make_timeline_semaphore(device);
    } else {
        fence_ = make_fence(device);
    }
}

void Completion::begin() {
    if (semaphore_) {
        ++value_;
        return;
    }
    const VkFence fence = fence_.get();
    check(device_->functions().vkResetFences(device_->handle(), 1, &fence), "vkResetFences",
          "a submission");
}

VkResult Completion::status() const {
    if (!semaphore_) {
        return device_->functions().vkGetFenceStatus(device_->handle(), fence_.get());
    }
    std::uint64_t reached = 0;
    const VkResult result = device_->functions().vkGetSemaphoreCounterValue(
        device_->handle(), semaphore_.get(), &reached);
    return result == VK_SUCCESS && reached < value_ ? VK_NOT_READY : result;
}

VkResult Completion::wait() const {
    if (!semaphore_) {
        const VkFence fence = fence_.get();
        return device_->functions().vkWaitForFences(device_->handle(), 1, &fence, VK_TRUE,
                                                    UINT64_MAX);
    }
    const VkSemaphore semaphore = semaphore_.get();
    VkSemaphoreWaitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
    info.semaphoreCount = 1;
    info.pSemaphores = &semaphore;
    info.pValues = &value_;
    return device_->functions().vkWaitSemaphores(device_->handle(), &info, UINT64_MAX);
}

}  // namespace nearfield::gpu
