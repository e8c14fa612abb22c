#pragma once

#include <engine/gpu/strategies.hpp>
#include <nearfield/requirements.hpp>

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace nearfield::gpu {

/// A physical device, as enumerated.
struct Candidate {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties{};
    Requirements requirements;
    StrategySupport support;  ///< with every available feature of the device enabled
};

/// The Vulkan loader, opened at run time, and an instance without layers except those that the
/// environment requests (VK_INSTANCE_LAYERS).
class Instance {
public:
    /// Throws StatusException (no_device) if there is no loader or no driver.
    Instance();
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    [[nodiscard]] VkInstance handle() const { return handle_; }
    [[nodiscard]] PFN_vkGetInstanceProcAddr get_instance_proc_addr() const { return get_; }
    /// The instance has VK_EXT_debug_utils.
    [[nodiscard]] bool debug_utils() const { return debug_utils_; }

    /// The entry point of a core function. Throws StatusException (no_device) if the loader has
    /// none.
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
