#pragma once

#include <nearfield/host.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::test_support {

/// An entry point of the host's device, as the host itself would call it.
template <class Function>
[[nodiscard]] Function host_function(const HostDevice& host, const char* name) {
    return reinterpret_cast<Function>(host.get_instance_proc_addr(host.instance, name));
}

/// The frames of a host: command buffers with fences, used in turn. Frame number n reuses those of
/// frame n - count. Throws std::runtime_error if Vulkan fails.
class HostFrames {
public:
    HostFrames(const HostDevice& host, std::uint32_t count);
    /// Waits for the frames in flight.
    ~HostFrames();
    HostFrames(const HostFrames&) = delete;
    HostFrames& operator=(const HostFrames&) = delete;

    /// Waits for the frame that used the same command buffer, then begins recording.
    VkCommandBuffer begin(std::uint64_t frame);
    /// Ends the command buffer and submits it.
    void submit(std::uint64_t frame);
    /// Ends the command buffer without submitting it.
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

/// Command buffers of a host that it submits as often as it likes. Throws as HostFrames does.
class KeptCommands {
public:
    explicit KeptCommands(const HostDevice& host);
    ~KeptCommands();
    KeptCommands(const KeptCommands&) = delete;
    KeptCommands& operator=(const KeptCommands&) = delete;

    /// A new one, which begins recording. Secondary ones are outside a render pass.
    [[nodiscard]] VkCommandBuffer begin(
        VkCommandBufferLevel level = VK_COMMAND_BUFFER_LEVEL_PRIMARY) const;
    void end(VkCommandBuffer commands) const;
    void execute(VkCommandBuffer primary, VkCommandBuffer secondary) const;
    /// Submits these, the same one any number of times, in one call, and waits for them.
    void run(std::span<const VkCommandBuffer> commands) const;

private:
    HostDevice host_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
};

/// A secondary command buffer of a host, outside a render pass. Throws as HostFrames does.
class SecondaryCommands {
public:
    explicit SecondaryCommands(const HostDevice& host);
    ~SecondaryCommands();
    SecondaryCommands(const SecondaryCommands&) = delete;
    SecondaryCommands& operator=(const SecondaryCommands&) = delete;

    /// Begins recording.
    [[nodiscard]] VkCommandBuffer begin() const;
    /// Ends recording and executes it in a primary command buffer.
    void execute_in(VkCommandBuffer primary) const;

private:
    HostDevice host_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

}  // namespace nearfield::test_support
