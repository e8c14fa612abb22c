#pragma once

#include <engine/plan/plan.hpp>
#include <engine/records/found_contacts.hpp>
#include <engine/records/point_resolver.hpp>

#include <shaders/layout.h>

#include <cstdint>
#include <span>

namespace nearfield::decode {

/// Decodes contacts from the resolved points of either boundary in the field of the other.
class ContactDecoder {
public:
    /// Finds the contacts of a query. `words`: the device's results, by point of the plan; `cell`:
    /// the side of a grid cell, world units.
    void find(const plan::Plan& plan, const plan::PlannedQuery& query,
              std::span<const std::uint32_t> words, double cell, records::FoundContacts& found);

private:
    records::PointResolver a_in_b_;
    records::PointResolver b_in_a_;
};

}  // namespace nearfield::decode
