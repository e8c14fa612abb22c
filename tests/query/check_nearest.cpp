#include <tests/oracle/plane.hpp>
#include <tests/query/check_nearest.hpp>
#include <tests/query/field_laws.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::test {
namespace {

using oracle::Nearest;
using oracle::ShapeOracle;

double angle_between(const Vector2& a, const Vector2& b) {
    return std::abs(std::atan2(a.x * b.y - a.y * b.x, oracle::dot(a, b)));
}

/// The flag must be cleared if another local minimum of the distance is clearly within d/1000 and
/// farther from `nearest` than twice the extent of one straight wall's points within d/1000; it
/// must be set if no edge has a point within d/1000 in any other direction.
void check_unique(Report& report, const NearestTruth& truth, const NearestClaim& claim) {
    const double slack = truth.tolerance / 1000;
    if (claim.unique) {
        const double along_wall = std::sqrt(slack * (2 * claim.distance + slack));
        const double clearly_near = claim.distance + 0.9 * slack - 2 * truth.allowed;
        for (const Nearest& rival : truth.other.local_minima_within(claim.point, clearly_near)) {
            report.require(
                oracle::distance(rival.point, claim.nearest) <= 2.05 * along_wall + truth.allowed,
                claim, "called unique; a rival is ", rival.distance, " away at ", rival.point.x,
                ", ", rival.point.y);
        }
    } else if (claim.distance > slack) {
        const auto others =
            truth.other.edges_within(claim.point, claim.distance + 1.1 * slack + 2 * truth.allowed);
        const Vector2 direction = oracle::minus(claim.nearest, claim.point);
        const bool rivalled = std::any_of(others.begin(), others.end(), [&](const Nearest& other) {
            return angle_between(oracle::minus(other.point, claim.point), direction) > 1e-6;
        });
        report.require(rivalled, claim, "called not unique and has no rival");
    }
}

}  // namespace

std::ostream& operator<<(std::ostream& text, const NearestClaim& claim) {
    return text << "record at " << claim.point.x << ", " << claim.point.y << ", distance "
                << claim.distance << " to " << claim.nearest.x << ", " << claim.nearest.y
                << (claim.unique ? "" : " (not unique)") << ": ";
}

double allowed_rounding(const PlacedPair& pair) {
    return pair.rounding() + 1e-6 * pair.tolerance();
}

void check_nearest(Report& report, const NearestTruth& truth, const NearestClaim& claim) {
    const auto require_at_most = [&](double value, double most, const char* what) {
        report.require(value <= most, claim, what, ' ', value);
    };
    require_at_most(truth.own.nearest(claim.point).distance, truth.allowed,
                    "the point is off its boundary by");
    require_at_most(truth.other.nearest(claim.nearest).distance, truth.allowed,
                    "`nearest` is off the other boundary by");
    require_at_most(distance_to_feature(truth.other, claim.feature, claim.nearest), truth.allowed,
                    "`nearest` is off its feature by");
    require_at_most(std::abs(oracle::distance(claim.point, claim.nearest) - claim.distance),
                    truth.allowed, "the distance misses that to `nearest` by");
    require_at_most(std::abs(claim.distance - truth.other.nearest(claim.point).distance),
                    1e-3 * truth.tolerance + truth.allowed, "the distance is off by");
    check_unique(report, truth, claim);
}

}  // namespace nearfield::test
