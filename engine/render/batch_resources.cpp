#include <engine/base/status_exception.hpp>
#include <engine/render/batch_resources.hpp>

#include <cstring>
#include <utility>

namespace nearfield::render {

BatchResources::BatchResources(const gpu::Device& device, const graph::ComputeLayout& layout,
                               const PipelineSet& passes, TileTechnique* drawn,
                               ComputeTechnique& computed, bool timestamps)
    : device_(&device),
      layout_(&layout),
      pipelines_(&passes),
      submission_(device),
      timestamps_(device, 0, timestamps),
      resident_(device, layout),
      updates_(device),
      stamp_buffer_(device, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::Direction::readback,
                    "nearfield stamp") {
    if (drawn != nullptr) {
        tiles_.push_back(drawn->make_work());
    }
    auto own = computed.make_computed();
    computed_ = own.get();
    tiles_.push_back(std::move(own));
}

BatchResources::~BatchResources() {
    if (state_ == SubmissionState::submitted) {
        submission_.wait_to_the_end();
    }
}

void BatchResources::prepare(const device_input::ResidentOutputs& resident, SampleRoom room) {
    is_searching_ = false;
    has_resident_outputs_ = !resident.empty();
    if (has_resident_outputs_) {
        resident_.upload(resident, pipelines_->exports());
    }
    for (const auto& tiles : tiles_) {
        tiles->prepare(room);
    }
}

bool BatchResources::select_those_without_room() {
    has_resident_outputs_ = false;
    bool any = false;
    for (const auto& tiles : tiles_) {
        tiles->select_those_without_room();
        any = any || !tiles->running().empty();
    }
    is_searching_ = is_searching_ && !search_->had_room();
    if (is_searching_) {
        search_->grow();
        timestamps_.reserve(passes_ + static_cast<std::uint32_t>(search_->found().count_passes()));
    }
    return any || is_searching_;
}

void BatchResources::lay_out_output() {
    stamp_buffer_.reserve(sizeof(stamp_));
    std::memset(stamp_buffer_.data(), 0, sizeof(stamp_));
    stamp_buffer_.flush();
    updates_.begin();
    for (const auto& tiles : tiles_) {
        tiles->lay_out_output(updates_);
    }
    if (has_resident_outputs_) {
        gpu::BufferPart none;
        const auto words = computed_->words(none);
        resident_.bind(words, none, pipelines_->exports(), updates_);
    }
    updates_.end();
    reserve_timestamps();
}

void BatchResources::reserve_timestamps() {
    std::size_t passes = 0;
    for (const auto& tiles : tiles_) {
        passes += tiles->pass_count();
    }
    if (has_resident_outputs_) {
        passes += resident_.count_passes(pipelines_->exports());
    }
    passes_ = static_cast<std::uint32_t>(passes);
    timestamps_.reserve(passes_);
}

void BatchResources::upload_search(const device_input::SearchShapes& shapes,
                                   const device_input::GivenPairs& pairs,
                                   const PairCounts& expected) {
    if (search_ == nullptr) {
        search_ = std::make_unique<GivenSearch>(*device_, *layout_,
                                                pipelines_->pair_search(device_input::given_pairs));
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

VkCommandBuffer BatchResources::begin() {
    return submission_.begin();
}

void BatchResources::submit(const Submission& order) {
    submission_.submit(order);
    state_ = SubmissionState::submitted;
}

void BatchResources::end_recording(VkCommandBuffer commands, std::uint32_t stamp) {
    const gpu::Functions& functions = device_->functions();
    functions.vkCmdFillBuffer(commands, stamp_buffer_.handle(), 0, sizeof(stamp), stamp);
    const VkBufferMemoryBarrier to_host{.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER,
                                        .pNext = nullptr,
                                        .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                        .dstAccessMask = VK_ACCESS_HOST_READ_BIT,
                                        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .buffer = stamp_buffer_.handle(),
                                        .offset = 0,
                                        .size = sizeof(stamp)};
    functions.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                   VK_PIPELINE_STAGE_HOST_BIT, 0, 0, nullptr, 1, &to_host, 0,
                                   nullptr);
    stamp_ = stamp;
    state_ = SubmissionState::recorded;
}

void BatchResources::require_stamp() {
    std::uint32_t found = 0;
    stamp_buffer_.invalidate();
    std::memcpy(&found, stamp_buffer_.data(), sizeof(found));
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
    if (recorded) {
        require_stamp();
    }
    if (is_searching_) {
        search_->read_back();
    }
    for (const auto& tiles : tiles_) {
        tiles->read_back();
    }
}

void BatchResources::release() {
    for (const auto& tiles : tiles_) {
        tiles->release();
    }
}

}  // namespace nearfield::render
