#include <engine/queries/simplified_shapes.hpp>

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>

namespace nearfield::queries {
namespace {

constexpr std::uint32_t free_slot = UINT32_MAX;

/// Above this many edges (about 40 MB) the cache is emptied, so that a batch that keeps changing
/// the tolerance for one big shape does not use unbounded memory.
constexpr std::size_t max_edges = std::size_t{1} << 20U;

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
    Entry& entry = find_or_add({&polygon, deviation, longest_run, false});
    if (entry.whole.edge_count == 0) {
        entry.whole = append(polygon, [&](std::vector<geometry::SimplifiedEdge>& edges) {
            geometry::simplify(polygon, deviation, longest_run, edges);
        });
    }
    return view(polygon, entry.whole);
}

SimplifiedBoundary SimplifiedShapes::get_near(const geometry::TransformedPolygon& placed,
                                              const geometry::Box& window, double deviation,
                                              double longest_run) {
    const geometry::Polygon& polygon = placed.polygon();
    const auto simplified_in = [&](const geometry::Box& box) {
        return append(polygon, [&](std::vector<geometry::SimplifiedEdge>& edges) {
            geometry::simplify_near(placed, box, deviation, longest_run, edges);
        });
    };
    Entry& entry = find_or_add({&polygon, deviation, longest_run, true});
    if (entry.whole.edge_count > 0) {
        return view(polygon, entry.whole);
    }
    // A shape queried through many windows is simplified as a whole once the windows together took
    // as much work; a small shape at once.
    constexpr std::uint32_t worth_a_window = 4 * geometry::edges_of_a_block;
    if (polygon.size() > worth_a_window && entry.edges_of_windows < polygon.size()) {
        const Place part = simplified_in(window);
        entry.edges_of_windows += part.edge_count;
        return view(polygon, part);
    }
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    entry.whole = simplified_in(
        {geometry::Vector::Constant(-everywhere), geometry::Vector::Constant(everywhere)});
    return view(polygon, entry.whole);
}

SimplifiedBoundary SimplifiedShapes::view(const geometry::Polygon& polygon,
                                          const Place& place) const {
    return {&polygon,
            {edges_.data() + place.edge, place.edge_count},
            {ring_of_.data() + place.edge, place.edge_count},
            {ring_begin_.data() + place.ring, place.ring_count},
            {boxes_.data() + place.box, place.box_count}};
}

SimplifiedShapes::Entry& SimplifiedShapes::find_or_add(const Key& key) {
    if (2 * (entries_.size() + 1) > table_.size()) {
        grow_table();
    }
    std::uint32_t& place = slot(key);
    const bool is_there = place != free_slot && entries_[place].whole.edge_count > 0;
    if (!is_there && edges_.size() > max_edges) {
        clear();
    }
    if (place == free_slot) {
        entries_.push_back({key, {}, 0});  // first: memory may run out
        place = static_cast<std::uint32_t>(entries_.size() - 1);
    }
    return entries_[place];
}

std::uint32_t& SimplifiedShapes::slot(const Key& key) {
    std::uint64_t hash = mixed(std::hash<const void*>()(key.polygon));
    hash = mixed(hash ^ std::bit_cast<std::uint64_t>(key.deviation));
    hash = mixed(hash ^ std::bit_cast<std::uint64_t>(key.longest_run));
    for (std::size_t i = hash;; ++i) {
        std::uint32_t& candidate = table_[i & (table_.size() - 1)];
        if (candidate == free_slot || entries_[candidate].key == key) {
            return candidate;
        }
    }
}

void SimplifiedShapes::grow_table() {
    table_.assign(std::max<std::size_t>(64, 2 * table_.size()), free_slot);
    for (std::uint32_t i = 0; i < entries_.size(); ++i) {
        slot(entries_[i].key) = i;
    }
}

template <class Simplify>
SimplifiedShapes::Place SimplifiedShapes::append(const geometry::Polygon& polygon,
                                                 const Simplify& simplify) {
    Place place;
    place.edge = static_cast<std::uint32_t>(edges_.size());
    place.ring = static_cast<std::uint32_t>(ring_begin_.size());
    place.box = static_cast<std::uint32_t>(boxes_.size());
    simplify(edges_);
    place.edge_count = static_cast<std::uint32_t>(edges_.size()) - place.edge;
    append_rings(polygon, place);
    append_boxes(polygon, {edges_.data() + place.edge, place.edge_count}, boxes_);
    place.box_count = static_cast<std::uint32_t>(boxes_.size()) - place.box;
    return place;
}

void SimplifiedShapes::append_rings(const geometry::Polygon& polygon, Place& place) {
    std::uint32_t edge = 0;
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        ring_begin_.push_back(edge);
        const std::uint32_t end = polygon.ring_end(ring);
        while (edge < place.edge_count && edges_[place.edge + edge].first < end) {
            ++edge;
        }
        ring_of_.resize(place.edge + edge, ring);
    }
    ring_begin_.push_back(edge);
    place.ring_count = static_cast<std::uint32_t>(ring_begin_.size()) - place.ring;
}

}  // namespace nearfield::queries
