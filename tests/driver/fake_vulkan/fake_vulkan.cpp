#include <vulkan/vulkan_core.h>

/// A Vulkan loader with exactly the functions that a test gives it.

#define NEARFIELD_SHOWN extern "C" __attribute__((visibility("default")))

NEARFIELD_SHOWN PFN_vkGetInstanceProcAddr nearfield_fake_target;
PFN_vkGetInstanceProcAddr nearfield_fake_target = nullptr;

NEARFIELD_SHOWN PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance,
                                                                    const char* name);
PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance, const char* name) {
    return nearfield_fake_target == nullptr ? nullptr : nearfield_fake_target(instance, name);
}
