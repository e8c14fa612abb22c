#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/memory.hpp>
#include <engine/gpu/owned.hpp>

#include <cstddef>
#include <cstdint>
#include <string>

namespace nearfield::gpu {

/// Which way data goes: `upload` memory is written by the host and read by the device, on the
/// device where it can be; `readback` memory is written by the device and read by the host, cached
/// where it can be; `none` is memory that never leaves the device.
enum class Direction { upload, readback, none };

/// A buffer that stays mapped, where the host has to do with it, and only grows.
class MappedBuffer {
public:
    MappedBuffer(const Device& device, VkBufferUsageFlags usage, Direction direction,
                 std::string name);

    /// Makes room for `bytes` (at least one). Existing content is lost when it has to grow; must
    /// not be called while the device uses the buffer. Returns true where the buffer was replaced.
    /// Throws Failure (too_large) where a storage buffer would exceed what a shader can address;
    /// after any Failure the buffer is empty.
    bool reserve(std::uint64_t bytes);

    [[nodiscard]] VkBuffer handle() const { return buffer_.get(); }
    [[nodiscard]] std::uint64_t capacity() const { return capacity_; }
    /// Aligned to 64 bytes at least; null for Direction::none.
    [[nodiscard]] std::byte* data() const { return data_; }

    /// Makes host writes visible to the device, or device writes to the host, where the memory is
    /// not coherent.
    void flush() const;
    void invalidate() const;

private:
    [[nodiscard]] std::uint64_t grown(std::uint64_t bytes) const;
    void create_buffer(std::uint64_t bytes);
    void allocate_memory();

    const Device* device_;
    VkBufferUsageFlags usage_;
    Direction direction_;
    std::string name_;
    DeviceMemory memory_;  // before the buffer bound to it, so it is freed after
    Owned<VkBuffer> buffer_;
    std::byte* data_ = nullptr;
    std::uint64_t capacity_ = 0;
    bool coherent_ = true;
};

}  // namespace nearfield::gpu
