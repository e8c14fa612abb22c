#pragma once

#include <nearfield/host.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace nearfield::test_support {

/// What a fake vkGetInstanceProcAddr changes in what the true driver says.
struct Lies {
    std::function<void(VkPhysicalDeviceProperties&)> properties;
    std::function<void(VkPhysicalDeviceMemoryProperties&)> memory;
    std::function<void(VkFormat, VkFormatProperties&)> format;
    std::function<void(std::vector<VkQueueFamilyProperties>&)> queue_families;
    /// Entry points, of instance or device, to give out instead; null for one that is missing.
    std::map<std::string, PFN_vkVoidFunction> entry_points;
};

/// While it lives, host() answers with the lies laid over the truth of the host it was made from.
/// One at a time: entry points carry no user data, so the lies are global.
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

/// The true entry point of the device behind the FakeLoader that lives.
[[nodiscard]] PFN_vkVoidFunction true_device_function(const char* name);

}  // namespace nearfield::test_support
