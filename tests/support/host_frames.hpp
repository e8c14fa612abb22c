#pragma once

#include <nearfield/host.hpp>

#include <cstdint>
#include <vector>

namespace nearfield::test_support {

/// An entry point of the host's device, as the host itself would call it.
template <class Function>
[[nodiscard]] Function host_function(const HostDevice& host, const char* name) {
    return reinterpret_cast<Function>(host.get_instance_proc_addr(host.instance, name));
}

/// The frames of a host: a command buffer and a fence each, which take turns. Frame number n uses
/// the ones of frame n - count again. Throws std::runtime_error where Vulkan fails.
class HostFrames {
public:
    HostFrames(const HostDevice& host, std::uint32_t count);
    /// Waits for what is in flight.
    ~HostFrames();
    HostFrames(const HostFrames&) = delete;
    HostFrames& operator=(const HostFrames&) = delete;

    /// Waits for the frame that used the same command buffer, and begins it anew.
    VkCommandBuffer begin(std::uint64_t frame);
    /// Ends and submits it.
    void submit(std::uint64_t frame);
    /// Ends it and leaves it at that.
    void abandon(std::uint64_t frame);
    void wait(std::uint64_t frame);

private:
    struct Frame {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence fence = VK_NULL_HANDLE;
    };
    [[nodiscard]] Frame& at(std::uint64_t frame) { return frames_[frame % frames_.size()]; }

    HostDevice host_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    std::vector<Frame> frames_;
};

}  // namespace nearfield::test_support
