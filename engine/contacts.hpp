#pragma once

#include <engine/found_contacts.hpp>
#include <engine/plan/gpu_layout.hpp>
#include <engine/plan/plan.hpp>
#include <engine/point_resolver.hpp>

#include <cstdint>
#include <span>

namespace nearfield {

/// Decodes contacts: what came back for points of either boundary in the field of the other.
class ContactDecoder {
public:
    /// Finds the contacts of a query. `words` by point of the plan; `cell`: the side of a grid
    /// cell, world units.
    void find(const plan::Plan& plan, const plan::PlannedQuery& query,
              std::span<const std::uint32_t> words, double cell, FoundContacts& found);

private:
    PointResolver a_in_b_;
    PointResolver b_in_a_;
};

}  // namespace nearfield
