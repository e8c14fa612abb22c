#include <engine/gpu/buffer_parts.hpp>
#include <engine/render/compute_buffers.hpp>
#include <engine/render/search_memory.hpp>

#include <algorithm>
#include <cstring>

namespace nearfield::render {
namespace {

/// Copies the contents of vectors, one after the other.
template <class... Vectors>
void copy_to(std::byte* target, const Vectors&... vectors) {
    const auto copy = [&](const auto& vector) {
        if (!vector.empty()) {
            std::memcpy(target, vector.data(), bytes_of(vector));
            target += bytes_of(vector);
        }
    };
    (copy(vectors), ...);
}

}  // namespace

ComputeBuffers::ComputeBuffers(const gpu::Device& device)
    : device_(&device),
      input_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload,
             "nearfield compute input"),
      scratch_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               gpu::Direction::none, "nearfield compute scratch"),
      shapes_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
              gpu::Direction::upload, "nearfield shapes in tiles"),
      crowd_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
             gpu::Direction::upload, "nearfield crowded blocks"),
      long_searches_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::readback,
                     "nearfield long searches") {}

template <class... Vectors>
BufferPart ComputeBuffers::append(const char* what, const Vectors&... vectors) {
    const std::uint64_t step =
        std::max<std::uint64_t>(device_->limits().minStorageBufferOffsetAlignment, smallest_part);
    BufferPart part{input_.handle(), (end_ + step - 1) / step * step, (bytes_of(vectors) + ...)};
    require_range(*device_, part.bytes, what);
    std::byte* target = input_.data() + part.offset;
    copy_to(target, vectors...);
    part.bytes = std::max(part.bytes, smallest_part);
    end_ = part.offset + part.bytes;
    return part;
}

void ComputeBuffers::upload(const plan::TileBatch& batch) {
    const plan::ComputeWork& work = batch.compute;
    constexpr std::uint64_t parts = 4;
    const std::uint64_t between =
        parts * (device_->limits().minStorageBufferOffsetAlignment + smallest_part);
    input_.reserve(between + bytes_of(batch.tiles) + bytes_of(batch.points) +
                   bytes_of(batch.lists.geometry()) + bytes_of(work.overlaps) +
                   bytes_of(work.field_rows));
    scratch_bytes_ = work.scratch_words() * sizeof(std::uint32_t);
    require_range(*device_, scratch_bytes_, "the masks and lists");
    scratch_.reserve(std::max(scratch_bytes_, smallest_part));
    end_ = 0;
    tiles_ = append("the tiles", batch.tiles);
    points_ = append("the points", batch.points);
    geometry_ = append("the edges", batch.lists.geometry());
    work_ = append("the rows of masks", work.overlaps, work.field_rows);
    input_.flush();
    shape_bytes_ = 0;
    if (work.shapes != nullptr) {
        upload_shapes(work);
    }
}

/// The shapes only if one of them changed.
void ComputeBuffers::upload_shapes(const plan::ComputeWork& work) {
    const auto shapes = std::as_bytes(work.shapes->units());
    const plan::FieldWork& fields = work.fields;
    shape_bytes_ = work.shape_bytes();
    shape_units_ = static_cast<std::uint32_t>(work.shapes->units().size());
    require_range(*device_, shape_bytes_, "the shapes");
    const bool is_new = reserve_with_texels(*device_, shapes_, texels_, shape_bytes_,
                                            "nearfield texels of shapes in tiles");
    if (is_new || work.shapes->revision() != revision_) {
        std::copy(shapes.begin(), shapes.end(), shapes_.data());
        revision_ = work.shapes->revision();
    }
    std::byte* target = shapes_.data() + shapes.size();
    copy_to(target, fields.tiles, fields.points, work.mask_shapes);
    shapes_.flush();
    crowd_.reserve(smallest_part);
    long_searches_.reserve(smallest_part);
}

void ComputeBuffers::empty_crowd() const {
    if (shape_bytes_ == 0) {
        return;
    }
    const VkDispatchIndirectCommand none{0, plan::groups_per_block, 1};
    std::memcpy(crowd_.data(), &none, sizeof(none));
    crowd_.flush();
    std::memset(long_searches_.data(), 0, sizeof(std::uint32_t));
    long_searches_.flush();
}

bool ComputeBuffers::had_long_searches() const {
    if (shape_bytes_ == 0) {
        return false;
    }
    long_searches_.invalidate();
    std::uint32_t count = 0;
    std::memcpy(&count, long_searches_.data(), sizeof(count));
    return count > 0;
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
    if (shape_bytes_ > 0) {
        const auto write_shapes = [&](VkDescriptorSet set) {
            write(set, Layout::shapes, {shapes_.handle(), 0, shape_bytes_});
            write(set, Layout::scratch_of_fields, scratch);
            write(set, Layout::output, output.field);
            layout.write_texels(set, Layout::texels, texels_.get());
        };
        write_shapes(sets.fields);
        write(sets.fields, Layout::crowd, {crowd_.handle(), 0, smallest_part});
        write_shapes(sets.places);
        write(sets.places, Layout::long_searches, {long_searches_.handle(), 0, smallest_part});
    }
}

}  // namespace nearfield::render
