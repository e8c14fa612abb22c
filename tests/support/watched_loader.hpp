#pragma once

#include <nearfield/host.hpp>

#include <tests/support/fake_loader.hpp>

#include <cstdint>
#include <functional>
#include <string_view>

namespace nearfield::test_support {

/// A completed call of an entry point.
struct WatchedCall {
    std::string_view name;
    bool takes_allocator = false;
    const VkAllocationCallbacks* allocator = nullptr;
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;  ///< if it takes one
    std::uint64_t made = 0;                           ///< the first object it created, if any
    std::uint64_t allocations = 0;  ///< on this thread during the call: those of the driver and
                                    ///< layers

    /// True if it creates objects (vkCreate, vkAllocate).
    [[nodiscard]] bool makes() const {
        return name.starts_with("vkCreate") || name.starts_with("vkAllocate");
    }
    [[nodiscard]] bool destroys() const {
        return name.starts_with("vkDestroy") || name.starts_with("vkFree");
    }
};

/// Lies that change nothing: every device entry point forwards to the original, and `watch`
/// receives each call. One at a time, as with FakeLoader; `watch` must be thread-safe if the
/// library is called from several threads.
[[nodiscard]] Lies watched(const HostDevice& host, std::function<void(const WatchedCall&)> watch);

}  // namespace nearfield::test_support
