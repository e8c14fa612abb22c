#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <nearfield/submission.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::gpu {

/// Throws Failure (invalid_submission) where a semaphore is null, no stage waits, or a value is
/// given of a timeline semaphore that the host did not say it enabled.
void check_semaphores(const Device& device, const nearfield::Submission& order);

/// A command buffer and the fence of its submission, used over and over.
class Submission {
public:
    explicit Submission(const Device& device);

    /// Starts recording anew. The former submission must have been waited for.
    VkCommandBuffer begin();
    /// Ends recording and submits, with the semaphores of `order`.
    void submit(const nearfield::Submission& order = {});
    /// Submits nothing but the semaphores of `order`, where there are any; there is nothing to wait
    /// for then.
    void submit_semaphores(const nearfield::Submission& order);
    /// Whether the device has done the work, without waiting. True where that cannot be said:
    /// wait() then says why, and does not wait either.
    [[nodiscard]] bool is_done() const;
    /// Waits until the device has done the work.
    void wait();
    /// The same before all goes, whatever the driver says: returns where the work is done, where
    /// the device is lost, and where neither can be found out.
    void wait_to_the_end() noexcept;

private:
    void send(const nearfield::Submission& order, std::uint32_t command_buffers, VkFence fence);

    const Device* device_;
    Owned<VkCommandPool> pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;  // owned by the pool
    Owned<VkFence> fence_;

    // Of the submission that is being made, as Vulkan wants them.
    std::vector<VkSemaphore> waits_;
    std::vector<VkPipelineStageFlags> wait_stages_;
    std::vector<std::uint64_t> wait_values_;
    std::vector<VkSemaphore> signals_;
    std::vector<std::uint64_t> signal_values_;
};

}  // namespace nearfield::gpu
