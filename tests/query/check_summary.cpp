#include <tests/query/check.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace nearfield::test {

void check_summary(Report& report, const ResultSummary& result, double tolerance) {
    check_summary(report, result, tolerance, tolerance * std::numbers::sqrt2);
}

void check_summary(Report& report, const ResultSummary& result, double tolerance, double cell) {
    report.require(result.status.ok(), "status: ", result.status.text());
    if (!result.status.ok()) {
        return;
    }
    report.require(result.tolerance == tolerance, "tolerance is ", result.tolerance);
    report.require(result.error_bound >= 0.0 && result.error_bound <= tolerance * (1 + 1e-12),
                   "error bound ", result.error_bound, " for d = ", tolerance);
    report.require(
        result.regions.empty() || (result.cell > 0.0 && result.cell <= cell * (1 + 1e-9)), "cell ",
        result.cell, " for d = ", tolerance);
    for (const Region& region : result.regions) {
        const double magnitude = std::abs(region.min.x) + std::abs(region.max.x) +
                                 std::abs(region.min.y) + std::abs(region.max.y);
        const double allowed = 1e-9 * result.cell + 1e-13 * magnitude;
        report.require(region.width > 0 && region.height > 0, "region of no cells");
        report.require(
            std::abs(region.max.x - region.min.x - region.width * result.cell) <= allowed &&
                std::abs(region.max.y - region.min.y - region.height * result.cell) <= allowed,
            "region from ", region.min.x, ", ", region.min.y, " to ", region.max.x, ", ",
            region.max.y, " is not ", region.width, " x ", region.height, " cells of ",
            result.cell);
    }
}

namespace {

void check_intersects(Report& report, const ResultSummary& result, const PlacedPair& pair) {
    const Truth truth = pair.intersects();
    report.require(truth == Truth::too_close_to_call || result.intersects == (truth == Truth::yes),
                   "intersects is ", result.intersects);
}

}  // namespace

void check_summary(Report& report, const ResultSummary& result, const PlacedPair& pair) {
    check_summary(report, result, pair.tolerance());
    check_intersects(report, result, pair);
}

void check_search_summary(Report& report, const ResultSummary& result, const PlacedPair& pair) {
    check_summary(report, result, pair.tolerance(), std::numeric_limits<double>::infinity());
    check_intersects(report, result, pair);
}

}  // namespace nearfield::test
