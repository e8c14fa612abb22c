#pragma once

#include <optional>
#include <string>

namespace nearfield::test_support {

/// Sets an environment variable for as long as it lives. No other thread may look at the
/// environment meanwhile.
class Environment {
public:
    Environment(std::string name, const std::string& value);
    ~Environment();
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    std::string name_;
    std::optional<std::string> former_;
};

/// While it lives, Vulkan instances are made of the drivers with these manifests alone (as the
/// loader wants several: separated by colons). With a file that does not exist there is no driver.
class OnlyDrivers {
public:
    explicit OnlyDrivers(const std::string& manifests)
        : new_name_("VK_DRIVER_FILES", manifests), old_name_("VK_ICD_FILENAMES", manifests) {}

private:
    Environment new_name_;
    Environment old_name_;
};

}  // namespace nearfield::test_support
