#include <engine/exact/placed_edges.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/localize/overlap.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace nearfield::exact {
namespace {

using geometry::Box;
using geometry::PlacedPolygon;
using geometry::Polygon;
using geometry::Vector;

constexpr std::uint32_t empty_slot = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t arrays = 4;  // start and end, x and y

bool same(const Pose& a, const Pose& b) {
    return a.translation.x == b.translation.x && a.translation.y == b.translation.y &&
           a.angle == b.angle;
}

std::uint64_t mix(std::uint64_t hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9e3779b97f4a7c15U;
    return hash ^ (hash >> 32U);
}

Box box_of(const PlacedEdges& edges, std::uint32_t edge) {
    return {edges.start(edge).cwiseMin(edges.end(edge)),
            edges.start(edge).cwiseMax(edges.end(edge))};
}

/// The edges whose boxes meet a box.
class EdgesIn {
public:
    EdgesIn(const PlacedEdges& edges, const Box& box) {
        for (std::uint32_t i = 0; i < edges.count; ++i) {
            const Box of_edge = box_of(edges, i);
            if (localize::boxes_meet(of_edge, box, 0.0)) {
                edges_[count_] = i;
                boxes_[count_] = of_edge;
                ++count_;
            }
        }
    }

    [[nodiscard]] std::uint32_t count() const { return count_; }
    [[nodiscard]] std::uint32_t edge(std::uint32_t i) const { return edges_[i]; }
    [[nodiscard]] const Box& box(std::uint32_t i) const { return boxes_[i]; }

private:
    std::array<std::uint32_t, most_edges_one_by_one> edges_;
    std::array<Box, most_edges_one_by_one> boxes_;
    std::uint32_t count_ = 0;
};

bool boundaries_meet(const PlacedEdges& a, const PlacedEdges& b, double margin) {
    Box common = a.box.intersection(b.box);
    common.min().array() -= 2.0 * margin;
    common.max().array() += 2.0 * margin;
    const EdgesIn of_a(a, common);
    const EdgesIn of_b(b, common);
    for (std::uint32_t i = 0; i < of_a.count(); ++i) {
        for (std::uint32_t j = 0; j < of_b.count(); ++j) {
            if (localize::boxes_meet(of_a.box(i), of_b.box(j), margin) &&
                geometry::segments_meet(a.start(of_a.edge(i)), a.end(of_a.edge(i)),
                                        b.start(of_b.edge(j)), b.end(of_b.edge(j)), margin)) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

bool contains(const PlacedEdges& edges, const Vector& point) {
    // Without branches, and all of one width, for the compiler's vectors.
    std::uint64_t crossings = 0;
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        const double side = (edges.end_x[i] - edges.start_x[i]) * (point.y() - edges.start_y[i]) -
                            (edges.end_y[i] - edges.start_y[i]) * (point.x() - edges.start_x[i]);
        const bool start_above = edges.start_y[i] > point.y();
        const bool end_above = edges.end_y[i] > point.y();
        // Left of an edge that goes up, right of one that goes down: the ray to the right hits it.
        const bool hit = (side > 0.0) == end_above;
        crossings += static_cast<std::uint64_t>((start_above != end_above) & hit);
    }
    return (crossings & 1U) != 0;
}

std::uint32_t find_nearest(const PlacedEdges& edges, const Vector& point,
                           std::span<double> squared) {
    double* const distances = squared.data();
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        const double along_x = edges.end_x[i] - edges.start_x[i];
        const double along_y = edges.end_y[i] - edges.start_y[i];
        const double to_x = point.x() - edges.start_x[i];
        const double to_y = point.y() - edges.start_y[i];
        const double length = along_x * along_x + along_y * along_y;
        const double along = along_x * to_x + along_y * to_y;
        // An edge of no length is its start: then both are 0.
        const double parameter =
            std::min(std::max(along, 0.0), length) / (length > 0.0 ? length : 1.0);
        const double off_x = to_x - parameter * along_x;
        const double off_y = to_y - parameter * along_y;
        distances[i] = off_x * off_x + off_y * off_y;
    }
    return static_cast<std::uint32_t>(std::min_element(distances, distances + edges.count) -
                                      distances);
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
    const std::size_t first = coordinates_.size();
    coordinates_.resize(first + arrays * count);
    double* const start_x = coordinates_.data() + first;
    double* const start_y = start_x + count;
    double* const end_x = start_y + count;
    double* const end_y = end_x + count;
    Box box;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vector vertex = placed.vertex(i);
        start_x[i] = vertex.x();
        start_y[i] = vertex.y();
        box.extend(vertex);
    }
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const std::uint32_t begin = polygon.ring_begin(ring);
        const std::uint32_t last = polygon.ring_end(ring) - 1;
        std::copy(start_x + begin + 1, start_x + last + 1, end_x + begin);
        std::copy(start_y + begin + 1, start_y + last + 1, end_y + begin);
        end_x[last] = start_x[begin];
        end_y[last] = start_y[begin];
    }
    entries_.push_back({pose, placed, box, localize::placement_rounding(placed, box), first});
}

PlacedEdges PlacedInstances::operator[](std::uint32_t index) const {
    const Entry& entry = entries_[index];
    const std::uint32_t count = entry.placed.polygon().size();
    const double* const start_x = coordinates_.data() + entry.first;
    return {entry.placed, entry.box,       entry.rounding,       count,
            start_x,      start_x + count, start_x + 2U * count, start_x + 3U * count};
}

}  // namespace nearfield::exact
