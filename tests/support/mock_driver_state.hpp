#pragma once

#include <tests/support/mock_driver.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <typeinfo>
#include <vector>

namespace nearfield::test_support {

/// A Vulkan handle whatever its type; the driver counts them up.
using Number = std::uint64_t;

template <class Handle>
[[nodiscard]] Number number(Handle handle) {
    return reinterpret_cast<Number>(handle);
}
template <class Handle>
[[nodiscard]] Handle handle(Number number) {
    return reinterpret_cast<Handle>(number);
}

/// A type of Vulkan handle: a pointer to something that has no definition.
template <class Type>
concept VulkanHandle = std::is_pointer_v<Type> && !std::is_void_v<std::remove_pointer_t<Type>> &&
                       !std::is_function_v<std::remove_pointer_t<Type>> && !requires {
    sizeof(std::remove_pointer_t<Type>);
};

/// Anything the library made.
struct MockObject {
    std::string_view made_by;               // entry point
    const std::type_info* type = nullptr;   // of its handle
    Number parent = 0;                      // device or pool
    std::map<std::uint64_t, Number> needs;  // what it refers to, by binding or place

    // Memory, and buffers bound to some.
    std::uint64_t bytes = 0;
    std::uint32_t memory_type = 0;
    std::vector<std::byte> content;  // where it is mapped
    std::span<std::uint32_t> words;  // the same, aligned
    bool mapped = false;
    bool bound = false;
    bool written = false;  // a buffer that commands write

    // Command buffers.
    enum class Commands { empty, recording, executable, pending };
    Commands commands = Commands::empty;

    // Fences: what the submission that is to signal it uses; the library has not seen it done.
    bool signalled = false;
    std::set<Number> in_use;
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

    /// Notes a call; returns the error it is to fail with, or VK_SUCCESS.
    VkResult enter(std::string_view call);
    void breach(std::string_view call, const std::string& what);

    template <class Handle>
    Handle make(std::string_view call, Number parent) {
        MockObject& object = objects[++last];
        object.made_by = call;
        object.type = &typeid(Handle);
        object.parent = parent;
        return handle<Handle>(last);
    }
    /// The object of a handle; a breach, and null, where there is none of that type.
    template <class Handle>
    MockObject* find(std::string_view call, Handle wanted) {
        return find(call, number(wanted), typeid(Handle));
    }
    MockObject* find(std::string_view call, Number wanted, const std::type_info& type);
    /// Takes an object away, with all that is allocated from it.
    template <class Handle>
    void destroy(std::string_view call, Number device_of_call, Handle gone) {
        destroy(call, device_of_call, number(gone), typeid(Handle));
    }
    void destroy(std::string_view call, Number device_of_call, Number gone,
                 const std::type_info& type);
    /// A breach where a submission that the library has not seen done uses the object.
    void expect_unused(std::string_view call, Number wanted);
    /// Everything an object refers to, itself too.
    void add_needs(Number wanted, std::set<Number>& all) const;
    void finish(MockObject& fence);
};

/// Of the driver that lives.
extern MockDriver::State* mock_driver;

/// The entry point of that name, with all that a driver does when it is called; null for one that
/// is not there.
[[nodiscard]] PFN_vkVoidFunction VKAPI_CALL mock_instance_function(VkInstance, const char* name);

}  // namespace nearfield::test_support
