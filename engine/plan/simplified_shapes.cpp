#include <engine/plan/simplified_shapes.hpp>

#include <algorithm>
#include <bit>
#include <functional>

namespace nearfield::plan {
namespace {

constexpr std::uint32_t free_slot = UINT32_MAX;

/// With more edges than this (about 40 MB) all are forgotten, lest a batch with ever new tolerances
/// for one big shape needs memory without end.
constexpr std::size_t most_edges = std::size_t{1} << 20U;

std::uint64_t mixed(std::uint64_t value) {
    value *= 0x9e3779b97f4a7c15ULL;
    return value ^ value >> 32U;
}

}  // namespace

void SimplifiedShapes::clear() {
    entries_.clear();
    std::fill(table_.begin(), table_.end(), free_slot);
    edges_.clear();
    ring_of_.clear();
    ring_begin_.clear();
    boxes_.clear();
}

SimplifiedBoundary SimplifiedShapes::get(const geometry::Polygon& polygon, double deviation,
                                         double longest_run) {
    if (2 * (entries_.size() + 1) > table_.size()) {
        grow_table();
    }
    if (const std::uint32_t found = slot(polygon, deviation, longest_run); found != free_slot) {
        return view(entries_[found]);
    }
    if (edges_.size() > most_edges) {
        clear();
    }
    slot(polygon, deviation, longest_run) = static_cast<std::uint32_t>(entries_.size());
    add(polygon, deviation, longest_run);
    return view(entries_.back());
}

SimplifiedBoundary SimplifiedShapes::view(const Entry& entry) const {
    return {entry.polygon,
            {edges_.data() + entry.edge, entry.edge_count},
            {ring_of_.data() + entry.edge, entry.edge_count},
            {ring_begin_.data() + entry.ring, entry.ring_count},
            {boxes_.data() + entry.box, entry.box_count}};
}

std::uint32_t& SimplifiedShapes::slot(const geometry::Polygon& polygon, double deviation,
                                      double longest_run) {
    std::uint64_t hash = mixed(std::hash<const void*>()(&polygon));
    hash = mixed(hash ^ std::bit_cast<std::uint64_t>(deviation));
    hash = mixed(hash ^ std::bit_cast<std::uint64_t>(longest_run));
    for (std::size_t i = hash;; ++i) {
        std::uint32_t& candidate = table_[i & (table_.size() - 1)];
        if (candidate == free_slot) {
            return candidate;
        }
        const Entry& entry = entries_[candidate];
        if (entry.polygon == &polygon && entry.deviation == deviation &&
            entry.longest_run == longest_run) {
            return candidate;
        }
    }
}

void SimplifiedShapes::grow_table() {
    table_.assign(std::max<std::size_t>(64, 2 * table_.size()), free_slot);
    for (std::uint32_t i = 0; i < entries_.size(); ++i) {
        const Entry& entry = entries_[i];
        slot(*entry.polygon, entry.deviation, entry.longest_run) = i;
    }
}

void SimplifiedShapes::add(const geometry::Polygon& polygon, double deviation, double longest_run) {
    Entry& entry = entries_.emplace_back();
    entry.polygon = &polygon;
    entry.deviation = deviation;
    entry.longest_run = longest_run;
    entry.edge = static_cast<std::uint32_t>(edges_.size());
    entry.ring = static_cast<std::uint32_t>(ring_begin_.size());
    entry.box = static_cast<std::uint32_t>(boxes_.size());
    geometry::simplify(polygon, deviation, longest_run, edges_);
    entry.edge_count = static_cast<std::uint32_t>(edges_.size()) - entry.edge;
    add_rings(polygon, entry);
    append_boxes(polygon, {edges_.data() + entry.edge, entry.edge_count}, boxes_);
    entry.box_count = static_cast<std::uint32_t>(boxes_.size()) - entry.box;
}

void SimplifiedShapes::add_rings(const geometry::Polygon& polygon, Entry& entry) {
    std::uint32_t edge = 0;
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        ring_begin_.push_back(edge);
        for (; edge < entry.edge_count && edges_[entry.edge + edge].first < polygon.ring_end(ring);
             ++edge) {
            ring_of_.push_back(ring);
        }
    }
    ring_begin_.push_back(edge);
    entry.ring_count = static_cast<std::uint32_t>(ring_begin_.size()) - entry.ring;
}

}  // namespace nearfield::plan
