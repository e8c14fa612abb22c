#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>

#include <cstdint>

namespace nearfield::gpu {

/// Tells when the device has finished a submission: by a fence, or by a timeline semaphore where
/// the host's queue takes no fence of the library's (HostDevice::completion_by_timeline).
class Completion {
public:
    /// Complete until begin() is called.
    explicit Completion(const Device& device);

    /// Prepares the next submission, which has to carry the fence, if there is one, or signal the
    /// semaphore with the value.
    void begin();
    [[nodiscard]] VkFence fence() const { return fence_.get(); }
    [[nodiscard]] VkSemaphore semaphore() const { return semaphore_.get(); }
    [[nodiscard]] std::uint64_t value() const { return value_; }

    /// VK_SUCCESS when the device has finished the work, VK_NOT_READY before, or an error.
    [[nodiscard]] VkResult status() const;
    /// Waits, and returns as vkWaitForFences does.
    [[nodiscard]] VkResult wait() const;
    /// The entry point that wait() calls.
    [[nodiscard]] const char* wait_call() const {
        return semaphore_ ? "vkWaitSemaphores" : "vkWaitForFences";
    }

private:
    const Device* device_;
    Owned<VkFence> fence_;
    Owned<VkSemaphore> semaphore_;
    std::uint64_t value_ = 0;
};

}  // namespace nearfield::gpu
