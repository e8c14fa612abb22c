#pragma once

#include <engine/batch/point_resolver.hpp>
#include <engine/device_input/plan.hpp>
#include <engine/solvers/found_contacts.hpp>

namespace nearfield::batch {

/// Decodes contacts from the resolved points of either boundary in the field of the other.
class ContactDecoder {
public:
    /// A query, or the other direction of it, with its points.
    struct Direction {
        const device_input::PlannedQuery& query;
        QueryPoints points;
    };
    /// Finds the contacts of a query. `cell`: the side of a grid cell, world units.
    void find(const Direction& of_a, const Direction& of_b, double cell,
              solvers::FoundContacts& found);

private:
    PointResolver a_in_b_;
    PointResolver b_in_a_;
};

}  // namespace nearfield::batch
