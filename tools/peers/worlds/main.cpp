// Compares worlds of nearfield with libraries that keep an index too: the same world, built once,
// the same questions, one core, in alternating turns. All answers are compared first.
//   bench_world_peers [--filter TEXT]

#include <nearfield/nearfield.hpp>

#include <CLI/CLI.hpp>
#include <sched.h>
#include <tools/benchmark/interleave.hpp>
#include <tools/benchmark/machine.hpp>
#include <tools/benchmark/milliseconds_of.hpp>
#include <tools/benchmark/spread.hpp>
#include <tools/common/library_error.hpp>
#include <tools/peers/worlds/contest.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iomanip>
#include <iostream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace nearfield::peers {
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

void race(const WorldProblem& problem) {
    OurWorld ours(problem);
    std::vector<benchmark::Contender> contenders(1);
    contenders[0].frame = [&] { return milliseconds_of([&] { ours.answer(); }); };
    std::vector<std::unique_ptr<WorldPeer>> peers;
    std::vector<std::size_t> apart;
    std::vector<double> answers;
    for (const auto make : {make_geos_world, make_cgal_world, make_box2d_world}) {
        std::unique_ptr<WorldPeer> peer = make();
        if (peer->how(problem).empty()) {
            continue;
        }
        peer->build(problem);
        peer->answer(problem, answers);
        apart.push_back(
            count_apart(range_of_answers(ours, problem, peer->rounding()), answers, *peer));
        peers.push_back(std::move(peer));
        contenders.emplace_back().frame = [&problem, &answers, &of = *peers.back()] {
            return milliseconds_of([&] { of.answer(problem, answers); });
        };
    }
    benchmark::measure(contenders, {.milliseconds = 3000.0, .max_frames = 50, .fewest_frames = 2});
    const double own = benchmark::spread_of(contenders[0].frames_ms).median;
    std::cout << "| " << problem.name << " | " << own << " |";
    for (std::size_t i = 0; i < peers.size(); ++i) {
        const double other = benchmark::spread_of(contenders[i + 1].frames_ms).median;
        std::cout << ' ' << peers[i]->name() << ": " << other << " (" << other / own << ") "
                  << peers[i]->how(problem);
        if (apart[i] > 0) {
            std::cout << "; " << apart[i] << " answers differ by more than its rounding";
        }
        std::cout << " |";
    }
    std::cout << '\n' << std::flush;
}

void run(const std::string& filter) {
    cpu_set_t core;
    CPU_ZERO(&core);
    CPU_SET(static_cast<unsigned>(sched_getcpu()), &core);
    if (sched_setaffinity(0, sizeof core, &core) != 0) {
        throw std::runtime_error("the process cannot be pinned to a core");
    }
    const benchmark::Machine machine = benchmark::this_machine();
    std::cout << std::setprecision(3) << machine.processor << ", " << machine.date << ", commit "
              << machine.commit
              << "\n\n| question | nearfield, ms | others: ms (times nearfield's) |\n"
              << "|---|---|---|\n";
    for (const WorldProblem& problem : world_problems()) {
        if (problem.name.find(filter) != std::string::npos) {
            race(problem);
        }
    }
}

}  // namespace
}  // namespace nearfield::peers

int main(int count, char** arguments) {
    CLI::App program("Worlds of nearfield and of its peers, turn by turn on one core",
                     "bench_world_peers");
    std::string filter;
    program.add_option("--filter", filter, "Only the rows whose names hold this text");
    CLI11_PARSE(program, count, arguments);
    try {
        nearfield::peers::run(filter);
    } catch (const std::exception& error) {
        std::cerr << "bench_world_peers: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
