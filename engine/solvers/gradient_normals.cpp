#include <engine/geometry/vector.hpp>
#include <engine/solvers/gradient_normals.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace nearfield::solvers {
namespace {

/// Side, in cells, of the squares that get a field each. Contacts lie along lines: one field over
/// all of them would be mostly empty.
constexpr double square_side = 256.0;

/// The area that the field's grid covers: all points and two cells around them.
Rectangle around(std::span<const Vector2> points, double cell) {
    geometry::Box box;
    for (const Vector2& point : points) {
        box.extend(geometry::to_vector(point));
    }
    box = geometry::grown(box, 2.0 * cell);
    return {geometry::to_public(box.min()), geometry::to_public(box.max())};
}

}  // namespace

void GradientNormals::sort_into_squares(double cell) {
    places_.clear();
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
        const double side = square_side * cell;
        places_.push_back({std::floor(points_[i].x / side), std::floor(points_[i].y / side), i});
    }
    std::sort(places_.begin(), places_.end(), [](const Place& i, const Place& j) {
        return std::tie(i.column, i.row, i.contact) < std::tie(j.column, j.row, j.contact);
    });
    sorted_points_.clear();
    for (const Place& place : places_) {
        sorted_points_.push_back(points_[place.contact]);
    }
}

std::span<const AnyQuery> GradientNormals::fields_around(const FoundContacts& found,
                                                         const ContactQuery& asked,
                                                         Technique technique, double cell) {
    points_.clear();
    found.append_points(points_);
    sort_into_squares(cell);
    queries_.clear();
    std::size_t first = 0;
    for (std::size_t i = 1; i <= places_.size(); ++i) {
        if (i < places_.size() && places_[i].column == places_[first].column &&
            places_[i].row == places_[first].row) {
            continue;
        }
        DistanceFieldQuery field;
        field.b = asked.b;
        field.tolerance = asked.tolerance;
        field.technique = technique;
        field.gradient = GradientMethod::central_differences;
        field.values = false;
        field.points = std::span(sorted_points_).subspan(first, i - first);
        field.rectangle = around(field.points, cell);
        queries_.emplace_back(field);
        first = i;
    }
    return queries_;
}

Status GradientNormals::set(std::span<const AnyResult> fields, FoundContacts& found) {
    gradients_.resize(points_.size());
    std::size_t next = 0;
    for (const AnyResult& any : fields) {
        const auto& field = std::get<DistanceFieldResult>(any);
        if (!field.status.ok()) {
            return {field.status.code(),
                    "the field whose gradient is asked for: " + field.status.message()};
        }
        for (const FieldPoint& point : field.points) {
            gradients_[places_[next++].contact] = point.gradient;
        }
    }
    found.set_normals(gradients_);
    return {};
}

}  // namespace nearfield::solvers
