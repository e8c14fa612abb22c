#pragma once

#include <engine/localize/lazy_tree.hpp>

#include <cstdint>
#include <limits>

namespace nearfield::exact {

/// Two boundary points, one on each of two polygons.
struct ClosestPair {
    std::uint32_t edge_a = 0;
    std::uint32_t edge_b = 0;
    geometry::Vector point_a = geometry::Vector::Zero();
    geometry::Vector point_b = geometry::Vector::Zero();
    double parameter_a = 0.0;  ///< of point_a on edge_a: 0 at its first vertex, 1 at its last
    double parameter_b = 0.0;
    double squared_distance = std::numeric_limits<double>::infinity();
};

/// Whose closest point is asked about.
enum class Side : std::uint8_t { a, either };

/// The closest points of two boundaries, exact up to the rounding of double precision: the
/// hierarchies of localisation, driven down to single edges. Keeps its memory from call to call.
class ClosestPairFinder {
public:
    /// `at_most`: some two boundary points are known to be no farther apart; infinity where nothing
    /// is known. The tighter, the less is looked at.
    ClosestPair find(const geometry::PlacedPolygon& a, const geometry::PlacedPolygon& b,
                     double at_most);

    /// Of the pair that the last find() gave: false where two other boundary points are no farther
    /// apart than it and `margin`, and the one of A, or one of either, is more than `apart` away
    /// from the pair's own. The polygons are still those of find().
    [[nodiscard]] bool is_unique(const ClosestPair& closest, Side side, double margin,
                                 double apart);

private:
    localize::LazyTree tree_a_;
    localize::LazyTree tree_b_;
};

}  // namespace nearfield::exact
