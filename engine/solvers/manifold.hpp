#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/queries/boundary_points.hpp>
#include <nearfield/result.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::solvers {

/// A contact, and the position of its point on the boundary of its own shape.
struct TransformedContact {
    ContactPoint record;
    queries::BoundaryPoint place;
    queries::BoundaryPoint on_a;  ///< position of A's point of the pair on A's boundary
};

/// Reduces contacts to a few clusters. Reuses its memory between calls.
class ManifoldBuilder {
public:
    /// `of_a` and `of_b`: contacts of either boundary, in order along its rings, with samples of
    /// one interval at most `spacing` apart. Appends to `manifold`.
    void build(const geometry::Polygon& a, const geometry::Polygon& b,
               std::span<const TransformedContact> of_a, std::span<const TransformedContact> of_b,
               double spacing, std::vector<ContactCluster>& manifold);

private:
    /// A range of contacts, and a second one if the interval extends over the start of its ring.
    struct Interval {
        std::size_t first = 0;
        std::size_t end = 0;
        std::size_t wrapped_first = 0;
        std::size_t wrapped_end = 0;
        geometry::Vector normals = geometry::Vector::Zero();  ///< sum

        /// Index of its last contact.
        [[nodiscard]] std::size_t last() const {
            return wrapped_end > wrapped_first ? wrapped_end - 1 : end - 1;
        }
        [[nodiscard]] std::size_t count() const {
            return end - first + wrapped_end - wrapped_first;
        }
    };

    void find_intervals(const geometry::Polygon& polygon,
                        std::span<const TransformedContact> contacts);
    void close_ring(std::span<const TransformedContact> contacts, std::size_t ring_start);
    [[nodiscard]] bool continues(std::span<const TransformedContact> contacts,
                                 const Interval& interval, const TransformedContact& next,
                                 const geometry::Vector& normal) const;
    void add_cluster(std::span<const TransformedContact> contacts, const Interval& interval,
                     std::vector<ContactCluster>& manifold) const;
    void join_contacts_of_b(const geometry::Polygon& a, std::span<const TransformedContact> of_a,
                            std::span<const TransformedContact> of_b,
                            std::span<ContactCluster> clusters);

    [[nodiscard]] std::span<const std::size_t> candidates(const geometry::Polygon& a,
                                                          std::span<const TransformedContact> of_a,
                                                          const queries::BoundaryPoint& place);

    double spacing_ = 0.0;
    std::vector<Interval> intervals_;
    std::vector<std::size_t> by_start_;  // intervals in order of their starts along A's boundary
    std::array<std::size_t, 2> candidates_{};
    std::size_t candidate_count_ = 0;
    std::vector<TransformedContact> left_over_;  // contacts of B on no interval of A
};

}  // namespace nearfield::solvers
