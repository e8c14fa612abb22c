#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/memory.hpp>
#include <engine/gpu/owned.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace nearfield::gpu {

/// Direction of data. `upload`: memory that the host writes and the device reads, device-local if
/// possible; `readback`: memory that the device writes and the host reads, cached if possible;
/// `none`: memory that never leaves the device.
enum class Direction { upload, readback, none };

/// A part of a buffer, as shaders and commands are given it.
struct BufferPart {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize bytes = 0;
    VkBufferView texels = VK_NULL_HANDLE;  ///< of the whole buffer, where shaders read it so
    /// Of the buffer: once it is gone, another one may have its handle. 0 for the host's.
    std::uint64_t identity = 0;

    friend bool operator==(const BufferPart&, const BufferPart&) = default;
};

/// A buffer that only grows; permanently mapped if the host accesses it. With
/// VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT it has a view as texels of four unsigned numbers: of
/// all of it, or of as many as the device allows.
class MappedBuffer {
public:
    /// `families`: the queue families that share the buffer, borrowed; fewer than two: exclusive.
    MappedBuffer(const Device& device, VkBufferUsageFlags usage, Direction direction,
                 std::string name, std::span<const std::uint32_t> families = {});

    /// Grows the buffer to `bytes` (at least one) if it is smaller. Growing discards its content
    /// and must not happen while the device uses the buffer. Returns true if the buffer was
    /// replaced. Throws StatusException; after any exception there is no buffer.
    bool reserve(std::uint64_t bytes);

    [[nodiscard]] VkBuffer handle() const { return buffer_.get(); }
    [[nodiscard]] std::uint64_t capacity() const { return capacity_; }
    /// A part, up to the next whole unit of 16 bytes: shaders read words as vectors of four, and of
    /// a vector that ends beyond the range some devices read zeros. At least one unit, since Vulkan
    /// forbids an empty range: a pass without work reads nothing.
    [[nodiscard]] BufferPart part(std::uint64_t offset, std::uint64_t bytes) const;
    /// Aligned to at least 64 bytes; null for Direction::none.
    [[nodiscard]] std::byte* data() const { return data_; }

    /// Makes host writes visible to the device, or device writes to the host, where the memory is
    /// not coherent.
    void flush() const;
    void invalidate() const;

private:
    [[nodiscard]] std::uint64_t grown(std::uint64_t bytes) const;
    void create_buffer(std::uint64_t bytes);
    void allocate_memory();
    void create_texels(std::uint64_t bytes);
    void release();
    [[nodiscard]] VkMappedMemoryRange range() const;

    const Device* device_;
    VkBufferUsageFlags usage_;
    Direction direction_;
    std::string name_;
    std::span<const std::uint32_t> families_;
    DeviceMemory memory_;  // declared before the buffer bound to it, so it is freed after
    Owned<VkBuffer> buffer_;
    Owned<VkBufferView> texels_;
    std::byte* data_ = nullptr;
    std::uint64_t capacity_ = 0;
    std::uint64_t identity_ = 0;
    bool coherent_ = true;
};

}  // namespace nearfield::gpu
