#include <tests/support/mock_entry.hpp>

#include <cstring>

namespace nearfield::test_support::mock {

VkResult perform(Tag_vkEnumerateInstanceExtensionProperties, const char*, std::uint32_t* count,
                 VkExtensionProperties* properties) {
    *count = 1;
    if (properties != nullptr) {
        *properties = {};
        std::strcpy(properties->extensionName, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    return VK_SUCCESS;
}

VkResult perform(Tag_vkCreateInstance tag, const VkInstanceCreateInfo*,
                 const VkAllocationCallbacks*, VkInstance* instance) {
    *instance = driver().make<VkInstance>(tag.name, 0);
    return VK_SUCCESS;
}

void perform(Tag_vkDestroyInstance tag, VkInstance instance, const VkAllocationCallbacks*) {
    driver().expect_childless(tag.name, number(instance));
    driver().destroy(tag.name, 0, instance);
}

VkResult perform(Tag_vkEnumeratePhysicalDevices tag, VkInstance instance, std::uint32_t* count,
                 VkPhysicalDevice* devices) {
    driver().find(tag.name, instance);
    *count = 1;
    if (devices != nullptr) {
        *devices = handle<VkPhysicalDevice>(driver().physical_device);
    }
    return VK_SUCCESS;
}

/// For the only instance.
VkResult perform(Tag_vkCreateDevice tag, VkPhysicalDevice, const VkDeviceCreateInfo*,
                 const VkAllocationCallbacks*, VkDevice* device) {
    Number instance = 0;
    for (const auto& [each, object] : driver().objects) {
        instance = *object.type == typeid(VkInstance) ? each : instance;
    }
    *device = driver().make<VkDevice>(tag.name, instance);
    return VK_SUCCESS;
}

void perform(Tag_vkGetDeviceQueue tag, VkDevice device, std::uint32_t, std::uint32_t,
             VkQueue* queue) {
    driver().find(tag.name, device);
    *queue = handle<VkQueue>(driver().queue);
}

void perform(Tag_vkDestroyDevice tag, VkDevice device, const VkAllocationCallbacks*) {
    driver().expect_childless(tag.name, number(device));
    if (const MockObject* const object = driver().find(tag.name, device)) {
        driver().destroy(tag.name, object->parent, device);
    }
}

}  // namespace nearfield::test_support::mock
