#include <engine/exact/lanes.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/localize/overlap.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace nearfield::exact {
namespace {

using geometry::Box;
using geometry::PlacedPolygon;
using geometry::Polygon;
using geometry::Vector;

constexpr std::uint32_t empty_slot = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t arrays = 9;  // start, end, low and high, x and y; inverse length

/// The length of an array, filled up to whole lanes.
std::size_t padded(std::size_t edges) {
    return (edges + lane_count - 1) / lane_count * lane_count;
}

/// The least and the greatest; far quicker than a box that is extended in memory.
std::pair<double, double> range_of(std::span<const double> values) {
    double low = values.front();
    double high = low;
    for (const double value : values) {
        low = value < low ? value : low;
        high = value > high ? value : high;
    }
    return {low, high};
}

bool same(const Pose& a, const Pose& b) {
    return a.translation.x == b.translation.x && a.translation.y == b.translation.y &&
           a.angle == b.angle;
}

std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9e3779b97f4a7c15U;
    return hash ^ (hash >> 32U);
}

/// The boxes of edges, or vertices as boxes of no extent.
struct Boxes {
    const double* low_x;
    const double* low_y;
    const double* high_x;
    const double* high_y;
};

/// Those of the boxes first, ..., end - 1 that meet a box.
Selection boxes_in(const Boxes& boxes, std::uint32_t first, std::uint32_t end, const Box& box) {
    const Lanes low_x = both(box.min().x());
    const Lanes low_y = both(box.min().y());
    const Lanes high_x = both(box.max().x());
    const Lanes high_y = both(box.max().y());
    Selection selection;
    for (std::uint32_t i = first; i < end; i += lane_count) {
        const LaneMask meets =
            (load(boxes.low_x + i) <= high_x) & (load(boxes.high_x + i) >= low_x) &
            (load(boxes.low_y + i) <= high_y) & (load(boxes.high_y + i) >= low_y);
        for (std::uint32_t lane = 0; lane < lane_count; ++lane) {
            selection.add(i + lane, meets[lane] != 0);
        }
    }
    selection.cut_off(end);
    return selection;
}

Selection edges_in(const PlacedEdges& edges, const Box& box) {
    return boxes_in({edges.low_x, edges.low_y, edges.high_x, edges.high_y}, 0, edges.count, box);
}

bool edges_meet(const PlacedEdges& a, std::uint32_t i, const PlacedEdges& b, std::uint32_t j,
                double margin) {
    const bool boxes_meet =
        a.low_x[i] - margin <= b.high_x[j] && b.low_x[j] <= a.high_x[i] + margin &&
        a.low_y[i] - margin <= b.high_y[j] && b.low_y[j] <= a.high_y[i] + margin;
    return boxes_meet &&
           geometry::segments_meet(a.start(i), a.end(i), b.start(j), b.end(j), margin);
}

bool boundaries_meet(const PlacedEdges& a, const PlacedEdges& b, double margin) {
    Box common = a.box.intersection(b.box);
    common.min().array() -= 2.0 * margin;
    common.max().array() += 2.0 * margin;
    const Selection of_a = edges_in(a, common);
    if (of_a.indices().empty()) {
        return false;
    }
    const Selection of_b = edges_in(b, common);
    for (const std::uint32_t i : of_a.indices()) {
        for (const std::uint32_t j : of_b.indices()) {
            if (edges_meet(a, i, b, j, margin)) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

Selection vertices_in(const PlacedEdges& edges, std::uint32_t first, const Box& box) {
    return boxes_in({edges.start_x, edges.start_y, edges.start_x, edges.start_y}, first,
                    std::min(edges.count, first + most_edges_one_by_one), box);
}

bool contains(const PlacedEdges& edges, const Vector& point) {
    const Lanes x = both(point.x());
    const Lanes y = both(point.y());
    LaneMask odd{};
    for (std::uint32_t i = 0; i < edges.count; i += lane_count) {
        const Lanes start_x = load(edges.start_x + i);
        const Lanes start_y = load(edges.start_y + i);
        const Lanes end_x = load(edges.end_x + i);
        const Lanes end_y = load(edges.end_y + i);
        const LaneMask left =
            (end_x - start_x) * (y - start_y) - (end_y - start_y) * (x - start_x) > 0.0;
        const LaneMask start_above = start_y > y;
        const LaneMask end_above = end_y > y;
        // Left of an edge that goes up, right of one that goes down: the ray to the right hits it.
        odd ^= (start_above ^ end_above) & ~(left ^ end_above);
    }
    return ((odd[0] ^ odd[1]) & 1) != 0;
}

std::uint32_t find_nearest(const PlacedEdges& edges, const Vector& point,
                           std::span<double> squared) {
    const Lanes x = both(point.x());
    const Lanes y = both(point.y());
    const Lanes zero = both(0.0);
    const Lanes one = both(1.0);
    Lanes least = both(std::numeric_limits<double>::infinity());
    for (std::uint32_t i = 0; i < edges.count; i += lane_count) {
        const Lanes along_x = load(edges.end_x + i) - load(edges.start_x + i);
        const Lanes along_y = load(edges.end_y + i) - load(edges.start_y + i);
        const Lanes to_x = x - load(edges.start_x + i);
        const Lanes to_y = y - load(edges.start_y + i);
        Lanes parameter = (along_x * to_x + along_y * to_y) * load(edges.inverse_length + i);
        parameter = parameter > zero ? parameter : zero;
        parameter = parameter < one ? parameter : one;
        const Lanes off_x = to_x - parameter * along_x;
        const Lanes off_y = to_y - parameter * along_y;
        const Lanes distance = off_x * off_x + off_y * off_y;
        least = distance < least ? distance : least;
        store(distance, squared.data() + i);
    }
    const double smallest = std::min(least[0], least[1]);
    const auto found = std::find(squared.begin(), squared.begin() + edges.count - 1, smallest);
    return static_cast<std::uint32_t>(found - squared.begin());
}

bool meet_without_vertex_inside(const PlacedEdges& a, const PlacedEdges& b) {
    const double margin = a.rounding + b.rounding;
    if (!localize::boxes_meet(a.box, b.box, margin)) {
        return false;
    }
    if (std::max(a.count, b.count) > most_edges_one_by_one) {
        return localize::intersects(a.placed, b.placed);
    }
    if (boundaries_meet(a, b, margin)) {
        return true;
    }
    // Then a whole ring of one lies in the other, or none does; and none of A does.
    const Polygon& polygon = b.placed.polygon();
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const Vector vertex = b.start(polygon.ring_begin(ring));
        if (a.box.contains(vertex) && contains(a, vertex)) {
            return true;
        }
    }
    return false;
}

void PlacedInstances::clear() {
    entries_.clear();
    coordinates_.clear();
    std::fill(slots_.begin(), slots_.end(), empty_slot);
}

std::size_t PlacedInstances::slot_of(const Polygon& polygon, const Pose& pose) const {
    std::uint64_t hash = mix(0, std::bit_cast<std::uintptr_t>(&polygon));
    for (const double value : {pose.translation.x, pose.translation.y, pose.angle}) {
        hash = mix(hash, std::bit_cast<std::uint64_t>(value));
    }
    std::size_t slot = hash & (slots_.size() - 1);
    while (slots_[slot] != empty_slot && !(&entries_[slots_[slot]].placed.polygon() == &polygon &&
                                           same(entries_[slots_[slot]].pose, pose))) {
        slot = (slot + 1) & (slots_.size() - 1);
    }
    return slot;
}

std::uint32_t PlacedInstances::place(const Polygon& polygon, const Pose& pose) {
    if (slots_.size() < 2 * (entries_.size() + 1)) {
        rehash();
    }
    std::uint32_t& slot = slots_[slot_of(polygon, pose)];
    if (slot == empty_slot) {
        slot = static_cast<std::uint32_t>(entries_.size());
        add(polygon, pose);
    }
    return slot;
}

void PlacedInstances::rehash() {
    slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), empty_slot);
    for (std::uint32_t i = 0; i < entries_.size(); ++i) {
        slots_[slot_of(entries_[i].placed.polygon(), entries_[i].pose)] = i;
    }
}

void PlacedInstances::add(const Polygon& polygon, const Pose& pose) {
    const PlacedPolygon placed(polygon, pose);
    const std::size_t count = polygon.size();
    const std::size_t length = padded(count);
    const std::size_t first = coordinates_.size();
    coordinates_.resize(first + arrays * length);
    double* const start_x = coordinates_.data() + first;
    double* const start_y = start_x + length;
    double* const end_x = start_y + length;
    double* const end_y = end_x + length;
    double* const low_x = end_y + length;
    double* const low_y = low_x + length;
    double* const high_x = low_y + length;
    double* const high_y = high_x + length;
    double* const inverse_length = high_y + length;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vector vertex = placed.vertex(i);
        start_x[i] = vertex.x();
        start_y[i] = vertex.y();
    }
    const auto [low_x_of_all, high_x_of_all] = range_of({start_x, count});
    const auto [low_y_of_all, high_y_of_all] = range_of({start_y, count});
    const Box box(Vector(low_x_of_all, low_y_of_all), Vector(high_x_of_all, high_y_of_all));
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const std::uint32_t begin = polygon.ring_begin(ring);
        const std::uint32_t last = polygon.ring_end(ring) - 1;
        std::copy(start_x + begin + 1, start_x + last + 1, end_x + begin);
        std::copy(start_y + begin + 1, start_y + last + 1, end_y + begin);
        end_x[last] = start_x[begin];
        end_y[last] = start_y[begin];
    }
    // What fills up the last lanes is the last vertex once more: an edge of no length.
    for (std::size_t i = count; i < length; ++i) {
        start_x[i] = end_x[i] = end_x[count - 1];
        start_y[i] = end_y[i] = end_y[count - 1];
    }
    for (std::size_t i = 0; i < length; ++i) {
        low_x[i] = std::min(start_x[i], end_x[i]);
        low_y[i] = std::min(start_y[i], end_y[i]);
        high_x[i] = std::max(start_x[i], end_x[i]);
        high_y[i] = std::max(start_y[i], end_y[i]);
        const double along_x = end_x[i] - start_x[i];
        const double along_y = end_y[i] - start_y[i];
        const double squared = along_x * along_x + along_y * along_y;
        inverse_length[i] = squared > 0.0 ? 1.0 / squared : 0.0;
    }
    entries_.push_back({pose, placed, box, localize::placement_rounding(placed, box), first});
}

PlacedEdges PlacedInstances::operator[](std::uint32_t index) const {
    const Entry& entry = entries_[index];
    const std::size_t count = entry.placed.polygon().size();
    const auto array = [&](std::size_t number) {
        return coordinates_.data() + entry.first + number * padded(count);
    };
    return {entry.placed, entry.box, entry.rounding, static_cast<std::uint32_t>(count),
            array(0),     array(1),  array(2),       array(3),
            array(4),     array(5),  array(6),       array(7),
            array(8)};
}

}  // namespace nearfield::exact
