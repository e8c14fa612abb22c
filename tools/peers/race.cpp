#include <tools/common/library.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/world_report.hpp>
#include <tools/peers/peer.hpp>
#include <tools/peers/race.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
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

std::vector<double> numbers_of(const tools::SceneAnswer& answer) {
    std::vector<double> numbers;
    std::visit(
        [&numbers](const auto& found) {
            for (const auto& record : tools::records_of(found)) {
                numbers.push_back(number_of(record));
            }
        },
        answer.world->records);
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

/// Compares the answers of a peer that is built from `shapes` with nearfield's results, each within
/// the error bound that the result states (plus rounding: a millionth of d), and keeps the largest
/// difference. Throws std::runtime_error where they differ.
/// - vertices: the count, and the greatest depth;
/// - boundary: the greatest depth within the bound, because the samples differ; and every record of
///   nearfield's, by asking the peer about the same point;
/// - separation: the distance;
/// - intersection test: the same answer;
/// - area: within the area of a band as wide as the bound along the boundary of the intersection,
///   whose length is bounded by the lengths of both boundaries near it;
/// - field: each value.
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

/// The same of a world: each number to a billionth. A peer that computes in float may differ by as
/// much as nearfield's answers to inputs that are displaced by its rounding do, and one answer in
/// ten thousand may be another: in float, rays can pass between two edges at their common vertex.
void compare_world(const Peer& peer, const Problem& problem, Context& context,
                   const tools::SceneAnswer& result, const std::vector<double>& numbers,
                   PeerTimes& times) {
    std::vector<double> least = numbers_of(result);
    std::vector<double> most = least;
    constexpr int directions = 8;
    for (int i = 0; i < directions && peer.rounding() > 0.0; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / directions;
        const Problem other_inputs = displaced(
            problem, {peer.rounding() * std::cos(angle), peer.rounding() * std::sin(angle)});
        tools::SceneRunner runner(other_inputs.scene, problem.name, context);
        runner.run_frame();
        const std::vector<double> other = numbers_of(runner.answers().front());
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

using benchmark::milliseconds_of;
using benchmark::milliseconds_of_short;
using tools::FrameInput;
using tools::SceneRunner;

double run_frame(SceneRunner& runner, FrameInput input) {
    const double milliseconds = runner.run_frame(input);
    runner.require_results();
    return milliseconds;
}

/// That of all queries of a problem that the task of penetrations poses; otherwise any.
PenetrationQuery penetration_of(const Problem& problem) {
    if (problem.task != Task::vertex_penetration) {
        return {};
    }
    Batch batch;
    tools::add_query(batch, problem.scene.queries.front().request, {}, {});
    return std::get<PenetrationQuery>(batch.queries().front());
}

constexpr PairTableOptions listed{.listed = true, .technique = Technique::cpu};

/// nearfield on a list of pairs of shapes that stay where they are: a world.
class KeptPairs {
public:
    /// Both must outlive it. Throws if anything is rejected.
    KeptPairs(const Problem& problem, Context& context);

    /// Whether a world answers lists of pairs for such a task.
    [[nodiscard]] static bool answers(Task task) {
        return task == Task::intersection_test || task == Task::vertex_penetration;
    }

    /// Runs one frame; returns milliseconds.
    double run_frame();

    /// Throws unless the answers of the last frame are these results.
    void require_same(std::span<const tools::SceneAnswer> results);

private:
    const Problem& problem_;
    World world_;
    std::vector<InstanceHandle> a_;
    std::vector<InstanceHandle> b_;
    PairTable<IntersectionTestQuery> tests_;
    PairTable<PenetrationQuery> penetrations_;
};

KeptPairs::KeptPairs(const Problem& problem, Context& context)
    : problem_(problem),
      world_(tools::take(World::create(context))),
      tests_(IntersectionTestQuery{}, listed),
      penetrations_(penetration_of(problem), listed) {
    const tools::Scene& scene = problem.scene;
    std::vector<ShapeHandle> shapes;
    for (const tools::SceneShape& shape : scene.shapes) {
        shapes.push_back(tools::take(tools::add_shape(context, shape.rings, shape.deviation)));
    }
    std::vector<InstanceHandle> instances;
    for (const tools::SceneInstance& instance : scene.instances) {
        instances.push_back(
            tools::take(world_.add({.shape = shapes[instance.shape], .pose = instance.pose})));
    }
    for (const tools::SceneQuery& query : scene.queries) {
        a_.push_back(instances[query.a]);
        b_.push_back(instances[query.b]);
    }
}

double KeptPairs::run_frame() {
    PairTableBase& table = problem_.task == Task::vertex_penetration
                               ? static_cast<PairTableBase&>(penetrations_)
                               : static_cast<PairTableBase&>(tests_);
    return milliseconds_of_short([&] {
        if (const Status status = world_.update(table, {.a = a_, .b = b_}); !status.ok()) {
            tools::require(status, "bench_peers");
        }
    });
}

void KeptPairs::require_same(std::span<const tools::SceneAnswer> results) {
    for (std::size_t i = 0; i < results.size(); ++i) {
        bool is_same = false;
        if (const auto* const test = std::get_if<IntersectionTestResult>(&results[i].result)) {
            is_same = test->intersects == tests_.rows()[i].intersects;
        } else if (const auto* const penetration =
                       std::get_if<PenetrationResult>(&results[i].result)) {
            const PairRow<PenetrationQuery>& row = penetrations_.rows()[i];
            is_same = row.status == StatusCode::ok && row.intersects == penetration->intersects &&
                      row.count == penetration->count &&
                      row.deepest.depth == penetration->deepest.depth;
        }
        if (!is_same) {
            throw std::runtime_error(problem_.name + ": a batch and a world differ in query " +
                                     std::to_string(i));
        }
    }
}

/// A peer at work on a problem, in two copies: one rebuilt each frame and one kept.
struct Entry {
    Entry(const Problem& of, std::unique_ptr<Peer> anew, std::unique_ptr<Peer> once)
        : problem(of), built(std::move(anew)), kept(std::move(once)) {
        place(problem.scene, kept_shapes);
        kept->build(problem, kept_shapes);
    }

    double run_built() {
        return milliseconds_of([&] {
            place(problem.scene, built_shapes);
            built->build(problem, built_shapes);
            answer(*built, problem, built_shapes, built_answers);
        });
    }
    double run_kept() {
        return milliseconds_of_short([&] { answer(*kept, problem, kept_shapes, kept_answers); });
    }
    /// Runs both, and compares their answers with nearfield's.
    PeerTimes checked(std::span<const tools::SceneAnswer> results, Context& context) {
        PeerTimes times{kept->name(), kept->methods().at(problem.task), {}, {}};
        run_kept();
        if (problem.is_of_world()) {
            compare_world(*kept, problem, context, results.front(), kept_answers.front().values,
                          times);
            return times;
        }
        run_built();
        for (const std::vector<Answer>* const answers : {&built_answers, &kept_answers}) {
            compare(*kept, problem, kept_shapes, results, *answers, times);
        }
        return times;
    }

    const Problem& problem;
    std::unique_ptr<Peer> built;
    std::unique_ptr<Peer> kept;
    std::vector<PlacedShape> built_shapes;
    std::vector<PlacedShape> kept_shapes;
    std::vector<Answer> built_answers;
    std::vector<Answer> kept_answers;
};

std::vector<std::unique_ptr<Entry>> entries_of(const Problem& problem) {
    std::vector<std::unique_ptr<Entry>> entries;
    for (const auto make : {make_geos_peer, make_boost_peer, make_boost_tree_peer, make_cgal_peer,
                            make_clipper_peer, make_box2d_peer}) {
        if (make()->methods().contains(problem.task)) {
            entries.push_back(std::make_unique<Entry>(problem, make(), make()));
        }
    }
    return entries;
}

}  // namespace

std::optional<double> ProblemTimes::quickest(benchmark::Spread PeerTimes::*times) const {
    std::optional<double> least;
    for (const PeerTimes& peer : peers) {
        least = std::min(least.value_or((peer.*times).median), (peer.*times).median);
    }
    return least;
}

ProblemTimes race(const Problem& problem, Context& context) {
    ProblemTimes times;
    times.name = problem.name;
    times.task = tools::name_of(problem.task);
    times.queries = problem.scene.queries.size();
    SceneRunner kept(problem.scene, problem.name, context);
    run_frame(kept, FrameInput::all);
    const std::vector<tools::SceneAnswer> results = kept.answers();
    std::optional<KeptPairs> pairs;
    if (KeptPairs::answers(problem.task)) {
        pairs.emplace(problem, context);
        pairs->run_frame();
        pairs->require_same(results);
    }
    times.technique = kept.technique();
    std::vector<benchmark::Contender> contenders;
    std::vector<benchmark::Spread*> spreads;
    const auto add = [&](benchmark::Spread& spread, std::function<double()> frame) {
        contenders.push_back({std::move(frame), {}});
        spreads.push_back(&spread);
    };
    add(times.kept_ms,
        [&] { return pairs ? pairs->run_frame() : run_frame(kept, FrameInput::nothing); });
    const std::vector<std::unique_ptr<Entry>> entries = entries_of(problem);
    times.peers.reserve(entries.size());
    for (const std::unique_ptr<Entry>& entry : entries) {
        PeerTimes& peer = times.peers.emplace_back(entry->checked(results, context));
        add(peer.kept_ms, [&entry] { return entry->run_kept(); });
        if (!problem.is_of_world()) {
            add(peer.built_ms, [&entry] { return entry->run_built(); });
        }
    }
    std::optional<SceneRunner> anew;
    if (problem.is_of_world()) {  // the index alone is of interest, which is built once
        benchmark::measure(contenders, {.milliseconds = 3000.0, .max_frames = 50});
    } else {
        anew.emplace(problem.scene, problem.name, context);
        add(times.built_ms, [&] { return run_frame(*anew, FrameInput::all); });
        benchmark::measure(contenders, {});
    }
    for (std::size_t i = 0; i < contenders.size(); ++i) {
        *spreads[i] = benchmark::spread_of(contenders[i].frames_ms);
    }
    return times;
}

}  // namespace nearfield::peers
