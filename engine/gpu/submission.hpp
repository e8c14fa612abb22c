#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>

namespace nearfield::gpu {

/// A command buffer and the fence of its submission, used over and over.
class Submission {
public:
    explicit Submission(const Device& device);

    /// Starts recording anew. The former submission must have been waited for.
    VkCommandBuffer begin();
    /// Ends recording and submits.
    void submit();
    /// Whether the device has done the work, without waiting. True where that cannot be said:
    /// wait() then says why, and does not wait either.
    [[nodiscard]] bool is_done() const;
    /// Waits until the device has done the work.
    void wait();
    /// The same before all goes, whatever the driver says: returns where the work is done, where
    /// the device is lost, and where neither can be found out.
    void wait_to_the_end() noexcept;

private:
    const Device* device_;
    Owned<VkCommandPool> pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;  // owned by the pool
    Owned<VkFence> fence_;
};

}  // namespace nearfield::gpu
