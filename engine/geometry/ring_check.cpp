#include <engine/base/status_exception.hpp>
#include <engine/geometry/number.hpp>
#include <engine/geometry/ring_check.hpp>
#include <engine/geometry/vector.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::geometry {
namespace {

Vector farthest_from(const Vector& point, std::span<const Vector2> vertices) {
    const auto distance = [&point](const Vector2& vertex) {
        return (to_vector(vertex) - point).cwiseAbs().maxCoeff();
    };
    return to_vector(*std::max_element(
        vertices.begin(), vertices.end(),
        [&](const Vector2& a, const Vector2& b) { return distance(a) < distance(b); }));
}

/// The width of the strip along a line that holds all vertices; 0 if they are all at `start`.
double width_along(const Vector& start, const Vector& end, std::span<const Vector2> vertices) {
    const double extent = (end - start).cwiseAbs().maxCoeff();
    if (extent == 0.0) {
        return 0.0;
    }
    // Dividing by the extent first keeps the products of a tiny ring from underflowing.
    const Vector along = ((end - start) / extent).normalized();
    double least = 0.0;
    double greatest = 0.0;
    for (const Vector2& vertex : vertices) {
        const double side = cross(along, (to_vector(vertex) - start) / extent);
        least = std::min(least, side);
        greatest = std::max(greatest, side);
    }
    return (greatest - least) * extent;
}

}  // namespace

void refuse_shape(const std::string& message) {
    throw StatusException({StatusCode::invalid_shape, message});
}

std::string coordinate_error(double value) {
    if (std::isnan(value)) {
        return "is not a number";
    }
    if (std::isinf(value)) {
        return "is infinite";
    }
    if (std::abs(value) > largest_coordinate) {
        return "is " + number(value) + ", more than " + number(largest_coordinate) +
               " from the origin";
    }
    return {};
}

bool usable(const Vector2& vertex) {
    // Also false for NaN.
    return std::abs(vertex.x) <= largest_coordinate && std::abs(vertex.y) <= largest_coordinate;
}

std::string vertex_error(std::size_t ring, std::size_t vertex, const Vector2& point) {
    const std::string error_of_x = coordinate_error(point.x);
    return "ring " + std::to_string(ring) + ", vertex " + std::to_string(vertex) + ": " +
           (error_of_x.empty() ? "y " + coordinate_error(point.y) : "x " + error_of_x);
}

void require_usable(std::span<const Ring> rings) {
    for (std::size_t ring = 0; ring < rings.size(); ++ring) {
        const auto bad = std::find_if_not(rings[ring].begin(), rings[ring].end(), usable);
        if (bad != rings[ring].end()) {
            const auto vertex = static_cast<std::size_t>(bad - rings[ring].begin());
            refuse_shape(vertex_error(ring, vertex, *bad));
        }
    }
}

std::span<const Vector2> open_ring(const Ring& ring) {
    const std::span<const Vector2> vertices(ring);
    const bool closed_twice = vertices.size() > 1 && vertices.front() == vertices.back();
    return closed_twice ? vertices.first(vertices.size() - 1) : vertices;
}

bool has_three_different(std::span<const Vector2> vertices) {
    const auto second = std::find_if(vertices.begin(), vertices.end(),
                                     [&](const Vector2& v) { return v != vertices.front(); });
    return std::any_of(second, vertices.end(),
                       [&](const Vector2& v) { return v != vertices.front() && v != *second; });
}

double largest_of(const Vector2& vertex) {
    return std::max(std::abs(vertex.x), std::abs(vertex.y));
}

double largest_coordinate_of(std::span<const Ring> rings) {
    double largest = 0.0;
    for (const Ring& ring : rings) {
        for (const Vector2& vertex : ring) {
            largest = std::max(largest, largest_of(vertex));
        }
    }
    return largest;
}

double smallest_width(double largest_magnitude) {
    return 0x1p-47 * largest_magnitude;
}

double strip_width(std::span<const Vector2> vertices) {
    if (vertices.empty()) {
        return 0.0;
    }
    const Vector front = to_vector(vertices.front());
    const Vector start = farthest_from(front, vertices);
    const Vector end = farthest_from(start, vertices);
    return std::min(width_along(front, start, vertices), width_along(start, end, vertices));
}

}  // namespace nearfield::geometry
