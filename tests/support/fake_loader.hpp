#pragma once

#include <nearfield/host.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace nearfield::test_support {

/// The changes that a fake vkGetInstanceProcAddr makes to the driver's replies.
struct Lies {
    std::function<void(VkPhysicalDeviceProperties&)> properties;
    std::function<void(VkPhysicalDeviceMemoryProperties&)> memory;
    std::function<void(VkFormat, VkFormatProperties&)> format;
    std::function<void(std::vector<VkQueueFamilyProperties>&)> queue_families;
    /// Replacements for entry points of instance or device; null for a missing one.
    std::map<std::string, PFN_vkVoidFunction> entry_points;
};

/// A function as a loader returns it.
template <class Function>
[[nodiscard]] PFN_vkVoidFunction erased(Function function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

/// During its lifetime, host() returns the original host with the lies applied. One at a time:
/// entry points carry no user data, so the lies are global.
class FakeLoader {
public:
    FakeLoader(const HostDevice& truth, Lies lies);
    ~FakeLoader();
    FakeLoader(const FakeLoader&) = delete;
    FakeLoader& operator=(const FakeLoader&) = delete;

    [[nodiscard]] const HostDevice& host() const { return host_; }

private:
    HostDevice host_;
};

/// The original entry point of the device behind the current FakeLoader.
[[nodiscard]] PFN_vkVoidFunction true_device_function(const char* name);

}  // namespace nearfield::test_support
