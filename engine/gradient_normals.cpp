#include <engine/gradient_normals.hpp>

namespace nearfield {
namespace {

/// What the grid covers: all points and two cells around them.
Rectangle around(const std::vector<Vector2>& points, double cell) {
    geometry::Box box;
    for (const Vector2& point : points) {
        box.extend(geometry::to_vector(point));
    }
    box.min().array() -= 2.0 * cell;
    box.max().array() += 2.0 * cell;
    return {geometry::to_public(box.min()), geometry::to_public(box.max())};
}

}  // namespace

GradientNormals::GradientNormals(const plan::PlanLimits& limits, const char* gradient_format,
                                 Renderer& renderer)
    : runner_(limits, gradient_format, renderer) {}

void GradientNormals::apply(const BatchRunner& main, const plan::FindShape& find_shape,
                            Results& results) {
    for (std::size_t i = 0; i < results.results.size(); ++i) {
        const plan::PlannedQuery& planned = main.plan().queries[i];
        const auto* const query = std::get_if<ContactQuery>(planned.query);
        if (query == nullptr || query->normals != ContactNormals::gradient) {
            continue;
        }
        auto& result = std::get<ContactResult>(results.results[i]);
        if (!result.status.ok()) {
            continue;
        }
        contacts_.find(main.plan(), planned, main.point_words(), result.cell);
        set_normals(planned, find_shape, result, results.timings);
        if (result.status.ok()) {
            contacts_.write(planned, result);
        }
    }
}

void GradientNormals::set_normals(const plan::PlannedQuery& planned,
                                  const plan::FindShape& find_shape, ContactResult& result,
                                  Timings& timings) {
    points_.clear();
    contacts_.append_points(points_);
    if (points_.empty()) {
        return;
    }
    const auto& asked = std::get<ContactQuery>(*planned.query);
    DistanceFieldQuery field;
    field.b = asked.b;
    field.tolerance = asked.tolerance;
    field.rectangle = around(points_, result.cell);
    field.gradient = GradientMethod::central_differences;
    field.values = false;
    field.points = points_;
    queries_.assign(1, field);
    fields_.timings = {};
    runner_.run(queries_, find_shape, fields_);
    timings.localize += fields_.timings.localize;
    timings.plan += fields_.timings.plan;
    timings.record += fields_.timings.record;
    timings.device += fields_.timings.device;
    timings.decode += fields_.timings.decode;
    const auto& answer = std::get<DistanceFieldResult>(fields_.results.front());
    if (answer.status.ok()) {
        contacts_.set_normals(answer.points);
    } else {
        result.status = {answer.status.code(),
                         "the field whose gradient is asked for: " + answer.status.message()};
    }
}

}  // namespace nearfield
