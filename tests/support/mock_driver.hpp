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
    /// What mapped memory is full of, and what submissions write: to the library each word says
    /// that edge 1 is nearest, and that the point or cell lies inside; as a number it is tiny.
    static constexpr std::uint32_t device_word = 0xA0000001;

    MockDriver();
    ~MockDriver();
    MockDriver(const MockDriver&) = delete;
    MockDriver& operator=(const MockDriver&) = delete;

    /// A device of this driver, with debug utils and the feature logicOp.
    [[nodiscard]] HostDevice host() const;

    /// The entry points called since the last forget_calls(), in order.
    [[nodiscard]] const std::vector<std::string_view>& calls() const;
    void forget_calls();

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

    /// What was made and not destroyed: the entry point that made it, for each object. A mapping of
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
