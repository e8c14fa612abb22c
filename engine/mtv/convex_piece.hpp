#pragma once

#include <engine/geometry/vector.hpp>

#include <utility>
#include <vector>

namespace nearfield::mtv {

/// A convex region of the plane, clipped by half planes, and its core: the part that is at least a
/// margin away from every line it was clipped with. A region without a core is too thin to count:
/// it lies between lines that coincide up to rounding. Reuses its memory.
class ConvexPiece {
public:
    ConvexPiece();
    /// Starts with a rectangle around a centre. `half`: half its sides. `margin`: that of the core.
    void begin(const geometry::Vector& centre, const geometry::Vector& half, double margin);
    /// Clips to the half plane whose coordinate along `direction`, a unit vector, is at least
    /// `least`.
    void keep(const geometry::Vector& direction, double least);
    /// Becomes the given piece clipped to the half plane.
    void keep_of(const ConvexPiece& whole, const geometry::Vector& direction, double least);

    void clear() { core_.clear(); }
    void swap(ConvexPiece& other) {
        corners_.swap(other.corners_);
        core_.swap(other.core_);
        std::swap(margin_, other.margin_);
    }

    /// True if there is no core.
    [[nodiscard]] bool is_empty() const { return core_.empty(); }
    /// Returns the point nearest to 0. Precondition, as of the others: not empty.
    [[nodiscard]] geometry::Vector nearest() const { return nearest_of(corners_); }
    /// Returns the point of the core nearest to 0.
    [[nodiscard]] geometry::Vector nearest_of_core() const { return nearest_of(core_); }
    /// Returns an interior point of the core.
    [[nodiscard]] geometry::Vector middle() const;
    [[nodiscard]] geometry::Box box() const;
    /// An interval of coordinates along a unit vector.
    struct Range {
        double least;
        double most;
    };
    [[nodiscard]] Range along(const geometry::Vector& direction) const;

private:
    using Corners = std::vector<geometry::Vector>;  // counter-clockwise

    static void clip(const Corners& corners, const geometry::Vector& direction, double least,
                     Corners& kept);
    [[nodiscard]] static geometry::Vector nearest_of(const Corners& corners);

    Corners corners_;
    Corners core_;
    Corners kept_;  // scratch
    double margin_ = 0.0;
};

}  // namespace nearfield::mtv
