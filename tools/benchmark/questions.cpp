#include <tools/benchmark/questions.hpp>

#include <numbers>
#include <utility>

namespace nearfield::benchmark {
namespace {

tools::QueryRequest request_of(tools::QueryType type, double tolerance) {
    tools::QueryRequest request;
    request.type = type;
    request.tolerance = tolerance;
    return request;
}

}  // namespace

tools::QueryRequest vertex_penetration(double tolerance) {
    tools::QueryRequest request = request_of(tools::QueryType::penetration, tolerance);
    request.points = PenetrationPoints::vertices;
    request.records = false;
    return request;
}

tools::QueryRequest boundary_penetration(double tolerance) {
    return request_of(tools::QueryType::penetration, tolerance);
}

tools::QueryRequest contacts(double tolerance) {
    tools::QueryRequest request = request_of(tools::QueryType::contacts, tolerance);
    request.contact_distance = 2.0 * tolerance;
    return request;
}

tools::QueryRequest separation(double tolerance) {
    return request_of(tools::QueryType::separation, tolerance);
}

tools::QueryRequest intersection_test(double /*tolerance*/) {
    return request_of(tools::QueryType::intersection_test, 0.0);
}

tools::QueryRequest intersection(double tolerance) {
    tools::QueryRequest request = request_of(tools::QueryType::intersection, tolerance);
    request.records = false;
    return request;
}

tools::QueryRequest square_field(Vector2 middle, double side, std::size_t cells) {
    const double cell = side / static_cast<double>(cells);
    tools::QueryRequest request =
        request_of(tools::QueryType::distance_field, cell / std::numbers::sqrt2);
    const double half = side / 2.0;
    request.rectangle =
        Rectangle{{middle.x - half, middle.y - half}, {middle.x + half, middle.y + half}};
    return request;
}

tools::Scene asked(tools::Scene scene, const tools::QueryRequest& request, Pairs pairs) {
    if (pairs == Pairs::all) {
        // A simulation does not need pairs farther apart than this.
        constexpr double reach_in_tolerances = 20.0;
        const double reach = request.type == tools::QueryType::separation
                                 ? reach_in_tolerances * request.tolerance
                                 : 0.0;
        scene.queries.push_back({request, 0, 0, true, reach});
        return scene;
    }
    for (std::size_t a = 0; a + 1 < scene.instances.size(); a += 2) {
        scene.queries.push_back({request, a, a + 1});
    }
    return scene;
}

tools::Scene asked(tools::Scene scene, const tools::QueryRequest& request, std::size_t a,
                   std::size_t b) {
    scene.queries.push_back({request, a, b});
    return scene;
}

}  // namespace nearfield::benchmark
