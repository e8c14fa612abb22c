#include <engine/base/status_exception.hpp>
#include <engine/render/search_memory.hpp>

#include <algorithm>
#include <array>
#include <cstring>

namespace nearfield::render {
namespace {

constexpr std::array<const char*, 1> name_of_instance_set{"nearfield pair set of instances"};
constexpr std::array<const char*, 2> names_of_part_sets{"nearfield pair set of points",
                                                        "nearfield pair set of rows"};

constexpr std::uint64_t bytes_of_counts = plan::words_of_counts * sizeof(std::uint32_t);
/// Those of the dispatches of all stages.
constexpr std::uint64_t bytes_of_arguments =
    std::uint64_t{plan::stages_of_pairs} * plan::words_of_arguments * sizeof(std::uint32_t);

bool have_room(const PairCounts& counts, const PairCounts& capacities) {
    return std::equal(counts.begin(), counts.end(), capacities.begin(),
                      [](std::uint32_t count, std::uint32_t room) { return count <= room; });
}

}  // namespace

std::uint32_t ScratchLayout::words(std::uint64_t count) {
    const std::uint64_t first = words_;
    words_ += (count + 3) / 4 * 4;
    return static_cast<std::uint32_t>(first);
}

std::uint32_t ScratchLayout::sums(std::uint64_t elements) {
    // A dispatch of several rows has up to one workgroup fewer than rows too many (totals.glsl).
    const std::uint64_t workgroups = elements / plan::search_block + 1;
    const std::uint64_t rows = workgroups / plan::max_workgroups + 1;
    return words(workgroups + rows);
}

void ScratchLayout::add_stages(std::uint64_t items, std::uint64_t edges, std::uint64_t points,
                               std::uint64_t others, plan::SearchPush& push) {
    const std::uint64_t threads = points / plan::points_per_thread + 1;
    push.block_sums = sums(std::max({items, edges, threads, others}));
    push.item_blocks = sums(items);
    push.item_words = words(plan::words_of_item * items);
    push.edge_blocks = sums(edges);
    push.edge_units = units(plan::units_of_edge * edges);
    push.point_blocks = sums(threads);
    push.point_units = units(points);
    push.depths = words(points);
}

bool reserve_with_texels(const gpu::Device& device, gpu::MappedBuffer& buffer,
                         gpu::Owned<VkBufferView>& texels, std::uint64_t bytes, const char* name) {
    // Where making either of the two failed before, there is no view.
    if (texels && bytes <= buffer.capacity()) {
        return false;
    }
    texels.reset();
    buffer.reserve(bytes);
    texels = gpu::make_texel_view(device, buffer, name);
    return true;
}

ShapeBuffer::ShapeBuffer(const gpu::Device& device)
    : device_(&device),
      buffer_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
              gpu::Direction::upload, "nearfield pair shapes") {}

bool ShapeBuffer::upload(const plan::SearchShapes& shapes) {
    const auto bytes = std::as_bytes(shapes.units());
    const bool is_new =
        reserve_with_texels(*device_, buffer_, texels_, bytes.size(), "nearfield pair texels");
    if (!is_new && shapes.revision() == revision_) {
        return false;
    }
    std::copy(bytes.begin(), bytes.end(), buffer_.data());
    buffer_.flush();
    revision_ = shapes.revision();
    const bool is_other = is_new || bytes_ != bytes.size();
    bytes_ = bytes.size();
    return is_other;
}

PairPartMemory::PairPartMemory(const gpu::Device& device, const passes::ComputeLayout& layout,
                               const plan::PairSearchKind& kind, bool is_resident)
    : layout_(&layout),
      kind_(kind),
      records_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::readback,
               "nearfield pair points"),
      // The host hardly reads rows that are resident: they lie in memory of the device.
      rows_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
            is_resident ? gpu::Direction::upload : gpu::Direction::readback, "nearfield pair rows"),
      // Some devices read arguments much faster where the host does not.
      counts_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::readback,
              "nearfield pair counts"),
      sets_(device, layout, names_of_part_sets) {
    counts_.reserve(bytes_of_counts);
    item_.sets[passes::PairSearch::of_points] = sets_[0];
    item_.sets[passes::PairSearch::of_rows] = sets_[1];
}

/// Makes room for a part, and places its arrays in the scratch memory of all `instances`.
void PairPartMemory::lay_out(const PairPart& part, std::uint32_t instances) {
    const PairBytes bytes = place_pair_arrays(kind_, instances, part.capacities, item_.push);
    item_.push.first_instance = part.first;
    item_.push.end_instance = part.end;
    item_.capacities = part.capacities;
    records_.reserve(bytes.records);
    rows_.reserve(bytes.rows);
}

/// Between updates of the layout begin and end; after that the passes can be recorded. `shared`:
/// what all parts have in common.
void PairPartMemory::bind(const SearchInput& input, const passes::PairSearch::Item& shared,
                          std::uint64_t scratch_bytes, VkBufferView scratch_texels) {
    using Layout = passes::ComputeLayout;
    using passes::PairSearch;
    item_.sets[PairSearch::of_instances] = shared.sets[PairSearch::of_instances];
    item_.shapes = shared.shapes;
    item_.instances = shared.instances;
    item_.scratch = shared.scratch;
    item_.arguments = shared.arguments;
    item_.records = records_.handle();
    item_.rows = rows_.handle();
    item_.counts = counts_.handle();
    for (const auto set : {PairSearch::of_points, PairSearch::of_rows}) {
        const auto write = [&](Layout::Binding binding, VkBuffer buffer, std::uint64_t bytes) {
            layout_->write_buffer(item_.sets[set], binding, buffer, 0, bytes);
        };
        write(Layout::tiles, item_.shapes, input.shapes->bytes());
        write(Layout::geometry, item_.scratch, scratch_bytes);
        layout_->write_texels(item_.sets[set], Layout::texels, input.shapes->texels());
        layout_->write_texels(item_.sets[set], Layout::scratch_texels, scratch_texels);
        if (set == PairSearch::of_rows) {
            write(Layout::points, item_.rows, row_bytes());
            write(Layout::output, item_.counts, bytes_of_counts);
        } else {
            write(Layout::points, item_.records, bytes_of_pair_records(kind_, item_.capacities));
            write(Layout::output, item_.arguments, bytes_of_arguments);
        }
    }
}

void PairPartMemory::clear_counts(std::uint32_t pairs) {
    std::memset(counts_.data(), 0, bytes_of_counts);
    std::memcpy(counts_.data() + plan::pair_total * sizeof(pairs), &pairs, sizeof(pairs));
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
    row_count_ = count(plan::row_total);
    candidates_ = count(plan::pair_total) - count(plan::reverse_pairs);
    rows_.invalidate();
    if (records_.data() != nullptr) {
        records_.invalidate();
    }
    if (kind_.are_given()) {
        return;  // each row says so
    }
    const auto* const numbers =
        reinterpret_cast<const std::uint32_t*>(rows_data() + 1 + item_.capacities[plan::row_total]);
    const std::uint32_t own = std::min(count(plan::undecided_rows), row_count_);
    const auto first = undecided.insert(undecided.end(), numbers, numbers + own);
    std::sort(first, undecided.end());
    for (auto number = first; number != undecided.end(); ++number) {
        *number += first_row;
    }
}

SearchMemory::SearchMemory(const gpu::Device& device, const passes::ComputeLayout& layout,
                           const plan::PairSearchKind& kind, bool is_resident)
    : device_(&device),
      layout_(&layout),
      kind_(kind),
      is_resident_(is_resident),
      scratch_(device, scratch_usage, gpu::Direction::none, "nearfield pair scratch"),
      arguments_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                 gpu::Direction::none, "nearfield pair arguments"),
      sets_(device, layout, name_of_instance_set),
      parts_(kind, is_resident) {
    arguments_.reserve(bytes_of_arguments);
}

void SearchMemory::lay_out(const SearchInput& input, const PairLimits& limits) {
    using Layout = passes::ComputeLayout;
    parts_.fit(limits);
    while (memories_.size() < parts_.count()) {
        memories_.push_back(
            std::make_unique<PairPartMemory>(*device_, *layout_, kind_, is_resident_));
    }
    memories_.resize(parts_.count());
    plan::SearchPush push{};
    scratch_bytes_ = 0;
    for (std::size_t i = 0; i < parts_.count(); ++i) {
        const PairBytes bytes =
            place_pair_arrays(kind_, input.instance_count, parts_[i].capacities, push);
        scratch_bytes_ = std::max(scratch_bytes_, bytes.scratch);
        memories_[i]->lay_out(parts_[i], input.instance_count);
    }
    reserve_with_texels(*device_, scratch_, scratch_texels_, scratch_bytes_,
                        "nearfield pair scratch texels");
    passes::PairSearch::Item shared;
    shared.sets[passes::PairSearch::of_instances] = sets_[0];
    shared.shapes = input.shapes->handle();
    shared.instances = input.instances;
    shared.scratch = scratch_.handle();
    shared.arguments = arguments_.handle();
    layout_->begin_updates();
    layout_->write_buffer(sets_[0], Layout::tiles, shared.shapes, 0, input.shapes->bytes());
    layout_->write_buffer(sets_[0], Layout::geometry, shared.scratch, 0, scratch_bytes_);
    layout_->write_buffer(sets_[0], Layout::points, shared.instances, 0, input.instance_bytes);
    layout_->write_buffer(sets_[0], Layout::output, shared.arguments, 0, bytes_of_arguments);
    layout_->write_texels(sets_[0], Layout::texels, input.shapes->texels());
    layout_->write_texels(sets_[0], Layout::scratch_texels, scratch_texels_.get());
    for (const auto& part : memories_) {
        part->bind(input, shared, scratch_bytes_, scratch_texels_.get());
    }
    layout_->end_updates();
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

bool SearchMemory::had_room() const {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        if (!have_room(counts_[i], parts_[i].capacities)) {
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

void SearchMemory::grow() {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        require_searchable(counts_[i]);
        if (have_room(counts_[i], parts_[i].capacities)) {
            parts_.note(i, counts_[i]);
        } else {
            parts_.grow(i, counts_[i]);
        }
    }
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
