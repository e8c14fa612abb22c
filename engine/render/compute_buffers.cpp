#include <engine/gpu/buffer_parts.hpp>
#include <engine/render/compute_buffers.hpp>

#include <algorithm>
#include <cstring>

namespace nearfield::render {
ComputeBuffers::ComputeBuffers(const gpu::Device& device)
    : device_(&device),
      input_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload,
             "nearfield compute input"),
      scratch_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               gpu::Direction::none, "nearfield compute scratch") {}

template <class... Vectors>
BufferPart ComputeBuffers::append(const char* what, const Vectors&... vectors) {
    const std::uint64_t step =
        std::max<std::uint64_t>(device_->limits().minStorageBufferOffsetAlignment, smallest_part);
    BufferPart part{input_.handle(), (end_ + step - 1) / step * step, (bytes_of(vectors) + ...)};
    require_range(*device_, part.bytes, what);
    std::byte* target = input_.data() + part.offset;
    const auto copy = [&](const auto& vector) {
        if (!vector.empty()) {
            std::memcpy(target, vector.data(), bytes_of(vector));
            target += bytes_of(vector);
        }
    };
    (copy(vectors), ...);
    part.bytes = std::max(part.bytes, smallest_part);
    end_ = part.offset + part.bytes;
    return part;
}

void ComputeBuffers::upload(const plan::TileBatch& batch) {
    const plan::ComputeWork& work = batch.compute;
    constexpr std::uint64_t parts = 7;
    const std::uint64_t between =
        parts * (device_->limits().minStorageBufferOffsetAlignment + smallest_part);
    input_.reserve(between + bytes_of(batch.tiles) + bytes_of(batch.points) +
                   bytes_of(work.blocks) + bytes_of(work.segments) + bytes_of(work.feature_blocks) +
                   bytes_of(batch.lists.geometry()) + bytes_of(work.points) +
                   work.ranges().words * sizeof(std::uint32_t));
    scratch_bytes_ = work.scratch_words() * sizeof(std::uint32_t);
    require_range(*device_, scratch_bytes_, "the masks");
    scratch_.reserve(std::max(scratch_bytes_, smallest_part));
    end_ = 0;
    tiles_ = append("the tiles", batch.tiles);
    points_ = append("the points", batch.points);
    blocks_ = append("the blocks of fields", work.blocks);
    segments_ = append("the edges near blocks of fields", work.segments);
    feature_blocks_ = append("the blocks of fields with features", work.feature_blocks);
    geometry_ = append("the edges", batch.lists.geometry(), work.points);
    work_ = append("the edges of masks", work.masks, work.edges, work.rows, work.polygons_a,
                   work.polygons_b, work.overlaps, work.overlap_rows);
    input_.flush();
}

void ComputeBuffers::bind(const passes::ComputeLayout& layout, const passes::TileBatchSets& sets,
                          const Output& output) const {
    using Layout = passes::ComputeLayout;
    const auto write = [&](VkDescriptorSet set, Layout::Binding binding, const BufferPart& part) {
        layout.write_buffer(set, binding, part.buffer, part.offset,
                            std::max(part.bytes, smallest_part));
    };
    const BufferPart scratch = scratch_part();
    write(sets.points_by_lists, Layout::tiles, tiles_);
    write(sets.points_by_lists, Layout::geometry, geometry_);
    write(sets.points_by_lists, Layout::points, points_);
    write(sets.points_by_lists, Layout::output, output.points);
    write(sets.masks, Layout::work, work_);
    write(sets.masks, Layout::scratch_of_masks, scratch);
    write(sets.masks, Layout::summaries, output.summaries);
    write(sets.masks, Layout::output, output.samples);
    write(sets.blocks, Layout::blocks, blocks_);
    write(sets.blocks, Layout::segments, segments_);
    write(sets.blocks, Layout::scratch_of_blocks, scratch);
    write(sets.blocks, Layout::output, output.field);
    write(sets.feature_blocks, Layout::tiles, feature_blocks_);
    write(sets.feature_blocks, Layout::geometry, geometry_);
    write(sets.feature_blocks, Layout::scratch_of_blocks, scratch);
    write(sets.feature_blocks, Layout::output, output.field);
}

}  // namespace nearfield::render
