#include <engine/failure.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/instance.hpp>
#include <engine/gpu/requirements.hpp>

#include <dlfcn.h>

#include <algorithm>
#include <cstring>

namespace nearfield::gpu {
namespace {

[[noreturn]] void fail(const std::string& message) {
    throw Failure(Status(StatusCode::no_device, message));
}

void* open_loader() {
    void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) {
        return library;
    }
    // The text of the name that every loader has is the one worth reporting.
    const char* error = dlerror();
    const std::string reason = error != nullptr ? error : "dlopen gives no reason";
    library = dlopen("libvulkan.so", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        fail("the Vulkan loader could not be opened: " + reason +
             "; install it (package libvulkan1) with a driver (mesa-vulkan-drivers has one that "
             "needs no graphics card)");
    }
    return library;
}

bool has_debug_utils(PFN_vkGetInstanceProcAddr get) {
    const auto enumerate = reinterpret_cast<PFN_vkEnumerateInstanceExtensionProperties>(
        get(VK_NULL_HANDLE, "vkEnumerateInstanceExtensionProperties"));
    std::uint32_t count = 0;
    check(enumerate(nullptr, &count, nullptr), "vkEnumerateInstanceExtensionProperties",
          "the Vulkan loader");
    std::vector<VkExtensionProperties> extensions(count);
    check(enumerate(nullptr, &count, extensions.data()), "vkEnumerateInstanceExtensionProperties",
          "the Vulkan loader");
    extensions.resize(count);
    return std::any_of(extensions.begin(), extensions.end(), [](const auto& extension) {
        return std::strcmp(extension.extensionName, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) == 0;
    });
}

// The first family that draws and computes. Where none does the first of all, whose lack
// missing_requirements() then names.
std::uint32_t choose_queue_family(PFN_vkGetPhysicalDeviceQueueFamilyProperties get_families,
                                  VkPhysicalDevice device) {
    const VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    std::uint32_t count = 0;
    get_families(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    get_families(device, &count, families.data());
    const auto found = std::find_if(families.begin(), families.end(), [needed](const auto& family) {
        return (family.queueFlags & needed) == needed;
    });
    return found != families.end() ? static_cast<std::uint32_t>(found - families.begin()) : 0;
}

}  // namespace

void Instance::CloseLibrary::operator()(void* library) const {
    dlclose(library);
}

Instance::Instance() : library_(open_loader()) {
    get_ =
        reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library_.get(), "vkGetInstanceProcAddr"));
    if (get_ == nullptr) {
        fail("the Vulkan loader has no vkGetInstanceProcAddr");
    }
    debug_utils_ = has_debug_utils(get_);
    create();
}

Instance::~Instance() {
    function<PFN_vkDestroyInstance>("vkDestroyInstance")(handle_, nullptr);
}

void Instance::create() {
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pEngineName = "nearfield";
    application.apiVersion = VK_API_VERSION_1_1;
    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    info.enabledExtensionCount = debug_utils_ ? 1 : 0;
    info.ppEnabledExtensionNames = &extension;
    const VkResult result =
        function<PFN_vkCreateInstance>("vkCreateInstance")(&info, nullptr, &handle_);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        fail(
            "vkCreateInstance failed with VK_ERROR_INCOMPATIBLE_DRIVER: no Vulkan 1.1 driver is "
            "installed, or VK_ICD_FILENAMES hides it; install one (package mesa-vulkan-drivers "
            "has one that needs no graphics card)");
    }
    if (result < VK_SUCCESS) {
        fail(std::string("vkCreateInstance failed with ") + to_string(result));
    }
}

std::vector<Candidate> Instance::candidates() const {
    const auto enumerate = function<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices");
    const auto get_properties =
        function<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties");
    const auto get_families = function<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
        "vkGetPhysicalDeviceQueueFamilyProperties");
    const auto get_formats =
        function<PFN_vkGetPhysicalDeviceFormatProperties>("vkGetPhysicalDeviceFormatProperties");
    const auto get_features =
        function<PFN_vkGetPhysicalDeviceFeatures>("vkGetPhysicalDeviceFeatures");
    std::uint32_t count = 0;
    const VkResult result = enumerate(handle_, &count, nullptr);
    if (result == VK_ERROR_INITIALIZATION_FAILED) {
        return {};  // how some loaders say that no driver has a device
    }
    check(result, "vkEnumeratePhysicalDevices", "the instance");
    std::vector<VkPhysicalDevice> handles(count);
    check(enumerate(handle_, &count, handles.data()), "vkEnumeratePhysicalDevices", "the instance");
    handles.resize(count);

    std::vector<Candidate> candidates;
    for (VkPhysicalDevice handle : handles) {
        Candidate& candidate = candidates.emplace_back();
        candidate.handle = handle;
        get_properties(handle, &candidate.properties);
        candidate.queue_family = choose_queue_family(get_families, handle);
        candidate.missing = missing_requirements(get_, handle_, handle, candidate.queue_family);
        VkPhysicalDeviceFeatures features{};
        get_features(handle, &features);
        candidate.support = strategy_support(get_formats, handle, features.logicOp == VK_TRUE);
    }
    return candidates;
}

}  // namespace nearfield::gpu
