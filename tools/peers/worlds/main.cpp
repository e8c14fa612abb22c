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

#include <cmath>
#include <exception>
#include <iomanip>
#include <iostream>
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

    void answer() {
        if (problem_.asks_distances) {
            require(world_.find_clearances({.shape = item_}, problem_.poses, clearances_));
        } else if (!problem_.poses.empty()) {
            require(world_.test_poses({.shape = item_}, problem_.poses, intersects_));
        } else if (!problem_.points.empty()) {
            require(world_.find_nearest({}, problem_.points, nearest_));
        } else {
            require(world_.cast_rays(problem_.segments, hits_));
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

void compare(const std::vector<double>& ours, const std::vector<double>& theirs,
             const std::string& name) {
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const double allowed = 1e-9 * (1.0 + std::abs(theirs[i]));
        if (!(std::abs(ours[i] - theirs[i]) <= allowed)) {
            throw std::runtime_error("answer " + std::to_string(i) + ": nearfield " +
                                     std::to_string(ours[i]) + ", " + name + " " +
                                     std::to_string(theirs[i]));
        }
    }
}

void race(const WorldProblem& problem) {
    OurWorld ours(problem);
    ours.answer();
    std::vector<benchmark::Contender> contenders(1);
    contenders[0].frame = [&] { return milliseconds_of([&] { ours.answer(); }); };
    std::vector<std::unique_ptr<WorldPeer>> peers;
    std::vector<double> answers;
    for (const auto make : {make_geos_world, make_cgal_world}) {
        std::unique_ptr<WorldPeer> peer = make();
        if (peer->how(problem).empty()) {
            continue;
        }
        peer->build(problem);
        peer->answer(problem, answers);
        compare(ours.answers(), answers, peer->name());
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
                  << peers[i]->how(problem) << " |";
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
