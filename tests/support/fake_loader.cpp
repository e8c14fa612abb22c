#include <tests/support/fake_loader.hpp>

#include <utility>

namespace nearfield::test_support {
namespace {

HostDevice truth;
Lies lies;

template <class Function>
Function true_instance_function(const char* name) {
    return reinterpret_cast<Function>(truth.get_instance_proc_addr(truth.instance, name));
}

void VKAPI_CALL properties(VkPhysicalDevice device, VkPhysicalDeviceProperties* result) {
    true_instance_function<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties")(
        device, result);
    if (lies.properties) {
        lies.properties(*result);
    }
}

void VKAPI_CALL memory_properties(VkPhysicalDevice device,
                                  VkPhysicalDeviceMemoryProperties* result) {
    true_instance_function<PFN_vkGetPhysicalDeviceMemoryProperties>(
        "vkGetPhysicalDeviceMemoryProperties")(device, result);
    if (lies.memory) {
        lies.memory(*result);
    }
}

void VKAPI_CALL format(VkPhysicalDevice device, VkFormat which, VkFormatProperties* result) {
    true_instance_function<PFN_vkGetPhysicalDeviceFormatProperties>(
        "vkGetPhysicalDeviceFormatProperties")(device, which, result);
    if (lies.format) {
        lies.format(which, *result);
    }
}

void VKAPI_CALL queue_families(VkPhysicalDevice device, std::uint32_t* count,
                               VkQueueFamilyProperties* result) {
    const auto get = true_instance_function<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
        "vkGetPhysicalDeviceQueueFamilyProperties");
    std::uint32_t true_count = 0;
    get(device, &true_count, nullptr);
    std::vector<VkQueueFamilyProperties> families(true_count);
    get(device, &true_count, families.data());
    if (lies.queue_families) {
        lies.queue_families(families);
    }
    if (result == nullptr) {
        *count = static_cast<std::uint32_t>(families.size());
        return;
    }
    for (std::uint32_t i = 0; i < *count; ++i) {
        result[i] = families[i];
    }
}

PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char* name) {
    const auto lie = lies.entry_points.find(name);
    return lie != lies.entry_points.end() ? lie->second
                                          : true_instance_function<PFN_vkGetDeviceProcAddr>(
                                                "vkGetDeviceProcAddr")(device, name);
}

PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char* name) {
    if (const auto lie = lies.entry_points.find(name); lie != lies.entry_points.end()) {
        return lie->second;
    }
    const std::map<std::string, PFN_vkVoidFunction> fakes{
        {"vkGetPhysicalDeviceProperties", erased(&properties)},
        {"vkGetPhysicalDeviceMemoryProperties", erased(&memory_properties)},
        {"vkGetPhysicalDeviceFormatProperties", erased(&format)},
        {"vkGetPhysicalDeviceQueueFamilyProperties", erased(&queue_families)},
        {"vkGetDeviceProcAddr", erased(&device_function)},
    };
    const auto fake = fakes.find(name);
    return fake != fakes.end() ? fake->second : truth.get_instance_proc_addr(instance, name);
}

}  // namespace

FakeLoader::FakeLoader(const HostDevice& host, Lies told) : host_(host) {
    truth = host;
    lies = std::move(told);
    host_.get_instance_proc_addr = &instance_function;
}

FakeLoader::~FakeLoader() {
    truth = HostDevice{};
    lies = Lies{};
}

PFN_vkVoidFunction true_device_function(const char* name) {
    return true_instance_function<PFN_vkGetDeviceProcAddr>("vkGetDeviceProcAddr")(truth.device,
                                                                                  name);
}

}  // namespace nearfield::test_support
