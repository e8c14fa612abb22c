#pragma once

#include <engine/plan/plan.hpp>
#include <engine/plan/search_shapes.hpp>

#include <shaders/search.h>

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

/// The pairs that a batch gives to the device's search, as it takes them.
struct GivenPairs {
    std::vector<SearchDirectionData> directions;
    std::uint32_t items = 0;
    double max_edges = 0.0;  ///< upper bounds on what the device may find
    double max_points = 0.0;

    void clear() {
        directions.clear();
        items = 0;
        max_edges = max_points = 0.0;
    }
};

/// Points of A's boundary at most, of a query or a pair.
inline constexpr double max_searched_points = 1U << 21U;

/// Turns the searched queries of a plan into the device's input.
class GivenPairsBuilder {
public:
    /// Shapes of earlier plans are kept as long as all take no more than `largest_range` bytes.
    void build(const Plan& plan, std::uint64_t largest_range, GivenPairs& pairs);
    /// The shapes of the last build, and more.
    [[nodiscard]] const SearchShapes& shapes() const { return shapes_; }

private:
    void fill(const Plan& plan, GivenPairs& pairs);

    SearchShapes shapes_;
};

}  // namespace nearfield::plan
