#include <engine/base/status_exception.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/instance.hpp>
#include <engine/gpu/requirements.hpp>

#include <dlfcn.h>

#include <algorithm>
#include <cstring>

namespace nearfield::gpu {
namespace {

constexpr std::uint32_t api_version = VK_API_VERSION_1_1;

[[noreturn]] void fail(const std::string& message) {
    throw StatusException(Status(StatusCode::no_device, message));
}

void* open_loader() {
    void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) {
        return library;
    }
    // Report the error for the name that every loader has.
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
    debug_utils_ = has_debug_utils();
    create();
}

PFN_vkVoidFunction Instance::entry_point(const char* name) const {
    const PFN_vkVoidFunction found = get_(handle_, name);
    if (found == nullptr) {
        fail(std::string("the Vulkan loader does not know the entry point ") + name);
    }
    return found;
}

bool Instance::has_debug_utils() const {
    const auto enumerate = function<PFN_vkEnumerateInstanceExtensionProperties>(
        "vkEnumerateInstanceExtensionProperties");
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

Instance::~Instance() {
    function<PFN_vkDestroyInstance>("vkDestroyInstance")(handle_, nullptr);
}

void Instance::create() {
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pEngineName = "nearfield";
    application.apiVersion = api_version;
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
    const auto get_formats =
        function<PFN_vkGetPhysicalDeviceFormatProperties>("vkGetPhysicalDeviceFormatProperties");
    std::uint32_t count = 0;
    const VkResult result = enumerate(handle_, &count, nullptr);
    if (result == VK_ERROR_INITIALIZATION_FAILED) {
        return {};  // some loaders report the absence of devices this way
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
        PhysicalDevice asked;
        asked.instance = handle_;
        asked.physical_device = handle;
        asked.get_instance_proc_addr = get_;
        asked.api_version = api_version;
        asked.debug_utils = debug_utils_;
        survey_base(asked, candidate.requirements);
        survey_optional_parts(asked, candidate.requirements);
        candidate.support = strategy_support(get_formats, handle,
                                             candidate.requirements.features.logicOp == VK_TRUE);
    }
    return candidates;
}

}  // namespace nearfield::gpu
