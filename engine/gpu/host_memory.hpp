#pragma once

#include <nearfield/host.hpp>

namespace nearfield::gpu {

/// One piece of device memory from the host's allocator (HostDevice::memory), given back when it
/// goes.
class HostMemory {
public:
    /// Throws StatusException: the error that the host returned, or invalid_settings, which names
    /// the part of the host's answer that contradicts the request.
    HostMemory(const MemoryFunctions& functions, const MemoryRequest& request);
    ~HostMemory();
    HostMemory(const HostMemory&) = delete;
    HostMemory& operator=(const HostMemory&) = delete;

    [[nodiscard]] const MemoryAllocation& allocation() const { return allocation_; }

private:
    explicit HostMemory(const MemoryFunctions& functions) : functions_(functions) {}

    MemoryFunctions functions_;
    MemoryAllocation allocation_;
    bool given_ = false;
};

}  // namespace nearfield::gpu
