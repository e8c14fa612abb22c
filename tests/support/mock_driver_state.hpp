#pragma once

#include <tests/support/mock_driver.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <typeinfo>
#include <vector>

namespace nearfield::test_support {

/// A Vulkan handle of any type; the driver numbers them.
using Number = std::uint64_t;

template <class Handle>
[[nodiscard]] Number number(Handle handle) {
    return reinterpret_cast<Number>(handle);
}
template <class Handle>
[[nodiscard]] Handle handle(Number number) {
    return reinterpret_cast<Handle>(number);
}

/// A type of Vulkan handle: a pointer to an incomplete type.
template <class Type>
concept VulkanHandle = std::is_pointer_v<Type> && !std::is_void_v<std::remove_pointer_t<Type>> &&
                       !std::is_function_v<std::remove_pointer_t<Type>> && !requires {
    sizeof(std::remove_pointer_t<Type>);
};

/// A pending vkCmdFillBuffer, or a region of vkCmdCopyBuffer.
struct MockWrite {
    Number buffer = 0;
    std::uint64_t first_word = 0;
    std::uint64_t words = 0;
    std::uint32_t value = 0;  // fill value
    Number from = 0;          // source buffer of a copy; 0: a fill
    std::uint64_t first_word_from = 0;
};

/// The part of a buffer that a descriptor refers to.
struct MockRange {
    std::uint64_t first_word = 0;
    std::uint64_t words = 0;
};

/// An object created by the library or the host.
struct MockObject {
    std::string_view made_by;               // entry point
    const std::type_info* type = nullptr;   // of its handle
    Number parent = 0;                      // device or pool
    std::map<std::uint64_t, Number> needs;  // objects it refers to, by binding or index

    // For memory, and buffers bound to it.
    std::uint64_t bytes = 0;
    std::uint64_t offset = 0;  // of a bound object in its memory
    std::uint32_t memory_type = 0;
    std::vector<std::byte> content;  // if mapped
    std::span<std::uint32_t> words;  // the same, aligned
    bool mapped = false;
    bool bound = false;
    bool written = false;      // a buffer that commands write
    bool copied_from = false;  // a buffer that commands may copy from

    // For command buffers.
    enum class Commands { empty, recording, executable, pending };
    Commands commands = Commands::empty;
    std::vector<MockWrite> writes;

    std::map<std::uint64_t, MockRange> ranges;  // for a descriptor set, by binding

    void* host_memory = nullptr;  // from the host's allocation callbacks

    // For fences and semaphores; for a fence also the objects used by the submission that will
    // signal it, as long as the library has not seen it complete.
    bool signalled = false;
    std::set<Number> in_use;
    std::optional<std::uint64_t> value;  // for a timeline semaphore
};

struct MockDriver::State {
    std::map<Number, MockObject> objects;
    Number last = 0x1000;
    std::vector<std::string_view> calls;
    std::vector<std::string> breaches;
    std::vector<std::string> work_after_loss;
    std::string hidden;

    std::string failing;  // entry point; empty: none
    std::size_t successes_left = 0;
    VkResult error = VK_SUCCESS;
    Failing how = Failing::once;
    bool has_failed = false;
    bool lost = false;

    Number instance = 0;
    Number physical_device = 0;
    Number device = 0;
    Number queue = 0;
    Number host_fence = 0;             // for all submissions of the host
    bool timeline_semaphores = false;  // the host enabled them
    std::vector<VkQueueFlags> families{VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT};
    std::uint32_t family = 0;  // the host's
    VkPhysicalDeviceType device_type = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    std::uint32_t storage_range = 1U << 30U;
    std::size_t shared_objects = 0;  // buffers and images of several families
    bool headless = false;           // there is no host whose allocator would be used
    std::vector<Submitted> submissions;
    std::optional<Finding> finding;

    VkAllocationCallbacks callbacks{};                 // the host's
    std::set<void*> host_blocks;                       // allocated through them
    const VkAllocationCallbacks* allocator = nullptr;  // of the current call

    /// Records a call; returns the error with which it must fail, or VK_SUCCESS.
    VkResult enter(std::string_view call);
    void breach(std::string_view call, const std::string& what);

    /// A breach if the host's queue family does not draw.
    void expect_drawing(std::string_view call);
    /// A breach if a buffer or image is shared by families that cannot be.
    void expect_families(std::string_view call, VkSharingMode mode,
                         std::span<const std::uint32_t> shared_by);
    /// The allocation callbacks of a call must be the host's.
    void use_allocator(std::string_view call, const VkAllocationCallbacks* used);

    template <class Handle>
    Handle make(std::string_view call, Number parent) {
        make(call, parent, typeid(Handle));
        return handle<Handle>(last);
    }
    void make(std::string_view call, Number parent, const std::type_info& type);
    /// The object of a handle; a breach, and null, if there is none of that type.
    template <class Handle>
    MockObject* find(std::string_view call, Handle wanted) {
        return find(call, number(wanted), typeid(Handle));
    }
    MockObject* find(std::string_view call, Number wanted, const std::type_info& type);
    /// Removes an object and everything allocated from it.
    template <class Handle>
    void destroy(std::string_view call, Number device_of_call, Handle gone) {
        destroy(call, device_of_call, number(gone), typeid(Handle));
    }
    void destroy(std::string_view call, Number device_of_call, Number gone,
                 const std::type_info& type);
    /// A breach for each object that was created from this one and still exists.
    void expect_childless(std::string_view call, Number parent);
    /// A breach if a submission that the library has not seen complete uses the object.
    void expect_unused(std::string_view call, Number wanted);
    /// Adds an object and everything it refers to.
    void add_needs(Number wanted, std::set<Number>& all) const;
    void finish(MockObject& fence);
    /// Moves a command buffer from one state to another; a breach if it is in neither.
    void change(std::string_view call, Number commands, MockObject::Commands from,
                MockObject::Commands to);
    /// Executes a command buffer, whose only effects are its writes to mapped memory; adds the
    /// objects that it uses to `used`.
    void execute(std::string_view call, Number commands, std::set<Number>& used);
    void write_results(Number commands, const std::set<Number>& used);
    /// Writes the counts that shaders are to find.
    void write_counts(const std::set<Number>& used);
    void write(const MockWrite& write);
    /// The words of a buffer's memory, mapped or not; empty if it has no memory.
    std::span<std::uint32_t> words_of(Number buffer);
};

/// The state of the current driver.
extern MockDriver::State* mock_driver;

/// The entry point with that name, with all checks of the driver; null if there is none.
[[nodiscard]] PFN_vkVoidFunction VKAPI_CALL mock_instance_function(VkInstance, const char* name);

}  // namespace nearfield::test_support
