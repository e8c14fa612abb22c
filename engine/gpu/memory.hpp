#pragma once

#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::gpu {

/// Required and preferred properties of memory.
struct MemoryWish {
    VkMemoryPropertyFlags required = 0;
    VkMemoryPropertyFlags preferred = 0;
};

/// What a piece of memory is for. Each kind has blocks of its own: no granularity separates images
/// from buffers then, and only what the host reads or writes is mapped.
enum class MemoryKind : std::uint8_t {
    mapped_buffer,
    buffer,
    image,
};

class MemoryBlocks;
struct MemoryBlock;

/// A piece of a block of device memory, given back when it goes.
class DeviceMemory {
public:
    DeviceMemory() = default;
    ~DeviceMemory() { reset(); }
    DeviceMemory(DeviceMemory&& other) noexcept { swap(other); }
    DeviceMemory& operator=(DeviceMemory&& other) noexcept {
        swap(other);
        return *this;
    }
    DeviceMemory(const DeviceMemory&) = delete;
    DeviceMemory& operator=(const DeviceMemory&) = delete;

    void reset() noexcept;

    /// What to bind to, with offset().
    [[nodiscard]] VkDeviceMemory get() const;
    [[nodiscard]] std::uint64_t offset() const { return offset_; }
    /// At least what was asked for; of mapped memory a multiple of nonCoherentAtomSize, as the
    /// offset is.
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// Aligned to at least 64 bytes; null unless it is mapped.
    [[nodiscard]] std::byte* data() const;
    [[nodiscard]] VkMemoryPropertyFlags flags() const;

private:
    friend class MemoryBlocks;
    void swap(DeviceMemory& other) noexcept {
        std::swap(blocks_, other.blocks_);
        std::swap(block_, other.block_);
        std::swap(offset_, other.offset_);
        std::swap(size_, other.size_);
    }

    MemoryBlocks* blocks_ = nullptr;
    MemoryBlock* block_ = nullptr;
    std::uint64_t offset_ = 0;
    std::uint64_t size_ = 0;
};

/// The device memory of a context: a few blocks (vkAllocateMemory), from which buffers and images
/// take pieces, the first gap that fits. A block that is no longer used is freed at once. Where the
/// host has an allocator (HostDevice::memory), it gives a block for each piece.
class MemoryBlocks {
public:
    explicit MemoryBlocks(const Device& device);
    ~MemoryBlocks();
    MemoryBlocks(const MemoryBlocks&) = delete;
    MemoryBlocks& operator=(const MemoryBlocks&) = delete;

    /// Takes a piece that meets these requirements, of the type that fits the wish best; if that
    /// type is exhausted, of the next one. Throws StatusException (out_of_memory) if every type is;
    /// (invalid_settings) if the host's allocator contradicts the request. `what`: for the message.
    [[nodiscard]] DeviceMemory allocate(const VkMemoryRequirements& needs, const MemoryWish& wish,
                                        MemoryKind kind, const std::string& what);

private:
    friend class DeviceMemory;

    /// A new block's size where that is enough: the first ones, and the largest.
    static constexpr std::uint64_t smallest_block = std::uint64_t{2} << 20U;
    static constexpr std::uint64_t largest_block = std::uint64_t{64} << 20U;

    [[nodiscard]] DeviceMemory take_from_any(std::uint32_t type, MemoryKind kind,
                                             const VkMemoryRequirements& needs);
    [[nodiscard]] MemoryBlock& ask_host(const VkMemoryRequirements& needs, const MemoryWish& wish,
                                        MemoryKind kind, const std::string& what);
    [[nodiscard]] DeviceMemory take(MemoryBlock& block, const VkMemoryRequirements& needs);
    [[nodiscard]] VkResult add_block(std::uint32_t type, MemoryKind kind, std::uint64_t bytes,
                                     const std::string& what);
    [[nodiscard]] std::uint64_t block_size(std::uint32_t type, MemoryKind kind,
                                           std::uint64_t needed) const;
    void give_back(MemoryBlock& block, std::uint64_t offset) noexcept;

    const Device* device_;
    std::vector<std::unique_ptr<MemoryBlock>> blocks_;
};

}  // namespace nearfield::gpu
