#pragma once

#include <engine/gpu/functions.hpp>

#include <tests/support/mock_driver_state.hpp>

#include <type_traits>

/// Defines the mock driver's entry points. Those in engine/gpu/functions.hpp are generated
/// (mock_entry_points.cpp): vkCreate and vkDestroy track objects and vkCmd refers to them,
/// according to their signatures. An entry point that does more, or has another name, has its own
/// overload of perform() in the file for its subject, and an entry in one of the lists below.

// mock_physical_device.cpp
#define NEARFIELD_MOCKED_PHYSICAL_DEVICE(X)     \
    X(vkGetPhysicalDeviceProperties)            \
    X(vkGetPhysicalDeviceMemoryProperties)      \
    X(vkGetPhysicalDeviceQueueFamilyProperties) \
    X(vkGetPhysicalDeviceFormatProperties)      \
    X(vkGetDeviceProcAddr)

// mock_memory.cpp
#define NEARFIELD_MOCKED_MEMORY(X)    \
    X(vkAllocateMemory)               \
    X(vkFreeMemory)                   \
    X(vkMapMemory)                    \
    X(vkFlushMappedMemoryRanges)      \
    X(vkInvalidateMappedMemoryRanges) \
    X(vkCreateBuffer)                 \
    X(vkCreateImage)                  \
    X(vkGetBufferMemoryRequirements)  \
    X(vkGetImageMemoryRequirements)   \
    X(vkBindBufferMemory)             \
    X(vkBindImageMemory)              \
    X(vkCreateBufferView)             \
    X(vkCreateImageView)              \
    X(vkCreateFramebuffer)

// mock_pipelines.cpp
#define NEARFIELD_MOCKED_PIPELINES(X) \
    X(vkCreateGraphicsPipelines)      \
    X(vkCreateComputePipelines)       \
    X(vkAllocateDescriptorSets)       \
    X(vkUpdateDescriptorSets)         \
    X(vkSetDebugUtilsObjectNameEXT)

// mock_commands.cpp
#define NEARFIELD_MOCKED_COMMANDS(X) \
    X(vkAllocateCommandBuffers)      \
    X(vkResetCommandPool)            \
    X(vkBeginCommandBuffer)          \
    X(vkEndCommandBuffer)            \
    X(vkCmdBeginRenderPass)          \
    X(vkCmdBindDescriptorSets)       \
    X(vkCmdBindVertexBuffers)        \
    X(vkCmdPipelineBarrier)          \
    X(vkCmdFillBuffer)               \
    X(vkCmdCopyBuffer)

// mock_submission.cpp
#define NEARFIELD_MOCKED_SUBMISSION(X) \
    X(vkCreateFence)                   \
    X(vkResetFences)                   \
    X(vkQueueSubmit)                   \
    X(vkWaitForFences)                 \
    X(vkGetFenceStatus)                \
    X(vkGetQueryPoolResults)

/// Additional functions for a headless context, of loader, instance and physical device
/// (mock_instance.cpp).
#define NEARFIELD_HEADLESS_FUNCTIONS(X)       \
    X(vkEnumerateInstanceExtensionProperties) \
    X(vkCreateInstance)                       \
    X(vkDestroyInstance)                      \
    X(vkEnumeratePhysicalDevices)             \
    X(vkCreateDevice)                         \
    X(vkGetDeviceQueue)                       \
    X(vkDestroyDevice)

namespace nearfield::test_support::mock {

#define NEARFIELD_TAG(function)                             \
    struct Tag_##function {                                 \
        static constexpr std::string_view name = #function; \
    };
NEARFIELD_INSTANCE_FUNCTIONS(NEARFIELD_TAG)
NEARFIELD_DEVICE_FUNCTIONS(NEARFIELD_TAG)
NEARFIELD_DEBUG_FUNCTIONS(NEARFIELD_TAG)
NEARFIELD_HEADLESS_FUNCTIONS(NEARFIELD_TAG)
#undef NEARFIELD_TAG

/// The type of perform() for an entry point: its own, with the tag in front.
template <class Tag, class Function>
struct Performing;
template <class Tag, class Result, class... Arguments>
struct Performing<Tag, Result(VKAPI_PTR*)(Arguments...)> {
    using Type = Result(Tag, Arguments...);
};
#define NEARFIELD_PERFORM(function) Performing<Tag_##function, PFN_##function>::Type perform;
NEARFIELD_MOCKED_PHYSICAL_DEVICE(NEARFIELD_PERFORM)
NEARFIELD_MOCKED_MEMORY(NEARFIELD_PERFORM)
NEARFIELD_MOCKED_PIPELINES(NEARFIELD_PERFORM)
NEARFIELD_MOCKED_COMMANDS(NEARFIELD_PERFORM)
NEARFIELD_MOCKED_SUBMISSION(NEARFIELD_PERFORM)
NEARFIELD_HEADLESS_FUNCTIONS(NEARFIELD_PERFORM)
#undef NEARFIELD_PERFORM

[[nodiscard]] inline MockDriver::State& driver() {
    return *mock_driver;
}

/// The memory types: device-local; visible to both and not coherent; host memory.
inline constexpr std::uint32_t memory_types = 3;
inline constexpr VkMemoryPropertyFlags memory_flags[memory_types]{
    VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
    VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
        VK_MEMORY_PROPERTY_HOST_CACHED_BIT,
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
};

inline constexpr VkDeviceSize non_coherent_atom = 64;

/// Object `index` among those that another refers to must exist and have memory.
template <class Handle>
void refer(std::string_view call, MockObject& from, std::uint64_t index, Handle to) {
    const MockObject* const object = driver().find(call, to);
    if (object == nullptr) {
        return;
    }
    if ((std::is_same_v<Handle, VkBuffer> || std::is_same_v<Handle, VkImage>)&&!object->bound) {
        driver().breach(call, "an object without memory");
    }
    from.needs[index] = number(to);
}

/// A command buffer in the recording state refers to every object that a command names.
template <class Type>
void use(std::string_view call, VkCommandBuffer commands, Type used) {
    if constexpr (VulkanHandle<Type> && !std::is_same_v<Type, VkCommandBuffer>) {
        if (MockObject* const object = driver().find(call, commands);
            object != nullptr && used != VK_NULL_HANDLE) {
            refer(call, *object, number(used), used);
        }
    }
}

/// The entry point with that name; null if there is none.
[[nodiscard]] PFN_vkVoidFunction find_entry_point(std::string_view name);

}  // namespace nearfield::test_support::mock
