#include "agreement.hpp"

#include <tests/oracle/plane.hpp>
#include <tests/query/all_numbers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

/// The cells that only one of two results has.
std::vector<Vector2> other_cells(const IntersectionResult& one, const IntersectionResult& other) {
    using Point = std::pair<double, double>;
    const auto sorted = [](const IntersectionResult& result) {
        std::vector<Point> cells;
        for (const IntersectionSample& sample : result.samples) {
            cells.emplace_back(sample.position.x, sample.position.y);
        }
        std::sort(cells.begin(), cells.end());
        return cells;
    };
    const std::vector<Point> ours = sorted(one);
    const std::vector<Point> theirs = sorted(other);
    std::vector<Point> apart;
    std::set_symmetric_difference(ours.begin(), ours.end(), theirs.begin(), theirs.end(),
                                  std::back_inserter(apart));
    std::vector<Vector2> points;
    for (const auto& [x, y] : apart) {
        points.push_back({x, y});
    }
    return points;
}

/// A feature position that both results report.
struct Place {
    Vector2 one;
    Vector2 other;
};

/// The search ends with an exact computation, whatever was rendered.
template <class Result>
void check_closest(Report& report, const Result& one, const Result& other,
                   const std::array<Place, 2>& places) {
    report.require(one.distance == other.distance, "distances are ", one.distance, " and ",
                   other.distance);
    report.require(one.unique == other.unique, "unique is ", one.unique, " and ", other.unique);
    for (const Place& place : places) {
        report.require(!one.unique || one.distance == 0.0 ||
                           oracle::distance(place.one, place.other) <= one.tolerance,
                       "a place is ", place.one.x, ", ", place.one.y, " and ", place.other.x, ", ",
                       place.other.y);
    }
    report.require(std::abs(one.sampled_distance - other.sampled_distance) <= one.tolerance / 1000,
                   "sampled distances are ", one.sampled_distance, " and ", other.sampled_distance);
}

template <class Result>
void check_identical(Report& report, const Result& one, const Result& other) {
    const auto numbers = [](const Result& result) {
        Results results;
        results.results.emplace_back(result);
        return all_numbers(results);
    };
    report.require(numbers(one) == numbers(other), "numbers differ");
}

bool same_regions(const ResultSummary& one, const ResultSummary& other) {
    if (one.regions.size() != other.regions.size()) {
        return false;
    }
    for (std::size_t i = 0; i < one.regions.size(); ++i) {
        const Region& a = one.regions[i];
        const Region& b = other.regions[i];
        if (!(a.min == b.min) || !(a.max == b.max) || a.width != b.width || a.height != b.height) {
            return false;
        }
    }
    return true;
}

/// Members common to all results.
void check_summaries(Report& report, SubPixelGrids grids, const ResultSummary& one,
                     const ResultSummary& other) {
    report.require(one.status.ok() && other.status.ok(), one.status.text(), " and ",
                   other.status.text());
    report.require(one.tolerance == other.tolerance, "tolerances differ");
    report.require(one.technique == other.technique, "techniques differ");
    report.require(one.intersects == other.intersects, "intersects is ", one.intersects, " and ",
                   other.intersects);
    if (grids == SubPixelGrids::same) {
        // For a field it includes a fraction of the largest value, which may differ by the bounds.
        const double share = std::ldexp(one.error_bound + other.error_bound, -21);
        report.require(std::abs(one.error_bound - other.error_bound) <= share, "bounds are ",
                       one.error_bound, " and ", other.error_bound);
        report.require(one.cell == other.cell, "cells are ", one.cell, " and ", other.cell);
        report.require(same_regions(one, other), "regions differ");
    }
}

}  // namespace

bool same_feature(const Feature& one, const Feature& other) {
    return one.kind == other.kind && one.index == other.index;
}

double Naming::along_wall(double distance) const {
    return 2.0 * std::sqrt(margin * (2.0 * distance + margin));
}

bool Naming::has_rival(const Vector2& point, const NamedFeature& named) const {
    const double reach = named.distance + 1.1 * margin + 2.0 * rounding;
    const double apart = 0.9 * along_wall(named.distance) - rounding;
    const auto others = shape.edges_within(point, reach);
    return std::any_of(others.begin(), others.end(), [&](const oracle::Nearest& other) {
        return oracle::distance(other.point, named.nearest) > apart;
    });
}

bool Naming::allows(const Vector2& point, const NamedFeature& one,
                    const NamedFeature& other) const {
    if (same_feature(one.feature, other.feature)) {
        return one.nearest == other.nearest && one.distance == other.distance &&
               (one.unique == other.unique || has_rival(point, one));
    }
    if (std::abs(one.distance - other.distance) > margin + rounding) {
        return false;
    }
    const double most = along_wall(std::min(one.distance, other.distance)) + rounding;
    return (!one.unique && !other.unique) || oracle::distance(one.nearest, other.nearest) <= most;
}

/// Raster: coverage is decided in integers, so results on equal grids must be identical. Compute:
/// cells may differ that are about as near to a boundary as it decides by. On different grids the
/// cells differ, and other tests compare each driver's results with the oracle.
void check_agreement(Report& report, const Asked& asked, const IntersectionResult& one,
                     const IntersectionResult& other) {
    report.require(one.kind == other.kind, "kinds differ");
    if (asked.grids == SubPixelGrids::apart) {
        return;
    }
    if (one.technique == Technique::compute) {
        for (const Vector2& point : other_cells(one, other)) {
            const double nearest = std::min(asked.pair.a().nearest(point).distance,
                                            asked.pair.b().nearest(point).distance);
            report.require(nearest <= one.error_bound + asked.pair.rounding(), "only one has ",
                           point.x, ", ", point.y, ", which is ", nearest, " from a boundary");
        }
        return;
    }
    report.require(one.count == other.count && one.area == other.area, "counts are ", one.count,
                   " and ", other.count);
    if (one.count > 0 && other.count > 0) {
        report.require(one.box.min == other.box.min && one.box.max == other.box.max,
                       "boxes differ");
    }
    report.require(one.samples.size() == other.samples.size(), one.samples.size(), " samples and ",
                   other.samples.size());
    for (std::size_t i = 0; report.clean() && i < one.samples.size(); ++i) {
        const IntersectionSample& a = one.samples[i];
        const IntersectionSample& b = other.samples[i];
        report.require(a.position == b.position, "sample ", i, " at ", a.position.x, ", ",
                       a.position.y, " and ", b.position.x, ", ", b.position.y);
        report.require(a.edge == b.edge, "sample ", i, " names edges ", a.edge, " and ", b.edge);
    }
}

void check_agreement(Report& report, const Asked&, const ClosestPointResult& one,
                     const ClosestPointResult& other) {
    check_closest(report, one, other, {{{one.point, other.point}, {one.nearest, other.nearest}}});
}

void check_agreement(Report& report, const Asked&, const SeparationResult& one,
                     const SeparationResult& other) {
    check_closest(report, one, other,
                  {{{one.point_a, other.point_a}, {one.point_b, other.point_b}}});
}

AnyResult by_technique_of(const AnyResult& found, AnyResult other) {
    std::visit(
        [&other](const auto& searched) {
            std::visit(
                [&searched](auto& one) {
                    one.technique = searched.technique;
                    one.regions = searched.regions;
                },
                other);
        },
        found);
    return other;
}

void check_agreement(const Asked& asked, const AnyResult& one, const AnyResult& other) {
    std::visit(
        [&](const auto& first) {
            const auto& second = std::get<std::decay_t<decltype(first)>>(other);
            Report report("answers of two drivers");
            if (first.technique == Technique::cpu) {  // the same bits whatever the device
                check_identical(report, first, second);
                return;
            }
            check_summaries(report, asked.grids, first, second);
            if (!report.clean()) {
                return;
            }
            if constexpr (requires { check_agreement(report, asked, first, second); }) {
                check_agreement(report, asked, first, second);
            } else {  // answers from the CPU alone
                check_identical(report, first, second);
            }
        },
        one);
}

}  // namespace nearfield::test
