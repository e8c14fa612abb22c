#pragma once

#include <engine/boundary_normal.hpp>
#include <engine/exact/boundary.hpp>
#include <engine/manifold.hpp>
#include <engine/plan/boundary_points.hpp>
#include <engine/point_resolver.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>

#include <span>
#include <vector>

namespace nearfield {

/// The contacts of two boundaries as they are found: their records, with analytic normals, and
/// their manifold. Keeps its memory from query to query.
class FoundContacts {
public:
    /// Forgets those before. `cell`: the side of a grid cell; `rounding`: of both shapes' vertices.
    void begin(double cell, double rounding);

    /// A sample of A's boundary that is close to B, in order along A's rings. `boundary_of_b()` is
    /// an exact::Boundary &, asked for where the normal takes it.
    template <class BoundaryOfB>
    void add_of_a(const plan::BoundaryPoint& place, const ResolvedPoint& resolved,
                  const BoundaryOfB& boundary_of_b) {
        const geometry::Vector normal = resolved.distance > touching_
                                            ? growth_of_distance(resolved)
                                            : normal_at_nearest(boundary_of_b(), resolved);
        of_a_.push_back({make_record(resolved, Side::a, normal), place, place});
    }
    /// The other way round.
    void add_of_b(const plan::BoundaryPoint& place, const ResolvedPoint& resolved,
                  exact::Boundary& boundary_of_b) {
        of_b_.push_back({make_record(resolved, Side::b, outward_normal_at(boundary_of_b, place)),
                         place,
                         {resolved.edge, resolved.parameter}});
    }

    /// Appends where the contacts found are: A's, then B's.
    void append_points(std::vector<Vector2>& points) const;
    /// Takes the field's gradients at the points of append_points(). Where there is hardly one,
    /// between walls, a contact keeps its normal and is not unique.
    void set_normals(std::span<const Vector2> gradients);

    /// Writes the contacts and their manifold; A and B as the manifold takes them.
    void write(const geometry::Polygon& a, const geometry::Polygon& b, const ContactQuery& query,
               ContactResult& result);

private:
    [[nodiscard]] static ContactRecord make_record(const ResolvedPoint& resolved, Side on,
                                                   const geometry::Vector& normal);
    /// The gradient of the signed distance.
    [[nodiscard]] static geometry::Vector growth_of_distance(const ResolvedPoint& resolved);
    [[nodiscard]] static geometry::Vector normal_at_nearest(exact::Boundary& boundary,
                                                            const ResolvedPoint& resolved);

    // Where there is hardly a distance, rounding would choose the direction to the nearest point.
    double touching_ = 0.0;
    std::vector<PlacedContact> of_a_;
    std::vector<PlacedContact> of_b_;
    ManifoldBuilder manifold_;
};

}  // namespace nearfield
