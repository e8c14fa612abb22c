#include <tools/io/answer.hpp>
#include <tools/io/world_report.hpp>
#include <tools/peers/agreement.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <variant>

namespace nearfield::peers {
namespace {

/// Compares the answers to the queries one by one.
class Comparison {
public:
    Comparison(Peer& peer, const Problem& problem, std::span<const PlacedShape> shapes,
               PeerTimes& times)
        : peer_(peer), problem_(problem), shapes_(shapes), times_(times) {}

    void next(std::size_t index) {
        query_ = &problem_.scene.queries[index];
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
    [[noreturn]] void complain(const std::string& text) const {
        throw std::runtime_error(problem_.name + ": nearfield and " + peer_.name() +
                                 " differ: query " + std::to_string(index_) + ": " + text);
    }
    void expect_near(const char* what, double ours, double theirs, double bound);
    [[nodiscard]] double length_near(std::size_t of, std::size_t other) const;
    [[nodiscard]] std::uint64_t touching_vertices() const;

    Peer& peer_;
    const Problem& problem_;
    std::span<const PlacedShape> shapes_;
    PeerTimes& times_;
    const tools::SceneQuery* query_ = nullptr;
    std::size_t index_ = 0;
};

void Comparison::expect_near(const char* what, double ours, double theirs, double bound) {
    const double allowed = bound + 1e-6 * query_->request.tolerance;
    const double difference = std::abs(ours - theirs);
    if (difference > times_.largest_difference) {
        times_.largest_difference = difference;
        times_.allowed = allowed;
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
    }
    for (std::size_t i = 0; i < answer.values.size(); ++i) {
        expect_near("value", result.values[i], answer.values[i], result.error_bound);
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

/// A number per input, as Peer::ask_world() has it.
template <class Record>
double number_of(const Record& record) {
    if constexpr (std::is_same_v<Record, RayHit>) {
        return tools::is_hit(record) ? record.parameter : 2.0;
    } else if constexpr (requires { record.distance; }) {
        return std::max(record.distance, 0.0);
    } else if constexpr (std::is_same_v<Record, std::uint8_t>) {
        return record;
    } else {
        throw std::logic_error("no problem has such a query");
    }
}

std::vector<double> numbers_of(const Problem& problem, Context& context) {
    tools::SceneRunner runner(problem.scene, problem.name, context);
    runner.run_frame();
    runner.require_results();
    std::vector<double> numbers;
    std::visit(
        [&numbers](const auto& found) {
            for (const auto& record : tools::records_of(found)) {
                numbers.push_back(number_of(record));
            }
        },
        runner.answers().front().world->records);
    return numbers;
}

/// Asks about inputs in the place of others that are off by rounding.
Problem displaced(Problem problem, const Vector2& by) {
    const auto displace = [&by](Vector2& point) { point = {point.x + by.x, point.y + by.y}; };
    tools::WorldRequest& request = *problem.scene.queries[0].world;
    for (Pose& pose : request.poses) {
        displace(pose.translation);
    }
    std::for_each(request.points.begin(), request.points.end(), displace);
    for (Segment& segment : request.segments) {
        displace(segment.from);
        displace(segment.to);
    }
    return problem;
}

}  // namespace

void compare(Peer& peer, const Problem& problem, std::span<const PlacedShape> shapes,
             std::span<const tools::SceneAnswer> results, std::span<const Answer> answers,
             PeerTimes& times) {
    Comparison comparison(peer, problem, shapes, times);
    for (std::size_t index = 0; index < answers.size(); ++index) {
        comparison.next(index);
        const AnyResult& result = results[index].result;
        if (problem.task == Task::intersection_test) {
            comparison.compare_test(tools::summary_of(result), answers[index]);
            continue;
        }
        std::visit([&](const auto& any) { comparison.compare(any, answers[index]); }, result);
    }
}

void compare_world(const Peer& peer, const Problem& problem, Context& context,
                   const std::vector<double>& numbers, PeerTimes& times) {
    std::vector<double> least = numbers_of(problem, context);
    std::vector<double> most = least;
    constexpr int directions = 8;
    for (int i = 0; i < directions && peer.rounding() > 0.0; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / directions;
        const Vector2 by{peer.rounding() * std::cos(angle), peer.rounding() * std::sin(angle)};
        const std::vector<double> other = numbers_of(displaced(problem, by), context);
        for (std::size_t k = 0; k < other.size(); ++k) {
            least[k] = std::min(least[k], other[k]);
            most[k] = std::max(most[k], other[k]);
        }
    }
    const std::size_t max_apart = peer.rounding() > 0.0 ? numbers.size() / 10'000 : 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double allowed = 1e-9 * (1.0 + std::abs(numbers[i]));
        const bool is_apart = numbers[i] < least[i] - allowed || numbers[i] > most[i] + allowed;
        times.apart += is_apart ? 1 : 0;
        if (is_apart && times.apart > max_apart) {
            throw std::runtime_error(problem.name + ": answer " + std::to_string(i) +
                                     ": nearfield " + std::to_string(least[i]) + " to " +
                                     std::to_string(most[i]) + ", " + peer.name() + " " +
                                     std::to_string(numbers[i]));
        }
    }
}

}  // namespace nearfield::peers
