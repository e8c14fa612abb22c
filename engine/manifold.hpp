#pragma once

#include <engine/geometry/polygon.hpp>
#include <engine/plan/boundary_points.hpp>
#include <nearfield/result.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield {

/// A contact and where its point lies on the boundary of its own shape.
struct PlacedContact {
    ContactRecord record;
    plan::BoundaryPoint place;
    plan::BoundaryPoint on_a;  ///< where A's point of the two lies on A's boundary
};

/// Reduces contacts to a few clusters. Keeps its memory from call to call.
class ManifoldBuilder {
public:
    /// `of_a` and `of_b`: contacts of either boundary, in order along its rings, samples of one
    /// stretch no farther apart than `spacing`. Appends to `manifold`.
    void build(const geometry::Polygon& a, const geometry::Polygon& b,
               std::span<const PlacedContact> of_a, std::span<const PlacedContact> of_b,
               double spacing, std::vector<ContactCluster>& manifold);

private:
    /// A range of contacts, and a second one where the stretch runs over the start of its ring.
    struct Stretch {
        std::size_t first = 0;
        std::size_t end = 0;
        std::size_t wrapped_first = 0;
        std::size_t wrapped_end = 0;
        geometry::Vector normals = geometry::Vector::Zero();  ///< their sum

        /// Its last contact.
        [[nodiscard]] std::size_t last() const {
            return wrapped_end > wrapped_first ? wrapped_end - 1 : end - 1;
        }
        [[nodiscard]] std::size_t count() const {
            return end - first + wrapped_end - wrapped_first;
        }
    };

    void find_stretches(const geometry::Polygon& polygon, std::span<const PlacedContact> contacts);
    void close_ring(std::span<const PlacedContact> contacts, std::size_t ring_start);
    [[nodiscard]] bool continues(std::span<const PlacedContact> contacts, const Stretch& stretch,
                                 const PlacedContact& next, const geometry::Vector& normal) const;
    void add_cluster(std::span<const PlacedContact> contacts, const Stretch& stretch,
                     std::vector<ContactCluster>& manifold) const;
    void join_contacts_of_b(const geometry::Polygon& a, std::span<const PlacedContact> of_a,
                            std::span<const PlacedContact> of_b,
                            std::span<ContactCluster> clusters);

    [[nodiscard]] std::span<const std::size_t> candidates(const geometry::Polygon& a,
                                                          std::span<const PlacedContact> of_a,
                                                          const plan::BoundaryPoint& place);

    double spacing_ = 0.0;
    std::vector<Stretch> stretches_;
    std::vector<std::size_t> by_start_;  // stretches by where they begin along A's boundary
    std::array<std::size_t, 2> candidates_{};
    std::size_t candidate_count_ = 0;
    std::vector<PlacedContact> left_over_;  // contacts of B that lie on no stretch of A
};

}  // namespace nearfield
