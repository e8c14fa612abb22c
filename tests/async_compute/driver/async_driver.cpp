#include <dlfcn.h>
#include <vulkan/vk_icd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// A Vulkan driver between the loader and another one (NEARFIELD_DRIVER_BELOW, the path of its
/// library), which adds a queue family that computes and does not draw. What is submitted to its
/// queue goes to the first queue of the driver below, in order. So the validation layers, which see
/// what this driver says, check the rules for several families. For one device, one thread.

#define NEARFIELD_SHOWN extern "C" __attribute__((visibility("default")))

namespace {

/// A queue of the added family. The loader writes to its first word.
struct AddedQueue {
    VK_LOADER_DATA loader{};
    VkQueue below = VK_NULL_HANDLE;
};

struct Below {
    PFN_vk_icdNegotiateLoaderICDInterfaceVersion negotiate = nullptr;
    PFN_vk_icdGetInstanceProcAddr get_instance = nullptr;
    PFN_GetPhysicalDeviceProcAddr get_physical_device = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    PFN_vkGetDeviceProcAddr get_device = nullptr;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t added_family = UINT32_MAX;
    std::vector<std::unique_ptr<AddedQueue>> queues;
};

Below& below() {
    static Below driver;
    static const bool opened = [] {
        const char* const path = std::getenv("NEARFIELD_DRIVER_BELOW");
        void* const library = path == nullptr ? nullptr : dlopen(path, RTLD_NOW | RTLD_LOCAL);
        if (library == nullptr) {
            return false;
        }
        const auto load = [&](auto& function, const char* name) {
            function =
                reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
        };
        load(driver.negotiate, "vk_icdNegotiateLoaderICDInterfaceVersion");
        load(driver.get_instance, "vk_icdGetInstanceProcAddr");
        load(driver.get_physical_device, "vk_icdGetPhysicalDeviceProcAddr");
        return true;
    }();
    static_cast<void>(opened);
    return driver;
}

template <class Function>
Function of_instance(const char* name) {
    return reinterpret_cast<Function>(below().get_instance(below().instance, name));
}

template <class Function>
Function of_device(const char* name) {
    return reinterpret_cast<Function>(below().get_device(below().device, name));
}

std::uint32_t family_below(std::uint32_t family) {
    return family == below().added_family ? 0 : family;
}

VkQueue queue_below(VkQueue queue) {
    for (const auto& added : below().queues) {
        if (reinterpret_cast<VkQueue>(added.get()) == queue) {
            return added->below;
        }
    }
    return queue;
}

// Instance and physical device.

VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                    const VkAllocationCallbacks* allocator, VkInstance* instance) {
    const VkResult result = reinterpret_cast<PFN_vkCreateInstance>(
        below().get_instance(VK_NULL_HANDLE, "vkCreateInstance"))(info, allocator, instance);
    below().instance = *instance;
    return result;
}

/// Writes as many families as there is room for, the added one last, or tells their number.
template <class Properties, class Get>
void get_families(VkPhysicalDevice device, std::uint32_t* count, Properties* properties, Get get) {
    std::uint32_t there = 0;
    get(device, &there, nullptr);
    below().added_family = there;
    if (properties == nullptr) {
        *count = there + 1;
        return;
    }
    const std::uint32_t room = *count;
    *count = std::min(room, there);
    get(device, count, properties);
    if (room > there) {
        properties[there] = properties[0];
        *count = there + 1;
    }
}

constexpr VkQueueFlags added_flags = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;

void VKAPI_CALL get_queue_families(VkPhysicalDevice device, std::uint32_t* count,
                                   VkQueueFamilyProperties* properties) {
    get_families(device, count, properties,
                 of_instance<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
                     "vkGetPhysicalDeviceQueueFamilyProperties"));
    if (properties != nullptr && *count > below().added_family) {
        properties[below().added_family].queueFlags = added_flags;
    }
}

void VKAPI_CALL get_queue_families_2(VkPhysicalDevice device, std::uint32_t* count,
                                     VkQueueFamilyProperties2* properties) {
    get_families(device, count, properties,
                 of_instance<PFN_vkGetPhysicalDeviceQueueFamilyProperties2>(
                     "vkGetPhysicalDeviceQueueFamilyProperties2"));
    if (properties != nullptr && *count > below().added_family) {
        properties[below().added_family].queueFamilyProperties.queueFlags = added_flags;
    }
}

VkResult VKAPI_CALL create_device(VkPhysicalDevice physical_device, const VkDeviceCreateInfo* info,
                                  const VkAllocationCallbacks* allocator, VkDevice* device) {
    std::vector<VkDeviceQueueCreateInfo> queues;
    for (std::uint32_t i = 0; i < info->queueCreateInfoCount; ++i) {
        VkDeviceQueueCreateInfo queue = info->pQueueCreateInfos[i];
        queue.queueFamilyIndex = family_below(queue.queueFamilyIndex);
        const bool is_there =
            std::any_of(queues.begin(), queues.end(), [&queue](const auto& other) {
                return other.queueFamilyIndex == queue.queueFamilyIndex;
            });
        if (!is_there) {
            queues.push_back(queue);
        }
    }
    VkDeviceCreateInfo changed = *info;
    changed.queueCreateInfoCount = static_cast<std::uint32_t>(queues.size());
    changed.pQueueCreateInfos = queues.data();
    const VkResult result = of_instance<PFN_vkCreateDevice>("vkCreateDevice")(
        physical_device, &changed, allocator, device);
    below().device = *device;
    below().get_device = of_instance<PFN_vkGetDeviceProcAddr>("vkGetDeviceProcAddr");
    return result;
}

// Device and queues.

void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator) {
    of_device<PFN_vkDestroyDevice>("vkDestroyDevice")(device, allocator);
    below().queues.clear();
}

void VKAPI_CALL get_device_queue(VkDevice device, std::uint32_t family, std::uint32_t index,
                                 VkQueue* queue) {
    of_device<PFN_vkGetDeviceQueue>("vkGetDeviceQueue")(device, family_below(family), index, queue);
    if (family == below().added_family) {
        auto added = std::make_unique<AddedQueue>();
        set_loader_magic_value(added.get());
        added->below = *queue;
        *queue = reinterpret_cast<VkQueue>(added.get());
        below().queues.push_back(std::move(added));
    }
}

VkResult VKAPI_CALL queue_submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                 VkFence fence) {
    return of_device<PFN_vkQueueSubmit>("vkQueueSubmit")(queue_below(queue), count, infos, fence);
}

VkResult VKAPI_CALL queue_wait_idle(VkQueue queue) {
    return of_device<PFN_vkQueueWaitIdle>("vkQueueWaitIdle")(queue_below(queue));
}

VkResult VKAPI_CALL create_command_pool(VkDevice device, const VkCommandPoolCreateInfo* info,
                                        const VkAllocationCallbacks* allocator,
                                        VkCommandPool* pool) {
    VkCommandPoolCreateInfo changed = *info;
    changed.queueFamilyIndex = family_below(info->queueFamilyIndex);
    return of_device<PFN_vkCreateCommandPool>("vkCreateCommandPool")(device, &changed, allocator,
                                                                     pool);
}

PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name);

template <class Function>
PFN_vkVoidFunction erased(Function function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

/// This driver's own function of that name; null if there is none.
PFN_vkVoidFunction own_function(const char* name) {
    static const std::map<std::string, PFN_vkVoidFunction> own{
        {"vkCreateInstance", erased(&create_instance)},
        {"vkGetPhysicalDeviceQueueFamilyProperties", erased(&get_queue_families)},
        {"vkGetPhysicalDeviceQueueFamilyProperties2", erased(&get_queue_families_2)},
        {"vkGetPhysicalDeviceQueueFamilyProperties2KHR", erased(&get_queue_families_2)},
        {"vkCreateDevice", erased(&create_device)},
        {"vkGetDeviceProcAddr", erased(&get_device_function)},
        {"vkDestroyDevice", erased(&destroy_device)},
        {"vkGetDeviceQueue", erased(&get_device_queue)},
        {"vkQueueSubmit", erased(&queue_submit)},
        {"vkQueueWaitIdle", erased(&queue_wait_idle)},
        {"vkCreateCommandPool", erased(&create_command_pool)},
    };
    const auto found = own.find(name);
    return found == own.end() ? nullptr : found->second;
}

PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name) {
    const PFN_vkVoidFunction own = own_function(name);
    return own != nullptr ? own : below().get_device(device, name);
}

}  // namespace

NEARFIELD_SHOWN VkResult VKAPI_CALL vk_icdNegotiateLoaderICDInterfaceVersion(uint32_t* version) {
    return below().negotiate == nullptr ? VK_ERROR_INCOMPATIBLE_DRIVER : below().negotiate(version);
}

NEARFIELD_SHOWN PFN_vkVoidFunction VKAPI_CALL vk_icdGetInstanceProcAddr(VkInstance instance,
                                                                        const char* name) {
    if (below().get_instance == nullptr) {
        return nullptr;
    }
    const PFN_vkVoidFunction own = own_function(name);
    return own != nullptr ? own : below().get_instance(instance, name);
}

NEARFIELD_SHOWN PFN_vkVoidFunction VKAPI_CALL vk_icdGetPhysicalDeviceProcAddr(VkInstance instance,
                                                                              const char* name) {
    if (below().get_physical_device == nullptr) {
        return nullptr;
    }
    const PFN_vkVoidFunction found = below().get_physical_device(instance, name);
    return found != nullptr && own_function(name) != nullptr ? own_function(name) : found;
}
