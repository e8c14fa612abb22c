#pragma once

#include <engine/geometry/vector.hpp>

#include <vector>

namespace nearfield::exact {

/// A convex part of the plane that lines cut pieces off. Keeps its memory.
class ConvexPiece {
public:
    /// A square around a centre, half so wide.
    void begin(const geometry::Vector& centre, double half);
    /// Leaves what is at least `least` along a direction, a unit vector.
    void keep(const geometry::Vector& direction, double least);

    [[nodiscard]] bool is_empty() const { return corners_.empty(); }
    /// The point nearest to 0. Precondition: it is not empty.
    [[nodiscard]] geometry::Vector nearest() const;
    /// A point inside, likewise.
    [[nodiscard]] geometry::Vector middle() const;

private:
    std::vector<geometry::Vector> corners_;  // counter-clockwise
    std::vector<geometry::Vector> kept_;
};

}  // namespace nearfield::exact
