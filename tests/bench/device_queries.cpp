// Measures many rays, points and poses that are asked about a world, answered by the device and by
// the CPU on one thread, and prints a table in Markdown. With `--passes`, the times of the passes
// go to the standard error output.

#include <nearfield/nearfield.hpp>

#include <tests/bench/clocks.hpp>
#include <tests/bench/crowd.hpp>
#include <tests/bench/take.hpp>
#include <tests/support/polygons.hpp>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using nearfield::bench::Crowd;
using nearfield::bench::median;
using nearfield::bench::require;
using nearfield::bench::take;
using nearfield::bench::wall_milliseconds;

using nearfield::Context;
using nearfield::NearestHit;
using nearfield::NearestQuery;
using nearfield::Pose;
using nearfield::RayHit;
using nearfield::Segment;
using nearfield::Status;
using nearfield::Vector2;
using nearfield::World;
using nearfield::WorldRequest;

std::vector<Vector2> points_of(Crowd& crowd, std::size_t count) {
    std::vector<Vector2> points;
    while (points.size() < count) {
        points.push_back(crowd.place());
    }
    return points;
}

std::vector<Segment> segments_of(Crowd& crowd, std::size_t count, double length) {
    std::vector<Segment> segments;
    while (segments.size() < count) {
        const Vector2 from = crowd.place();
        const double angle = crowd.random().between(0.0, 6.3);
        segments.push_back(
            {from, {from.x + length * std::cos(angle), from.y + length * std::sin(angle)}});
    }
    return segments;
}

/// The median time of a call, after the instances have moved if they do.
template <class Call>
double measure(Crowd& crowd, bool moves, int frames, const Call& call) {
    std::vector<double> times;
    for (int frame = -2; frame < frames; ++frame) {
        if (moves) {
            crowd.move();
        }
        const double start = wall_milliseconds();
        require(call());
        if (frame >= 0) {
            times.push_back(wall_milliseconds() - start);
        }
    }
    return median(times);
}

bool shows_passes = false;

/// The device and the CPU answer the same questions: `submit(request)` has the device begin, and
/// `ask()` asks the CPU.
template <class Answer, class Submit, class Ask>
void compare(Crowd& crowd, const char* kind, std::size_t count, bool moves, WorldRequest& request,
             std::vector<Answer>& answers, const Submit& submit, const Ask& ask) {
    const int frames = count > 100'000 ? 5 : 25;
    const double whole = measure(crowd, moves, frames, [&] {
        const Status status = submit(request);
        return status.ok() ? request.collect(answers) : status;
    });
    const nearfield::Timings& timings = request.timings();
    const double cpu = measure(crowd, moves, frames, ask);
    std::printf("| %u | %s | %s | %zu | %u | %.3f | %.3f | %.3f | %.3f | %.3f | %.2f |\n",
                crowd.world().size(), moves ? "move" : "stand", kind, count, request.left_to_cpu(),
                timings.plan + timings.record, timings.device, timings.decode, whole, cpu,
                whole / cpu);
    std::fflush(stdout);
    if (shows_passes) {
        for (const nearfield::PassTime& pass : timings.passes) {
            std::fprintf(stderr, "  %s %.3f\n", pass.name.c_str(), pass.milliseconds);
        }
    }
}

void compare_all(Context& context, std::uint32_t instances, double side) {
    Crowd crowd(context, instances, side);
    World& world = crowd.world();
    const nearfield::ShapeHandle robot = take(context.add_shape(nearfield::test::scaled_and_moved(
        nearfield::test::star(crowd.random(), 20, 0.5), 0.3, {})));
    const nearfield::WorldOptions by_device{.technique = nearfield::Technique::compute};
    WorldRequest rays;
    WorldRequest nearest;
    WorldRequest tests;
    for (const std::size_t count : {1'000U, 30'000U, 1'000'000U}) {
        for (const bool moves : {false, true}) {
            std::vector<RayHit> hits(count);
            for (const double length : {3.0, 30.0}) {
                const std::vector<Segment> segments = segments_of(crowd, count, length);
                compare(
                    crowd, length < 10.0 ? "rays of 3" : "rays of 30", count, moves, rays, hits,
                    [&](WorldRequest& by) { return world.submit(by, segments, by_device); },
                    [&] { return world.cast_rays(segments, hits); });
            }
            const std::vector<Vector2> points = points_of(crowd, count);
            std::vector<NearestHit> found(count);
            std::vector<Pose> poses;
            for (const Vector2& point : points) {
                poses.push_back({point, 17.0 * point.x});
            }
            std::vector<std::uint8_t> meets(count);
            compare(
                crowd, "poses", count, moves, tests, meets,
                [&](WorldRequest& by) { return world.submit(by, robot, poses, by_device); },
                [&] { return world.test_poses(robot, poses, meets); });
            for (const double reach : {0.25, 1e30}) {
                const NearestQuery query{.max_distance = reach};
                compare(
                    crowd, reach < 1.0 ? "nearest within 0.25" : "nearest", count, moves, nearest,
                    found,
                    [&](WorldRequest& by) { return world.submit(by, query, points, by_device); },
                    [&] { return world.find_nearest(query, points, found); });
            }
        }
    }
}

}  // namespace

int main(int count, char** arguments) {
    shows_passes = count > 1 && std::string(arguments[1]) == "--passes";
    try {
        nearfield::Settings settings;
        settings.timestamps = shows_passes;
        settings.pipelines_on_demand = true;
        Context context = take(Context::create_headless({}, settings));
        std::printf("Device: %s\n\n", context.device_name().c_str());
        std::puts(
            "| objects | they | query | number | left | CPU: upload | wait | CPU: answers | device "
            "| cpu | device / cpu |\n"
            "|---|---|---|---|---|---|---|---|---|---|---|");
        compare_all(context, 1'000, 50.0);
        compare_all(context, 42'000, 325.0);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
