#include <engine/device_input/pair_search.hpp>

#include <cmath>

namespace nearfield::device_input {
using geometry::Vector;

shaders::SearchInstanceData data_of_shape(const geometry::Polygon& polygon) {
    shaders::SearchInstanceData data;
    data.unit = static_cast<float>(unit_length_of(polygon));
    data.radius = rounded_up(polygon.radius());
    return data;
}

double rounding_of_host_pose(const geometry::Polygon& polygon, double magnitude) {
    const double lever =
        static_cast<double>(rounded_up(polygon.radius())) + polygon.centre().lpNorm<1>();
    return (1.0 + 0x1p-20) * (static_cast<double>(shaders::rounding_of_turn) * lever +
                              static_cast<double>(shaders::rounding_of_place) * magnitude);
}

double margin_of_pair(const Vector& place_a, double radius_a, const Vector& place_b,
                      double radius_b) {
    const double extent = static_cast<double>(rounded_up(radius_a)) +
                          static_cast<double>(rounded_up(radius_b)) + (place_a - place_b).norm();
    return std::ldexp(extent, -20) + std::ldexp(place_a.lpNorm<1>() + place_b.lpNorm<1>(), -47);
}

}  // namespace nearfield::device_input
