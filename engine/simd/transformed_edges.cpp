#include <engine/geometry/hierarchy.hpp>
#include <engine/geometry/magnitude.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace nearfield::simd {
namespace {

using geometry::Box;
using geometry::Polygon;
using geometry::TransformedPolygon;
using geometry::Vector;

/// The number of arrays the edges take: start and end, x and y; inverse lengths where they are
/// read.
std::size_t arrays_of(std::uint32_t count) {
    return count <= max_edges_one_by_one ? 5 : 4;
}

/// Derives the end points of all edges from their start points, ring by ring.
void copy_ends(const Polygon& polygon, const double* start, double* end) {
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const std::uint32_t begin = polygon.ring_begin(ring);
        const std::uint32_t last = polygon.ring_end(ring) - 1;
        std::copy(start + begin + 1, start + last + 1, end + begin);
        end[last] = start[begin];
    }
}

/// From this many rings on, their order matters.
constexpr std::uint32_t many_rings = 32;

bool is_in_pieces(const Polygon& polygon) {
    return polygon.ring_count() >= many_rings;
}

/// The length of each edge array. Pieces of rings begin anywhere, so one more vector is read.
std::size_t length_of_arrays(const Polygon& polygon) {
    return padded(polygon.size()) + (is_in_pieces(polygon) ? max_lanes : 0);
}

/// Writes the ring starts of an AabbTree whose boxes are over every eight edges.
void write_ring_starts(const Polygon& polygon, const EdgeArrays& edges, double* starts) {
    const std::size_t length = padded(AabbTree::boxes_over(edges.count));
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        const std::uint32_t first = polygon.ring_begin(ring);
        const std::uint32_t begin = AabbTree::boxes_over(first);
        const std::uint32_t end = AabbTree::boxes_over(polygon.ring_end(ring));
        std::fill(starts + begin, starts + end, edges.start_x[first]);
        std::fill(starts + length + begin, starts + length + end, edges.start_y[first]);
    }
}

/// The same for boxes over pieces of rings in the given order.
void write_ring_starts(const Polygon& polygon, const EdgeArrays& edges,
                       std::span<const std::uint32_t> rings, std::size_t length, double* starts) {
    for (const std::uint32_t ring : rings) {
        const std::uint32_t first = polygon.ring_begin(ring);
        const std::uint32_t pieces = AabbTree::boxes_over(polygon.ring_end(ring) - first);
        std::fill(starts, starts + pieces, edges.start_x[first]);
        std::fill(starts + length, starts + length + pieces, edges.start_y[first]);
        starts += pieces;
    }
}

}  // namespace

bool contains(const TransformedEdges& edges, const geometry::Vector& point) {
    return is_small(edges) ? kernels::contain(edges, point.x(), point.y())
                           : kernels::contain(edges.tree(), point.x(), point.y());
}

NearEdge find_nearest(const TransformedEdges& edges, const geometry::Vector& point) {
    constexpr NearEdge nothing{0, std::numeric_limits<double>::infinity()};
    return is_small(edges) ? kernels::find_nearest(edges, point.x(), point.y())
                           : kernels::find_nearer(edges.tree(), point.x(), point.y(), nothing);
}

std::span<const std::uint32_t> find_edges_in(const TransformedEdges& edges,
                                             const geometry::Box& box,
                                             std::vector<std::uint32_t>& memory) {
    if (memory.size() < padded(edges.count)) {
        memory.resize(padded(edges.count));
    }
    const std::uint32_t count =
        is_small(edges) ? kernels::find_edges_in(edges, extent_of(box), memory.data())
                        : kernels::find_edges_in(edges.tree(), extent_of(box), memory.data());
    return {memory.data(), count};
}

void TransformedInstances::Memory::clear() {
    used = 0;
    pieces.clear();
}

std::size_t TransformedInstances::room_of(const Entry& entry) {
    const Polygon& polygon = entry.edges.placed.polygon();
    return arrays_of(entry.edges.count) * length_of_arrays(polygon) / max_lanes;
}

std::size_t TransformedInstances::room_of_boxes(const Entry& entry) {
    const std::size_t pieces = entry.end_piece - entry.first_piece;
    const std::uint32_t lowest =
        pieces > 0 ? static_cast<std::uint32_t>(pieces) : AabbTree::boxes_over(entry.edges.count);
    return AabbTree::room(lowest) / max_lanes;
}

void TransformedInstances::find_arrays(Entry& entry) {
    Memory& memory = memory_of(entry);
    if (entry.first != nowhere) {
        const std::uint32_t count = entry.edges.count;
        const std::size_t length = length_of_arrays(entry.edges.placed.polygon()) / max_lanes;
        const auto array = [&](std::size_t number) {
            return memory.coordinates[entry.first + number * length].values;
        };
        static_cast<EdgeArrays&>(entry.edges) = {count,    array(0), array(1),
                                                 array(2), array(3), nullptr};
        if (arrays_of(count) > 4) {
            entry.edges.inverse_length = array(4);
        }
    }
    if (entry.first_boxes != nowhere) {
        entry.edges.boxes = memory.coordinates[entry.first_boxes].values;
        entry.edges.pieces = std::span(memory.pieces)
                                 .subspan(entry.first_piece, entry.end_piece - entry.first_piece);
    }
}

void TransformedInstances::find_moved_arrays(Entry& entry) {
    if (entry.own) {
        find_arrays(entry);
        return;
    }
    for (Entry& other : entries_) {
        if (!other.own) {
            find_arrays(other);
        }
    }
}

std::size_t TransformedInstances::grow(Entry& entry, std::size_t by) {
    Memory& memory = memory_of(entry);
    const std::size_t end = memory.used + by;
    if (end > memory.coordinates.size()) {
        memory.coordinates.resize(std::max(end, 2 * memory.coordinates.size()));
        find_moved_arrays(entry);
    }
    return std::exchange(memory.used, end);  // last: memory may have run out
}

void TransformedInstances::add(const TransformedPolygon& placed, const Pose& pose, const Box* box) {
    const Polygon& polygon = placed.polygon();
    Entry& entry = entries_.emplace_back(Entry{pose,
                                               polygon.revision(),
                                               nullptr,
                                               true,
                                               true,
                                               nowhere,
                                               nowhere,
                                               0,
                                               0,
                                               false,
                                               {{}, placed, {}}});
    TransformedEdges& edges = entry.edges;
    edges.count = polygon.size();
    if (is_small(edges)) {
        entry.first = grow(entry, room_of(entry));
        find_arrays(entry);
        edges.box = write_arrays(entry);
    } else {
        if (spare_.empty()) {
            spare_.push_back(std::make_unique<Memory>());
        }
        entry.own = std::move(spare_.back());
        spare_.pop_back();
        edges.box = box != nullptr ? *box : placed.box();
    }
    write_magnitudes(pose, edges);
}

void TransformedInstances::write_magnitudes(const Pose& pose, TransformedEdges& edges) {
    edges.rounding = geometry::placement_rounding(edges.placed, edges.box);
    edges.magnitude = geometry::largest_magnitude(edges.placed, pose, edges.box);
}

void TransformedInstances::place_alone(const TransformedPolygon& placed, const Box* box) {
    const Polygon& polygon = placed.polygon();
    // Arrays of few edges in few rings are written anew where they are, unless memory ran out.
    const bool fits = !entries_.empty() && entries_.front().first != nowhere &&
                      is_small(entries_.front().edges) &&
                      entries_.front().edges.count == polygon.size() && !is_in_pieces(polygon);
    if (!fits) {
        clear();
        add(placed, {}, box);
        return;
    }
    Entry& entry = entries_.front();
    entry.revision = polygon.revision();
    entry.first_piece = entry.end_piece = 0;
    entry.edges.placed = placed;
    find_arrays(entry);
    entry.edges.box = write_arrays(entry);
    write_magnitudes({}, entry.edges);
    entry.is_complete = false;
}

void TransformedInstances::prepare(std::uint32_t index) {
    Entry& entry = entries_[index];
    if (entry.is_complete || entry.edges.on_demand != nullptr) {
        return;
    }
    const Polygon& polygon = entry.edges.placed.polygon();
    const geometry::EdgeBoxes* const boxes = is_small(entry.edges) || is_in_pieces(polygon)
                                                 ? nullptr
                                                 : polygon.find_boxes(geometry::BoxSearch::edges);
    if (boxes != nullptr) {
        place_on_demand(entry, *boxes);
    } else {
        complete(index);
    }
}

void TransformedInstances::place_on_demand(Entry& entry, const geometry::EdgeBoxes& boxes) {
    if (entry.first == nowhere) {
        entry.first = grow(entry, room_of(entry));
    }
    if (entry.first_boxes == nowhere) {
        entry.first_boxes = grow(entry, room_of_boxes(entry));
    }
    find_arrays(entry);
    Memory& memory = memory_of(entry);
    const std::uint32_t lowest = AabbTree::boxes_over(entry.edges.count);
    memory.on_demand.begin(
        entry.edges.placed, boxes,
        {memory.coordinates[entry.first].values, length_of_arrays(entry.edges.placed.polygon()),
         memory.coordinates[entry.first_boxes].values + 2 * padded(lowest)});
    entry.edges.on_demand = &memory.on_demand;
}

void TransformedInstances::complete(std::uint32_t index) {
    Entry& entry = entries_[index];
    if (entry.is_complete) {
        return;
    }
    if (entry.edges.on_demand != nullptr) {
        entry.edges.on_demand->place_all();
        entry.is_complete = true;
        return;
    }
    const std::uint32_t count = entry.edges.count;
    const Polygon& polygon = entry.edges.placed.polygon();
    if (entry.first == nowhere) {
        entry.first = grow(entry, room_of(entry));
        find_arrays(entry);
        static_cast<void>(write_arrays(entry));
    }
    std::span<const std::uint32_t> rings;
    std::uint32_t lowest = AabbTree::boxes_over(count);
    if (is_in_pieces(polygon)) {
        rings = ring_order_.sort(polygon.ring_count(), [&](std::size_t ring) {
            const std::uint32_t edge = polygon.ring_begin(static_cast<std::uint32_t>(ring));
            return Vector2{entry.edges.start_x[edge], entry.edges.start_y[edge]};
        });
        lowest = cut_into_pieces(entry, rings);
    }
    if (entry.first_boxes == nowhere) {
        entry.first_boxes = grow(entry, room_of_boxes(entry));
        find_arrays(entry);
    }
    double* const boxes = memory_of(entry).coordinates[entry.first_boxes].values;
    if (is_in_pieces(polygon)) {
        write_ring_starts(polygon, entry.edges, rings, padded(lowest), boxes);
    } else {
        write_ring_starts(polygon, entry.edges, boxes);
    }
    kernels::find_boxes(entry.edges, entry.edges.pieces, boxes);
    entry.is_complete = true;
}

std::uint32_t TransformedInstances::cut_into_pieces(Entry& entry,
                                                    std::span<const std::uint32_t> rings) {
    const Polygon& polygon = entry.edges.placed.polygon();
    std::vector<EdgeRange>& pieces = memory_of(entry).pieces;
    const std::size_t room_before = pieces.capacity();
    entry.first_piece = pieces.size();
    for (const std::uint32_t ring : rings) {
        const std::uint32_t end = polygon.ring_end(ring);
        for (std::uint32_t i = polygon.ring_begin(ring); i < end; i += AabbTree::fan_out) {
            pieces.push_back({i, std::min(i + AabbTree::fan_out, end)});
        }
    }
    entry.end_piece = pieces.size();
    if (pieces.capacity() != room_before) {
        find_moved_arrays(entry);
    }
    return static_cast<std::uint32_t>(entry.end_piece - entry.first_piece);
}

Box TransformedInstances::write_arrays(Entry& entry) {
    const Polygon& polygon = entry.edges.placed.polygon();
    const std::uint32_t count = polygon.size();
    const std::size_t length = length_of_arrays(polygon);
    double* const start_x = memory_of(entry).coordinates[entry.first].values;
    double* const start_y = start_x + length;
    double* const end_x = start_y + length;
    double* const end_y = end_x + length;
    const Extent extent = geometry::kernels::place_points(
        polygon.vertices(), entry.edges.placed.placement(), start_x, start_y);
    copy_ends(polygon, start_x, end_x);
    copy_ends(polygon, start_y, end_y);
    // The padding repeats the last edge's end: an edge of zero length.
    std::fill(start_x + count, start_x + length, end_x[count - 1]);
    std::fill(start_y + count, start_y + length, end_y[count - 1]);
    std::fill(end_x + count, end_x + length, end_x[count - 1]);
    std::fill(end_y + count, end_y + length, end_y[count - 1]);
    if (entry.edges.inverse_length != nullptr) {
        kernels::find_inverse_lengths(entry.edges, end_y + length);
    }
    return geometry::box_of(extent);
}

}  // namespace nearfield::simd
