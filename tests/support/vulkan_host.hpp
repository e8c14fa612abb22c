#pragma once

#include <nearfield/host.hpp>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace nearfield::test_support {

/// What a device has enabled beyond the base: nothing, unless asked for.
struct Enabled {
    VkPhysicalDeviceFeatures features{};
    bool timeline_semaphore = false;  ///< by VK_KHR_timeline_semaphore
};

/// A renderer in small: a Vulkan 1.1 device with no extension and, unless asked for, no feature
/// enabled, under the Khronos validation layer with synchronisation validation. What the layer says
/// is collected.
class VulkanHost {
public:
    /// Throws std::runtime_error where the loader, the layer or a device is missing, so that a test
    /// without validation fails rather than passes.
    VulkanHost() : VulkanHost(Enabled{}) {}
    /// Enables what is asked for where the physical device offers it: device().logic_op and
    /// device().timeline_semaphore say whether it did.
    explicit VulkanHost(const Enabled& wanted);
    ~VulkanHost();
    VulkanHost(const VulkanHost&) = delete;
    VulkanHost& operator=(const VulkanHost&) = delete;

    [[nodiscard]] const HostDevice& device() const { return device_; }
    /// All that the physical device offers, by what its driver says.
    [[nodiscard]] Enabled offered() const;

    /// Every warning and error of the validation layer since the last clear, in order.
    [[nodiscard]] std::vector<std::string> messages() const;
    void clear_messages();

    /// Destroys device and instance, then returns all messages, with those about objects that were
    /// left behind. Whatever was made on the device must be gone before.
    std::vector<std::string> close();

private:
    struct CloseLibrary {
        void operator()(void* library) const;
    };

    template <class Function>
    [[nodiscard]] Function function(const char* name) const;
    static VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                  VkDebugUtilsMessageTypeFlagsEXT types,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* host);

    void open_loader();
    void require_layer() const;
    void create_instance();
    void choose_physical_device();
    [[nodiscard]] bool has_extension(const char* name) const;
    void create_device(const Enabled& enabled);
    void destroy();

    mutable std::mutex mutex_;  // the layer may speak from any thread
    std::vector<std::string> messages_;
    std::unique_ptr<void, CloseLibrary> library_;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    HostDevice device_;
};

}  // namespace nearfield::test_support
