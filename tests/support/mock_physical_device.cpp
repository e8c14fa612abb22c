#include <tests/support/mock_entry.hpp>

#include <cstring>

namespace nearfield::test_support::mock {

void perform(Tag_vkGetPhysicalDeviceProperties, VkPhysicalDevice,
             VkPhysicalDeviceProperties* properties) {
    *properties = {};
    properties->apiVersion = VK_API_VERSION_1_1;
    properties->deviceType = driver().device_type;
    std::strcpy(properties->deviceName, "nearfield mock driver");
    VkPhysicalDeviceLimits& limits = properties->limits;
    limits.maxImageDimension2D = 16384;
    limits.maxStorageBufferRange = driver().storage_range;
    limits.maxPerStageDescriptorStorageBuffers = 16;
    limits.maxPerStageDescriptorStorageImages = 4;
    limits.maxComputeWorkGroupInvocations = 1024;
    limits.subPixelPrecisionBits = 8;
    limits.minStorageBufferOffsetAlignment = 16;
    limits.nonCoherentAtomSize = non_coherent_atom;
    limits.timestampPeriod = 1.0F;
}

void perform(Tag_vkGetPhysicalDeviceMemoryProperties, VkPhysicalDevice,
             VkPhysicalDeviceMemoryProperties* properties) {
    *properties = {};
    properties->memoryTypeCount = memory_types;
    for (std::uint32_t i = 0; i < memory_types; ++i) {
        properties->memoryTypes[i] = {memory_flags[i], 0};
    }
    properties->memoryHeapCount = 1;
    properties->memoryHeaps[0] = {VkDeviceSize{1} << 34U, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
}

void perform(Tag_vkGetPhysicalDeviceQueueFamilyProperties, VkPhysicalDevice, std::uint32_t* count,
             VkQueueFamilyProperties* families) {
    const std::vector<VkQueueFlags>& all = driver().families;
    for (std::uint32_t i = 0; families != nullptr && i < *count && i < all.size(); ++i) {
        families[i] = {all[i], 1, 64, {1, 1, 1}};
    }
    *count = static_cast<std::uint32_t>(all.size());
}

void perform(Tag_vkGetPhysicalDeviceFormatProperties, VkPhysicalDevice, VkFormat,
             VkFormatProperties* properties) {
    constexpr VkFormatFeatureFlags all = 0x7FFFFFFF;
    *properties = {all, all, all};
}

PFN_vkVoidFunction perform(Tag_vkGetDeviceProcAddr, VkDevice, const char* name) {
    return find_entry_point(name);
}

}  // namespace nearfield::test_support::mock
