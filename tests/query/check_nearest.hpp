#pragma once

#include <tests/query/pair.hpp>
#include <tests/query/report.hpp>

#include <ostream>

namespace nearfield::test {

/// The part of a record that relates a point of one boundary to the nearest point of the other.
struct NearestClaim {
    Vector2 point;
    double distance = 0.0;
    Vector2 nearest;
    Feature feature;
    bool unique = true;
};

std::ostream& operator<<(std::ostream& text, const NearestClaim& claim);

/// The two boundaries and the allowed error of claims about them.
struct NearestTruth {
    const oracle::ShapeOracle& own;    ///< the point's boundary
    const oracle::ShapeOracle& other;  ///< the boundary of its nearest point
    double tolerance = 0.0;
    double allowed = 0.0;  ///< rounding only
};

/// The allowed error of points and directions: rounding only. The library is free only to choose
/// between features that are equally near within d/1000.
[[nodiscard]] double allowed_rounding(const PlacedPair& pair);

/// The point must be on its boundary, `nearest` on the other one and on its feature, the distance
/// correct, and the flag set where required.
void check_nearest(Report& report, const NearestTruth& truth, const NearestClaim& claim);

}  // namespace nearfield::test
