#include <engine/queries/check_query.hpp>
#include <engine/queries/technique.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace nearfield::queries {
namespace {

Status invalid(const std::string& message) {
    return {StatusCode::invalid_query, message};
}

// Messages are composed only after an error was found: a frame without errors allocates nothing.

bool is_length(double length) {
    return length > 0.0 && length <= largest_coordinate;
}

Status no_length(double length, const char* what) {
    return invalid(std::string(what) + " is " + geometry::number(length) +
                   "; it must be a finite number above 0 and at most " +
                   geometry::number(largest_coordinate));
}

Status no_enumerator(const char* what, std::size_t value) {
    return invalid(std::string(what) + " no enumerator: " + std::to_string(value));
}

template <class Enumeration>
std::size_t value_of(Enumeration value) {
    return static_cast<std::size_t>(value);
}

bool is_usable(double coordinate) {
    return std::abs(coordinate) <= largest_coordinate;  // false for NaN too
}

Status unusable(double coordinate, const std::string& what) {
    return invalid(what + " is " + geometry::number(coordinate) +
                   "; it must be finite and at most " + geometry::number(largest_coordinate) +
                   " in magnitude");
}

Status check_rectangle(const Rectangle& rectangle) {
    for (const double value :
         {rectangle.min.x, rectangle.min.y, rectangle.max.x, rectangle.max.y}) {
        if (!is_usable(value)) {
            return unusable(value, "a coordinate of the rectangle");
        }
    }
    if (!(rectangle.min.x < rectangle.max.x && rectangle.min.y < rectangle.max.y)) {
        return invalid(
            "the rectangle is empty: its low corner (" + geometry::number(rectangle.min.x) + ", " +
            geometry::number(rectangle.min.y) + ") is not below its high corner (" +
            geometry::number(rectangle.max.x) + ", " + geometry::number(rectangle.max.y) + ")");
    }
    return {};
}

bool is_usable(const Pose& pose) {
    return std::isfinite(pose.angle) && is_usable(pose.translation.x) &&
           is_usable(pose.translation.y);
}

/// `which` names the pose: "A's pose".
Status unusable(const Pose& pose, const std::string& which) {
    if (!std::isfinite(pose.angle)) {
        return invalid("the angle of " + which + " is " + geometry::number(pose.angle));
    }
    const auto& [x, y] = pose.translation;
    return unusable(is_usable(x) ? y : x,
                    std::string("the ") + (is_usable(x) ? "y" : "x") + " of " + which);
}

}  // namespace

Status check_pose(const Pose& pose, std::string_view whose) {
    return is_usable(pose) ? Status() : unusable(pose, std::string(whose) + "'s pose");
}

namespace {

Status no_technique(Technique technique, const AvailableTechniques& available) {
    const std::string needs = std::string("the technique ") + to_string(technique);
    if (!available.device) {
        return {StatusCode::unsupported_technique,
                needs +
                    " needs a Vulkan device, and this context has none (Context::create_cpu); ask "
                    "for cpu or automatic"};
    }
    if (technique == Technique::raster && !available.draws) {
        return {StatusCode::unsupported_technique,
                needs +
                    " draws, and the host's queue family does not (it lacks "
                    "VK_QUEUE_GRAPHICS_BIT); ask for compute, cpu or automatic"};
    }
    if (technique == Technique::raster && !available.has_raster) {
        return {StatusCode::unsupported_technique,
                "this library was built without " + needs + "; ask for compute, cpu or automatic"};
    }
    return {StatusCode::unsupported_technique,
            "this context was made without " + needs +
                " (Settings::techniques); add it there, or ask for automatic"};
}

/// The error for a query that uses `what`, which none of this context's techniques answers.
Status none_answers(const char* what, const AvailableTechniques& available) {
    if (!available.device) {
        return {StatusCode::unsupported_technique,
                std::string("only a Vulkan device answers ") + what +
                    ", and this context has none (Context::create_cpu)"};
    }
    return {StatusCode::unsupported_technique,
            std::string("no technique that this context has (Settings::techniques") +
                (!available.draws       ? "; the host's queue family lacks VK_QUEUE_GRAPHICS_BIT, "
                                          "so raster is not among them"
                 : available.has_raster ? ""
                                        : "; this library was built without raster") +
                ") answers " + what};
}

Status check_technique(const CommonNumbers& numbers, const AvailableTechniques& available) {
    switch (numbers.technique) {
        case Technique::automatic:
            return none_answers(numbers.unanswered_by_cpu, available);
        case Technique::raster:
        case Technique::compute:
        case Technique::cpu:
            break;
        default:
            return no_enumerator("the technique is", value_of(numbers.technique));
    }
    if (numbers.unanswered != nullptr) {
        return invalid(std::string("the technique ") + to_string(numbers.technique) +
                       " does not answer " + numbers.unanswered +
                       "; ask for another, or for automatic");
    }
    return available.has(numbers.technique) ? Status() : no_technique(numbers.technique, available);
}

}  // namespace

Status check_common(const CommonNumbers& numbers, const AvailableTechniques& available) {
    if (Status status = check_technique(numbers, available); !status.ok()) {
        return status;
    }
    if (numbers.tolerance != nullptr && !is_length(*numbers.tolerance)) {
        return no_length(*numbers.tolerance, "the tolerance");
    }
    if (!is_usable(numbers.a)) {
        return unusable(numbers.a, "A's pose");
    }
    return is_usable(numbers.b) ? Status() : unusable(numbers.b, "B's pose");
}

Status check_own(const PenetrationQuery& query) {
    return query.points == PenetrationPoints::boundary ||
                   query.points == PenetrationPoints::vertices
               ? Status()
               : no_enumerator("the points are", value_of(query.points));
}

Status check_own(const IntersectionQuery& query) {
    if (value_of(query.kind) > value_of(IntersectionKind::volume_volume)) {
        return no_enumerator("the kind is", value_of(query.kind));
    }
    if (value_of(query.strategy) >= intersection_strategies) {
        return no_enumerator("the strategy is", value_of(query.strategy));
    }
    return {};
}

Status check_own(const DistanceFieldQuery& query) {
    if (value_of(query.sign) > value_of(SignEncoding::feature_bit)) {
        return no_enumerator("the sign encoding is", value_of(query.sign));
    }
    if (value_of(query.gradient) > value_of(GradientMethod::blended)) {
        return no_enumerator("the gradient method is", value_of(query.gradient));
    }
    if (!query.rectangle && query.a.shape == ShapeHandle{}) {
        return invalid("a distance field needs a rectangle, or a shape A whose box it shares");
    }
    if (!query.values && !query.features && !query.gradients && query.points.empty() &&
        !query.on_device) {
        return invalid(
            "the distance field asks for nothing: neither for values, features or gradients at "
            "cells nor for points, nor for anything that stays on the device");
    }
    for (std::size_t i = 0; i < query.points.size(); ++i) {
        for (const double value : {query.points[i].x, query.points[i].y}) {
            if (!is_usable(value)) {
                return unusable(value, "a coordinate of point " + std::to_string(i));
            }
        }
    }
    return query.rectangle ? check_rectangle(*query.rectangle) : Status();
}

Status check_own(const ContactQuery& query) {
    if (query.normals != ContactNormals::analytic && query.normals != ContactNormals::gradient) {
        return no_enumerator("the normals are", value_of(query.normals));
    }
    if (query.on_device && query.normals == ContactNormals::gradient) {
        return invalid(
            "contacts that stay on the device (on_device) have analytic normals; gradient normals "
            "are known only once the batch is collected");
    }
    return is_length(query.contact_distance)
               ? Status()
               : no_length(query.contact_distance, "the contact distance");
}

Status check_own(const TimeOfImpactQuery& query) {
    if (!(query.time_bound > 0.0 && query.time_bound <= 1.0)) {
        return invalid("the time bound is " + geometry::number(query.time_bound) +
                       "; it must be above 0 and at most 1");
    }
    if (query.max_steps == 0) {
        return invalid("the most steps are 0; at least 1 has to be allowed");
    }
    if (!(query.contact_distance >= 0.0 && is_usable(query.contact_distance))) {
        return invalid("the contact distance is " + geometry::number(query.contact_distance) +
                       "; it must be a finite number, 0 or above and at most " +
                       geometry::number(largest_coordinate));
    }
    if (!is_usable(query.end_a)) {
        return unusable(query.end_a, "A's end pose");
    }
    return is_usable(query.end_b) ? Status() : unusable(query.end_b, "B's end pose");
}

Status unresolved(double tolerance, double largest_magnitude, double smallest) {
    return invalid("the tolerance " + geometry::number(tolerance) +
                   " is below what double precision resolves at coordinates of " +
                   geometry::number(largest_magnitude) + "; the smallest is " +
                   geometry::number(smallest));
}

Status too_deviant(double tolerance, const Deviations& deviations, double bound) {
    const double together = deviations.a + deviations.b;
    const std::string shapes = "the shapes' rings may be off by " + geometry::number(deviations.a) +
                               " (A) and " + geometry::number(deviations.b) + " (B), ";
    if (together > max_deviation * tolerance) {
        return invalid(shapes + "together more than " + geometry::number(max_deviation) +
                       " of the tolerance " + geometry::number(tolerance) +
                       "; tessellate finer, or ask for at least " +
                       geometry::number(together / max_deviation));
    }
    return invalid(shapes + "which with what this device's raster needs is " +
                   geometry::number(bound) + ", more than the tolerance " +
                   geometry::number(tolerance) + "; tessellate finer");
}

Status check_distance(double tolerance, double bound, double distance) {
    return bound <= tolerance
               ? Status()
               : invalid("the field reaches to a distance of " + geometry::number(distance) +
                         " from B, where single precision cannot tell apart what differs by the "
                         "tolerance " +
                         geometry::number(tolerance) +
                         "; take a rectangle nearer to B or a larger tolerance");
}

}  // namespace nearfield::queries
