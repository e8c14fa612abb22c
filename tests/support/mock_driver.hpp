#pragma once

#include <nearfield/host.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::test_support {

/// An entry point that the library fetches, as engine/gpu/functions.hpp lists them.
struct EntryPoint {
    std::string_view name;
    bool returns_result = false;  ///< a VkResult, so it can fail
    bool of_device = false;       ///< fetched through vkGetDeviceProcAddr
};
[[nodiscard]] const std::vector<EntryPoint>& entry_points();

/// A Vulkan driver with nothing below: handles are counters, memory is the host's, commands do
/// nothing and submissions are done at once, though the library may not know before it has asked.
/// Counts every object and says which rules of the specification about them were broken: unknown,
/// destroyed or foreign handles, memory and objects given back while a submission uses them,
/// buffers without memory, command buffers and fences in a wrong state. Can be told to fail. One at
/// a time: entry points carry no user data. For one thread.
class MockDriver {
public:
    /// What memory that is not mapped is full of: to the library each word says that edge 1 is
    /// nearest, and that the point or cell lies inside; as a number it is tiny.
    static constexpr std::uint32_t resident_word = 0xA0000001;
    /// What mapped memory is full of, and what submissions write there, unless they copy: the same
    /// of edge 2.
    static constexpr std::uint32_t device_word = 0xA0000002;

    MockDriver();
    ~MockDriver();
    MockDriver(const MockDriver&) = delete;
    MockDriver& operator=(const MockDriver&) = delete;

    /// A device of this driver, with debug utils, the feature logicOp and allocation callbacks that
    /// every call has to pass on.
    [[nodiscard]] HostDevice host() const;

    /// From now on there is no host whose allocation callbacks would be used.
    void go_without_host();

    // What a host does with the driver, without the library.

    /// A binary semaphore.
    [[nodiscard]] VkSemaphore make_semaphore(bool signalled);
    [[nodiscard]] bool is_signalled(VkSemaphore semaphore) const;
    /// What host() says of timeline semaphores from now on.
    void enable_timeline_semaphores(bool enabled = true);
    [[nodiscard]] VkSemaphore make_timeline_semaphore(std::uint64_t value);
    [[nodiscard]] std::uint64_t value_of(VkSemaphore semaphore) const;
    /// A command buffer that is being recorded.
    [[nodiscard]] VkCommandBuffer begin_commands();
    /// Ends it and submits it.
    void submit(VkCommandBuffer commands);
    /// Waits for all that the host submitted.
    void finish_submissions();

    /// The entry points called since the last forget_calls(), in order.
    [[nodiscard]] const std::vector<std::string_view>& calls() const;
    void forget_calls();

    /// What came with a vkQueueSubmit that succeeded.
    struct Submitted {
        struct Semaphore {
            VkSemaphore semaphore = VK_NULL_HANDLE;
            std::uint64_t value = 0;          ///< as handed over, if at all
            VkPipelineStageFlags stages = 0;  ///< that wait

            friend bool operator==(const Semaphore&, const Semaphore&) = default;
        };
        std::vector<Semaphore> waits;
        std::vector<Semaphore> signals;
        std::uint32_t command_buffers = 0;
    };
    [[nodiscard]] const std::vector<Submitted>& submissions() const;

    /// What shaders find from now on: where a descriptor at `binding` stands for words of which the
    /// host set the first to 0, that becomes `count`, and what follows 0.
    struct Finding {
        std::uint32_t binding = 0;
        std::uint32_t count = 0;
    };
    void let_shaders_find(const Finding& finding);

    /// How long an entry point fails.
    enum class Failing {
        once,
        from_then_on,  ///< until work_again()
    };
    /// From now on `call` succeeds so many times and then fails. A device that is lost stays so:
    /// whatever can say so does, work_again() or not.
    void fail(std::string_view call, std::size_t successes, VkResult result, Failing failing);
    void work_again();
    /// Makes an entry point unknown, until the next one is hidden; empty: none.
    void hide(std::string_view call);
    /// A fail() has come true.
    [[nodiscard]] bool has_failed() const;

    /// What the library made and did not destroy: the entry point that made it, for each object,
    /// and a line for each block of memory that the host's allocator did not get back. A mapping of
    /// memory goes with the memory.
    [[nodiscard]] std::vector<std::string> alive() const;
    /// Every rule that was broken, in words.
    [[nodiscard]] const std::vector<std::string>& breaches() const;
    /// Calls after the device was lost, but for those that destroy, free or wait.
    [[nodiscard]] const std::vector<std::string>& work_after_loss() const;

    struct State;

private:
    std::unique_ptr<State> state_;
};

}  // namespace nearfield::test_support
