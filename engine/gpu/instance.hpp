#pragma once

#include <engine/gpu/strategies.hpp>
#include <nearfield/requirements.hpp>

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace nearfield::gpu {

/// A physical device as found.
struct Candidate {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties{};
    Requirements requirements;
    StrategySupport support;  ///< of a device with every feature enabled that there is
};

/// The Vulkan loader, opened at run time, and an instance with no layer but those the environment
/// asks for (VK_INSTANCE_LAYERS).
class Instance {
public:
    /// Throws Failure (no_device) where there is no loader or no driver.
    Instance();
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    [[nodiscard]] VkInstance handle() const { return handle_; }
    [[nodiscard]] PFN_vkGetInstanceProcAddr get_instance_proc_addr() const { return get_; }
    /// The instance has VK_EXT_debug_utils.
    [[nodiscard]] bool debug_utils() const { return debug_utils_; }

    /// The entry point of a core function. Throws Failure (no_device) where the loader has none.
    template <class Function>
    [[nodiscard]] Function function(const char* name) const {
        return reinterpret_cast<Function>(entry_point(name));
    }

    /// Every device of every driver, in the loader's order.
    [[nodiscard]] std::vector<Candidate> candidates() const;

private:
    struct CloseLibrary {
        void operator()(void* library) const;
    };

    [[nodiscard]] PFN_vkVoidFunction entry_point(const char* name) const;
    [[nodiscard]] bool has_debug_utils() const;
    void create();

    std::unique_ptr<void, CloseLibrary> library_;
    PFN_vkGetInstanceProcAddr get_ = nullptr;
    VkInstance handle_ = VK_NULL_HANDLE;
    bool debug_utils_ = false;
};

}  // namespace nearfield::gpu
