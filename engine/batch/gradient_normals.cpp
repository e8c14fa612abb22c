#include <engine/base/interruption.hpp>
#include <engine/batch/gradient_normals.hpp>
#include <engine/plan/empty_result.hpp>
#include <engine/plan/query_timer.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace nearfield::batch {
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

GradientNormals::GradientNormals(Planning& planning, render::Renderer* renderer)
    : runner_(planning, renderer) {}

void GradientNormals::apply(BatchRunner& main) {
    Results& results = main.results();
    for (const std::uint32_t index : main.plan().with_gradient_normals) {
        const plan::PlannedQuery& planned = main.plan().queries[index];
        auto& result = std::get<ContactResult>(results.results[index]);
        if (!result.status.ok()) {
            continue;
        }
        try {
            {
                const plan::QueryTimer timer(main.plan().times, index, &QueryTime::answer);
                const std::uint32_t reverse = planned.points().reverse;
                decoder_.find({planned, main.points_of(index)},
                              {main.plan().queries[reverse], main.points_of(reverse)}, result.cell,
                              contacts_);
            }
            set_normals(planned, result, results.timings);
            if (result.status.ok()) {
                const plan::QueryTimer timer(main.plan().times, index, &QueryTime::answer);
                contacts_.write(*planned.a, *planned.b, std::get<ContactQuery>(*planned.query),
                                result);
            }
        } catch (const Interrupted& interrupted) {
            plan::cut_short(interrupted.status(), results.results[index]);
        }
    }
}

void GradientNormals::sort_into_squares(double cell) {
    points_.clear();
    contacts_.append_points(points_);
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

void GradientNormals::add_fields(const ContactQuery& asked, double cell) {
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
        field.technique = asked.technique;
        field.gradient = GradientMethod::central_differences;
        field.values = false;
        field.points = std::span(sorted_points_).subspan(first, i - first);
        field.rectangle = around(field.points, cell);
        queries_.emplace_back(field);
        first = i;
    }
}

void GradientNormals::set_normals(const plan::PlannedQuery& planned, ContactResult& result,
                                  Timings& timings) {
    sort_into_squares(result.cell);
    if (points_.empty()) {
        return;
    }
    add_fields(std::get<ContactQuery>(*planned.query), result.cell);
    // Use B as it was submitted, whatever it is now.
    const auto find_shape = [&planned](ShapeHandle shape) {
        return shape == ShapeHandle{} ? nullptr : planned.b;
    };
    Laps laps;
    runner_.submit(queries_, find_shape, laps);
    runner_.collect(laps);
    const Results& fields = runner_.results();
    timings.localize += fields.timings.localize;
    timings.plan += fields.timings.plan;
    timings.record += fields.timings.record;
    timings.device += fields.timings.device;
    timings.decode += fields.timings.decode;

    gradients_.resize(points_.size());
    std::size_t next = 0;
    for (const AnyResult& any : fields.results) {
        const auto& field = std::get<DistanceFieldResult>(any);
        if (!field.status.ok()) {
            result.status = {field.status.code(),
                             "the field whose gradient is asked for: " + field.status.message()};
            return;
        }
        for (const FieldPoint& point : field.points) {
            gradients_[places_[next++].contact] = point.gradient;
        }
    }
    contacts_.set_normals(gradients_);
}

}  // namespace nearfield::batch
