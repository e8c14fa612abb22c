#include <engine/render/pair_part_memory.hpp>
#include <engine/render/search_memory.hpp>

#include <algorithm>
#include <array>
#include <cstring>

namespace nearfield::render {
namespace {

constexpr std::array<const char*, 2> names_of_part_sets{"nearfield pair set of points",
                                                        "nearfield pair set of rows"};

constexpr std::uint64_t bytes_of_counts = plan::words_of_counts * sizeof(std::uint32_t);

}  // namespace

PairPartMemory::PairPartMemory(const gpu::Device& device, const passes::ComputeLayout& layout,
                               const plan::PairQuestion& question)
    : layout_(&layout),
      kind_(question.kind()),
      records_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::readback,
               "nearfield pair points"),
      // The host hardly reads rows that are resident: they lie in memory of the device.
      rows_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
            question.resident ? gpu::Direction::upload : gpu::Direction::readback,
            "nearfield pair rows"),
      // Some devices read arguments much faster where the host does not.
      counts_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::readback,
              "nearfield pair counts"),
      sets_(device, layout, names_of_part_sets) {
    counts_.reserve(bytes_of_counts);
    item_.sets[passes::PairSearch::of_points] = sets_[0];
    item_.sets[passes::PairSearch::of_rows] = sets_[1];
}

void PairPartMemory::lay_out(const PairPart& part, std::uint32_t instances) {
    const PairBytes bytes = place_pair_arrays(kind_, instances, part.capacities, item_.push);
    item_.push.first_instance = part.first;
    item_.push.end_instance = part.end;
    item_.capacities = part.capacities;
    records_.reserve(bytes.records);
    rows_.reserve(bytes.rows);
}

void PairPartMemory::bind(const Shared& shared) {
    using Layout = passes::ComputeLayout;
    using passes::PairSearch;
    item_.sets[PairSearch::of_instances] = shared.of_instances;
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
        write(Layout::tiles, shared.shapes, shared.shape_bytes);
        write(Layout::geometry, shared.scratch, shared.scratch_bytes);
        layout_->write_texels(item_.sets[set], Layout::texels, shared.texels);
        layout_->write_texels(item_.sets[set], Layout::scratch_texels, shared.scratch_texels);
        if (set == PairSearch::of_rows) {
            write(Layout::points, item_.rows, row_bytes());
            write(Layout::output, item_.counts, bytes_of_counts);
        } else {
            write(Layout::points, item_.records, bytes_of_pair_records(kind_, item_.capacities));
            write(Layout::output, item_.arguments, argument_bytes(plan::stages_of_pairs));
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

void PairPartMemory::read_results(std::uint32_t first_row, std::vector<std::uint32_t>& undecided) {
    first_row_ = first_row;
    row_count_ = count(plan::row_total);
    candidates_ = count(plan::pair_total) - count(plan::reverse_pairs);
    rows_.invalidate();
    if (records_.data() != nullptr) {
        records_.invalidate();
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

}  // namespace nearfield::render
