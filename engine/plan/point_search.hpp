#pragma once

#include <engine/plan/plan.hpp>
#include <engine/plan/search_shapes.hpp>

#include <shaders/search.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nearfield::plan {

/// The search for boundary points by the compute technique: the device finds the points of A's
/// boundary that a query asks for, the side of B's boundary on which they lie, and the nearest edge
/// of B, with nothing planned on the CPU (shaders/search.h).

/// The search for a query, or one direction of it. `axis`, `offset`: A's frame in B's, both
/// relative to the centres of the shapes.
[[nodiscard]] SearchedQuery searched_query(std::uint32_t index, const PlannedQuery& query,
                                           const geometry::Vector& axis,
                                           const geometry::Vector& offset);

/// The points of A's boundary that the device has found for a query, or one direction of it;
/// fastest where consecutive points lie on the same edge.
class FoundPlaces {
public:
    /// Keeps a reference: A must outlive it.
    explicit FoundPlaces(const PlannedQuery& query) : a_(*query.a), cell_(query.budget.cell) {}

    [[nodiscard]] BoundaryPoint operator()(const FoundPointData& found) {
        if (found.number == 0) {
            return {found.edge, 0.0};
        }
        if (found.edge != edge_) {
            enter(found.edge);
        }
        return {found.edge, found.number / parts_};
    }

private:
    void enter(std::uint32_t edge);

    const geometry::Polygon& a_;
    double cell_;
    std::uint32_t edge_ = UINT32_MAX;  // of which the number of parts is known
    double parts_ = 1.0;
};

/// A part of a batch's searches, small enough for the buffers of one.
struct PointSearch {
    std::vector<SearchDirectionData> directions;
    std::vector<std::uint32_t> queries;  ///< by direction: index in Plan::queries
    std::uint32_t items = 0;
    std::vector<std::uint32_t> first_directions;  ///< by block of items: of its first item
    double max_edges = 0.0;                       ///< upper bounds on what the device may find
    double max_points = 0.0;
    /// Of some directions the number of points and the deepest alone are asked for.
    bool summarizes = false;

    void clear() {
        directions.clear();
        queries.clear();
        items = 0;
        first_directions.clear();
        max_edges = max_points = 0.0;
        summarizes = false;
    }
};

/// Points of A's boundary at most, of a query or a pair.
inline constexpr double max_searched_points = 1U << 21U;
static_assert(max_searched_points < 1U << left_out_shift);

/// Turns the searched queries of a plan into the device's input.
class PointSearchBuilder {
public:
    /// Fills the first searches of `searches`, which grows as needed, and returns their number: as
    /// few as have buffers of at most `largest_range` bytes whatever the device finds. Shapes of
    /// earlier plans are kept as long as all take no more than that.
    std::size_t build(const Plan& plan, std::uint64_t largest_range,
                      std::vector<PointSearch>& searches);
    /// The shapes of the last build, and more; the input starts with them.
    [[nodiscard]] const SearchShapes& shapes() const { return shapes_; }

private:
    std::size_t fill(const Plan& plan, std::uint64_t largest_range,
                     std::vector<PointSearch>& searches);
    void add(const SearchedQuery& searched, PointSearch& search);

    SearchShapes shapes_;
};

}  // namespace nearfield::plan
