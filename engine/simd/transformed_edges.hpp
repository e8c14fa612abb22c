#pragma once

#include <engine/geometry/hilbert_curve.hpp>
#include <engine/geometry/transformed_polygon.hpp>
#include <engine/simd/aabb_tree.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nearfield::simd {

/// A polygon at a pose with all its edges transformed to the world, in one contiguous array per
/// coordinate, so that several are processed at once. For polygons with few edges (see
/// max_edges_one_by_one) this is faster than any tree; larger ones have boxes over their edges, and
/// no inverse lengths. If they are only prepared (TransformedInstances::prepare), start() and end()
/// hold for all edges, and the arrays for those that a search of the tree has found.
struct TransformedEdges : EdgeArrays {
    geometry::TransformedPolygon placed;
    geometry::Box box;
    double rounding = 0.0;                     ///< of the vertices: geometry::placement_rounding
    double magnitude = 0.0;                    ///< geometry::largest_magnitude
    std::span<const EdgeRange> pieces = {};    ///< of an AabbTree
    const double* boxes = nullptr;             ///< of the tree; null until they are built
    const EdgesOnDemand* on_demand = nullptr;  ///< fills the arrays, unless they are

    /// Precondition: it has boxes.
    [[nodiscard]] AabbTree tree() const { return {*this, pieces, boxes, on_demand}; }

    [[nodiscard]] geometry::Vector start(std::uint32_t edge) const {
        place(edge);
        return {start_x[edge], start_y[edge]};
    }
    [[nodiscard]] geometry::Vector end(std::uint32_t edge) const {
        place(edge);
        return {end_x[edge], end_y[edge]};
    }
    /// All start points.
    [[nodiscard]] PointArrays all_starts() const {
        if (on_demand != nullptr) {
            on_demand->place_all();
        }
        return starts();
    }
    /// The point at `parameter` < 1 along an edge, bit for bit equal to queries::position().
    [[nodiscard]] geometry::Vector at(std::uint32_t edge, double parameter) const {
        const geometry::Vector from = start(edge);
        return from + parameter * (end(edge) - from);
    }

private:
    void place(std::uint32_t edge) const {
        if (on_demand != nullptr) {
            on_demand->place_edges(edge / AabbTree::fan_out);
        }
    }
};

/// Polygons with at most this many edges are processed by brute force, without a tree.
inline constexpr std::uint32_t max_edges_one_by_one = 256;

[[nodiscard]] inline bool is_small(const TransformedEdges& edges) {
    return edges.count <= max_edges_one_by_one;
}

using geometry::extent_of;

/// True if the point is inside by the even-odd rule. Precondition: few edges, or boxes present.
[[nodiscard]] bool contains(const TransformedEdges& edges, const geometry::Vector& point);
/// Returns the edge nearest to a point. Same precondition.
[[nodiscard]] NearEdge find_nearest(const TransformedEdges& edges, const geometry::Vector& point);
/// Lists the edges whose boxes intersect a box, in memory that grows where it has to. Same
/// precondition.
[[nodiscard]] std::span<const std::uint32_t> find_edges_in(const TransformedEdges& edges,
                                                           const geometry::Box& box,
                                                           std::vector<std::uint32_t>& memory);

/// The instances of a batch, each transformed once, however many pairs it is in. Reuses its memory.
class TransformedInstances {
public:
    /// Forgets all instances.
    void clear();
    /// Forgets instances with many edges that were not placed since the last call, and those with
    /// few edges unless more than half of what is kept of them was: if rings and pose do not
    /// change, an instance is still there for the next batch. Precondition: all polygons placed so
    /// far still exist.
    void begin_batch();
    /// Returns the index of an instance, and transforms it if it is new. If it has many edges, only
    /// its box, rounding and magnitude are known until prepare() or complete().
    [[nodiscard]] std::uint32_t place(const geometry::Polygon& polygon, const Pose& pose);
    /// Makes an instance the only one, with index 0: of many poses of a shape, one after the other,
    /// or of many shapes. No place() is to follow. `box`: its bounding box, if that is known.
    void place_alone(const geometry::TransformedPolygon& placed,
                     const geometry::Box* box = nullptr);
    /// Makes it ready to be searched: transforms all edges and builds the boxes over them, or,
    /// where the polygon has boxes of its own, what a search comes to.
    void prepare(std::uint32_t index);
    /// The same, with all edges transformed.
    void complete(std::uint32_t index);
    /// Host memory, in bytes.
    [[nodiscard]] std::size_t bytes() const;
    /// Valid until the next place(), prepare() or complete().
    [[nodiscard]] const TransformedEdges& operator[](std::uint32_t index) const {
        return entries_[index].edges;
    }

private:
    static constexpr std::size_t nowhere = SIZE_MAX;

    /// One widest vector, aligned for the fastest loads.
    struct alignas(max_lanes * sizeof(double)) Coordinates {
        double values[max_lanes];
    };
    /// Where the arrays of entries are.
    struct Memory {
        std::vector<Coordinates> coordinates;  // the first `used` are in use
        std::size_t used = 0;
        std::vector<EdgeRange> pieces;
        EdgesOnDemand on_demand;

        void clear();
    };
    struct Entry {
        Pose pose;
        std::uint64_t revision;       // of the polygon
        std::unique_ptr<Memory> own;  // null: its arrays are in the memory that entries share
        bool is_placed;               // since the last batch began
        bool is_kept;                 // where that batch began
        std::size_t first;            // of its arrays, which are consecutive
        std::size_t first_boxes;      // `nowhere`, like the arrays, until they exist
        std::size_t first_piece;      // of its pieces, if any
        std::size_t end_piece;
        bool is_complete;
        TransformedEdges edges;
    };
    [[nodiscard]] std::size_t slot_of(const geometry::Polygon& polygon, const Pose& pose) const;
    [[nodiscard]] static bool is(const Entry& entry, const geometry::Polygon& polygon,
                                 const Pose& pose);
    /// The same for the entry of an index, if there is one.
    [[nodiscard]] bool is_at(std::uint32_t index, const geometry::Polygon& polygon,
                             const Pose& pose) const;
    [[nodiscard]] std::uint32_t find_or_add(const geometry::Polygon& polygon, const Pose& pose);
    void add(const geometry::TransformedPolygon& placed, const Pose& pose,
             const geometry::Box* box = nullptr);
    /// The number of vectors that the arrays of an entry take, and its boxes, once it has pieces.
    [[nodiscard]] static std::size_t room_of(const Entry& entry);
    [[nodiscard]] static std::size_t room_of_boxes(const Entry& entry);
    /// Whether a place() may find it again.
    [[nodiscard]] static bool can_be_found(const Entry& entry);
    [[nodiscard]] bool keeps_small_ones();
    /// Cuts the rings of an entry into pieces, in this order; returns their number.
    [[nodiscard]] std::uint32_t cut_into_pieces(Entry& entry, std::span<const std::uint32_t> rings);
    /// Has the edges and boxes of an entry placed as they are needed.
    void place_on_demand(Entry& entry, const geometry::EdgeBoxes& boxes);
    /// Writes the arrays of an entry, whose space is allocated; returns its bounding box.
    [[nodiscard]] geometry::Box write_arrays(Entry& entry);
    static void write_magnitudes(const Pose& pose, TransformedEdges& edges);
    void rehash();
    void fill_slots();
    [[nodiscard]] Memory& memory_of(Entry& entry) { return entry.own ? *entry.own : shared_; }
    /// Sets the array pointers of an entry.
    void find_arrays(Entry& entry);
    /// The same for all entries whose arrays are where those of `entry` are.
    void find_moved_arrays(Entry& entry);
    /// Allocates space for `by` more coordinates of an entry; returns its index.
    [[nodiscard]] std::size_t grow(Entry& entry, std::size_t by);

    std::vector<Entry> entries_;
    std::size_t kept_ = 0;  // of the entries, those of the batch before, which come first
    SearchTrials keeping_;  // small ones
    Memory shared_;
    std::vector<std::unique_ptr<Memory>> spare_;  // of former entries
    geometry::HilbertOrder ring_order_;
    // What each call of place() with a polygon and a pose returned, in this batch or, where it has
    // not come that far, in the one before: a batch often asks about the same pairs again.
    std::vector<std::uint32_t> found_;
    std::size_t calls_ = 0;                  // in this batch
    std::array<std::uint32_t, 2> recent_{};  // most recent indices: pairs come in both orders
    std::vector<std::uint32_t> slots_;       // a hash table of entries; its size is a power of two
};

}  // namespace nearfield::simd
