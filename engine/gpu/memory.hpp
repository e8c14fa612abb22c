#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>

#include <cstdint>
#include <string>
#include <utility>

namespace nearfield::gpu {

/// A share of Device::memory_count(), counted for as long as the object lives.
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
    VkMemoryPropertyFlags flags = 0;  ///< of its memory type

    [[nodiscard]] VkDeviceMemory get() const { return memory.get(); }
};

/// Required and preferred properties of memory.
struct MemoryWish {
    VkMemoryPropertyFlags required = 0;
    VkMemoryPropertyFlags preferred = 0;
};

/// Allocates memory that meets these requirements, from the type that fits the wish best; if that
/// type is exhausted, from the next one. Throws StatusException (out_of_memory) if every type is.
/// `what`: for the message; `name`: of the memory, for debuggers.
[[nodiscard]] DeviceMemory allocate_memory(const Device& device, const VkMemoryRequirements& needs,
                                           const MemoryWish& wish, const std::string& what,
                                           const std::string& name);

}  // namespace nearfield::gpu
