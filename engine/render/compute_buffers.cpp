#include <engine/gpu/buffer_parts.hpp>
#include <engine/render/compute_buffers.hpp>

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
      scratch_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
               gpu::Direction::none, "nearfield compute scratch"),
      shapes_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
              gpu::Direction::upload, "nearfield shapes in tiles"),
      crowd_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
             gpu::Direction::upload, "nearfield crowded blocks"),
      long_searches_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::readback,
                     "nearfield long searches") {}

void ComputeBuffers::upload(const device_input::ComputeBatch& batch) {
    const device_input::ComputeWork& work = batch.work;
    scratch_bytes_ = work.scratch_words() * sizeof(std::uint32_t);
    require_range(*device_, scratch_bytes_, "the masks and lists");
    scratch_.reserve(std::max(scratch_bytes_, smallest_part));
    shape_bytes_ = 0;
    if (work.shapes != nullptr) {
        upload_shapes(work);
    }
}

/// The shapes only if one of them changed.
void ComputeBuffers::upload_shapes(const device_input::ComputeWork& work) {
    const auto shapes = std::as_bytes(work.shapes->units());
    const device_input::FieldWork& fields = work.fields;
    shape_bytes_ = work.shape_bytes();
    shape_units_ = static_cast<std::uint32_t>(work.shapes->units().size());
    require_range(*device_, shape_bytes_, "the shapes");
    const bool is_new = shapes_.reserve(shape_bytes_);
    if (is_new || work.shapes->revision() != revision_) {
        std::copy(shapes.begin(), shapes.end(), shapes_.data());
        revision_ = work.shapes->revision();
    }
    std::byte* target = shapes_.data() + shapes.size();
    copy_to(target, fields.tiles, fields.points, work.mask_shapes, work.overlaps);
    shapes_.flush();
    crowd_.reserve(smallest_part);
    long_searches_.reserve(smallest_part);
}

void ComputeBuffers::empty_crowd() const {
    if (shape_bytes_ == 0) {
        return;
    }
    const VkDispatchIndirectCommand none{0, shaders::groups_per_block, 1};
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

void ComputeBuffers::bind(const ComputeHandles& handles, graph::BoundResources& resources) const {
    resources.set(handles.scratch, scratch());
    resources.set(handles.shapes, shapes_.part(0, shape_bytes_));
    resources.set(handles.crowd, crowd_.part(0, smallest_part));
    resources.set(handles.long_searches, long_searches_.part(0, smallest_part));
}

}  // namespace nearfield::render
