#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

/// \file
/// What a Vulkan host hands over, once.
///
/// A structure that a host fills begins with `structure_size`: leave it as it is. It tells the
/// library which members there were when the host was compiled. Members that are missing have their
/// defaults; a larger structure than the library knows is accepted where all that is unknown is
/// zero (StatusCode::invalid_settings otherwise, as for a size at which it never ended).
/// docs/host_integration.md shows how the parts go together.

namespace nearfield {

/// How much a message matters.
enum class LogLevel {
    information,  ///< created and destroyed, the device, pipelines with the time they took
    warning,      ///< memory or images grew after start-up, which a frame may feel
    error,        ///< the device was lost; a shader that is to be reloaded does not compile
};

/// Where messages go; without `write` the library says nothing. `message` is one line without a
/// line break, valid during the call. Called by the thread that called the library, inside that
/// call; it must not throw and must not call the context.
struct Log {
    void* user = nullptr;  ///< handed back with each message
    /// Takes a message.
    void (*write)(void* user, LogLevel level, const char* message) = nullptr;
};

/// How the library gets at the queue where the host uses it too. All of it is optional; functions
/// are called by the thread that called the library and must not throw.
///
/// `lock` and `unlock` (both or neither) stand around every vkQueueSubmit, and around nothing else:
/// no wait and no other work happens in between. `submit`, where given, is called instead of
/// vkQueueSubmit and of both, with the same arguments but for the queue; what it returns counts as
/// what vkQueueSubmit returned, so it has to have called that before it returns.
struct QueueAccess {
    void* user = nullptr;                  ///< handed back with each call
    void (*lock)(void* user) = nullptr;    ///< before vkQueueSubmit
    void (*unlock)(void* user) = nullptr;  ///< after it
    /// In place of it.
    VkResult (*submit)(void* user, std::uint32_t count, const VkSubmitInfo* infos,
                       VkFence fence) = nullptr;
};

/// A host's Vulkan objects. nearfield borrows them: they must outlive the context, and are never
/// destroyed by it.
///
/// Context::run, submit and collect may submit to the queue, and nothing else may do so at the same
/// time: `queue_access` sees to that where several threads use the queue. What they wait for is the
/// fence of their own work; no queue and no device is ever waited for to become idle.
///
/// Nothing needs to be enabled on the device: the base is Vulkan 1.1 without features and without
/// extensions. The queue family must have VK_QUEUE_GRAPHICS_BIT and VK_QUEUE_COMPUTE_BIT.
/// requirements() (requirements.hpp) says all of it before there is a device.
struct HostDevice {
    std::uint32_t structure_size = sizeof(HostDevice);  ///< leave it as it is
    std::uint32_t queue_family = 0;        ///< of `queue` and of command buffers to record into
    VkInstance instance = VK_NULL_HANDLE;  ///< made for Vulkan 1.1 or later
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;  ///< what `device` was made from
    VkDevice device = VK_NULL_HANDLE;                   ///< all objects are made on it
    /// All work is submitted to it. May be null where queue_access.submit is given.
    VkQueue queue = VK_NULL_HANDLE;
    /// Every entry point is fetched through this one.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;

    // What the host enabled. What instance and physical device could do says nothing about the
    // device, so none of it is ever looked up.

    /// The instance was created with VK_EXT_debug_utils: objects are named, passes are labelled.
    bool debug_utils = false;
    /// The device was created with the feature logicOp enabled: IntersectionStrategy::logic_op may
    /// be used.
    bool logic_op = false;
    /// The device was created with the feature timelineSemaphore enabled (Vulkan 1.2, or
    /// VK_KHR_timeline_semaphore): Submission may have values of timeline semaphores.
    bool timeline_semaphore = false;
    /// VkApplicationInfo::apiVersion that the instance was created with; 0: Vulkan 1.1 or later.
    /// What is no version of Vulkan 1 is refused (StatusCode::invalid_settings).
    std::uint32_t api_version = 0;

    /// Handed to every vkCreate, vkAllocate, vkDestroy and vkFree. Copied; what it points to is
    /// called for as long as the context lives. pfnAllocation, pfnReallocation and pfnFree must be
    /// there, and of pfnInternalAllocation and pfnInternalFree both or neither.
    const VkAllocationCallbacks* allocator = nullptr;
    /// Pipelines are made with it, all of them when the context is made. Borrowed and never
    /// destroyed. The host must not have created it as externally synchronised.
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;
    QueueAccess queue_access = {};  ///< how to get at the queue; empty: nobody else uses it
    Log log = {};                   ///< where messages go
};

/// Which device a headless context takes.
struct HeadlessOptions {
    std::uint32_t structure_size = sizeof(HeadlessOptions);  ///< leave it as it is
    /// A part of the device's name, case-sensitive; null or empty: the best kind there is
    /// (discrete, integrated, virtual, then a CPU implementation such as lavapipe).
    const char* device_name = nullptr;
    Log log = {};  ///< where messages go
};

}  // namespace nearfield
