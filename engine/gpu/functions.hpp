#pragma once

#include <vulkan/vulkan_core.h>

/// Every Vulkan entry point that the library uses, by level. Nothing is linked: all of them are
/// obtained through the host's vkGetInstanceProcAddr.

#define NEARFIELD_INSTANCE_FUNCTIONS(X)         \
    X(vkGetPhysicalDeviceProperties)            \
    X(vkGetPhysicalDeviceMemoryProperties)      \
    X(vkGetPhysicalDeviceQueueFamilyProperties) \
    X(vkGetPhysicalDeviceFormatProperties)      \
    X(vkGetDeviceProcAddr)

#define NEARFIELD_DEVICE_FUNCTIONS(X) \
    X(vkAllocateCommandBuffers)       \
    X(vkAllocateDescriptorSets)       \
    X(vkAllocateMemory)               \
    X(vkBeginCommandBuffer)           \
    X(vkBindBufferMemory)             \
    X(vkBindImageMemory)              \
    X(vkCmdBeginQuery)                \
    X(vkCmdBeginRenderPass)           \
    X(vkCmdBindDescriptorSets)        \
    X(vkCmdBindPipeline)              \
    X(vkCmdBindVertexBuffers)         \
    X(vkCmdCopyBuffer)                \
    X(vkCmdCopyQueryPoolResults)      \
    X(vkCmdDispatch)                  \
    X(vkCmdDispatchIndirect)          \
    X(vkCmdDraw)                      \
    X(vkCmdEndQuery)                  \
    X(vkCmdEndRenderPass)             \
    X(vkCmdFillBuffer)                \
    X(vkCmdPipelineBarrier)           \
    X(vkCmdPushConstants)             \
    X(vkCmdResetQueryPool)            \
    X(vkCmdSetScissor)                \
    X(vkCmdSetStencilCompareMask)     \
    X(vkCmdSetStencilReference)       \
    X(vkCmdSetStencilWriteMask)       \
    X(vkCmdSetViewport)               \
    X(vkCmdWriteTimestamp)            \
    X(vkCreateBuffer)                 \
    X(vkCreateCommandPool)            \
    X(vkCreateComputePipelines)       \
    X(vkCreateDescriptorPool)         \
    X(vkCreateDescriptorSetLayout)    \
    X(vkCreateFence)                  \
    X(vkCreateFramebuffer)            \
    X(vkCreateGraphicsPipelines)      \
    X(vkCreateImage)                  \
    X(vkCreateBufferView)             \
    X(vkCreateImageView)              \
    X(vkCreatePipelineLayout)         \
    X(vkCreateQueryPool)              \
    X(vkCreateRenderPass)             \
    X(vkCreateSampler)                \
    X(vkCreateShaderModule)           \
    X(vkDestroyBuffer)                \
    X(vkDestroyCommandPool)           \
    X(vkDestroyDescriptorPool)        \
    X(vkDestroyDescriptorSetLayout)   \
    X(vkDestroyFence)                 \
    X(vkDestroyFramebuffer)           \
    X(vkDestroyImage)                 \
    X(vkDestroyBufferView)            \
    X(vkDestroyImageView)             \
    X(vkDestroyPipeline)              \
    X(vkDestroyPipelineLayout)        \
    X(vkDestroyQueryPool)             \
    X(vkDestroyRenderPass)            \
    X(vkDestroySampler)               \
    X(vkDestroyShaderModule)          \
    X(vkEndCommandBuffer)             \
    X(vkFlushMappedMemoryRanges)      \
    X(vkFreeMemory)                   \
    X(vkGetBufferMemoryRequirements)  \
    X(vkGetFenceStatus)               \
    X(vkGetImageMemoryRequirements)   \
    X(vkGetQueryPoolResults)          \
    X(vkInvalidateMappedMemoryRanges) \
    X(vkMapMemory)                    \
    X(vkQueueSubmit)                  \
    X(vkResetCommandPool)             \
    X(vkResetFences)                  \
    X(vkUpdateDescriptorSets)         \
    X(vkWaitForFences)

/// Looked up if the host says that its instance has VK_EXT_debug_utils.
#define NEARFIELD_DEBUG_FUNCTIONS(X) \
    X(vkSetDebugUtilsObjectNameEXT)  \
    X(vkCmdBeginDebugUtilsLabelEXT)  \
    X(vkCmdEndDebugUtilsLabelEXT)

/// Looked up if submissions signal a timeline semaphore in place of a fence.
#define NEARFIELD_SEMAPHORE_FUNCTIONS(X) \
    X(vkCreateSemaphore)                 \
    X(vkDestroySemaphore)                \
    X(vkGetSemaphoreCounterValue)        \
    X(vkWaitSemaphores)

namespace nearfield::gpu {

struct Functions {
#define NEARFIELD_MEMBER(name) PFN_##name name = nullptr;
    NEARFIELD_INSTANCE_FUNCTIONS(NEARFIELD_MEMBER)
    NEARFIELD_DEVICE_FUNCTIONS(NEARFIELD_MEMBER)
    NEARFIELD_DEBUG_FUNCTIONS(NEARFIELD_MEMBER)
    NEARFIELD_SEMAPHORE_FUNCTIONS(NEARFIELD_MEMBER)
#undef NEARFIELD_MEMBER
};

}  // namespace nearfield::gpu
