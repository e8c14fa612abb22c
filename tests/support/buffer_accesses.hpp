#pragma once

#include <tests/support/fake_loader.hpp>
#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace nearfield::test_support {

/// A part of a buffer, in bytes.
struct BufferRange {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize first = 0;
    VkDeviceSize end = 0;

    [[nodiscard]] bool overlaps(const BufferRange& other) const {
        return buffer == other.buffer && first < other.end && other.first < end;
    }
};

/// A command's access to a part of a buffer.
struct BufferAccess {
    BufferRange range;
    VkPipelineStageFlags stage = 0;
    VkAccessFlags flags = 0;
    bool writes = false;
    VkPipeline pipeline = VK_NULL_HANDLE;  // that of a dispatch or draw
    std::uint32_t command = 0;             // its number; one command does not wait for itself
    std::size_t barriers_before = 0;
};

struct RecordedBarrier {
    VkPipelineStageFlags source = 0;
    VkPipelineStageFlags destination = 0;
    std::vector<VkMemoryBarrier> memory;
    std::vector<VkBufferMemoryBarrier> buffers;
    bool has_images = false;
};

/// What a command buffer has recorded so far, in order.
struct Recording {
    std::vector<std::variant<BufferAccess, RecordedBarrier>> commands;
    std::uint32_t next_command = 0;
    bool is_submitted_again = false;  // or may be
    VkPipeline compute = VK_NULL_HANDLE;
    VkPipeline graphics = VK_NULL_HANDLE;
    VkDescriptorSet compute_set = VK_NULL_HANDLE;
    VkDescriptorSet graphics_set = VK_NULL_HANDLE;
};

/// Watches what recorded commands access. What a dispatch or a draw accesses is read from its
/// shaders' code and from its descriptor set, not from what the library declares. One at a time, as
/// with FakeLoader.
class BufferAccesses {
public:
    /// Lies that change nothing. The host enables debug utils, which name the buffers.
    [[nodiscard]] static Lies lies();

    /// Since the lies were made.
    [[nodiscard]] static std::vector<Recording> recordings();
    [[nodiscard]] static std::string name_of(VkBuffer buffer);
    /// The range of a barrier.
    [[nodiscard]] static BufferRange range_of(const VkBufferMemoryBarrier& barrier);
};

}  // namespace nearfield::test_support
