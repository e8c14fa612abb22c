#include <engine/buffer_parts.hpp>
#include <engine/render_slot.hpp>

#include <algorithm>
#include <cstring>

namespace nearfield {
namespace {

// All of points and fields, and three for each strategy.
constexpr std::uint32_t most_passes = 16 + 3 * intersection_strategies;

// Beside those of the rounds: what is copied back; a pass for each field that stays on the device,
// three for each query with records there.
std::uint32_t hand_over_passes(const plan::HandOver& hand_over) {
    return static_cast<std::uint32_t>(1 + hand_over.fields.size() + 3 * hand_over.records.size());
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

void RenderSlot::lay_out_output() {
    std::uint64_t end = 0;
    bool any_resident = false;
    for (const std::uint32_t number : running_) {
        RoundOnDevice& on_device = rounds_[number];
        const plan::Round& round = *on_device.frame.round;
        any_resident = any_resident || round.resident;
        const std::uint64_t point_bytes =
            round.points.size() *
            (sizeof(std::uint32_t) + (round.resident ? sizeof(plan::PointDetails) : 0));
        const std::uint64_t field_bytes = round.field_words * sizeof(std::uint32_t);
        const std::uint64_t summary_bytes = round.tiles.size() * sizeof(plan::TileSummary);
        const std::uint64_t sample_bytes =
            sizeof(std::uint32_t) + on_device.frame.sample_capacity * sizeof(plan::SampleData);
        require_range(*device_, std::max({point_bytes, field_bytes, summary_bytes, sample_bytes}),
                      "the results");
        OutputParts& parts = on_device.output;
        parts.points = align(end);
        parts.field = align(parts.points + point_bytes);
        parts.summaries = align(parts.field + field_bytes);
        parts.samples = align(parts.summaries + summary_bytes);
        parts.end = parts.samples + sample_bytes;
        end = parts.end + smallest_part;
    }
    stamp_offset_ = align(end);
    read_back_.reserve(stamp_offset_ + sizeof(stamp_));
    std::memset(read_back_.data() + stamp_offset_, 0, sizeof(stamp_));
    copies_.clear();
    if (is_to_hand_over_ || any_resident) {
        words_.reserve(std::max(end, smallest_part));
    }
    for (const std::uint32_t number : running_) {
        RoundOnDevice& on_device = rounds_[number];
        find_copies(on_device);
        on_device.frame.mesh = mesh_.handle();
        on_device.frame.read_back = read_back_.handle();
        on_device.frame.summaries_offset = on_device.output.summaries;
        empty_output(on_device);
        if (on_device.frame.round->by_compute) {
            bind_compute(number);
        } else {
            bind(on_device);
        }
    }
    read_back_.flush();
    if (is_to_hand_over_) {
        bind_hand_over();
    }
}

VkBuffer RenderSlot::words_of(const RoundOnDevice& on_device) const {
    return on_device.frame.round->resident ? words_.handle() : read_back_.handle();
}

void RenderSlot::find_copies(const RoundOnDevice& on_device) {
    const plan::Round& round = *on_device.frame.round;
    if (!round.resident) {
        return;
    }
    const auto copy = [this](std::uint64_t first_byte, std::uint64_t words) {
        copies_.push_back({first_byte, first_byte, words * sizeof(std::uint32_t)});
    };
    if (!round.points.empty()) {
        copy(on_device.output.points, round.points.size());
    }
    for (const plan::WordRange& range : round.field_read_back) {
        copy(on_device.output.field + range.first * sizeof(std::uint32_t), range.count);
    }
}

void RenderSlot::bind_hand_over() {
    hand_over_words_.clear();
    for (const RoundOnDevice& round : rounds_) {
        const OutputParts& parts = round.output;
        const VkBuffer buffer = words_of(round);
        hand_over_words_.push_back({{buffer, parts.points, parts.field - parts.points},
                                    {buffer, parts.field, parts.summaries - parts.field},
                                    static_cast<std::uint32_t>(round.frame.round->points.size())});
    }
    hand_over_.bind(hand_over_words_, {words_.handle(), 0, smallest_part});
}

void RenderSlot::empty_output(const RoundOnDevice& on_device) const {
    const plan::TileSummary empty;
    const OutputParts& parts = on_device.output;
    std::memset(read_back_.data() + parts.samples, 0, sizeof(std::uint32_t));
    for (std::size_t i = 0; i < on_device.frame.round->tiles.size(); ++i) {
        std::memcpy(read_back_.data() + parts.summaries + i * sizeof(empty), &empty, sizeof(empty));
    }
}

void RenderSlot::bind(const RoundOnDevice& on_device) const {
    using Layout = passes::ComputeLayout;
    const plan::Round& round = *on_device.frame.round;
    const passes::Frame& frame = on_device.frame;
    const InputParts& input = on_device.input;
    const OutputParts& output = on_device.output;
    const Needs needs = on_device.recipe->needs();
    // A range of no bytes is not allowed; a pass without work reads nothing.
    const auto write = [&](VkDescriptorSet set, Layout::Binding binding, VkBuffer buffer,
                           std::uint64_t from, std::uint64_t to) {
        layout_->write_buffer(set, binding, buffer, from, std::max(to - from, smallest_part));
    };
    const auto write_tiles = [&](VkDescriptorSet set) {
        write(set, Layout::tiles, input_.handle(), input.tiles,
              input.tiles + bytes_of(round.tiles));
        write(set, Layout::geometry, input_.handle(), input.geometry,
              input.geometry + bytes_of(round.lists.geometry()));
    };
    if (needs.points) {
        write_tiles(frame.points);
        write(frame.points, Layout::points, input_.handle(), input.points, input.field_points);
        write(frame.points, Layout::output, words_of(on_device), output.points, output.field);
    }
    const auto write_field = [&](VkDescriptorSet set) {
        write_tiles(set);
        write(set, Layout::points, input_.handle(), input.field_points, input.end);
        write(set, Layout::output, words_of(on_device), output.field, output.summaries);
    };
    for (std::size_t encoding = 0; encoding < passes::sign_encodings; ++encoding) {
        if (needs.field[encoding]) {
            write_field(frame.field[encoding]);
        }
    }
    if (needs.blended) {
        write_field(frame.gradients);
    }
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        if (needs.overlap[i]) {
            write_tiles(frame.samples[i]);
            write(frame.samples[i], Layout::summaries, read_back_.handle(), output.summaries,
                  output.samples);
            write(frame.samples[i], Layout::output, read_back_.handle(), output.samples,
                  output.end);
        }
    }
    on_device.recipe->bind_images(*layout_, frame);
}

void RenderSlot::bind_compute(std::uint32_t number) const {
    const RoundOnDevice& on_device = rounds_[number];
    const OutputParts& parts = on_device.output;
    const VkBuffer words = words_of(on_device);
    const VkBuffer read_back = read_back_.handle();
    compute_[number]->bind(*layout_, on_device.frame,
                           {{words, parts.points, parts.field - parts.points},
                            {words, parts.field, parts.summaries - parts.field},
                            {read_back, parts.summaries, parts.samples - parts.summaries},
                            {read_back, parts.samples, parts.end - parts.samples}});
}

void RenderSlot::hand_buffers_to(Recipe& recipe, std::uint32_t number) const {
    const VkBuffer words = words_of(rounds_[number]);
    if (rounds_[number].frame.round->by_compute) {
        const ComputeBuffers& compute = *compute_[number];
        recipe.set_buffers(
            {VK_NULL_HANDLE, compute.input(), compute.scratch(), words, read_back_.handle()});
    } else {
        recipe.set_buffers(
            {mesh_.handle(), input_.handle(), VK_NULL_HANDLE, words, read_back_.handle()});
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
