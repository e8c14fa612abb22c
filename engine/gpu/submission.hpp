#pragma once

#include <engine/gpu/completion.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>
#include <nearfield/submission.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::gpu {

/// Throws StatusException (invalid_submission) if a semaphore is null, a wait has no stage, or a
/// value is given for a timeline semaphore although the host did not declare the feature enabled.
void check_semaphores(const Device& device, const nearfield::Submission& order);

/// A reusable command buffer and the completion of its submission.
class Submission {
public:
    explicit Submission(const Device& device);

    /// Starts a new recording. The former submission must have been waited for. `again`: it may be
    /// submitted more than once.
    VkCommandBuffer begin(bool again = false);
    /// Ends recording and submits, with the semaphores of `order`.
    void submit(const nearfield::Submission& order = {});
    /// Submits the last recording, made for that, once more. The former submission must have been
    /// waited for.
    void submit_again();
    /// Submits only the semaphores of `order`, if there are any; then there is nothing to wait for.
    void submit_semaphores(const nearfield::Submission& order);
    /// Returns, without waiting, whether the device has finished the work. True if the status
    /// cannot be queried: wait() then reports the error and does not wait either.
    [[nodiscard]] bool is_done() const;
    /// Waits until the device has finished the work.
    void wait();
    /// The same before destruction, whatever the driver returns: ends when the work is done, the
    /// device is lost, or neither can be determined.
    void wait_to_the_end() noexcept;

private:
    /// Takes the semaphores of the next submission.
    void take(const nearfield::Submission& order);
    void send_commands(const nearfield::Submission& order);
    void send(std::uint32_t command_buffers, VkFence fence);

    const Device* device_;
    Owned<VkCommandPool> pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;  // owned by the pool
    Completion completion_;

    // Semaphores of the submission in progress, in Vulkan's form.
    std::vector<VkSemaphore> waits_;
    std::vector<VkPipelineStageFlags> wait_stages_;
    std::vector<std::uint64_t> wait_values_;
    std::vector<VkSemaphore> signals_;
    std::vector<std::uint64_t> signal_values_;
};

}  // namespace nearfield::gpu
