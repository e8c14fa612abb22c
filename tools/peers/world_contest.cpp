#include <nearfield/nearfield.hpp>

#include <tools/benchmark/measuring.hpp>
#include <tools/benchmark/workloads.hpp>
#include <tools/common/library_error.hpp>
#include <tools/peers/world_contest.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace nearfield::peers {
namespace {

using benchmark::Random;

constexpr double whole_turn = 2.0 * std::numbers::pi;

Pose anywhere(Random& random, const Vector2& low, const Vector2& high) {
    return {{random.between(low.x, high.x), random.between(low.y, high.y)},
            random.between(0.0, whole_turn)};
}

/// 48 items of 21 vertices side by side, and another one at many poses among and beside them.
WorldProblem layout() {
    WorldProblem problem;
    problem.name = "48 items, 1,008 vertices: an item at 1,000,000 poses, hit or not";
    Random random(41);
    for (int i = 0; i < 48; ++i) {
        problem.shapes.push_back(
            {{benchmark::star(random, 21)},
             {{2.1 * (i % 8), 2.1 * (i / 8)}, random.between(0.0, whole_turn)}});
    }
    problem.item = {benchmark::star(random, 21)};
    for (int i = 0; i < 1'000'000; ++i) {
        problem.poses.push_back(anywhere(random, {-4.0, -4.0}, {32.0, 20.0}));
    }
    return problem;
}

/// Paths of a footprint over coast lines: both islands twice, 10,612 edges in all.
WorldProblem paths() {
    WorldProblem problem;
    problem.name = "112,000 footprints of 12 vertices, 10,612 edges: least distances";
    problem.asks_distances = true;
    problem.shapes = {{benchmark::iceland(), {{0.0, 0.0}, 0.0}},
                      {benchmark::ireland(), {{600.0, 0.0}, 0.0}},
                      {benchmark::iceland(), {{0.0, 600.0}, 2.0}},
                      {benchmark::ireland(), {{600.0, 600.0}, 4.0}}};
    Ring footprint;
    for (int i = 0; i < 12; ++i) {
        const double angle = whole_turn * i / 12.0;
        footprint.push_back({4.0 * std::cos(angle), 2.0 * std::sin(angle)});
    }
    problem.item = {footprint};
    Random random(43);
    for (int path = 0; path < 2000; ++path) {
        Pose pose = anywhere(random, {-400.0, -400.0}, {1000.0, 1000.0});
        const double bend = random.between(-0.1, 0.1);
        for (int i = 0; i < 56; ++i) {
            problem.poses.push_back(pose);
            pose.translation.x += 2.0 * std::cos(pose.angle);
            pose.translation.y += 2.0 * std::sin(pose.angle);
            pose.angle += bend;
        }
    }
    return problem;
}

WorldProblem many_polygons() {
    WorldProblem problem;
    problem.name = "100,000 polygons of 50 vertices: the nearest of 1,000,000 points";
    Random random(47);
    for (int i = 0; i < 100'000; ++i) {
        problem.shapes.push_back(
            {{benchmark::star(random, 50)}, anywhere(random, {0.0, 0.0}, {1000.0, 1000.0})});
    }
    for (int i = 0; i < 1'000'000; ++i) {
        problem.points.push_back(anywhere(random, {0.0, 0.0}, {1000.0, 1000.0}).translation);
    }
    return problem;
}

WorldProblem rays() {
    WorldProblem problem;
    problem.name = "map x100, 71,900 edges: the first hit of 1,000,000 rays";
    const tools::Scene scene = benchmark::map_scene(100);
    Vector2 low{1e300, 1e300};
    Vector2 high{-1e300, -1e300};
    for (const tools::SceneInstance& instance : scene.instances) {
        problem.shapes.push_back({scene.shapes[instance.shape].rings, instance.pose});
        for (const Ring& ring : problem.shapes.back().rings) {
            for (const Vector2& vertex : ring) {
                const Vector2 at = at_pose(vertex, instance.pose);
                low = {std::min(low.x, at.x), std::min(low.y, at.y)};
                high = {std::max(high.x, at.x), std::max(high.y, at.y)};
            }
        }
    }
    Random random(53);
    for (int i = 0; i < 1'000'000; ++i) {
        problem.segments.push_back(
            {anywhere(random, low, high).translation, anywhere(random, low, high).translation});
    }
    return problem;
}

}  // namespace

Vector2 at_pose(const Vector2& point, const Pose& pose) {
    const double c = std::cos(pose.angle);
    const double s = std::sin(pose.angle);
    return {c * point.x - s * point.y + pose.translation.x,
            s * point.x + c * point.y + pose.translation.y};
}

std::vector<WorldProblem> world_problems() {
    return {layout(), paths(), many_polygons(), rays()};
}

namespace {

using benchmark::milliseconds_of;

void require(const Status& status) {
    if (!status.ok()) {
        throw std::runtime_error(status.text());
    }
}

/// nearfield's world of a problem.
class OurWorld {
public:
    explicit OurWorld(const WorldProblem& problem)
        : problem_(problem),
          context_(tools::take(Context::create_cpu())),
          world_(tools::take(World::create(context_))) {
        for (const WorldShape& shape : problem.shapes) {
            WorldInstance instance;
            instance.shape = tools::take(context_.add_shape(shape.rings));
            instance.pose = shape.pose;
            static_cast<void>(tools::take(world_.add(instance)));
        }
        if (!problem.item.empty()) {
            item_ = tools::take(context_.add_shape(problem.item));
        }
        intersects_.resize(problem.poses.size());
        clearances_.resize(problem.asks_distances ? problem.poses.size() : 0);
        nearest_.resize(problem.points.size());
        hits_.resize(problem.segments.size());
    }

    void answer() { answer(problem_); }
    /// The same questions about other poses, points or segments.
    void answer(const WorldInputs& inputs) {
        if (problem_.asks_distances) {
            require(world_.find_clearances({.shape = item_}, inputs.poses, clearances_));
        } else if (!inputs.poses.empty()) {
            require(world_.test_poses(item_, inputs.poses, intersects_));
        } else if (!inputs.points.empty()) {
            require(world_.find_nearest({}, inputs.points, nearest_));
        } else {
            require(world_.cast_rays(inputs.segments, hits_));
        }
    }

    /// As WorldPeer::answer(), after answer().
    [[nodiscard]] std::vector<double> answers() const {
        std::vector<double> numbers;
        if (problem_.asks_distances) {
            for (const Clearance& clearance : clearances_) {
                numbers.push_back(std::max(clearance.distance, 0.0));
            }
        } else {
            numbers.assign(intersects_.begin(), intersects_.end());
        }
        for (const NearestHit& hit : nearest_) {
            numbers.push_back(std::max(hit.distance, 0.0));
        }
        for (const RayHit& hit : hits_) {
            numbers.push_back(hit.instance == InstanceHandle{} ? 2.0 : hit.parameter);
        }
        return numbers;
    }

private:
    const WorldProblem& problem_;
    Context context_;
    World world_;
    ShapeHandle item_;
    std::vector<std::uint8_t> intersects_;
    std::vector<Clearance> clearances_;
    std::vector<NearestHit> nearest_;
    std::vector<RayHit> hits_;
};

/// Inputs in the place of others that are off by rounding.
WorldInputs displaced(WorldInputs inputs, const Vector2& by) {
    const auto displace = [&by](Vector2& point) { point = {point.x + by.x, point.y + by.y}; };
    for (Pose& pose : inputs.poses) {
        displace(pose.translation);
    }
    std::for_each(inputs.points.begin(), inputs.points.end(), displace);
    for (Segment& segment : inputs.segments) {
        displace(segment.from);
        displace(segment.to);
    }
    return inputs;
}

/// nearfield's least and greatest answers, each with that of inputs displaced by `rounding`.
struct AnswerRange {
    std::vector<double> least;
    std::vector<double> most;
};

AnswerRange range_of_answers(OurWorld& ours, const WorldProblem& problem, double rounding) {
    ours.answer();
    AnswerRange range{ours.answers(), ours.answers()};
    constexpr int directions = 8;
    for (int i = 0; i < directions && rounding > 0.0; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / directions;
        ours.answer(displaced(problem, {rounding * std::cos(angle), rounding * std::sin(angle)}));
        const std::vector<double> answers = ours.answers();
        for (std::size_t k = 0; k < answers.size(); ++k) {
            range.least[k] = std::min(range.least[k], answers[k]);
            range.most[k] = std::max(range.most[k], answers[k]);
        }
    }
    return range;
}

/// Counts the answers of a peer outside nearfield's range. Throws if a library that computes in
/// double has any, or another one more than one in ten thousand: in float, rays can pass between
/// two edges at their common vertex.
std::size_t count_apart(const AnswerRange& ours, const std::vector<double>& theirs,
                        const WorldPeer& peer) {
    const std::size_t most = peer.rounding() > 0.0 ? theirs.size() / 10'000 : 0;
    std::size_t apart = 0;
    for (std::size_t i = 0; i < theirs.size(); ++i) {
        const double allowed = 1e-9 * (1.0 + std::abs(theirs[i]));
        if (theirs[i] >= ours.least[i] - allowed && theirs[i] <= ours.most[i] + allowed) {
            continue;
        }
        if (++apart > most) {
            throw std::runtime_error("answer " + std::to_string(i) + ": nearfield " +
                                     std::to_string(ours.least[i]) + " to " +
                                     std::to_string(ours.most[i]) + ", " + peer.name() + " " +
                                     std::to_string(theirs[i]));
        }
    }
    return apart;
}

}  // namespace

WorldTimes race(const WorldProblem& problem) {
    OurWorld ours(problem);
    WorldTimes times{.name = problem.name};
    std::vector<benchmark::Contender> contenders(1);
    contenders[0].frame = [&] { return milliseconds_of([&] { ours.answer(); }); };
    std::vector<std::unique_ptr<WorldPeer>> peers;
    std::vector<double> answers;
    for (const auto make : {make_geos_world, make_cgal_world, make_box2d_world}) {
        std::unique_ptr<WorldPeer> peer = make();
        if (peer->how(problem).empty()) {
            continue;
        }
        peer->build(problem);
        peer->answer(problem, answers);
        const AnswerRange range = range_of_answers(ours, problem, peer->rounding());
        times.peers.push_back({.name = peer->name(),
                               .how = peer->how(problem),
                               .apart = count_apart(range, answers, *peer)});
        peers.push_back(std::move(peer));
        contenders.emplace_back().frame = [&problem, &answers, &of = *peers.back()] {
            return milliseconds_of([&] { of.answer(problem, answers); });
        };
    }
    benchmark::measure(contenders, {.milliseconds = 3000.0, .max_frames = 50, .fewest_frames = 2});
    times.nearfield_ms = benchmark::spread_of(contenders[0].frames_ms);
    for (std::size_t i = 0; i < peers.size(); ++i) {
        times.peers[i].ms = benchmark::spread_of(contenders[i + 1].frames_ms);
    }
    return times;
}

}  // namespace nearfield::peers
