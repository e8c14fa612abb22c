#pragma once

#include <engine/geometry/vector.hpp>

#include <vector>

namespace nearfield::mtv {

/// A convex region of the plane, clipped by half planes. Reuses its memory.
class ConvexPiece {
public:
    /// Starts with a square around a centre; `half`: half its side.
    void begin(const geometry::Vector& centre, double half);
    /// Clips to the half plane whose coordinate along `direction`, a unit vector, is at least
    /// `least`.
    void keep(const geometry::Vector& direction, double least);

    [[nodiscard]] bool is_empty() const { return corners_.empty(); }
    /// Returns the point nearest to 0. Precondition: not empty.
    [[nodiscard]] geometry::Vector nearest() const;
    /// Returns an interior point. Precondition: not empty.
    [[nodiscard]] geometry::Vector middle() const;

private:
    std::vector<geometry::Vector> corners_;  // counter-clockwise
    std::vector<geometry::Vector> kept_;
};

}  // namespace nearfield::mtv
