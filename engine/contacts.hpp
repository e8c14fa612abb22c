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
    /// Finds the contacts of a query, with analytic normals. `words` by point of the plan; `cell`:
    /// the side of a grid cell, world units.
    void find(const plan::Plan& plan, const plan::PlannedQuery& query,
              std::span<const std::uint32_t> words, double cell);

    /// Appends where the contacts found are: A's, then B's.
    void append_points(std::vector<Vector2>& points) const;
    /// Takes the field's gradients at the points of append_points(). Where there is hardly one,
    /// between walls, a contact keeps its normal and is not unique.
    void set_normals(std::span<const Vector2> gradients);

    /// Writes the contacts and their manifold.
    void write(const plan::PlannedQuery& query, ContactResult& result);

private:
    void find_contacts_of_a(const plan::Plan& plan, const plan::PlannedQuery& query,
                            std::span<const std::uint32_t> words, double contact_distance);
    void find_contacts_of_b(const plan::Plan& plan, const plan::PlannedQuery& reverse,
                            std::span<const std::uint32_t> words, double contact_distance);
    [[nodiscard]] geometry::Vector normal_of_b_near(const ResolvedPoint& resolved);

    double touching_ = 0.0;  // nearer than this, the direction to the nearest point means little
    PointResolver a_in_b_;
    PointResolver b_in_a_;
    std::vector<PlacedContact> of_a_;
    std::vector<PlacedContact> of_b_;
    ManifoldBuilder manifold_;
};

}  // namespace nearfield
