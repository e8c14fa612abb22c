#include <engine/plan/pair_search.hpp>

#include <cmath>
#include <limits>

namespace nearfield::plan {
namespace {

using geometry::Vector;

/// What rounding to a float leaves out.
float rest_of(double value, float rounded) {
    return static_cast<float>(value - static_cast<double>(rounded));
}

Vector place_of(const SearchInstanceData& instance) {
    return {static_cast<double>(instance.high.x) + static_cast<double>(instance.low.x),
            static_cast<double>(instance.high.y) + static_cast<double>(instance.low.y)};
}

}  // namespace

void set_shape(const geometry::Polygon& polygon, SearchInstanceData& data) {
    data.unit = static_cast<float>(unit_length_of(polygon));
    data.radius = rounded_up(polygon.radius());
}

void set_place(const geometry::TransformedPolygon& placed, const Vector& origin,
               SearchInstanceData& data) {
    const Vector axis = placed.rotation().col(0);
    const Vector place = placed.translation() - origin;
    data.axis = {static_cast<float>(axis.x()), static_cast<float>(axis.y())};
    data.high = {static_cast<float>(place.x()), static_cast<float>(place.y())};
    data.low = {rest_of(place.x(), data.high.x), rest_of(place.y(), data.high.y)};
}

float rounding_at(double magnitude) {
    // As localize::placement_rounding, whose magnitude is the sum of three.
    return rounded_up(4.0 * std::numeric_limits<double>::epsilon() * 3.0 * magnitude);
}

double margin_of_pair(const SearchInstanceData& a, const SearchInstanceData& b) {
    const Vector place_a = place_of(a);
    const Vector place_b = place_of(b);
    const double extent =
        static_cast<double>(a.radius) + static_cast<double>(b.radius) + (place_a - place_b).norm();
    return std::ldexp(extent, -20) + std::ldexp(place_a.lpNorm<1>() + place_b.lpNorm<1>(), -47);
}

}  // namespace nearfield::plan
