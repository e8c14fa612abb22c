#pragma once

#include <nearfield/host.hpp>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace nearfield::test_support {

/// The parts of a device enabled beyond the base: none by default.
struct Enabled {
    VkPhysicalDeviceFeatures features{};
    bool timeline_semaphore = false;  ///< through VK_KHR_timeline_semaphore
    /// The validation layer reports best practices too, which is no error.
    bool best_practices = false;
    /// device() has a queue of a family that computes and does not draw, and drawing_device() has
    /// one that does both; both are of one device. Throws if there is no such family.
    bool async_compute = false;
};

/// A minimal renderer: a Vulkan 1.1 device with no extension and, by default, no feature enabled,
/// under the Khronos validation layer with synchronisation validation. It collects the layer's
/// messages.
class VulkanHost {
public:
    /// Throws std::runtime_error if the loader, the layer or a device is missing, so that a test
    /// without validation fails rather than passes.
    VulkanHost() : VulkanHost(Enabled{}) {}
    /// Enables the requested parts if the physical device offers them: device().logic_op and
    /// device().timeline_semaphore report whether it did.
    explicit VulkanHost(const Enabled& wanted);
    ~VulkanHost();
    VulkanHost(const VulkanHost&) = delete;
    VulkanHost& operator=(const VulkanHost&) = delete;

    [[nodiscard]] const HostDevice& device() const { return device_; }
    /// The same device with a queue that draws and computes.
    [[nodiscard]] const HostDevice& drawing_device() const { return drawing_device_; }
    /// Everything that the physical device offers, according to its driver.
    [[nodiscard]] Enabled offered() const;

    /// Every warning and error of the validation layer since the last clear, in order.
    [[nodiscard]] std::vector<std::string> messages() const;
    void clear_messages();

    /// Destroys device and instance, then returns all messages, including those about leaked
    /// objects. All objects of the device must have been destroyed before.
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
    void create_instance(bool best_practices);
    void choose_physical_device();
    void choose_compute_family();
    [[nodiscard]] bool has_extension(const char* name) const;
    void create_device(const Enabled& enabled);
    void destroy();

    mutable std::mutex mutex_;  // the layer may report from any thread
    std::vector<std::string> messages_;
    std::unique_ptr<void, CloseLibrary> library_;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    HostDevice device_;
    HostDevice drawing_device_;
};

}  // namespace nearfield::test_support
