#pragma once

#include <engine/narrowphase/boundary.hpp>
#include <engine/queries/boundary_points.hpp>
#include <engine/solvers/boundary_normal.hpp>
#include <engine/solvers/manifold.hpp>
#include <engine/solvers/resolved_point.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::solvers {

/// Collects the contacts of two boundaries as they are found: their records, with analytic normals,
/// and their manifold. Reuses its memory between queries.
class FoundContacts {
public:
    /// Removes the previous contacts. `cell`: the side of a grid cell; `rounding`: of both shapes'
    /// vertices.
    void begin(double cell, double rounding);

    /// Adds a sample of A's boundary that is close to B, in order along A's rings.
    /// `boundary_of_b()` returns a narrowphase::Boundary & and is called only if the normal
    /// requires it; see decide_normals().
    template <class BoundaryOfB>
    void add_of_a(const queries::BoundaryPoint& place, const ResolvedPoint& resolved,
                  const BoundaryOfB& boundary_of_b) {
        if (resolved.distance > undirected_) {
            of_a_.push_back(
                {make_record(resolved, Side::a, growth_of_distance(resolved)), place, place});
            return;
        }
        of_a_.push_back({make_record(resolved, Side::a, geometry::Vector::Zero()), place, place});
        normals_of_a_.push_back(
            {of_a_.size() - 1, ask_normal_at_nearest(boundary_of_b(), resolved)});
    }
    /// The same for a sample of B's boundary.
    void add_of_b(const queries::BoundaryPoint& place, const ResolvedPoint& resolved,
                  narrowphase::Boundary& boundary_of_b) {
        of_b_.push_back({make_record(resolved, Side::b, geometry::Vector::Zero()),
                         place,
                         {resolved.edge, resolved.parameter}});
        normals_of_b_.push_back({of_b_.size() - 1, ask_outward_normal_at(boundary_of_b, place)});
    }
    /// Sets the normals of the contacts added, all at once. `boundary_of_b()` as above.
    template <class BoundaryOfB>
    void decide_normals(const BoundaryOfB& boundary_of_b) {
        if (!normals_of_a_.empty() || !normals_of_b_.empty()) {
            decide_normals_by(boundary_of_b());
        }
    }

    /// The number of contacts that were added.
    [[nodiscard]] std::uint32_t count() const {
        return static_cast<std::uint32_t>(of_a_.size() + of_b_.size());
    }
    /// Appends the points of the contacts found: A's, then B's.
    void append_points(std::vector<Vector2>& points) const;
    /// Sets normals to the field's gradients at the points of append_points(). Where the gradient
    /// nearly vanishes, between walls, a contact keeps its normal and is not unique.
    void set_normals(std::span<const Vector2> gradients);

    /// Writes the contacts and their manifold, with A and B in the order that the manifold uses.
    void write(const geometry::Polygon& a, const geometry::Polygon& b, const ContactQuery& query,
               ContactResult& result);

private:
    struct NormalOfContact {
        std::size_t contact;
        AskedBoundaryNormal asked;
    };

    [[nodiscard]] ContactPoint make_record(const ResolvedPoint& resolved, Side on,
                                           const geometry::Vector& normal) const;
    /// The gradient of the signed distance.
    [[nodiscard]] static geometry::Vector growth_of_distance(const ResolvedPoint& resolved);
    [[nodiscard]] static AskedBoundaryNormal ask_normal_at_nearest(narrowphase::Boundary& boundary,
                                                                   const ResolvedPoint& resolved);
    void decide_normals_by(narrowphase::Boundary& boundary_of_b);

    // At distances below this, rounding would determine the direction to the nearest point.
    double undirected_ = 0.0;
    double touching_depth_ = 0.0;  // of points that do not count as inside
    std::vector<TransformedContact> of_a_;
    std::vector<TransformedContact> of_b_;
    std::vector<NormalOfContact> normals_of_a_;  // that are not decided yet
    std::vector<NormalOfContact> normals_of_b_;
    ManifoldBuilder manifold_;
};

}  // namespace nearfield::solvers
