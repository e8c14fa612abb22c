#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/plan/plan.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace nearfield::plan {

/// The search for boundary points by the compute technique: the device finds the points of A's
/// boundary that a query asks for, the side of B's boundary on which they lie, and the nearest edge
/// of B, with nothing planned on the CPU. Structures in the layout of shaders/search.glsl (std430).
///
/// A shape is given in its own frame, relative to its centre, in units of a power of two near its
/// radius, in chunks of edges that are consecutive on one ring: a box per chunk, and levels of
/// boxes above, until at most one group is left. Many rings, which may come in any order, are in
/// Morton order.

/// Sixteen bytes of the search's input.
using SearchUnit = std::array<std::uint32_t, 4>;

/// Edges per chunk, and boxes per box of the next level.
inline constexpr std::uint32_t chunk_size = 8;
/// Elements that the device sums at once: those of one workgroup.
inline constexpr std::uint32_t search_block = 64;
/// Points that one of the device's threads resolves.
inline constexpr std::uint32_t points_per_thread = 4;
/// Replaces the first word of the numbers of parts: one point per edge, its first vertex.
inline constexpr std::uint32_t no_parts = UINT32_MAX;

/// The points of A's boundary in the field of B. Lengths in units of B's frame.
struct SearchDirectionData {
    std::array<float, 2> axis{1.0F, 0.0F};   ///< A's x axis, of a unit of A's frame, in B's
    std::array<float, 2> offset{};           ///< A's centre in B's frame
    std::uint32_t shape_a = 0, shape_b = 0;  ///< first units in the input
    std::uint32_t parts = no_parts;          ///< first word of the numbers of parts of A's edges
    std::uint32_t first_item = 0;            ///< an item is a chunk of A in one direction
    float reach = 0.0F;                      ///< from B's boundary to points outside
    float margin = 0.0F;                     ///< bound on the errors of single precision
    float rival = 0.0F;    ///< a second point farther by no more: the nearest is not unique
    float outside = 0.0F;  ///< 1: points outside B are asked for as well
    float doubt = 0.0F;    ///< a second edge farther by no more: in doubt; < 0: never
    float unused[3]{};
};
static_assert(sizeof(SearchDirectionData) == 4 * sizeof(SearchUnit));

/// A point that the device has found.
struct FoundPointData {
    std::uint32_t direction = 0;
    std::uint32_t edge = 0;    ///< of A
    std::uint32_t number = 0;  ///< among the points of the edge
    std::uint32_t word = 0;    ///< B's nearest edge and flags, as point_inside
};
static_assert(sizeof(FoundPointData) == 16);

/// The point of A's boundary that the device has found.
[[nodiscard]] BoundaryPoint found_point(const PlannedQuery& query, const FoundPointData& found);

/// A part of a batch's searches, small enough for the buffers of one.
struct PointSearch {
    std::vector<SearchDirectionData> directions;
    std::vector<std::uint32_t> queries;  ///< by direction: index in Plan::queries
    std::uint32_t items = 0;
    std::vector<std::uint32_t> first_directions;  ///< by block of items: of its first item
    double max_edges = 0.0;                       ///< upper bounds on what the device may find
    double max_points = 0.0;

    void clear() {
        directions.clear();
        queries.clear();
        items = 0;
        first_directions.clear();
        max_edges = max_points = 0.0;
    }
};

/// Points of one search at most; keeps all its buffers within the range that every device can
/// address.
inline constexpr double max_searched_points = 1U << 21U;

/// The shapes that the input of searches starts with.
struct SearchShapes {
    std::span<const SearchUnit> units;
    std::uint64_t revision = 0;  ///< differs if a unit may have changed
};

/// Turns the searched queries of a plan into the device's input. Keeps what it makes of a shape
/// until the shape changes.
class PointSearchBuilder {
public:
    /// Fills the first searches of `searches`, which grows as needed, and returns their number.
    std::size_t build(Plan& plan, std::vector<PointSearch>& searches);
    /// The shapes of the last build, and more; the input starts with them.
    [[nodiscard]] SearchShapes shapes() const { return {units_, revision_}; }

private:
    struct Key {
        const geometry::Polygon* polygon = nullptr;
        double spacing = 0.0;  ///< of samples; 0: the shape itself

        [[nodiscard]] bool operator==(const Key&) const = default;
    };
    struct Hash {
        [[nodiscard]] std::size_t operator()(const Key& key) const;
    };
    struct Entry {
        std::uint64_t revision = 0;
        std::uint32_t first = 0;  ///< unit
        std::uint32_t room = 0;   ///< units that it may take; 0: not made yet
        std::uint64_t batch = 0;  ///< that used it last
    };

    void drop_unused();
    [[nodiscard]] std::uint32_t find_or_make(const Key& key);
    void make_shape(const geometry::Polygon& polygon);
    void order_rings(const geometry::Polygon& polygon);
    void add_chunks(const geometry::Polygon& polygon, std::uint32_t edges, std::uint32_t infos);
    void add_level(std::uint32_t first);
    void make_parts(const geometry::Polygon& polygon, double spacing);
    void add(Plan& plan, const SearchedQuery& searched, PointSearch& search);

    std::unordered_map<Key, Entry, Hash> entries_;
    std::vector<SearchUnit> units_;
    std::vector<SearchUnit> made_;  // of one shape
    std::vector<std::array<float, 4>> boxes_;
    /// Of a ring: its place on a Morton curve, its number, its first chunk along the rings.
    struct OrderedRing {
        std::uint32_t on_curve;
        std::uint32_t ring;
        std::uint32_t first_chunk;
    };
    std::vector<OrderedRing> rings_;
    std::uint64_t revision_ = 0;
    std::uint64_t batch_ = 0;
    std::size_t units_in_use_ = 0;  // by the present batch
};

}  // namespace nearfield::plan
