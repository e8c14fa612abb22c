#pragma once

#include <engine/device_input/search_shapes.hpp>
#include <engine/geometry/polygon.hpp>
#include <engine/geometry/vector.hpp>
#include <nearfield/portable_math.hpp>
#include <nearfield/shape.hpp>

#include <shaders/pairs.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nearfield::device_input {

/// What all instances of a shape have alike, except for its places in the input.
[[nodiscard]] shaders::SearchInstanceData data_of_shape(const geometry::Polygon& polygon);

/// Writes a position relative to an origin, rounded to floats, and what the rounding leaves out.
inline void split(const Vector2& position, const geometry::Vector& origin, shaders::vec2& high,
                  shaders::vec2& low) {
    const double x = position.x - origin.x();
    const double y = position.y - origin.y();
    high = {static_cast<float>(x), static_cast<float>(y)};
    low = {static_cast<float>(x - static_cast<double>(high.x)),
           static_cast<float>(y - static_cast<double>(high.y))};
}

/// An instance's place: that of its shape's centre, relative to the origin.
struct InstancePlace {
    geometry::Vector place;
    double magnitude = 0.0;  ///< no number that occurs at this pose exceeds it
};

/// Sets what an instance has of its pose. `turn`: of its angle; `origin`: that positions are
/// relative to. Inline, since it is called for each instance of each frame.
inline InstancePlace set_place(const geometry::Polygon& polygon, const Pose& pose,
                               const SineCosine& turn, const geometry::Vector& origin,
                               shaders::SearchInstanceData& data) {
    const geometry::Vector& centre = polygon.centre();
    const double x = turn.cosine * centre.x() - turn.sine * centre.y() + pose.translation.x;
    const double y = turn.sine * centre.x() + turn.cosine * centre.y() + pose.translation.y;
    const geometry::Vector place{x - origin.x(), y - origin.y()};
    data.axis = {static_cast<float>(turn.cosine), static_cast<float>(turn.sine)};
    data.high = {static_cast<float>(place.x()), static_cast<float>(place.y())};
    // What rounding to a float leaves out.
    data.low = {static_cast<float>(place.x() - static_cast<double>(data.high.x)),
                static_cast<float>(place.y() - static_cast<double>(data.high.y))};
    const auto largest = [](double a, double b) { return std::max(std::abs(a), std::abs(b)); };
    return {place, std::max({largest(x, y) + polygon.radius(), largest(centre.x(), centre.y()),
                             largest(pose.translation.x, pose.translation.y)})};
}

/// Bound on the rounding of a vertex's place in double precision, where no number that occurs
/// exceeds `magnitude`.
[[nodiscard]] inline float rounding_at(double magnitude) {
    // As geometry::placement_rounding, whose magnitude is the sum of three; the last factor is for
    // rounding to a float.
    return static_cast<float>(4.0 * std::numeric_limits<double>::epsilon() * 3.0 * magnitude *
                              (1.0 + 0x1p-22));
}

/// Bound on what the device loses where it takes a pose of a buffer of the host's, as
/// shaders/pair_poses.comp has it. `magnitude`: no number that occurs at the pose exceeds it.
[[nodiscard]] double rounding_of_host_pose(const geometry::Polygon& polygon, double magnitude);

/// Bound on the errors of the device's single precision for a pair, world units; as
/// shaders/pair_directions.comp has it.
[[nodiscard]] double margin_of_pair(const geometry::Vector& place_a, double radius_a,
                                    const geometry::Vector& place_b, double radius_b);

}  // namespace nearfield::device_input
