#include <engine/base/status_exception.hpp>
#include <engine/gpu/buffer_parts.hpp>
#include <engine/render/given_search.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

namespace nearfield::render {
namespace {

/// Vulkan promises that so much can be allocated at once.
constexpr std::uint64_t largest_allocation = std::uint64_t{1} << 30U;

/// More than any buffer has room for stays more.
std::uint32_t rounded_up(double count) {
    return static_cast<std::uint32_t>(std::min(std::ceil(count), 1.0 * UINT32_MAX));
}

/// How much a search of these can count.
PairCounts most_of(const device_input::GivenPairs& pairs) {
    const auto count = static_cast<std::uint32_t>(pairs.directions.size());
    // The threads of each direction, and of each of its blocks of edges, may have room for a few
    // points more.
    const double parts = count + pairs.max_edges / shaders::search_block + 1.0;
    const double padding = (shaders::points_per_thread - 1.0) * parts;
    PairCounts most{};
    most[shaders::pair_total] = most[shaders::row_total] = count;
    most[shaders::item_total] = pairs.items;
    most[shaders::edge_total] = rounded_up(pairs.max_edges);
    most[shaders::point_total] = rounded_up(pairs.max_points + padding);
    most[shaders::record_total] = rounded_up(pairs.max_points);
    return most;
}

}  // namespace

GivenSearch::GivenSearch(const gpu::Device& device, const graph::ComputeLayout& layout,
                         const passes::PairSearch& search)
    : device_(&device),
      shapes_(device),
      pairs_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload,
             "nearfield given pairs"),
      memory_(device, layout, search, device_input::given_pairs, {}, false) {}

void GivenSearch::upload(const device_input::SearchShapes& shapes,
                         const device_input::GivenPairs& pairs, const PairCounts& expected) {
    const auto directions = std::as_bytes(std::span(pairs.directions));
    pair_bytes_ = directions.size();
    require_range(*device_, std::max<std::uint64_t>(pair_bytes_, shapes.units().size_bytes()),
                  "the shapes and queries");
    shapes_.upload(shapes);
    pairs_.reserve(pair_bytes_);
    std::copy(directions.begin(), directions.end(), pairs_.data());
    pairs_.flush();
    most_ = most_of(pairs);
    PairCounts known{};
    known[shaders::pair_total] = most_[shaders::pair_total];
    known[shaders::item_total] = most_[shaders::item_total];
    PairCounts room{};
    for (std::size_t stage = 0; stage < room.size(); ++stage) {
        room[stage] = std::min(most_[stage], expected[stage]);
    }
    memory_.capacities().set_given(known, room);
    lay_out();
}

void GivenSearch::lay_out() {
    memory_.lay_out({shapes_.part(), pairs_.part(0, pair_bytes_), 0},
                    {.reach = std::min<std::uint64_t>(device_->limits().maxStorageBufferRange,
                                                      largest_allocation),
                     .memory = std::numeric_limits<std::uint64_t>::max()});
    memory_.clear_counts();
}

void GivenSearch::read_back() {
    memory_.read_counts();
    counts_ = {};
    for (const PairCounts& part : memory_.counts()) {
        for (std::size_t stage = 0; stage < counts_.size(); ++stage) {
            counts_[stage] += part[stage];
        }
    }
    for (std::size_t stage = 0; stage < counts_.size(); ++stage) {
        if (counts_[stage] > most_[stage]) {
            throw StatusException({StatusCode::device_error,
                                   "a search for points counted " + std::to_string(counts_[stage]) +
                                       " where there are at most " + std::to_string(most_[stage])});
        }
    }
    if (memory_.had_room()) {
        memory_.read_results();
    }
}

void GivenSearch::grow() {
    memory_.grow();
    lay_out();
}

}  // namespace nearfield::render
