#pragma once

#include <optional>
#include <string>

namespace nearfield::test_support {

/// Sets an environment variable during its lifetime. No other thread may access the environment
/// meanwhile.
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

/// During its lifetime, Vulkan instances use only the drivers with these manifests (several are
/// separated by colons, as the loader expects). A file that does not exist means no driver.
class OnlyDrivers {
public:
    explicit OnlyDrivers(const std::string& manifests)
        : new_name_("VK_DRIVER_FILES", manifests), old_name_("VK_ICD_FILENAMES", manifests) {}

private:
    Environment new_name_;
    Environment old_name_;
};

}  // namespace nearfield::test_support
