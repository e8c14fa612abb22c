#include <engine/base/status_exception.hpp>
#include <engine/render/search_memory.hpp>

#include <algorithm>
#include <cstring>
#include <numeric>

namespace nearfield::render {
namespace {

constexpr std::uint64_t bytes_of_counts = shaders::words_of_counts * sizeof(std::uint32_t);
/// Those of the dispatches of all stages.
constexpr std::uint64_t bytes_of_arguments =
    std::uint64_t{shaders::stages_of_pairs} * shaders::words_of_arguments * sizeof(std::uint32_t);

bool have_room(const PairCounts& counts, const PairCounts& capacities, double headroom = 1.0) {
    return std::equal(
        counts.begin(), counts.end(), capacities.begin(),
        [headroom](std::uint32_t count, std::uint32_t room) { return headroom * count <= room; });
}

PairTableCounts table_counts(const PairCounts& counts) {
    return {.pairs = counts[shaders::pair_total],
            .points = counts[shaders::record_total],
            .rows = counts[shaders::row_total],
            .edge_groups = counts[shaders::item_total],
            .edges = counts[shaders::edge_total],
            .tested_points = counts[shaders::point_total]};
}

}  // namespace

std::uint32_t ScratchLayout::words(std::uint64_t count) {
    const std::uint64_t first = words_;
    words_ += (count + 3) / 4 * 4;
    return static_cast<std::uint32_t>(first);
}

std::uint32_t ScratchLayout::sums(std::uint64_t elements) {
    // A dispatch of several rows has up to one workgroup fewer than rows too many (totals.glsl).
    const std::uint64_t workgroups = elements / shaders::search_block + 1;
    const std::uint64_t rows = workgroups / shaders::max_workgroups + 1;
    return words(workgroups + rows);
}

void ScratchLayout::add_stages(std::uint64_t items, std::uint64_t edges, std::uint64_t points,
                               std::uint64_t others, shaders::SearchPush& push) {
    const std::uint64_t threads = points / shaders::points_per_thread + 1;
    push.block_sums = sums(std::max({items, edges, threads, others}));
    push.item_blocks = sums(items);
    push.item_words = words(shaders::words_of_item * items);
    push.edge_blocks = sums(edges);
    push.edge_units = units(shaders::units_of_edge * edges);
    push.point_blocks = sums(threads);
    push.point_units = units(points);
    push.depths = words(points);
}

ShapeBuffer::ShapeBuffer(const gpu::Device& device)
    : buffer_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
              gpu::Direction::upload, "nearfield pair shapes") {}

bool ShapeBuffer::upload(const device_input::SearchShapes& shapes) {
    const std::size_t bytes = shapes.units().size_bytes();
    const bool is_new = buffer_.reserve(bytes);
    if (!is_new && shapes.revision() == revision_) {
        return false;
    }
    shapes.copy_changes(is_new ? 0 : revision_, {buffer_.data(), bytes});
    buffer_.flush();
    revision_ = shapes.revision();
    const bool is_other = is_new || bytes_ != bytes;
    bytes_ = bytes;
    return is_other;
}

PairPartMemory::PairPartMemory(const gpu::Device& device, const graph::ComputeLayout& layout,
                               const passes::PairSearch& search,
                               const device_input::PairSearchKind& kind, bool is_resident)
    : search_(&search),
      kind_(kind),
      records_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::readback,
               "nearfield pair points"),
      // The host hardly reads rows that are resident: they lie in memory of the device.
      rows_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
            is_resident ? gpu::Direction::upload : gpu::Direction::readback, "nearfield pair rows"),
      // Some devices read arguments much faster where the host does not.
      counts_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::readback,
              "nearfield pair counts"),
      resources_(search.part().graph.make_resources(layout)) {
    counts_.reserve(bytes_of_counts);
}

/// Makes room for a part, and places its arrays in the scratch memory of all `instances`.
void PairPartMemory::lay_out(const PairPart& part, std::uint32_t instances) {
    const PairBytes bytes = place_pair_arrays(kind_, instances, part.capacities, input_.push);
    input_.push.first_instance = part.first;
    input_.push.end_instance = part.end;
    input_.capacities = part.capacities;
    records_.reserve(bytes.records);
    rows_.reserve(bytes.rows);
}

/// After that the passes can be recorded. `scratch`, `arguments`: what all parts have in common.
void PairPartMemory::bind(const SearchInput& input, const gpu::BufferPart& scratch,
                          const gpu::BufferPart& arguments, graph::DescriptorUpdates& updates) {
    const passes::PairSearch::Passes& passes = search_->part();
    resources_.set(passes.shapes, input.shapes);
    resources_.set(passes.instances, input.instances);
    resources_.set(passes.scratch, scratch);
    resources_.set(passes.arguments, arguments);
    resources_.set(passes.points,
                   records_.part(0, bytes_of_pair_records(kind_, input_.capacities)));
    resources_.set(passes.rows, row_part());
    resources_.set(passes.counts, counts_.part(0, bytes_of_counts));
    updates.add(resources_);
}

void PairPartMemory::clear_counts(std::uint32_t pairs) {
    std::memset(counts_.data(), 0, bytes_of_counts);
    std::memcpy(counts_.data() + shaders::pair_total * sizeof(pairs), &pairs, sizeof(pairs));
    counts_.flush();
}

PairCounts PairPartMemory::read_counts() const {
    counts_.invalidate();
    PairCounts counts{};
    std::memcpy(counts.data(), counts_.data(), sizeof(counts));
    return counts;
}

std::uint32_t PairPartMemory::count(std::uint32_t word) const {
    std::uint32_t count = 0;
    std::memcpy(&count, counts_.data() + word * sizeof(count), sizeof(count));
    return count;
}

/// Reads what there was room for. `first_row`: how many rows the parts before have.
void PairPartMemory::read_results(std::uint32_t first_row, std::vector<std::uint32_t>& undecided) {
    first_row_ = first_row;
    row_count_ = count(shaders::row_total);
    candidates_ = count(shaders::pair_total) - count(shaders::reverse_pairs);
    rows_.invalidate();
    if (records_.data() != nullptr) {
        records_.invalidate();
    }
    if (kind_.are_given()) {
        return;  // each row says so
    }
    const auto* const numbers = reinterpret_cast<const std::uint32_t*>(
        rows_data() + 1 + input_.capacities[shaders::row_total]);
    const std::uint32_t own = std::min(count(shaders::undecided_rows), row_count_);
    const auto first = undecided.insert(undecided.end(), numbers, numbers + own);
    std::sort(first, undecided.end());
    for (auto number = first; number != undecided.end(); ++number) {
        *number += first_row;
    }
}

SearchMemory::SearchMemory(const gpu::Device& device, const graph::ComputeLayout& layout,
                           const passes::PairSearch& search,
                           const device_input::PairSearchKind& kind, const PairTableCounts& reserve,
                           bool is_resident)
    : device_(&device),
      layout_(&layout),
      search_(&search),
      kind_(kind),
      is_resident_(is_resident),
      scratch_(device, scratch_usage, gpu::Direction::none, "nearfield pair scratch"),
      arguments_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                 gpu::Direction::none, "nearfield pair arguments"),
      updates_(device),
      parts_(kind, first_capacities(kind, reserve), is_resident) {
    arguments_.reserve(bytes_of_arguments);
    if (const auto* const boxes = search.boxes()) {
        boxes_.emplace(boxes->graph.make_resources(layout));
    }
}

gpu::BufferPart SearchMemory::arguments() const {
    return arguments_.part(0, bytes_of_arguments);
}

void SearchMemory::lay_out(const SearchInput& input, const PairLimits& limits) {
    parts_.fit(limits);
    while (memories_.size() < parts_.count()) {
        memories_.push_back(
            std::make_unique<PairPartMemory>(*device_, *layout_, *search_, kind_, is_resident_));
    }
    memories_.resize(parts_.count());
    shaders::SearchPush push{};
    scratch_bytes_ = 0;
    for (std::size_t i = 0; i < parts_.count(); ++i) {
        const PairBytes bytes =
            place_pair_arrays(kind_, input.instance_count, parts_[i].capacities, push);
        scratch_bytes_ = std::max(scratch_bytes_, bytes.scratch);
        memories_[i]->lay_out(parts_[i], input.instance_count);
    }
    scratch_.reserve(scratch_bytes_);
    updates_.begin();
    if (boxes_) {
        boxes_->set(search_->boxes()->shapes, input.shapes);
        boxes_->set(search_->boxes()->instances, input.instances);
        boxes_->set(search_->boxes()->scratch, scratch());
        updates_.add(*boxes_);
    }
    for (const auto& part : memories_) {
        part->bind(input, scratch(), arguments(), updates_);
    }
    updates_.end();
}

void SearchMemory::record_boxes(VkCommandBuffer commands, gpu::Timestamps& timestamps) const {
    search_->boxes()->graph.execute(commands, timestamps, *boxes_, memories_.front()->input());
}

void SearchMemory::record(std::size_t part, VkCommandBuffer commands,
                          gpu::Timestamps& timestamps) const {
    const PairPartMemory& memory = *memories_[part];
    search_->part().graph.execute(commands, timestamps, memory.resources_, memory.input());
}

std::size_t SearchMemory::count_passes() const {
    return (boxes_ ? search_->boxes()->graph.passes().size() : 0) +
           parts() * search_->part().graph.passes().size();
}

void SearchMemory::clear_counts(std::uint32_t pairs) {
    for (const auto& part : memories_) {
        part->clear_counts(pairs);
    }
}

void SearchMemory::read_counts() {
    counts_.clear();
    for (const auto& part : memories_) {
        counts_.push_back(part->read_counts());
    }
}

bool SearchMemory::had_room(double headroom) const {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        if (!have_room(counts_[i], parts_[i].capacities, headroom)) {
            return false;
        }
    }
    return true;
}

void SearchMemory::require_room() const {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        require_searchable(counts_[i]);
        if (!have_room(counts_[i], parts_[i].capacities)) {
            throw StatusException(overflow(counts_[i], parts_[i].capacities));
        }
    }
}

void SearchMemory::read_results() {
    undecided_.clear();
    std::uint32_t rows = 0;
    for (std::size_t i = 0; i < memories_.size(); ++i) {
        memories_[i]->read_results(rows, undecided_);
        rows += memories_[i]->row_count();
        parts_.note(i, counts_[i]);
    }
}

void SearchMemory::grow(double headroom) {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        require_searchable(counts_[i]);
        if (have_room(counts_[i], parts_[i].capacities, headroom)) {
            parts_.note(i, counts_[i]);
        } else {
            parts_.grow(i, counts_[i], headroom);
        }
    }
}

PairTableCounts SearchMemory::found() const {
    PairCounts all{};
    for (const auto& part : memories_) {
        const PairCounts own = part->read_counts();
        if (own[shaders::pair_total] == not_counted) {
            return {};
        }
        all = sum(all, own);
    }
    return table_counts(all);
}

PairTableCounts SearchMemory::last_found() const {
    return table_counts(std::accumulate(counts_.begin(), counts_.end(), PairCounts{}, sum));
}

PairTableCounts SearchMemory::room() const {
    PairCounts all{};
    for (const auto& part : memories_) {
        all = sum(all, part->input().capacities);
    }
    return table_counts(all);
}

std::uint32_t SearchMemory::candidates() const {
    std::uint32_t all = 0;
    for (const auto& part : memories_) {
        all += part->candidates();
    }
    return all;
}

std::uint32_t SearchMemory::row_count() const {
    return memories_.back()->first_row() + memories_.back()->row_count();
}

const PairPartMemory& SearchMemory::part_of_row(std::uint32_t row) const {
    const auto next = std::upper_bound(
        memories_.begin() + 1, memories_.end(), row,
        [](std::uint32_t number, const auto& part) { return number < part->first_row(); });
    return **(next - 1);
}

}  // namespace nearfield::render
