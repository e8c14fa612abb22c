#include <engine/buffer_parts.hpp>
#include <engine/render_slot.hpp>

#include <algorithm>
#include <cstring>

namespace nearfield {
namespace {

// All of points and fields, and three for each strategy.
constexpr std::uint32_t most_passes = 16 + 3 * intersection_strategies;

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
                 gpu::Direction::readback, "nearfield read-back") {
    make_room_for(1);
}

RenderSlot::~RenderSlot() {
    if (in_flight_) {
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

void RenderSlot::upload(std::span<const plan::Round> rounds) {
    make_room_for(rounds.size());
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
    std::erase_if(running_, [&](std::uint32_t number) { return rounds_[number].had_room(); });
    for (const std::uint32_t number : running_) {
        rounds_[number].frame.sample_capacity = rounds_[number].sample_count;
    }
}

void RenderSlot::lay_out_output() {
    std::uint64_t end = 0;
    for (const std::uint32_t number : running_) {
        RoundOnDevice& on_device = rounds_[number];
        const plan::Round& round = *on_device.frame.round;
        const std::uint64_t point_bytes = round.points.size() * sizeof(std::uint32_t);
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
    read_back_.reserve(end);
    for (const std::uint32_t number : running_) {
        RoundOnDevice& on_device = rounds_[number];
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
    const auto write = [&](VkDescriptorSet set, Layout::Binding binding,
                           const gpu::MappedBuffer& buffer, std::uint64_t from, std::uint64_t to) {
        layout_->write_buffer(set, binding, buffer.handle(), from,
                              std::max(to - from, smallest_part));
    };
    const auto write_tiles = [&](VkDescriptorSet set) {
        write(set, Layout::tiles, input_, input.tiles, input.tiles + bytes_of(round.tiles));
        write(set, Layout::geometry, input_, input.geometry,
              input.geometry + bytes_of(round.lists.geometry()));
    };
    if (needs.points) {
        write_tiles(frame.points);
        write(frame.points, Layout::points, input_, input.points, input.field_points);
        write(frame.points, Layout::output, read_back_, output.points, output.field);
    }
    const auto write_field = [&](VkDescriptorSet set) {
        write_tiles(set);
        write(set, Layout::points, input_, input.field_points, input.end);
        write(set, Layout::output, read_back_, output.field, output.summaries);
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
            write(frame.samples[i], Layout::summaries, read_back_, output.summaries,
                  output.samples);
            write(frame.samples[i], Layout::output, read_back_, output.samples, output.end);
        }
    }
    on_device.recipe->bind_images(*layout_, frame);
}

void RenderSlot::bind_compute(std::uint32_t number) const {
    const RoundOnDevice& on_device = rounds_[number];
    const OutputParts& parts = on_device.output;
    const auto part = [&](std::uint64_t from, std::uint64_t to) {
        return BufferPart{read_back_.handle(), from, to - from};
    };
    compute_[number]->bind(*layout_, on_device.frame,
                           {part(parts.points, parts.field), part(parts.field, parts.summaries),
                            part(parts.summaries, parts.samples), part(parts.samples, parts.end)});
}

void RenderSlot::hand_buffers_to(Recipe& recipe, std::uint32_t number) const {
    if (rounds_[number].frame.round->by_compute) {
        const ComputeBuffers& compute = *compute_[number];
        recipe.set_buffers(VK_NULL_HANDLE, compute.input(), compute.scratch(), read_back_.handle());
    } else {
        recipe.set_buffers(mesh_.handle(), input_.handle(), VK_NULL_HANDLE, read_back_.handle());
    }
}

VkCommandBuffer RenderSlot::begin() {
    return submission_.begin();
}

void RenderSlot::submit() {
    submission_.submit();
    in_flight_ = true;
}

void RenderSlot::wait() {
    submission_.wait();
    in_flight_ = false;
    read_back_.invalidate();
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
