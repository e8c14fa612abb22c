#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>

#include <cstdint>
#include <utility>

namespace nearfield::gpu {

/// A share of what Device::memory_count() counts, for as long as it lives.
class CountedBytes {
public:
    CountedBytes() = default;
    CountedBytes(const Device& device, std::uint64_t bytes) : device_(&device), bytes_(bytes) {
        device.memory_count().add(bytes);
    }
    ~CountedBytes() {
        if (device_ != nullptr) {
            device_->memory_count().remove(bytes_);
        }
    }
    CountedBytes(CountedBytes&& other) noexcept
        : device_(std::exchange(other.device_, nullptr)), bytes_(other.bytes_) {}
    CountedBytes& operator=(CountedBytes&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(bytes_, other.bytes_);
        return *this;
    }
    CountedBytes(const CountedBytes&) = delete;
    CountedBytes& operator=(const CountedBytes&) = delete;

private:
    const Device* device_ = nullptr;
    std::uint64_t bytes_ = 0;
};

/// Device memory, counted.
struct DeviceMemory {
    Owned<VkDeviceMemory> memory;
    CountedBytes bytes;

    DeviceMemory() = default;
    DeviceMemory(const Device& device, VkDeviceMemory handle, std::uint64_t size)
        : memory(device, handle), bytes(device, size) {}

    [[nodiscard]] VkDeviceMemory get() const { return memory.get(); }
};

}  // namespace nearfield::gpu
