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

Status GradientNormals::take_field(const queries::CheckedQuery& query,
                                   std::span<const Vector2> points, double cell,
                                   Workspace& workspace, std::size_t first) {
    const auto& asked = std::get<ContactQuery>(*query.query);
    DistanceFieldQuery field;
    field.b = asked.b;
    field.tolerance = asked.tolerance;
    field.technique = Technique::cpu;
    field.gradient = GradientMethod::central_differences;
    field.values = false;
    field.points = points;
    field.rectangle = around(points, cell);
    field_ = field;
    queries::CheckedQuery checked;
    if (queries::check(0, field_, {nullptr, query.b}, workspace.limits, checked, result_)) {
        // The points are needed for no longer than the contacts.
        queries::MemoryBudget own(workspace.limits);
        solver_.answer(checked, workspace, own, std::get<DistanceFieldResult>(result_));
    }
    const auto& result = std::get<DistanceFieldResult>(result_);
    if (!result.status.ok()) {
        return {result.status.code(),
                "the field whose gradient is asked for: " + result.status.message()};
    }
    for (const FieldPoint& point : result.points) {
        gradients_[places_[first++].contact] = point.gradient;
    }
    return {};
}

Status GradientNormals::set(const queries::CheckedQuery& query, double cell, Workspace& workspace,
                            FoundContacts& found) {
    points_.clear();
    found.append_points(points_);
    sort_into_squares(cell);
    gradients_.resize(points_.size());
    std::size_t first = 0;
    for (std::size_t i = 1; i <= places_.size(); ++i) {
        if (i < places_.size() && places_[i].column == places_[first].column &&
            places_[i].row == places_[first].row) {
            continue;
        }
        const std::span points = std::span(sorted_points_).subspan(first, i - first);
        if (Status status = take_field(query, points, cell, workspace, first); !status.ok()) {
            return status;
        }
        first = i;
    }
    found.set_normals(gradients_);
    return {};
}

}  // namespace nearfield::solvers
