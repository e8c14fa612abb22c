#include <tests/support/driver_errors.hpp>

#include <map>

namespace nearfield::test_support {
namespace {

using Errors = std::vector<VkResult>;

// Errors that nearly every call may return.
const Errors memory{VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY};
const Errors device_memory{VK_ERROR_OUT_OF_DEVICE_MEMORY};
const Errors memory_or_loss{VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,
                            VK_ERROR_DEVICE_LOST};

Errors memory_and(VkResult error) {
    Errors errors = memory;
    errors.push_back(error);
    return errors;
}

// One row for each entry point that can fail, in alphabetical order.
const std::map<std::string_view, Errors> table{
    {"vkAllocateCommandBuffers", memory},
    {"vkAllocateDescriptorSets",
     {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_FRAGMENTED_POOL,
      VK_ERROR_OUT_OF_POOL_MEMORY}},
    {"vkAllocateMemory",
     {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_TOO_MANY_OBJECTS,
      VK_ERROR_INVALID_EXTERNAL_HANDLE}},
    {"vkBeginCommandBuffer", memory},
    {"vkBindBufferMemory", memory},
    {"vkBindImageMemory", memory},
    {"vkCreateBuffer", memory},
    {"vkCreateBufferView", memory},
    {"vkCreateCommandPool", memory},
    {"vkCreateComputePipelines", memory_and(VK_ERROR_INVALID_SHADER_NV)},
    {"vkCreateDescriptorPool", memory_and(VK_ERROR_FRAGMENTATION)},
    {"vkCreateDescriptorSetLayout", memory},
    {"vkCreateDevice",
     {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_INITIALIZATION_FAILED,
      VK_ERROR_EXTENSION_NOT_PRESENT, VK_ERROR_FEATURE_NOT_PRESENT, VK_ERROR_TOO_MANY_OBJECTS,
      VK_ERROR_DEVICE_LOST}},
    {"vkCreateFence", memory},
    {"vkCreateFramebuffer", memory},
    {"vkCreateGraphicsPipelines", memory_and(VK_ERROR_INVALID_SHADER_NV)},
    {"vkCreateImage", memory},
    {"vkCreateImageView", memory},
    {"vkCreateInstance",
     {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_INITIALIZATION_FAILED,
      VK_ERROR_LAYER_NOT_PRESENT, VK_ERROR_EXTENSION_NOT_PRESENT, VK_ERROR_INCOMPATIBLE_DRIVER}},
    {"vkCreatePipelineLayout", memory},
    {"vkCreateQueryPool", memory},
    {"vkCreateRenderPass", memory},
    {"vkCreateSampler", memory},
    {"vkCreateSemaphore", memory},
    {"vkCreateShaderModule", memory_and(VK_ERROR_INVALID_SHADER_NV)},
    {"vkEndCommandBuffer", memory},
    {"vkEnumerateInstanceExtensionProperties", memory_and(VK_ERROR_LAYER_NOT_PRESENT)},
    {"vkEnumeratePhysicalDevices", memory_and(VK_ERROR_INITIALIZATION_FAILED)},
    {"vkFlushMappedMemoryRanges", memory},
    {"vkGetFenceStatus", memory_or_loss},
    {"vkGetQueryPoolResults", memory_or_loss},
    {"vkInvalidateMappedMemoryRanges", memory},
    {"vkMapMemory", memory_and(VK_ERROR_MEMORY_MAP_FAILED)},
    {"vkQueueSubmit", memory_or_loss},
    {"vkResetCommandPool", device_memory},
    {"vkResetFences", device_memory},
    {"vkSetDebugUtilsObjectNameEXT", memory},
    {"vkWaitForFences", memory_or_loss},
};

}  // namespace

const std::vector<VkResult>& errors_of(std::string_view call) {
    static const Errors none;
    const auto row = table.find(call);
    return row != table.end() ? row->second : none;
}

const char* name_of(VkResult error) {
    switch (error) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "VK_ERROR_OUT_OF_HOST_MEMORY";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "VK_ERROR_INITIALIZATION_FAILED";
        case VK_ERROR_DEVICE_LOST:
            return "VK_ERROR_DEVICE_LOST";
        case VK_ERROR_MEMORY_MAP_FAILED:
            return "VK_ERROR_MEMORY_MAP_FAILED";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "VK_ERROR_LAYER_NOT_PRESENT";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "VK_ERROR_EXTENSION_NOT_PRESENT";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "VK_ERROR_FEATURE_NOT_PRESENT";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "VK_ERROR_INCOMPATIBLE_DRIVER";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "VK_ERROR_TOO_MANY_OBJECTS";
        case VK_ERROR_FRAGMENTED_POOL:
            return "VK_ERROR_FRAGMENTED_POOL";
        case VK_ERROR_OUT_OF_POOL_MEMORY:
            return "VK_ERROR_OUT_OF_POOL_MEMORY";
        case VK_ERROR_INVALID_EXTERNAL_HANDLE:
            return "VK_ERROR_INVALID_EXTERNAL_HANDLE";
        case VK_ERROR_FRAGMENTATION:
            return "VK_ERROR_FRAGMENTATION";
        case VK_ERROR_INVALID_SHADER_NV:
            return "VK_ERROR_INVALID_SHADER_NV";
        default:
            return "an error without a row in this list";
    }
}

}  // namespace nearfield::test_support
