#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>

/// \file
/// What a host hands over with each batch: semaphores around a submission, or the command buffer
/// to record into. For `structure_size` see host.hpp.

namespace nearfield {

/// A semaphore that the device waits for before it works on a batch.
struct SemaphoreWait {
    VkSemaphore semaphore = VK_NULL_HANDLE;  ///< binary or timeline; borrowed
    /// Stages that wait. The batch works in compute shaders, transfer, and all stages of drawing.
    VkPipelineStageFlags stages = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    /// Of a timeline semaphore (HostDevice::timeline_semaphore): waits until it is at least this.
    /// 0 for a binary one.
    std::uint64_t value = 0;
};

/// A semaphore that the device signals when all of a batch is done.
struct SemaphoreSignal {
    VkSemaphore semaphore = VK_NULL_HANDLE;  ///< binary or timeline; borrowed
    /// Of a timeline semaphore: what it becomes, more than it is. 0 for a binary one.
    std::uint64_t value = 0;
};

/// What goes with the submission of a batch. Everything is borrowed until Context::submit()
/// returns; the semaphores themselves must live until the batch is done.
struct Submission {
    std::uint32_t structure_size = sizeof(Submission);  ///< leave it as it is
    std::span<const SemaphoreWait> waits = {};          ///< before the work begins
    std::span<const SemaphoreSignal> signals = {};      ///< when all of it is done
};

/// Where Context::record() puts the commands of a batch.
struct Recording {
    std::uint32_t structure_size = sizeof(Recording);  ///< leave it as it is
    /// A primary command buffer of HostDevice::queue_family in the recording state, outside a
    /// render pass, without an active query of occlusion and without conditional rendering.
    VkCommandBuffer commands = VK_NULL_HANDLE;
    /// The host's number of the frame that the command buffer belongs to. Frames are numbered in
    /// the order of their submission.
    std::uint64_t frame = 0;
};

}  // namespace nearfield
