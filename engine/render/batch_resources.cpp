#include <engine/base/status_exception.hpp>
#include <engine/gpu/buffer_parts.hpp>
#include <engine/render/batch_resources.hpp>

#include <algorithm>
#include <cstring>

namespace nearfield::render {
namespace {

template <class Element>
void copy_to(std::byte* target, const std::vector<Element>& elements) {
    if (!elements.empty()) {
        std::memcpy(target, elements.data(), bytes_of(elements));
    }
}

template <class Element>
std::uint64_t bytes_of_all(std::span<const std::vector<Element>> meshes) {
    std::uint64_t bytes = 0;
    for (const std::vector<Element>& mesh : meshes) {
        bytes += bytes_of(mesh);
    }
    return bytes;
}

std::span<const std::vector<plan::CellGroup>> groups_of(const plan::TileBatch& batch) {
    return batch.raster.groups;
}

/// One after the other.
template <class Element>
void copy_all_to(std::byte* target, std::span<const std::vector<Element>> meshes) {
    for (const std::vector<Element>& mesh : meshes) {
        copy_to(target, mesh);
        target += bytes_of(mesh);
    }
}

template <class Element>
std::span<const Element> elements_at(const gpu::MappedBuffer& buffer, std::uint64_t offset,
                                     std::uint64_t count) {
    return {reinterpret_cast<const Element*>(buffer.data() + offset), count};
}

}  // namespace

BatchResources::BatchResources(const gpu::Device& device, const graph::ComputeLayout& layout,
                               const PipelineSet& passes, bool timestamps)
    : device_(&device),
      layout_(&layout),
      pipelines_(&passes),
      submission_(device),
      timestamps_(device, 0, timestamps),
      mesh_(device, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, gpu::Direction::upload, "nearfield mesh"),
      input_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload, "nearfield input"),
      read_back_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                 gpu::Direction::readback, "nearfield read-back"),
      words_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
             gpu::Direction::none, "nearfield resident words"),
      resident_(device, layout),
      updates_(device) {
    make_room_for(1);
}

BatchResources::~BatchResources() {
    if (state_ == SubmissionState::submitted) {
        submission_.wait_to_the_end();
    }
}

void BatchResources::make_room_for(std::size_t tile_batches) {
    bound_.resize(std::max(bound_.size(), tile_batches));
    compute_.resize(std::max(compute_.size(), tile_batches));
}

std::uint64_t BatchResources::align(std::uint64_t offset) const {
    const std::uint64_t step =
        std::max<std::uint64_t>(device_->limits().minStorageBufferOffsetAlignment, smallest_part);
    return (offset + step - 1) / step * step;
}

void BatchResources::upload(std::span<const plan::TileBatch> tile_batches,
                            const plan::ResidentOutputs& resident) {
    make_room_for(tile_batches.size());
    is_searching_ = false;
    has_resident_outputs_ = !resident.empty();
    if (has_resident_outputs_) {
        resident_.upload(resident, pipelines_->exports());
    }
    tile_batches_.resize(tile_batches.size());
    std::uint64_t mesh_end = 0;
    std::uint64_t input_end = 0;
    for (std::size_t i = 0; i < tile_batches.size(); ++i) {
        tile_batches_[i].batch = &tile_batches[i];
        if (tile_batches[i].by_compute) {
            if (compute_[i] == nullptr) {
                compute_[i] = std::make_unique<ComputeBuffers>(*device_);
            }
            compute_[i]->upload(tile_batches[i]);
        } else {
            lay_out_input(tile_batches_[i], input_end, mesh_end);
        }
    }
    input_.reserve(input_end);
    mesh_.reserve(mesh_end);
    for (const TileBatchOnDevice& on_device : tile_batches_) {
        if (!on_device.batch->by_compute) {
            copy_input(on_device);
        }
    }
    input_.flush();
    mesh_.flush();
}

void BatchResources::upload_search(const plan::SearchShapes& shapes, const plan::GivenPairs& pairs,
                                   const PairCounts& expected) {
    if (search_ == nullptr) {
        search_ = std::make_unique<GivenSearch>(*device_, *layout_,
                                                pipelines_->pair_search(plan::given_pairs));
    }
    search_->upload(shapes, pairs, expected);
    if (has_resident_outputs_) {
        updates_.begin();
        resident_.bind_records(search_->shapes(), search_->found().scratch(),
                               pipelines_->exports().records, updates_);
        updates_.end();
    }
    timestamps_.reserve(passes_ + static_cast<std::uint32_t>(search_->found().count_passes()));
    is_searching_ = true;
}

void BatchResources::lay_out_input(TileBatchOnDevice& on_device, std::uint64_t& input_end,
                                   std::uint64_t& mesh_end) const {
    const plan::TileBatch& batch = *on_device.batch;
    const auto& geometry = batch.lists.geometry();
    require_range(*device_, bytes_of(geometry), "the edges");
    require_range(*device_, std::max(bytes_of(batch.points), bytes_of(batch.raster.field_points)),
                  "the points");
    InputParts& parts = on_device.input;
    parts.tiles = align(input_end);
    parts.groups_end = parts.tiles + bytes_of(batch.tiles) + bytes_of_all(groups_of(batch));
    parts.geometry = align(parts.groups_end);
    parts.points = align(parts.geometry + bytes_of(geometry));
    parts.field_points = align(parts.points + bytes_of(batch.points));
    parts.end = parts.field_points + bytes_of(batch.raster.field_points);
    input_end = parts.end + smallest_part;
    on_device.input.tile_meshes = mesh_end;
    on_device.input.meshes = mesh_end + bytes_of_all(batch.raster.meshes.tile_meshes());
    mesh_end = align(on_device.input.meshes + bytes_of_all(batch.raster.meshes.meshes()));
}

void BatchResources::copy_input(const TileBatchOnDevice& on_device) const {
    const plan::TileBatch& batch = *on_device.batch;
    const InputParts& parts = on_device.input;
    copy_to(input_.data() + parts.tiles, batch.tiles);
    copy_all_to(input_.data() + parts.tiles + bytes_of(batch.tiles), groups_of(batch));
    copy_to(input_.data() + parts.geometry, batch.lists.geometry());
    copy_to(input_.data() + parts.points, batch.points);
    copy_to(input_.data() + parts.field_points, batch.raster.field_points);
    copy_all_to(mesh_.data() + on_device.input.tile_meshes, batch.raster.meshes.tile_meshes());
    copy_all_to(mesh_.data() + on_device.input.meshes, batch.raster.meshes.meshes());
}

passes::RecordContext BatchResources::record_context(std::uint32_t number) const {
    const TileBatchOnDevice& on_device = tile_batches_[number];
    const bool by_compute = on_device.batch->by_compute;
    return {.batch = *on_device.batch,
            .mesh = mesh_.handle(),
            .mesh_offset = on_device.input.meshes,
            .tile_mesh_offset = on_device.input.tile_meshes,
            .shape_units = by_compute ? compute_[number]->shape_units() : 0,
            .sample_capacity = on_device.sample_capacity};
}

void BatchResources::run(std::uint32_t count) {
    running_.clear();
    for (std::uint32_t number = 0; number < count; ++number) {
        running_.push_back(number);
    }
}

void BatchResources::run_those_without_room() {
    has_resident_outputs_ = false;
    std::erase_if(running_, [&](std::uint32_t number) { return tile_batches_[number].had_room(); });
    for (const std::uint32_t number : running_) {
        tile_batches_[number].sample_capacity = tile_batches_[number].sample_count;
    }
    is_searching_ = is_searching_ && !search_->had_room();
    if (is_searching_) {
        search_->grow();
        timestamps_.reserve(passes_ + static_cast<std::uint32_t>(search_->found().count_passes()));
    }
}

VkCommandBuffer BatchResources::begin() {
    return submission_.begin();
}

void BatchResources::submit(const Submission& order) {
    submission_.submit(order);
    state_ = SubmissionState::submitted;
}

void BatchResources::end_recording(VkCommandBuffer commands, std::uint32_t stamp) {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdFillBuffer(commands, read_back_.handle(), stamp_offset_, sizeof(stamp), stamp);
    const VkBufferMemoryBarrier to_host{.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER,
                                        .pNext = nullptr,
                                        .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                        .dstAccessMask = VK_ACCESS_HOST_READ_BIT,
                                        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .buffer = read_back_.handle(),
                                        .offset = stamp_offset_,
                                        .size = sizeof(stamp)};
    functions.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                   VK_PIPELINE_STAGE_HOST_BIT, 0, 0, nullptr, 1, &to_host, 0,
                                   nullptr);
    stamp_ = stamp;
    state_ = SubmissionState::recorded;
}

void BatchResources::require_stamp() {
    std::uint32_t found = 0;
    std::memcpy(&found, read_back_.data() + stamp_offset_, sizeof(found));
    if (found != stamp_) {
        throw StatusException(
            {StatusCode::not_executed,
             "the frame of this batch counts as complete, but the device did not execute the "
             "commands recorded for it; was the command buffer submitted?"});
    }
}

void BatchResources::wait() {
    if (state_ == SubmissionState::submitted) {
        submission_.wait();
    }
    const bool recorded = state_ == SubmissionState::recorded;
    state_ = SubmissionState::none;
    read_back_.invalidate();
    if (recorded) {
        require_stamp();
    }
    if (is_searching_) {
        search_->read_back();
    }
    for (const std::uint32_t number : running_) {
        TileBatchOnDevice& on_device = tile_batches_[number];
        std::memcpy(&on_device.sample_count, read_back_.data() + on_device.output.samples,
                    sizeof(on_device.sample_count));
        on_device.had_long_searches =
            on_device.batch->by_compute && compute_[number]->had_long_searches();
    }
}

void BatchResources::release() {
    for (TileBatchOnDevice& on_device : tile_batches_) {
        on_device.graph = nullptr;
    }
}

std::span<const std::uint32_t> BatchResources::points(std::uint32_t number) const {
    const TileBatchOnDevice& on_device = tile_batches_[number];
    return elements_at<std::uint32_t>(read_back_, on_device.output.points,
                                      on_device.batch->points.size());
}

std::span<const std::uint32_t> BatchResources::field_words(std::uint32_t number) const {
    const TileBatchOnDevice& on_device = tile_batches_[number];
    return elements_at<std::uint32_t>(read_back_, on_device.output.field,
                                      on_device.batch->field_words);
}

std::span<const plan::TileSummary> BatchResources::summaries(std::uint32_t number) const {
    const TileBatchOnDevice& on_device = tile_batches_[number];
    return elements_at<plan::TileSummary>(read_back_, on_device.output.summaries,
                                          on_device.batch->tiles.size());
}

std::span<const plan::SampleData> BatchResources::samples(std::uint32_t number) const {
    const TileBatchOnDevice& on_device = tile_batches_[number];
    return elements_at<plan::SampleData>(
        read_back_, on_device.output.samples + sizeof(std::uint32_t), on_device.sample_count);
}

}  // namespace nearfield::render
