#include <tools/peers/peer.hpp>

#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace nearfield::peers {
namespace {

[[noreturn]] void fail_unasked(const Peer& peer) {
    throw std::logic_error(peer.name() + " was asked what it does not answer");
}

void answer_points(Peer& peer, const tools::SceneQuery& query, double spacing,
                   std::span<const PlacedShape> shapes, std::vector<Vector2>& points,
                   Answer& result) {
    points_in(shapes[query.a], spacing, shapes[query.b].box, points);
    for (const Vector2& point : points) {
        if (peer.is_inside(query.b, point)) {
            ++result.count;
            result.number = std::max(result.number, peer.distance_to_boundary(query.b, point));
        }
    }
}

void answer_field(Peer& peer, std::size_t shape, const Grid& grid, std::vector<double>& values) {
    for (std::size_t row = 0; row < grid.height; ++row) {
        for (std::size_t column = 0; column < grid.width; ++column) {
            const Vector2 center = grid.center(column, row);
            const double distance = peer.distance_to_boundary(shape, center);
            values.push_back(peer.is_inside(shape, center) ? -distance : distance);
        }
    }
}

}  // namespace

bool Peer::is_inside(std::size_t /*shape*/, Vector2 /*point*/) {
    fail_unasked(*this);
}

double Peer::distance_to_boundary(std::size_t /*shape*/, Vector2 /*point*/) {
    fail_unasked(*this);
}

double Peer::separation(std::size_t /*a*/, std::size_t /*b*/) {
    fail_unasked(*this);
}

bool Peer::intersect(std::size_t /*a*/, std::size_t /*b*/) {
    fail_unasked(*this);
}

double Peer::common_area(std::size_t /*a*/, std::size_t /*b*/) {
    fail_unasked(*this);
}

void Peer::ask_world(const Problem& /*problem*/, std::vector<double>& /*numbers*/) {
    fail_unasked(*this);
}

void answer(Peer& peer, const Problem& problem, std::span<const PlacedShape> shapes,
            std::vector<Answer>& answers) {
    std::vector<Vector2> points;
    answers.resize(problem.scene.queries.size());
    for (std::size_t index = 0; index < answers.size(); ++index) {
        const tools::SceneQuery& query = problem.scene.queries[index];
        Answer& result = answers[index];
        result.count = 0;
        result.number = 0.0;
        result.values.clear();
        switch (problem.task) {
            case Task::vertex_penetration:
                answer_points(peer, query, 0.0, shapes, points, result);
                break;
            case Task::boundary_penetration:
                answer_points(peer, query, query.request.tolerance * std::numbers::sqrt2, shapes,
                              points, result);
                break;
            case Task::separation:
                result.number = peer.separation(query.a, query.b);
                break;
            case Task::intersection_test:
                result.number = peer.intersect(query.a, query.b) ? 1.0 : 0.0;
                break;
            case Task::common_area:
                result.number = peer.common_area(query.a, query.b);
                break;
            case Task::field:
                answer_field(peer, query.b, grid_of(query.request), result.values);
                break;
            default:
                peer.ask_world(problem, result.values);
                break;
        }
    }
}

}  // namespace nearfield::peers
