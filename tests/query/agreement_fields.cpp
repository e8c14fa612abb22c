#include "agreement.hpp"

#include <tests/oracle/plane.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::test {
namespace {

Vector2 centre_of_cell(const DistanceFieldResult& result, std::size_t index) {
    return {result.origin.x + (static_cast<double>(index % result.width) + 0.5) * result.cell,
            result.origin.y + (static_cast<double>(index / result.width) + 0.5) * result.cell};
}

/// Recomputes the nearest point, because fields do not contain it.
NamedFeature named(const oracle::ShapeOracle& b, const Feature& feature, const Vector2& point,
                   bool unique) {
    const Vector2 place = feature.kind == Feature::Kind::vertex
                              ? b.vertex(feature.index)
                              : b.nearest_on_edge(feature.index, point).point;
    return {feature, place, oracle::distance(place, point), unique};
}

bool allows(const PlacedPair& pair, const Vector2& point, const NamedFeature& one,
            const NamedFeature& other) {
    const double margin = std::max(pair.tolerance() / 1000, std::ldexp(one.distance, -18));
    return Naming{pair.b(), margin, pair.rounding()}.allows(point, one, other);
}

void check_values(Report& report, const Asked& asked, const DistanceFieldResult& one,
                  const DistanceFieldResult& other) {
    const double most = one.error_bound + other.error_bound + asked.pair.rounding();
    for (std::size_t i = 0; i < one.values.size(); ++i) {
        const double a = one.values[i];
        const double b = other.values[i];
        report.require(std::abs(a - b) <= most, "cell ", i, " is ", a, " and ", b, ", bound ",
                       most);
        if (asked.grids == SubPixelGrids::same) {
            report.require(std::signbit(a) == std::signbit(b), "cell ", i, " is ", a, " and ", b);
        }
    }
}

void check_features(Report& report, const PlacedPair& pair, const DistanceFieldResult& one,
                    const DistanceFieldResult& other) {
    std::size_t otherwise = 0;
    for (std::size_t i = 0; i < one.features.size(); ++i) {
        const Vector2 centre = centre_of_cell(one, i);
        const NamedFeature a = named(pair.b(), one.features[i], centre, one.unique[i] != 0);
        const NamedFeature b = named(pair.b(), other.features[i], centre, other.unique[i] != 0);
        otherwise +=
            std::abs(a.distance - b.distance) <= pair.rounding() && a.unique == b.unique ? 0U : 1U;
        report.require(allows(pair, centre, a, b), "cell ", i, " at ", centre.x, ", ", centre.y,
                       " names feature ", a.feature.index, ", ", a.distance,
                       a.unique ? "" : " (not unique)", ", and ", b.feature.index, ", ", b.distance,
                       b.unique ? "" : " (not unique)");
    }
    report.require(otherwise <= 1 + one.features.size() / 20, otherwise, " of ",
                   one.features.size(), " cells do not say the same");
}

/// Compares analytic gradients only if the features are equal, because each follows its feature.
void check_gradients(Report& report, const DistanceFieldResult& one,
                     const DistanceFieldResult& other) {
    report.require(std::string(one.gradient_format) == other.gradient_format, "blended in ",
                   one.gradient_format, " and ", other.gradient_format);
    const double most = one.gradient_error_bound + other.gradient_error_bound;
    for (std::size_t i = 0; i < one.gradients.size(); ++i) {
        const std::size_t cell = i / 2;
        if (!one.features.empty() && !same_feature(one.features[cell], other.features[cell])) {
            continue;
        }
        const double a = one.gradients[i];
        const double b = other.gradients[i];
        report.require(std::abs(a - b) <= most, "gradient ", i, " is ", a, " and ", b, ", bound ",
                       most);
    }
}

void check_points(Report& report, const Asked& asked, const DistanceFieldResult& one,
                  const DistanceFieldResult& other) {
    report.require(one.points.size() == other.points.size(), "points differ in number");
    for (std::size_t i = 0; report.clean() && i < one.points.size(); ++i) {
        const FieldPoint& a = one.points[i];
        const FieldPoint& b = other.points[i];
        report.require(a.position == b.position, "point ", i, " is another");
        report.require(std::abs(a.distance - b.distance) <=
                           a.error_bound + b.error_bound + asked.pair.rounding(),
                       "point ", i, " is ", a.distance, " and ", b.distance, ", bounds ",
                       a.error_bound, " and ", b.error_bound);
        if (asked.grids == SubPixelGrids::same) {
            report.require(a.inside == b.inside, "point ", i, " is inside by ", a.inside, " and ",
                           b.inside);
        }
        report.require(
            allows(asked.pair, a.position, named(asked.pair.b(), a.feature, a.position, a.unique),
                   named(asked.pair.b(), b.feature, b.position, b.unique)),
            "point ", i, " names features ", a.feature.index, " and ", b.feature.index);
    }
}

}  // namespace

void check_agreement(Report& report, const Asked& asked, const DistanceFieldResult& one,
                     const DistanceFieldResult& other) {
    report.require(one.origin == other.origin && one.width == other.width &&
                       one.height == other.height && one.cell == other.cell,
                   "grids differ");
    report.require(one.values.size() == other.values.size() &&
                       one.features.size() == other.features.size() &&
                       one.gradients.size() == other.gradients.size() &&
                       one.unique.size() == other.unique.size(),
                   "not the same was answered");
    if (!report.clean()) {
        return;
    }
    check_values(report, asked, one, other);
    check_features(report, asked.pair, one, other);
    check_gradients(report, one, other);
    check_points(report, asked, one, other);
}

}  // namespace nearfield::test
