#pragma once

#include <nearfield/export.hpp>
#include <nearfield/headless.hpp>

#include <vulkan/vulkan_core.h>

#include <cstdint>

/// \file
/// The Vulkan objects and callbacks that a host gives to a context.
///
/// docs/host_integration.md shows how the parts fit together.

namespace nearfield {

/// Access to a queue that the host uses too. Every member is optional. The functions are called by
/// the thread that called the library and must not throw.
///
/// `lock` and `unlock` (both or neither) enclose every vkQueueSubmit and nothing else: no wait and
/// no other work happens between them. `submit`, if set, is called in place of vkQueueSubmit,
/// `lock` and `unlock`, with the same arguments except the queue. Its result counts as that of
/// vkQueueSubmit, so it must have called vkQueueSubmit before it returns.
struct QueueAccess {
    void* user = nullptr;                  ///< passed to each function
    void (*lock)(void* user) = nullptr;    ///< called before vkQueueSubmit
    void (*unlock)(void* user) = nullptr;  ///< called after vkQueueSubmit
    /// Called in place of all three.
    VkResult (*submit)(void* user, std::uint32_t count, const VkSubmitInfo* infos,
                       VkFence fence) = nullptr;
};

/// A request for device memory, to MemoryFunctions::allocate.
struct MemoryRequest {
    /// Size, alignment and allowed memory types (bit mask); types that need a feature or protected
    /// memory are not among them. Of memory that is to be mapped, size and alignment are multiples
    /// of nonCoherentAtomSize and of 64 bytes.
    VkMemoryRequirements requirements{};
    /// Property flags that the memory type must have. VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT is among
    /// them if and only if the memory has to be mapped.
    VkMemoryPropertyFlags required = 0;
    VkMemoryPropertyFlags preferred = 0;  ///< property flags that it should have
    /// For images with optimal tiling, otherwise for one buffer: what bufferImageGranularity
    /// separates. Images that are never in use at the same time share memory.
    bool optimal_images = false;
    const char* name = "";  ///< what it is for; valid during the call
};

/// Stands for the memory type if the host's allocator does not report it.
inline constexpr std::uint32_t unknown_memory_type = UINT32_MAX;

/// Device memory that a host gave: bytes `offset` to `offset` + requirements.size of `memory`.
struct MemoryAllocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;  ///< of HostDevice::device; may hold other data too
    VkDeviceSize offset = 0;                 ///< a multiple of requirements.alignment
    /// The type that `memory` was allocated from. If it is unknown, the library assumes one of the
    /// allowed types, and that mapped memory is not coherent.
    std::uint32_t memory_type = unknown_memory_type;
    /// Where the host sees the byte at `offset`, if the memory has to be mapped; it stays mapped
    /// until it is freed. Otherwise ignored.
    void* mapped = nullptr;
    void* handle = nullptr;  ///< the host's own, for `free`; not read
};

/// A host's allocator of device memory. Both functions or neither. They are called by the thread
/// that called the library, during any call that may allocate or free (Context::create, submit,
/// record, layout_on_device, trim, collect, the destructor, ...), must not throw and must not call
/// the context.
struct MemoryFunctions {
    void* user = nullptr;  ///< passed to each function
    /// Fills in `allocation` (which has its defaults) and returns VK_SUCCESS, or returns an error,
    /// which fails the call of the library as that of vkAllocateMemory would. The function chooses
    /// among the allowed types, also when one is exhausted. An allocation that contradicts the
    /// request is freed and fails with StatusCode::invalid_settings.
    VkResult (*allocate)(void* user, const MemoryRequest* request,
                         MemoryAllocation* allocation) = nullptr;
    /// Frees what `allocate` returned, with the same values; called once for every success.
    /// Everything bound to it was destroyed, and the device no longer uses it.
    void (*free)(void* user, const MemoryAllocation* allocation) = nullptr;
};

/// A host's Vulkan objects. nearfield borrows them and never destroys them: they must outlive the
/// context and all that keeps it.
///
/// Context::run, submit and collect may submit to the queue, and nothing else may submit to it at
/// the same time; set `queue_access` if several threads use the queue. They wait only for the
/// fences of their own work, never for a queue or a device to become idle.
///
/// Nothing needs to be enabled on the device: the base is Vulkan 1.1 without features or
/// extensions. The queue family must have VK_QUEUE_COMPUTE_BIT; without VK_QUEUE_GRAPHICS_BIT there
/// is no Technique::raster. requirements() (requirements.hpp) checks all of this before the device
/// is created.
struct HostDevice {
    std::uint32_t queue_family = 0;        ///< of `queue` and of command buffers to record into
    VkInstance instance = VK_NULL_HANDLE;  ///< created for Vulkan 1.1 or later
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;  ///< the one that `device` was created from
    VkDevice device = VK_NULL_HANDLE;                   ///< owner of all objects of the library
    /// All work of the library is submitted to it. Null: only queue_access.submit can submit, if it
    /// is set; otherwise the host records all work of the device, and calls that would have to
    /// submit fail with invalid_submission.
    VkQueue queue = VK_NULL_HANDLE;
    /// Every entry point is loaded through this function.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;

    // What the host has enabled. The library does not query it: support by the instance or the
    // physical device does not mean that it is enabled on the device.

    /// VK_EXT_debug_utils is enabled on the instance: objects get names and passes get labels.
    bool debug_utils = false;
    /// The feature logicOp is enabled on the device: IntersectionStrategy::logic_op is available.
    bool logic_op = false;
    /// The feature timelineSemaphore is enabled on the device (Vulkan 1.2, or
    /// VK_KHR_timeline_semaphore): Submission may have values of timeline semaphores.
    bool timeline_semaphore = false;
    /// VkApplicationInfo::apiVersion of the instance; 0: Vulkan 1.1 or later. Any value that is not
    /// a version of Vulkan 1 fails with StatusCode::invalid_settings.
    std::uint32_t api_version = 0;

    /// Passed to every vkCreate, vkAllocate, vkDestroy and vkFree; may be null. The structure is
    /// copied; its functions and pUserData must stay valid for the lifetime of the context.
    /// pfnAllocation, pfnReallocation and pfnFree must be set, and pfnInternalAllocation and
    /// pfnInternalFree both or neither.
    const VkAllocationCallbacks* allocator = nullptr;
    /// Used to create pipelines, by default all of them when the context is created
    /// (Settings::pipelines_on_demand); may be null. Borrowed, never destroyed. Must not have been
    /// created as externally synchronised.
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;
    QueueAccess queue_access = {};  ///< default: only this context uses the queue
    Log log = {};                   ///< receives messages
    /// True: submissions have no fence (VK_NULL_HANDLE) and signal a timeline semaphore of the
    /// library's own instead, the last of VkSubmitInfo::pSignalSemaphores. For a host whose
    /// `queue_access.submit` has a fence of its own for every submission. Needs
    /// `timeline_semaphore` (StatusCode::invalid_settings otherwise).
    bool completion_by_timeline = false;

    /// Where all device memory comes from. Default: blocks that the library allocates.
    MemoryFunctions memory = {};
    /// Queue families other than `queue_family` whose commands read results on the device
    /// (on_device.hpp). Their images and buffers are then shared by these families and
    /// `queue_family` (VK_SHARING_MODE_CONCURRENT), so a semaphore is all that a queue of another
    /// family needs. Default: exclusive to `queue_family`. The array is copied; `device` must have
    /// been created with queues of each.
    const std::uint32_t* reader_families = nullptr;
    std::uint32_t reader_family_count = 0;  ///< length of `reader_families`
};

}  // namespace nearfield
