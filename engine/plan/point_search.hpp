#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/plan/plan.hpp>

#include <shaders/search.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace nearfield::plan {

/// The search for boundary points by the compute technique: the device finds the points of A's
/// boundary that a query asks for, the side of B's boundary on which they lie, and the nearest edge
/// of B, with nothing planned on the CPU (shaders/search.h).

/// Sixteen bytes of the search's input.
using SearchUnit = std::array<std::uint32_t, 4>;

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
