#include <engine/render/search_memory.hpp>

#include <algorithm>
#include <cstring>

namespace nearfield::render {

std::uint32_t ScratchLayout::words(std::uint64_t count) {
    const std::uint64_t first = words_;
    words_ += (count + 3) / 4 * 4;
    return static_cast<std::uint32_t>(first);
}

std::uint32_t ScratchLayout::sums(std::uint64_t elements) {
    // A dispatch of several rows has up to one workgroup fewer than rows too many (totals.glsl).
    const std::uint64_t workgroups = elements / plan::search_block + 1;
    const std::uint64_t rows = workgroups / plan::max_workgroups + 1;
    return words(workgroups + rows);
}

void ScratchLayout::add_stages(std::uint64_t items, std::uint64_t edges, std::uint64_t points,
                               std::uint64_t others, plan::SearchPush& push) {
    const std::uint64_t threads = points / plan::points_per_thread + 1;
    push.block_sums = sums(std::max({items, edges, threads, others}));
    push.item_blocks = sums(items);
    push.item_words = words(plan::words_of_item * items);
    push.edge_blocks = sums(edges);
    push.edge_units = units(plan::units_of_edge * edges);
    push.point_blocks = sums(threads);
    push.point_units = units(points);
    push.depths = words(points);
}

bool reserve_with_texels(const gpu::Device& device, gpu::MappedBuffer& buffer,
                         gpu::Owned<VkBufferView>& texels, std::uint64_t bytes, const char* name) {
    // Where making either of the two failed before, there is no view.
    if (texels && bytes <= buffer.capacity()) {
        return false;
    }
    texels.reset();
    buffer.reserve(bytes);
    texels = gpu::make_texel_view(device, buffer, name);
    return true;
}

void clear_counts(const gpu::MappedBuffer& arguments, std::uint64_t stages) {
    std::memset(arguments.data(), 0, argument_bytes(stages));
    arguments.flush();
}

void read_counts(const gpu::MappedBuffer& arguments, std::span<std::uint32_t> counts) {
    arguments.invalidate();
    for (std::size_t i = 0; i < counts.size(); ++i) {
        std::memcpy(&counts[i], arguments.data() + offset_of_count(i), sizeof(counts[i]));
    }
}

bool have_room(std::span<const std::uint32_t> counts, std::span<const std::uint32_t> capacities) {
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > capacities[i]) {
            return false;
        }
    }
    return true;
}

}  // namespace nearfield::render
