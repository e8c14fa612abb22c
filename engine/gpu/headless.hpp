#pragma once

#include <engine/gpu/instance.hpp>
#include <nearfield/host.hpp>

namespace nearfield::gpu {

/// An instance and a device of nearfield's own, without a surface. The Vulkan loader is opened at
/// run time, so a program that always provides its own device does not need one.
class HeadlessDevice {
public:
    /// Throws StatusException (no_device, or unsupported_device with the reasons for every device).
    explicit HeadlessDevice(const HeadlessOptions& options);
    ~HeadlessDevice();
    HeadlessDevice(const HeadlessDevice&) = delete;
    HeadlessDevice& operator=(const HeadlessDevice&) = delete;

    [[nodiscard]] const HostDevice& host() const { return host_; }

private:
    Instance instance_;
    HostDevice host_;
    PFN_vkDestroyDevice destroy_ = nullptr;
};

}  // namespace nearfield::gpu
