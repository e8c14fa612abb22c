#pragma once

#include <tests/query/pair.hpp>
#include <tests/query/report.hpp>

namespace nearfield::test {

/// What a record says about a point of one boundary and the nearest point of the other.
struct NearestClaim {
    Vector2 point;
    double distance = 0.0;
    Vector2 nearest;
    Feature feature;
    bool unique = true;
};

/// The two boundaries, and what claims about them may be off by.
struct NearestTruth {
    const oracle::ShapeOracle& own;    ///< the point's boundary
    const oracle::ShapeOracle& other;  ///< the boundary of its nearest point
    double tolerance = 0.0;
    double allowed = 0.0;  ///< rounding, no more
};

/// What points and directions may differ by from exact ones: rounding, no more. Only the choice
/// between features that are equally near within d/1000 is left to the library.
[[nodiscard]] double allowed_rounding(const PlacedPair& pair);

/// The point is on its boundary, `nearest` on the other one and on its feature, the distance is
/// right, and the flag is where it must be.
void check_nearest(Report& report, const NearestTruth& truth, const NearestClaim& claim);

}  // namespace nearfield::test
