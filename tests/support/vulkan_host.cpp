#include <dlfcn.h>
#include <tests/support/host_gpu.hpp>
#include <tests/support/vulkan_host.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string_view>

namespace nearfield::test_support {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

[[noreturn]] void fail(const std::string& message) {
    throw std::runtime_error("Vulkan test host: " + message);
}

/// The features in both.
VkPhysicalDeviceFeatures common(const VkPhysicalDeviceFeatures& one,
                                const VkPhysicalDeviceFeatures& other) {
    // The structure contains only a VkBool32 for each feature.
    using Flags = std::array<VkBool32, sizeof(VkPhysicalDeviceFeatures) / sizeof(VkBool32)>;
    auto both = std::bit_cast<Flags>(one);
    const auto others = std::bit_cast<Flags>(other);
    for (std::size_t i = 0; i < both.size(); ++i) {
        both[i] = both[i] == VK_TRUE && others[i] == VK_TRUE ? VK_TRUE : VK_FALSE;
    }
    return std::bit_cast<VkPhysicalDeviceFeatures>(both);
}

// Passes that write a buffer in several dispatches: one for each tile, run of points or run of
// rows, whose words are its own (the planners give each the words behind those of the one before).
// The layer knows which buffers a shader writes and not which words, so it reports them, falsely.
constexpr std::array<std::string_view, 7> passes_of_parts{
    "resolve field",     "resolve field points", "resolve field points by walks",
    "collect gradients", "count samples",        "write samples",
    "export field"};

/// True if one of these passes is said to write what it has written itself, without a barrier.
bool is_about_parts(const VkDebugUtilsMessengerCallbackDataEXT& data) {
    const std::string_view message = data.pMessage;
    const std::span labels(data.pCmdBufLabels, data.cmdBufLabelCount);
    return message.find("WRITE_AFTER_WRITE") != std::string_view::npos &&
           std::any_of(passes_of_parts.begin(), passes_of_parts.end(), [&](std::string_view pass) {
               return message.find(std::string(pass) + "] command") != std::string_view::npos &&
                      std::any_of(labels.begin(), labels.end(),
                                  [pass](const auto& label) { return label.pLabelName == pass; });
           });
}

}  // namespace

void VulkanHost::CloseLibrary::operator()(void* library) const {
    dlclose(library);
}

template <class Function>
Function VulkanHost::function(const char* name) const {
    const auto found =
        reinterpret_cast<Function>(device_.get_instance_proc_addr(device_.instance, name));
    if (found == nullptr) {
        fail(std::string("there is no ") + name);
    }
    return found;
}

VulkanHost::VulkanHost(const Enabled& wanted) {
    try {
        open_loader();
        require_layer();
        create_instance(wanted.best_practices);
        choose_physical_device();
        drawing_device_.queue_family = device_.queue_family;
        if (wanted.async_compute) {
            choose_compute_family();
        }
        const Enabled there = offered();
        create_device({common(wanted.features, there.features),
                       wanted.timeline_semaphore && there.timeline_semaphore});
    } catch (...) {
        destroy();
        throw;
    }
}

VulkanHost::~VulkanHost() {
    destroy();
}

std::vector<std::string> VulkanHost::messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

void VulkanHost::clear_messages() {
    const std::lock_guard lock(mutex_);
    messages_.clear();
}

std::vector<std::string> VulkanHost::close() {
    destroy();
    return messages();
}

VKAPI_ATTR VkBool32 VKAPI_CALL VulkanHost::collect(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                   VkDebugUtilsMessageTypeFlagsEXT,
                                                   const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                   void* host) {
    if (is_about_parts(*data)) {
        return VK_FALSE;
    }
    VulkanHost& self = *static_cast<VulkanHost*>(host);
    const std::lock_guard lock(self.mutex_);
    self.messages_.emplace_back(std::string(data->pMessageIdName) + ": " + data->pMessage);
    return VK_FALSE;
}

void VulkanHost::open_loader() {
    library_.reset(dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL));
    if (library_ == nullptr) {
        fail(std::string("the Vulkan loader could not be opened: ") + dlerror());
    }
    device_.get_instance_proc_addr =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library_.get(), "vkGetInstanceProcAddr"));
    if (device_.get_instance_proc_addr == nullptr) {
        fail("the Vulkan loader has no vkGetInstanceProcAddr");
    }
}

void VulkanHost::require_layer() const {
    const auto enumerate =
        function<PFN_vkEnumerateInstanceLayerProperties>("vkEnumerateInstanceLayerProperties");
    std::uint32_t count = 0;
    require(enumerate(&count, nullptr), "vkEnumerateInstanceLayerProperties");
    std::vector<VkLayerProperties> layers(count);
    require(enumerate(&count, layers.data()), "vkEnumerateInstanceLayerProperties");
    if (std::none_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
            return std::strcmp(layer.layerName, validation_layer) == 0;
        })) {
        fail(std::string(validation_layer) + " is not installed (package vulkan-validationlayers)");
    }
}

void VulkanHost::create_instance(bool best_practices) {
    // General messages come from the loader, about drivers that this machine cannot use.
    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                            VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = &VulkanHost::collect;
    messenger.pUserData = this;

    constexpr std::array<VkValidationFeatureEnableEXT, 2> enabled{
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,
        VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT};
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger;  // covers creation and destruction of the instance too
    features.enabledValidationFeatureCount = best_practices ? 2 : 1;
    features.pEnabledValidationFeatures = enabled.data();

    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "nearfield tests";
    application.apiVersion = VK_API_VERSION_1_1;
    const std::array<const char*, 2> extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME,
                                                VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pNext = &features;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &validation_layer;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    require(function<PFN_vkCreateInstance>("vkCreateInstance")(&info, nullptr, &device_.instance),
            "vkCreateInstance");
    require(function<PFN_vkCreateDebugUtilsMessengerEXT>("vkCreateDebugUtilsMessengerEXT")(
                device_.instance, &messenger, nullptr, &messenger_),
            "vkCreateDebugUtilsMessengerEXT");
    device_.debug_utils = true;
}

void VulkanHost::choose_physical_device() {
    const auto enumerate = function<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices");
    const auto get_families = function<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
        "vkGetPhysicalDeviceQueueFamilyProperties");
    std::uint32_t count = 0;
    require(enumerate(device_.instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    require(enumerate(device_.instance, &count, devices.data()), "vkEnumeratePhysicalDevices");
    const VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (VkPhysicalDevice candidate : devices) {
        std::uint32_t family_count = 0;
        get_families(candidate, &family_count, nullptr);
        std::vector<VkQueueFamilyProperties> families(family_count);
        get_families(candidate, &family_count, families.data());
        for (std::uint32_t family = 0; family < family_count; ++family) {
            if ((families[family].queueFlags & needed) == needed) {
                device_.physical_device = candidate;
                device_.queue_family = family;
                return;
            }
        }
    }
    fail("none of " + std::to_string(count) +
         " Vulkan devices has a queue family with graphics and compute (package "
         "mesa-vulkan-drivers has one that needs no graphics card)");
}

void VulkanHost::choose_compute_family() {
    const auto get_families = function<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
        "vkGetPhysicalDeviceQueueFamilyProperties");
    std::uint32_t count = 0;
    get_families(device_.physical_device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    get_families(device_.physical_device, &count, families.data());
    const auto found = std::find_if(families.begin(), families.end(), [](const auto& family) {
        return (family.queueFlags & (VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT)) ==
               VK_QUEUE_COMPUTE_BIT;
    });
    if (found == families.end()) {
        fail("no queue family computes and does not draw (tests/async_compute/driver adds one)");
    }
    device_.queue_family = static_cast<std::uint32_t>(found - families.begin());
}

Enabled VulkanHost::offered() const {
    Enabled all;
    function<PFN_vkGetPhysicalDeviceFeatures>("vkGetPhysicalDeviceFeatures")(
        device_.physical_device, &all.features);
    // A device with the extension also has its feature.
    all.timeline_semaphore = has_extension(VK_KHR_TIMELINE_SEMAPHORE_EXTENSION_NAME);
    return all;
}

bool VulkanHost::has_extension(const char* name) const {
    const auto enumerate =
        function<PFN_vkEnumerateDeviceExtensionProperties>("vkEnumerateDeviceExtensionProperties");
    std::uint32_t count = 0;
    require(enumerate(device_.physical_device, nullptr, &count, nullptr),
            "vkEnumerateDeviceExtensionProperties");
    std::vector<VkExtensionProperties> extensions(count);
    require(enumerate(device_.physical_device, nullptr, &count, extensions.data()),
            "vkEnumerateDeviceExtensionProperties");
    return std::any_of(extensions.begin(), extensions.end(),
                       [name](const VkExtensionProperties& extension) {
                           return std::strcmp(extension.extensionName, name) == 0;
                       });
}

void VulkanHost::create_device(const Enabled& enabled) {
    const float priority = 1.0F;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = device_.queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    std::array<VkDeviceQueueCreateInfo, 2> queues{queue, queue};
    queues[1].queueFamilyIndex = drawing_device_.queue_family;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = device_.queue_family == drawing_device_.queue_family ? 1 : 2;
    info.pQueueCreateInfos = queues.data();
    info.pEnabledFeatures = &enabled.features;
    VkPhysicalDeviceTimelineSemaphoreFeatures timeline{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES, nullptr, VK_TRUE};
    const char* const extension = VK_KHR_TIMELINE_SEMAPHORE_EXTENSION_NAME;
    if (enabled.timeline_semaphore) {
        info.pNext = &timeline;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &extension;
    }
    require(function<PFN_vkCreateDevice>("vkCreateDevice")(device_.physical_device, &info, nullptr,
                                                           &device_.device),
            "vkCreateDevice");
    const auto get_queue = function<PFN_vkGetDeviceQueue>("vkGetDeviceQueue");
    get_queue(device_.device, device_.queue_family, 0, &device_.queue);
    device_.logic_op = enabled.features.logicOp == VK_TRUE;
    device_.timeline_semaphore = enabled.timeline_semaphore;
    const std::uint32_t drawing_family = drawing_device_.queue_family;
    drawing_device_ = device_;
    drawing_device_.queue_family = drawing_family;
    get_queue(device_.device, drawing_family, 0, &drawing_device_.queue);
}

void VulkanHost::destroy() {
    if (device_.device != VK_NULL_HANDLE) {
        function<PFN_vkDestroyDevice>("vkDestroyDevice")(device_.device, nullptr);
    }
    if (messenger_ != VK_NULL_HANDLE) {
        function<PFN_vkDestroyDebugUtilsMessengerEXT>("vkDestroyDebugUtilsMessengerEXT")(
            device_.instance, messenger_, nullptr);
    }
    if (device_.instance != VK_NULL_HANDLE) {
        function<PFN_vkDestroyInstance>("vkDestroyInstance")(device_.instance, nullptr);
    }
    device_ = drawing_device_ = HostDevice{};
    messenger_ = VK_NULL_HANDLE;
    library_.reset();
}

}  // namespace nearfield::test_support
