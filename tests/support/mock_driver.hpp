#pragma once

#include <nearfield/host.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::test_support {

/// An entry point that the library fetches, as listed in engine/gpu/functions.hpp.
struct EntryPoint {
    std::string_view name;
    bool returns_result = false;  ///< a VkResult, so it can fail
    bool of_device = false;       ///< fetched through vkGetDeviceProcAddr
};
[[nodiscard]] const std::vector<EntryPoint>& entry_points();

/// A Vulkan driver without a device: handles are counters, memory is the host's, commands do
/// nothing and submissions complete at once, although the library cannot know before it asks. It
/// tracks every object and reports violations of the specification: unknown, destroyed or foreign
/// handles, memory and objects freed while a submission uses them, buffers without memory, command
/// buffers and fences in a wrong state. It fails on request. One at a time, because entry points
/// carry no user data; for one thread.
class MockDriver {
public:
    /// The initial contents of device-local memory: to the library each word means that edge 1 is
    /// nearest and that the point or cell is inside; as a number it is tiny.
    static constexpr std::uint32_t resident_word = 0xA0000001;
    /// The initial contents of mapped memory, and the value that submissions write there unless
    /// they copy: the same for edge 2.
    static constexpr std::uint32_t device_word = 0xA0000002;

    MockDriver();
    ~MockDriver();
    MockDriver(const MockDriver&) = delete;
    MockDriver& operator=(const MockDriver&) = delete;

    /// A device of this driver, with debug utils, the feature logicOp and allocation callbacks that
    /// every call must pass on.
    [[nodiscard]] HostDevice host() const;

    /// From now on there is no host whose allocation callbacks must be used.
    void go_without_host();

    /// Sets the queue families of the device, by what they can do, and the one of the host's queue.
    /// Default: one that draws and computes.
    void set_queue_families(std::vector<VkQueueFlags> families, std::uint32_t used);
    /// Sets VkPhysicalDeviceProperties::deviceType. Default: a GPU of its own.
    void set_device_type(VkPhysicalDeviceType type);
    /// Sets VkPhysicalDeviceLimits::maxStorageBufferRange.
    void set_storage_range(std::uint32_t bytes);
    /// The number of buffers and images so far that were made for several queue families.
    [[nodiscard]] std::size_t shared_objects() const;

    // Driver calls that a host makes without the library.

    /// A binary semaphore.
    [[nodiscard]] VkSemaphore make_semaphore(bool signalled);
    [[nodiscard]] bool is_signalled(VkSemaphore semaphore) const;
    /// An image of the host, with memory.
    [[nodiscard]] VkImage make_image();
    /// A view of the host's of such an image.
    [[nodiscard]] VkImageView make_view(VkImage image);
    /// `bytes`: that copies may write.
    [[nodiscard]] VkBuffer make_buffer(std::uint64_t bytes = 0);
    /// Sets the timeline semaphore support that host() reports.
    void enable_timeline_semaphores(bool enabled = true);
    [[nodiscard]] VkSemaphore make_timeline_semaphore(std::uint64_t value);
    [[nodiscard]] std::uint64_t value_of(VkSemaphore semaphore) const;
    /// Whether a host may use this part of a buffer: both exist, and the memory behind them.
    [[nodiscard]] bool has_memory(VkBuffer buffer, std::uint64_t offset, std::uint64_t bytes) const;
    /// The same of an image, of which `view` is a view.
    [[nodiscard]] bool has_memory(VkImage image, VkImageView view) const;
    /// A command buffer in the recording state.
    [[nodiscard]] VkCommandBuffer begin_commands();
    /// Ends and submits the command buffer.
    void submit(VkCommandBuffer commands);
    /// Waits for all submissions of the host.
    void finish_submissions();

    /// The entry points called since the last forget_calls(), in order.
    [[nodiscard]] const std::vector<std::string_view>& calls() const;
    void forget_calls();

    /// The semaphores of a successful vkQueueSubmit.
    struct Submitted {
        struct Semaphore {
            VkSemaphore semaphore = VK_NULL_HANDLE;
            std::uint64_t value = 0;          ///< as submitted, if at all
            VkPipelineStageFlags stages = 0;  ///< that wait

            friend bool operator==(const Semaphore&, const Semaphore&) = default;
        };
        std::vector<Semaphore> waits;
        std::vector<Semaphore> signals;
        std::uint32_t command_buffers = 0;
    };
    [[nodiscard]] const std::vector<Submitted>& submissions() const;

    /// The simulated results of shaders: if a descriptor at `binding` refers to words of which the
    /// host set the first to 0, the one at `word` becomes `count`, and the others become 0.
    struct Finding {
        std::uint32_t binding = 0;
        std::uint32_t count = 0;
        std::uint32_t word = 0;
        bool is_divided = false;  ///< `count`, among all such descriptors of a submission
    };
    void let_shaders_find(const Finding& finding);

    /// How long an entry point fails.
    enum class Failing {
        once,
        twice,         ///< a block of memory, and the smaller one that would do
        from_then_on,  ///< until work_again()
    };
    /// From now on `call` succeeds a number of times and then fails. A lost device stays lost:
    /// every call that can report it does so, even after work_again().
    void fail(std::string_view call, std::size_t successes, VkResult result, Failing failing);
    void work_again();
    /// Makes an entry point unavailable until the next one is hidden; empty: none.
    void hide(std::string_view call);
    /// True if a failure requested by fail() has occurred.
    [[nodiscard]] bool has_failed() const;

    /// The objects that the library created and did not destroy: for each object the entry point
    /// that created it, and a line for each block of memory not returned to the host's allocator. A
    /// mapping of memory ends with the memory.
    [[nodiscard]] std::vector<std::string> alive() const;
    /// All violations of rules, as text.
    [[nodiscard]] const std::vector<std::string>& breaches() const;
    /// Calls after the device was lost, except those that destroy, free or wait.
    [[nodiscard]] const std::vector<std::string>& work_after_loss() const;

    struct State;

private:
    [[nodiscard]] bool has_memory(std::uint64_t object) const;

    std::unique_ptr<State> state_;
};

}  // namespace nearfield::test_support
