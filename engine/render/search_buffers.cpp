#include <engine/base/status_exception.hpp>
#include <engine/gpu/buffer_parts.hpp>
#include <engine/render/search_buffers.hpp>
#include <engine/render/search_memory.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace nearfield::render {
namespace {

constexpr std::array<const char*, 1> names_of_sets{"nearfield search set"};

std::uint32_t rounded_up(double value) {
    return static_cast<std::uint32_t>(std::ceil(value));
}

/// Of so many points, and of their depths behind them.
std::uint64_t bytes_of_found(std::uint32_t count) {
    return std::max<std::uint64_t>(count, 1) * (sizeof(plan::FoundPointData) + sizeof(float));
}

}  // namespace

SearchBuffers::SearchBuffers(const gpu::Device& device, const passes::ComputeLayout& layout)
    : device_(&device),
      layout_(&layout),
      input_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
             gpu::Direction::upload, "nearfield search input"),
      scratch_(device, scratch_usage, gpu::Direction::none, "nearfield search scratch"),
      records_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::readback,
               "nearfield found points"),
      arguments_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                 gpu::Direction::readback, "nearfield search arguments"),
      sets_(device, layout, names_of_sets) {
    arguments_.reserve(argument_bytes(plan::stages));
    item_.set = sets_[0];
}

void SearchBuffers::upload(const plan::SearchShapes& shapes, const plan::PointSearch& search,
                           const SearchCounts& expected) {
    const auto shape_bytes = std::as_bytes(shapes.units());
    const auto directions = std::as_bytes(std::span(search.directions));
    const auto blocks = std::as_bytes(std::span(search.first_directions));
    input_bytes_ = shape_bytes.size() + directions.size() + blocks.size();
    require_range(*device_, input_bytes_, "the shapes and queries");
    const bool is_new =
        reserve_with_texels(*device_, input_, texels_, input_bytes_, "nearfield search texels");
    std::byte* target = input_.data();
    if (is_new || shapes.revision() != revision_) {
        std::copy(shape_bytes.begin(), shape_bytes.end(), target);
        revision_ = shapes.revision();
    }
    target += shape_bytes.size();
    target = std::copy(directions.begin(), directions.end(), target);
    std::copy(blocks.begin(), blocks.end(), target);
    input_.flush();
    item_.push.items = search.items;
    item_.push.summarizes = search.summarizes ? 1 : 0;
    item_.push.directions = static_cast<std::uint32_t>(shapes.units().size());
    item_.push.direction_count = static_cast<std::uint32_t>(search.directions.size());
    const std::uint32_t max_edges = rounded_up(search.max_edges);
    const std::uint32_t max_points = rounded_up(search.max_points);
    // The threads of each direction, and of each of its blocks of edges, may have room for a few
    // points more.
    const std::uint32_t max_parts = item_.push.direction_count + max_edges / plan::search_block + 1;
    const std::uint32_t max_padding = (plan::points_per_thread - 1) * max_parts;
    max_counts_ = {max_edges, max_points + max_padding, max_points};
    lay_out(expected);
}

void SearchBuffers::lay_out(const SearchCounts& expected) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
        item_.capacities[i] = std::min(expected[i], max_counts_[i]);
    }
    const auto [edges, points, found] = item_.capacities;
    ScratchLayout layout;
    layout.add_stages(item_.push.items, edges, points, 0, item_.push);
    scratch_bytes_ = layout.bytes();
    reserve_with_texels(*device_, scratch_, scratch_texels_, scratch_bytes_,
                        "nearfield search scratch texels");
    records_.reserve(bytes_of_found(found));
    clear_counts(arguments_, plan::stages);
    item_.input = input_.handle();
    item_.scratch = scratch_.handle();
    item_.records = records_.handle();
    item_.arguments = arguments_.handle();
    bind();
}

void SearchBuffers::bind() const {
    using Layout = passes::ComputeLayout;
    const auto write = [this](Layout::Binding binding, VkBuffer buffer, std::uint64_t bytes) {
        layout_->write_buffer(item_.set, binding, buffer, 0, bytes);
    };
    layout_->begin_updates();
    write(Layout::tiles, item_.input, input_bytes_);
    write(Layout::geometry, item_.scratch, scratch_bytes_);
    write(Layout::points, item_.records, bytes_of_found(item_.capacities[plan::record_total]));
    write(Layout::output, item_.arguments, argument_bytes(plan::stages));
    layout_->write_texels(item_.set, Layout::texels, texels_.get());
    layout_->write_texels(item_.set, Layout::scratch_texels, scratch_texels_.get());
    layout_->end_updates();
}

void SearchBuffers::read_back() {
    read_counts(arguments_, counts_);
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        if (counts_[i] > max_counts_[i]) {
            throw StatusException({StatusCode::device_error, "a search for points counted " +
                                                                 std::to_string(counts_[i]) +
                                                                 " where there are at most " +
                                                                 std::to_string(max_counts_[i])});
        }
    }
    if (had_room()) {
        records_.invalidate();
    }
}

bool SearchBuffers::had_room() const {
    return have_room(counts_, item_.capacities);
}

void SearchBuffers::grow() {
    SearchCounts expected = item_.capacities;
    double growth = 1.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        // A stage that came after one without room counted only a part.
        const double counted = growth * counts_[i];
        growth = std::max(growth, counted / std::max(1.0, 1.0 * expected[i]));
        expected[i] = static_cast<std::uint32_t>(
            std::min(1.0 * max_counts_[i], std::max(1.0 * expected[i], std::ceil(counted))));
    }
    lay_out(expected);
}

std::span<const plan::FoundPointData> SearchBuffers::found() const {
    return {reinterpret_cast<const plan::FoundPointData*>(records_.data()),
            counts_[plan::record_total]};
}

std::span<const float> SearchBuffers::depths() const {
    const std::byte* const behind =
        records_.data() + item_.capacities[plan::record_total] * sizeof(plan::FoundPointData);
    return {reinterpret_cast<const float*>(behind), counts_[plan::record_total]};
}

}  // namespace nearfield::render
