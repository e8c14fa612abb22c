#include <engine/buffer_parts.hpp>
#include <engine/failure.hpp>
#include <engine/render_slot.hpp>

#include <algorithm>
#include <cstring>

namespace nearfield {
namespace {

// All of points and fields, and three for each strategy.
constexpr std::uint32_t most_passes = 16 + 3 * intersection_strategies;

// Beside those of the rounds: what is copied back; a pass for each field that stays on the device,
// three for each query with records or samples there.
std::uint32_t hand_over_passes(const plan::HandOver& hand_over) {
    return static_cast<std::uint32_t>(1 + hand_over.fields.size() + 3 * hand_over.records.size() +
                                      3 * hand_over.samples.size());
}

template <class Element>
void copy_to(std::byte* target, const std::vector<Element>& elements) {
    if (!elements.empty()) {
        std::memcpy(target, elements.data(), bytes_of(elements));
    }
}

template <class Element>
std::span<const Element> elements_at(const gpu::MappedBuffer& buffer, std::uint64_t offset,
                                     std::uint64_t count) {
    return {reinterpret_cast<const Element*>(buffer.data() + offset), count};
}

}  // namespace

RenderSlot::RenderSlot(const gpu::Device& device, const passes::ComputeLayout& layout)
    : device_(&device),
      layout_(&layout),
      submission_(device),
      timestamps_(device, most_passes),
      mesh_(device, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, gpu::Direction::upload, "nearfield mesh"),
      input_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload, "nearfield input"),
      read_back_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                 gpu::Direction::readback, "nearfield read-back"),
      words_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
             gpu::Direction::none, "nearfield resident words"),
      hand_over_(device, layout) {
    make_room_for(1);
}

RenderSlot::~RenderSlot() {
    if (flight_ == Flight::submitted) {
        submission_.wait_to_the_end();
    }
}

void RenderSlot::make_room_for(std::size_t rounds) {
    while (sets_.size() < rounds) {
        sets_.emplace_back(*device_, *layout_);
    }
    compute_.resize(std::max(compute_.size(), rounds));
    timestamps_.reserve(static_cast<std::uint32_t>(rounds) * most_passes);
}

std::uint64_t RenderSlot::align(std::uint64_t offset) const {
    const std::uint64_t step =
        std::max<std::uint64_t>(device_->limits().minStorageBufferOffsetAlignment, smallest_part);
    return (offset + step - 1) / step * step;
}

void RenderSlot::upload(std::span<const plan::Round> rounds, const plan::HandOver& hand_over) {
    make_room_for(rounds.size());
    is_to_hand_over_ = !hand_over.empty();
    if (is_to_hand_over_) {
        timestamps_.reserve(static_cast<std::uint32_t>(rounds.size()) * most_passes +
                            hand_over_passes(hand_over));
        hand_over_.upload(hand_over);
    }
    rounds_.resize(rounds.size());
    std::uint64_t mesh_end = 0;
    std::uint64_t input_end = 0;
    for (std::size_t i = 0; i < rounds.size(); ++i) {
        passes::Frame& frame = rounds_[i].frame;
        frame.round = &rounds[i];
        frame.subpixel_bits = device_->limits().subPixelPrecisionBits;
        sets_[i].hand_to(frame);
        if (rounds[i].by_compute) {
            if (compute_[i] == nullptr) {
                compute_[i] = std::make_unique<ComputeBuffers>(*device_);
            }
            compute_[i]->upload(rounds[i]);
            frame.scratch = compute_[i]->scratch();
        } else {
            lay_out_input(rounds_[i], input_end, mesh_end);
        }
    }
    input_.reserve(input_end);
    mesh_.reserve(mesh_end);
    for (const RoundOnDevice& round : rounds_) {
        if (!round.frame.round->by_compute) {
            copy_input(round);
        }
    }
    input_.flush();
    mesh_.flush();
}

void RenderSlot::lay_out_input(RoundOnDevice& on_device, std::uint64_t& input_end,
                               std::uint64_t& mesh_end) const {
    const plan::Round& round = *on_device.frame.round;
    const auto& geometry = round.lists.geometry();
    require_range(*device_, bytes_of(geometry), "the edges");
    require_range(*device_, std::max(bytes_of(round.points), bytes_of(round.field_points)),
                  "the points");
    InputParts& parts = on_device.input;
    parts.tiles = align(input_end);
    parts.geometry = align(parts.tiles + bytes_of(round.tiles));
    parts.points = align(parts.geometry + bytes_of(geometry));
    parts.field_points = align(parts.points + bytes_of(round.points));
    parts.end = parts.field_points + bytes_of(round.field_points);
    input_end = parts.end + smallest_part;
    on_device.frame.mesh_offset = mesh_end;
    mesh_end = align(mesh_end + bytes_of(round.mesh));
}

void RenderSlot::copy_input(const RoundOnDevice& on_device) const {
    const plan::Round& round = *on_device.frame.round;
    const InputParts& parts = on_device.input;
    copy_to(input_.data() + parts.tiles, round.tiles);
    copy_to(input_.data() + parts.geometry, round.lists.geometry());
    copy_to(input_.data() + parts.points, round.points);
    copy_to(input_.data() + parts.field_points, round.field_points);
    copy_to(mesh_.data() + on_device.frame.mesh_offset, round.mesh);
}

void RenderSlot::run(std::uint32_t count) {
    running_.clear();
    for (std::uint32_t number = 0; number < count; ++number) {
        running_.push_back(number);
    }
}

void RenderSlot::run_those_without_room() {
    is_to_hand_over_ = false;
    std::erase_if(running_, [&](std::uint32_t number) { return rounds_[number].had_room(); });
    for (const std::uint32_t number : running_) {
        rounds_[number].frame.sample_capacity = rounds_[number].sample_count;
    }
}

VkCommandBuffer RenderSlot::begin() {
    return submission_.begin();
}

void RenderSlot::submit(const Submission& order) {
    submission_.submit(order);
    flight_ = Flight::submitted;
}

void RenderSlot::end_recording(VkCommandBuffer commands, std::uint32_t stamp) {
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
    flight_ = Flight::recorded;
}

void RenderSlot::require_stamp() {
    std::uint32_t found = 0;
    std::memcpy(&found, read_back_.data() + stamp_offset_, sizeof(found));
    if (found != stamp_) {
        throw Failure({StatusCode::not_executed,
                       "the host says that the frame of this batch is complete, but the device "
                       "did not execute the commands recorded for it; was the command buffer "
                       "submitted?"});
    }
}

void RenderSlot::wait() {
    if (flight_ == Flight::submitted) {
        submission_.wait();
    }
    const bool recorded = flight_ == Flight::recorded;
    flight_ = Flight::none;
    read_back_.invalidate();
    if (recorded) {
        require_stamp();
    }
    for (const std::uint32_t number : running_) {
        RoundOnDevice& round = rounds_[number];
        std::memcpy(&round.sample_count, read_back_.data() + round.output.samples,
                    sizeof(round.sample_count));
    }
}

void RenderSlot::release() {
    for (RoundOnDevice& round : rounds_) {
        round.recipe = nullptr;
    }
}

std::span<const std::uint32_t> RenderSlot::points(std::uint32_t number) const {
    const RoundOnDevice& round = rounds_[number];
    return elements_at<std::uint32_t>(read_back_, round.output.points,
                                      round.frame.round->points.size());
}

std::span<const std::uint32_t> RenderSlot::field_words(std::uint32_t number) const {
    const RoundOnDevice& round = rounds_[number];
    return elements_at<std::uint32_t>(read_back_, round.output.field,
                                      round.frame.round->field_words);
}

std::span<const plan::TileSummary> RenderSlot::summaries(std::uint32_t number) const {
    const RoundOnDevice& round = rounds_[number];
    return elements_at<plan::TileSummary>(read_back_, round.output.summaries,
                                          round.frame.round->tiles.size());
}

std::span<const plan::SampleData> RenderSlot::samples(std::uint32_t number) const {
    const RoundOnDevice& round = rounds_[number];
    return elements_at<plan::SampleData>(read_back_, round.output.samples + sizeof(std::uint32_t),
                                         round.sample_count);
}

}  // namespace nearfield
