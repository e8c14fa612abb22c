#include <tools/io/answer.hpp>
#include <tools/io/summary.hpp>
#include <tools/peers/agreement.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

namespace nearfield::peers {
namespace {

/// Compares the answers to the queries one by one.
class Comparison {
public:
    Comparison(Peer& peer, std::span<const PlacedShape> shapes, Agreement& agreement)
        : peer_(peer), shapes_(shapes), agreement_(agreement) {}

    void next(const tools::SceneQuery& query, std::size_t index) {
        query_ = &query;
        index_ = index;
    }

    void compare(const PenetrationResult& result, const Answer& answer);
    void compare_test(const ResultSummary& result, const Answer& answer) {
        if (result.intersects != (answer.number != 0.0)) {
            complain(result.intersects ? "only nearfield says that they intersect"
                                       : "only the peer says that they intersect");
        }
    }
    void compare(const SeparationResult& result, const Answer& answer) {
        expect_near("distance", result.distance, answer.number, 0.0);
    }
    void compare(const IntersectionResult& result, const Answer& answer) {
        // The band on both sides of the boundary and around the ends of the parts in the box.
        const double bound = result.error_bound;
        const double length = length_near(query_->a, query_->b) + length_near(query_->b, query_->a);
        expect_near("area", result.area, answer.number, 2.0 * bound * (length + 4.0 * bound));
    }
    void compare(const DistanceFieldResult& result, const Answer& answer);
    void compare(const ResultSummary& /*result*/, const Answer& /*answer*/) {
        complain("no problem has such a query");
    }

private:
    void complain(const std::string& text) {
        if (agreement_.complaint.empty()) {
            agreement_.complaint = "query " + std::to_string(index_) + ": " + text;
        }
    }
    void expect_near(const char* what, double ours, double theirs, double bound);
    [[nodiscard]] double length_near(std::size_t of, std::size_t other) const;
    [[nodiscard]] std::uint64_t touching_vertices() const;

    Peer& peer_;
    std::span<const PlacedShape> shapes_;
    Agreement& agreement_;
    const tools::SceneQuery* query_ = nullptr;
    std::size_t index_ = 0;
};

void Comparison::expect_near(const char* what, double ours, double theirs, double bound) {
    const double allowed = bound + 1e-6 * query_->request.tolerance;
    const double difference = std::abs(ours - theirs);
    if (difference > agreement_.largest_difference) {
        agreement_.largest_difference = difference;
        agreement_.allowed = allowed;
    }
    if (!(difference <= allowed)) {
        complain(std::string(what) + " " + tools::short_number(ours) + ", by the peer " +
                 tools::short_number(theirs) + ", allowed " + tools::short_number(allowed));
    }
}

void Comparison::compare(const PenetrationResult& result, const Answer& answer) {
    const double depth = result.count > 0 ? result.deepest.depth : 0.0;
    if (query_->request.points == PenetrationPoints::vertices) {
        // The peer counts vertices inside that only touch, too.
        std::uint64_t by_peer = answer.count;
        if (result.count != by_peer) {
            by_peer -= touching_vertices();
        }
        if (result.count != by_peer) {
            complain(std::to_string(result.count) + " vertices, by the peer " +
                     std::to_string(by_peer));
        }
        expect_near("depth", depth, by_peer > 0 ? answer.number : 0.0, 0.0);
        return;
    }
    // Both sides are sampled: each may miss the deepest point by the bound.
    expect_near("depth", depth, answer.number, result.error_bound);
    for (const PenetratingPoint& record : result.points) {
        if (!peer_.is_inside(query_->b, record.position)) {
            complain("a record's point is not inside");
        }
        expect_near("depth of a record", record.depth,
                    peer_.distance_to_boundary(query_->b, record.position), 0.0);
    }
}

void Comparison::compare(const DistanceFieldResult& result, const Answer& answer) {
    if (result.values.size() != answer.values.size()) {
        complain("grids of different sizes");
        return;
    }
    for (std::size_t i = 0; i < answer.values.size(); ++i) {
        const float value = result.values[i];
        expect_near("value", peer_.signed_field() ? value : std::abs(value), answer.values[i],
                    result.error_bound);
    }
}

/// The vertices of A inside B, by the peer, that are no deeper than a penetrating point is.
std::uint64_t Comparison::touching_vertices() const {
    std::vector<Vector2> vertices;
    points_in(shapes_[query_->a], 0.0, shapes_[query_->b].box, vertices);
    const double touching = query_->request.tolerance / 1024.0;
    return static_cast<std::uint64_t>(
        std::count_if(vertices.begin(), vertices.end(), [&](const Vector2& vertex) {
            return peer_.is_inside(query_->b, vertex) &&
                   peer_.distance_to_boundary(query_->b, vertex) <= touching;
        }));
}

/// The length of one shape's boundary within the other's box.
double Comparison::length_near(std::size_t of, std::size_t other) const {
    const double spacing = query_->request.tolerance;
    std::vector<Vector2> points;
    points_in(shapes_[of], spacing, shapes_[other].box, points);
    return spacing * static_cast<double>(points.size());
}

}  // namespace

Agreement compare(Peer& peer, const Problem& problem, std::span<const PlacedShape> shapes,
                  std::span<const AnyResult* const> results, std::span<const Answer> answers) {
    Agreement agreement;
    Comparison comparison(peer, shapes, agreement);
    for (std::size_t index = 0; index < answers.size(); ++index) {
        comparison.next(problem.scene.queries[index], index);
        if (problem.task == Task::intersection_test) {
            comparison.compare_test(tools::summary_of(*results[index]), answers[index]);
            continue;
        }
        std::visit([&](const auto& result) { comparison.compare(result, answers[index]); },
                   *results[index]);
    }
    return agreement;
}

double largest_field_error(const Problem& problem, std::span<const Answer> exact,
                           std::span<const Answer> approximate) {
    double largest = 0.0;
    for (std::size_t index = 0; index < exact.size(); ++index) {
        const double cell = problem.scene.queries[index].request.tolerance * std::numbers::sqrt2;
        for (std::size_t i = 0; i < exact[index].values.size(); ++i) {
            largest = std::max(
                largest, std::abs(exact[index].values[i] - approximate[index].values[i]) / cell);
        }
    }
    return largest;
}

}  // namespace nearfield::peers
