#pragma once

#include <engine/device_input/plan.hpp>
#include <engine/device_input/search_shapes.hpp>

#include <shaders/search.h>

#include <cstdint>
#include <vector>

namespace nearfield::device_input {

/// The search for boundary points by the compute technique: the device finds the points of A's
/// boundary that a query asks for, the side of B's boundary on which they lie, and the nearest edge
/// of B, with nothing planned on the CPU (shaders/search.h).

/// The points of A's boundary that the device has found for a query, or one direction of it;
/// fastest where consecutive points lie on the same edge.
class FoundPlaces {
public:
    /// Keeps a reference: A must outlive it.
    explicit FoundPlaces(const PlannedQuery& query) : a_(*query.a), cell_(query.budget.cell) {}

    [[nodiscard]] queries::BoundaryPoint operator()(const shaders::FoundPointData& found) {
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

/// Makes the pairs that a plan gives to the device's search.
class GivenPairsBuilder {
public:
    /// Adds a query, or one direction of it, with this index in the plan. `axis`, `offset`: A's
    /// frame in B's, both relative to the centres of the shapes. Returns a bound on the errors of
    /// single precision, world units.
    double add(std::uint32_t index, const PlannedQuery& query, const geometry::Vector& axis,
               const geometry::Vector& offset, GivenPairs& pairs);
    /// After the last one: forgets the shapes of earlier plans if all take more than
    /// `largest_range` bytes.
    void fit(std::uint64_t largest_range, Plan& plan);
    /// Those of the pairs, and more.
    [[nodiscard]] const SearchShapes& shapes() const { return shapes_; }

private:
    /// Says where the shapes are in the input.
    void place(const PlannedQuery& query, shaders::SearchDirectionData& data);

    SearchShapes shapes_;
};

/// The largest distance from B at which points outside B matter; infinity where no distance is too
/// large.
[[nodiscard]] double reach_of(const PlannedQuery& query);

}  // namespace nearfield::device_input
