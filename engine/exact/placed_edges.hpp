#pragma once

#include <engine/exact/box_tree.hpp>
#include <engine/exact/ring_order.hpp>
#include <engine/geometry/placed_polygon.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::exact {

/// A polygon at a pose with all its edges placed in the world, a contiguous array for each
/// coordinate, so that several are worked on at once. For polygons of few edges (see
/// most_edges_one_by_one) that is faster than any tree; those of more edges have boxes over them,
/// and no inverse lengths.
struct PlacedEdges : EdgeArrays {
    geometry::PlacedPolygon placed;
    geometry::Box box;
    double rounding = 0.0;                   ///< of the vertices: localize::placement_rounding
    double magnitude = 0.0;                  ///< geometry::largest_magnitude
    std::span<const EdgeRange> pieces = {};  ///< of a BoxTree
    const double* boxes = nullptr;           ///< of it; null where there are none yet

    /// Precondition: it has boxes.
    [[nodiscard]] BoxTree tree() const { return {*this, pieces, boxes}; }

    [[nodiscard]] geometry::Vector start(std::uint32_t edge) const {
        return {start_x[edge], start_y[edge]};
    }
    [[nodiscard]] geometry::Vector end(std::uint32_t edge) const {
        return {end_x[edge], end_y[edge]};
    }
    /// `parameter` of the way along an edge, below 1: bit for bit as plan::position() has it.
    [[nodiscard]] geometry::Vector at(std::uint32_t edge, double parameter) const {
        const geometry::Vector from = start(edge);
        return from + parameter * (end(edge) - from);
    }
};

/// So many edges are looked at one by one, without a tree.
inline constexpr std::uint32_t most_edges_one_by_one = 256;

[[nodiscard]] inline bool is_small(const PlacedEdges& edges) {
    return edges.count <= most_edges_one_by_one;
}

using geometry::extent_of;

/// By the odd-even rule. Precondition: the edges are small or have boxes.
[[nodiscard]] bool contains(const PlacedEdges& edges, const geometry::Vector& point);
/// The edge nearest to a point; likewise.
[[nodiscard]] NearEdge find_nearest(const PlacedEdges& edges, const geometry::Vector& point);

/// The instances of a batch, each placed once, however many pairs it is in. Keeps its memory.
class PlacedInstances {
public:
    void clear();
    /// The index of an instance, which is placed where it is new. Of one with many edges nothing
    /// but its box, rounding and magnitude is known until complete().
    [[nodiscard]] std::uint32_t place(const geometry::Polygon& polygon, const Pose& pose);
    /// The same of an instance that place() will not find again.
    [[nodiscard]] std::uint32_t place(const geometry::PlacedPolygon& placed);
    /// Places all edges, and finds the boxes over them.
    void complete(std::uint32_t index);
    /// Valid until the next place() or complete().
    [[nodiscard]] const PlacedEdges& operator[](std::uint32_t index) const {
        return entries_[index].edges;
    }

private:
    static constexpr std::size_t nowhere = SIZE_MAX;

    struct Entry {
        Pose pose;
        std::size_t first;        // of its arrays, which follow one another
        std::size_t first_boxes;  // nowhere, like the arrays, where there are none yet
        std::size_t first_piece;  // of its pieces, of which there may be none
        std::size_t end_piece;
        PlacedEdges edges;
    };
    /// As many as the widest vector has, where it loads them fastest.
    struct alignas(most_lanes * sizeof(double)) Coordinates {
        double values[most_lanes];
    };

    [[nodiscard]] std::size_t slot_of(const geometry::Polygon& polygon, const Pose& pose) const;
    [[nodiscard]] static bool is(const Entry& entry, const geometry::Polygon& polygon,
                                 const Pose& pose);
    [[nodiscard]] std::uint32_t find_or_add(const geometry::Polygon& polygon, const Pose& pose);
    void add(const geometry::PlacedPolygon& placed, const Pose& pose);
    /// Cuts the rings of an entry into pieces, in this order; returns how many.
    [[nodiscard]] std::uint32_t cut_into_pieces(Entry& entry, std::span<const std::uint32_t> rings);
    /// Writes the arrays of an entry, for which there is room; returns the box around them.
    [[nodiscard]] geometry::Box write_arrays(const Entry& entry);
    void rehash();
    /// Says where the arrays of an entry are.
    void find_arrays(Entry& entry) const;
    /// Makes room for so many coordinates more; returns where.
    [[nodiscard]] std::size_t grow(std::size_t by);

    std::vector<Entry> entries_;
    std::vector<Coordinates> coordinates_;  // the first used_ of them; the others wait for more
    std::size_t used_ = 0;
    std::vector<EdgeRange> pieces_;
    RingOrder ring_order_;
    std::array<std::uint32_t, 2> recent_{};  // asked for last: pairs come in both orders
    std::vector<std::uint32_t> slots_;       // a hash table of entries, a power of two
};

}  // namespace nearfield::exact
