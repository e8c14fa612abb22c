#pragma once

#include <engine/manifold.hpp>
#include <engine/plan/gpu_layout.hpp>
#include <engine/plan/plan.hpp>
#include <engine/point_resolver.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield {

/// Decodes contacts: what came back for points of either boundary in the field of the other.
class ContactDecoder {
public:
    /// `words` by point of the plan.
    void decode(const plan::Plan& plan, const plan::PlannedQuery& query,
                std::span<const std::uint32_t> words, ContactResult& result);

private:
    void find_contacts_of_a(const plan::Plan& plan, const plan::PlannedQuery& query,
                            std::span<const std::uint32_t> words, double contact_distance);
    void find_contacts_of_b(const plan::Plan& plan, const plan::PlannedQuery& reverse,
                            std::span<const std::uint32_t> words, double contact_distance);
    [[nodiscard]] geometry::Vector normal_of_b_near(const ResolvedPoint& resolved);
    [[nodiscard]] geometry::Vector normal_of_b(std::uint32_t edge, double parameter);
    [[nodiscard]] geometry::Vector normal_of_b_at(const plan::BoundaryPoint& point);

    double touching_ = 0.0;  // nearer than this, the direction to the nearest point means little
    PointResolver a_in_b_;
    PointResolver b_in_a_;
    std::vector<PlacedContact> of_a_;
    std::vector<PlacedContact> of_b_;
    ManifoldBuilder manifold_;
};

}  // namespace nearfield
