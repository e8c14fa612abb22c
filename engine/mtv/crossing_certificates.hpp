#pragma once

#include <engine/mtv/work_budget.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nearfield::mtv {

/// The translations of A for which an edge of A crosses an edge of B: a parallelogram, the common
/// part of two strips. Proves an overlap where boundaries cross but no vertex is deep inside, such
/// as for bars and the teeth of combs.
struct CrossingCertificate {
    geometry::Vector across_a;  ///< unit normal of A's edge
    geometry::Vector across_b;  ///< of B's edge
    double middle_a = 0.0;      ///< coordinate of the strip's middle along the normal
    double middle_b = 0.0;
    double half_a = 0.0;  ///< half the width of the strip
    double half_b = 0.0;

    /// How far inside the strips all translations of a rectangle are, and any of them is; negative
    /// outside.
    struct Reach {
        double least;
        double most;
    };
    [[nodiscard]] Reach reach(const geometry::Vector& centre, const geometry::Vector& half) const {
        const double by_a = half_a - std::abs(across_a.dot(centre) - middle_a);
        const double by_b = half_b - std::abs(across_b.dot(centre) - middle_b);
        const double extent_a = across_a.cwiseAbs().dot(half);
        const double extent_b = across_b.cwiseAbs().dot(half);
        return {std::min(by_a - extent_a, by_b - extent_b),
                std::min(by_a + extent_a, by_b + extent_b)};
    }
    /// The part of a rectangle around the centre that is certified, 0 to 1, roughly; 0 or less if
    /// the centre is not.
    [[nodiscard]] double part_of(const geometry::Vector& centre,
                                 const geometry::Vector& half) const {
        const double by_a = half_a - std::abs(across_a.dot(centre) - middle_a);
        const double by_b = half_b - std::abs(across_b.dot(centre) - middle_b);
        if (std::min(by_a, by_b) <= 0.0) {
            return std::min(by_a, by_b);
        }
        return std::min(1.0, by_a / across_a.cwiseAbs().dot(half)) *
               std::min(1.0, by_b / across_b.cwiseAbs().dot(half));
    }
};

/// The certificate of an edge of A and one of B; without any reach if they are parallel.
[[nodiscard]] CrossingCertificate crossing_of(const simd::TransformedEdges& a,
                                              const simd::TransformedEdges& b,
                                              const simd::EdgePair& pair);

/// Finds the certificates of the longest edges of two shapes. Reuses its memory.
class CrossingCertificates {
public:
    /// Writes the certificates that reach farther than `least`, for translations up to `longest`.
    void find(const simd::TransformedEdges& a, const simd::TransformedEdges& b, double longest,
              double least, WorkBudget& work, std::vector<CrossingCertificate>& certificates);

private:
    struct Edge {
        std::uint32_t index = 0;
        double length = 0.0;
        geometry::Vector along = geometry::Vector::Zero();  ///< unit vector
    };
    /// Of those that come to a box.
    static void find_longest(const simd::TransformedEdges& edges, const geometry::Box& reach,
                             std::vector<Edge>& longest);

    std::vector<Edge> of_a_;
    std::vector<Edge> of_b_;
};

}  // namespace nearfield::mtv
