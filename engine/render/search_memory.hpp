#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/owned.hpp>

#include <shaders/push.h>
#include <shaders/search.h>

#include <cstdint>
#include <span>

/// \file What the memory of both searches for points has in common.

namespace nearfield::render {

/// The arrays in the scratch memory of a search, one after the other.
class ScratchLayout {
public:
    /// Each adds an array and returns where it starts: in words, or in units of four words.
    [[nodiscard]] std::uint32_t words(std::uint64_t count);
    [[nodiscard]] std::uint32_t units(std::uint64_t count) { return words(4 * count) / 4; }
    /// The sums of the blocks of so many elements, in words.
    [[nodiscard]] std::uint32_t sums(std::uint64_t elements);
    /// Adds the arrays of items, edges and points, and one for the sums of the blocks of any of
    /// these, or of so many other elements.
    void add_stages(std::uint64_t items, std::uint64_t edges, std::uint64_t points,
                    std::uint64_t others, plan::SearchPush& push);

    [[nodiscard]] std::uint64_t bytes() const { return words_ * sizeof(std::uint32_t); }

private:
    std::uint64_t words_ = plan::words_of_totals;
};

/// Of a scratch memory, which shaders also read as texels.
inline constexpr VkBufferUsageFlags scratch_usage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;

/// Makes room in a buffer that has a view of texels. Returns whether both are new: what the buffer
/// held is lost then.
bool reserve_with_texels(const gpu::Device& device, gpu::MappedBuffer& buffer,
                         gpu::Owned<VkBufferView>& texels, std::uint64_t bytes, const char* name);

/// Bytes of the arguments of the dispatches of so many stages.
[[nodiscard]] constexpr std::uint64_t argument_bytes(std::uint64_t stages) {
    return stages * plan::words_of_arguments * sizeof(std::uint32_t);
}
/// Where they have the number that a stage counted, in bytes.
[[nodiscard]] constexpr std::uint64_t offset_of_count(std::uint64_t stage) {
    return (stage * plan::words_of_arguments + 3) * sizeof(std::uint32_t);
}
/// Empties the arguments, so that a device that is lost leaves no counts of an earlier search.
void clear_counts(const gpu::MappedBuffer& arguments, std::uint64_t stages);
/// Reads what each stage counted; call once the device is done.
void read_counts(const gpu::MappedBuffer& arguments, std::span<std::uint32_t> counts);
[[nodiscard]] bool have_room(std::span<const std::uint32_t> counts,
                             std::span<const std::uint32_t> capacities);

}  // namespace nearfield::render
