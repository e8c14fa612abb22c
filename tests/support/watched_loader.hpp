#pragma once

#include <nearfield/host.hpp>

#include <tests/support/fake_loader.hpp>

#include <cstdint>
#include <functional>
#include <string_view>

namespace nearfield::test_support {

/// A call of an entry point, as it returned.
struct WatchedCall {
    std::string_view name;
    bool takes_allocator = false;
    const VkAllocationCallbacks* allocator = nullptr;
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;  ///< where it takes one
    std::uint64_t made = 0;                           ///< the (first) object it made, if any
    std::uint64_t allocations = 0;  ///< of this thread during the call: the driver's and layers'

    /// It makes objects (vkCreate, vkAllocate).
    [[nodiscard]] bool makes() const {
        return name.starts_with("vkCreate") || name.starts_with("vkAllocate");
    }
    [[nodiscard]] bool destroys() const {
        return name.starts_with("vkDestroy") || name.starts_with("vkFree");
    }
};

/// Lies that are none: every device entry point of the library goes to the truth, and `watch` is
/// told of each call. One at a time, as with FakeLoader; `watch` must be thread-safe where the
/// library is called from several threads.
[[nodiscard]] Lies watched(const HostDevice& host, std::function<void(const WatchedCall&)> watch);

}  // namespace nearfield::test_support
