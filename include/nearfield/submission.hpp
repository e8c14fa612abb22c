#pragma once

#include <nearfield/export.hpp>

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>

/// \file
/// The host's objects for one batch or table: semaphores for a submission, or the command buffer to
/// record into.

namespace nearfield {

/// A semaphore that the device waits for before it works on a batch.
struct SemaphoreWait {
    VkSemaphore semaphore = VK_NULL_HANDLE;  ///< binary or timeline; borrowed
    /// The stages that wait, not 0. A batch uses compute shaders, transfers and all graphics
    /// stages.
    VkPipelineStageFlags stages = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    /// For a timeline semaphore (HostDevice::timeline_semaphore): waits until its value is at least
    /// this. 0 for a binary one.
    std::uint64_t value = 0;
};

/// A semaphore that the device signals when it has finished a batch.
struct SemaphoreSignal {
    VkSemaphore semaphore = VK_NULL_HANDLE;  ///< binary or timeline; borrowed
    /// For a timeline semaphore: its new value, greater than the current one. 0 for a binary one.
    std::uint64_t value = 0;
};

/// Semaphores for the submission of a batch. The lists are borrowed until Context::submit()
/// returns; the semaphores must live until the batch is complete.
struct Submission {
    std::span<const SemaphoreWait> waits = {};      ///< before the device starts the batch
    std::span<const SemaphoreSignal> signals = {};  ///< after the device has finished the batch
};

/// The command buffer that Context::record() records a batch into, or World::record() a table.
struct Recording {
    /// A command buffer of HostDevice::queue_family in the recording state, outside a render pass,
    /// without an active occlusion query and without conditional rendering. A primary one; or a
    /// secondary one, if no query is answered by Technique::raster, which begins render passes of
    /// its own. Vulkan does not tell which it is: a host that records into secondary ones sets
    /// Settings::techniques to {.raster = false}.
    VkCommandBuffer commands = VK_NULL_HANDLE;
    /// The host's number for the frame that the command buffer belongs to. Frames are numbered in
    /// the order of their submission.
    std::uint64_t frame = 0;
};

}  // namespace nearfield
