// Measures Context::record() of 1,000 pairs, from the queries to the recorded commands, and prints
// a table in Markdown.

#include <engine/gpu/headless.hpp>
#include <nearfield/vulkan.hpp>

#include <tests/bench/clocks.hpp>
#include <tests/bench/take.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using nearfield::bench::processor_milliseconds;
using nearfield::bench::take;

using nearfield::Batch;
using nearfield::Context;
using nearfield::PenetrationPoints;
using nearfield::PenetrationQuery;
using nearfield::Technique;

constexpr std::uint64_t warm_up = 2;
constexpr std::uint64_t frames = 10;

/// 1,000 pairs of stars of 50 vertices, 32 x 32 cells each.
Batch pairs(Context& context, Technique technique, PenetrationPoints points) {
    Batch batch;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        nearfield::test::Random random(i);
        PenetrationQuery query;
        query.a = {take(context.add_shape(nearfield::test::star(random, 50, 0.5))), {}};
        query.b = {take(context.add_shape(nearfield::test::star(random, 50, 0.5))),
                   {{0.9, 0.2}, random.between(0.0, 6.0)}};
        query.tolerance = 1.4 / 32.0 / 1.414;
        query.points = points;
        query.technique = technique;
        batch.add(query);
    }
    return batch;
}

void measure(const nearfield::HostDevice& device, Technique technique, PenetrationPoints points) {
    Context context = take(Context::create(device));
    const Batch batch = pairs(context, technique, points);
    nearfield::test_support::HostFrames host(device, 1);
    nearfield::Results results;
    std::vector<double> whole;
    for (std::uint64_t frame = 0; frame < warm_up + frames; ++frame) {
        const VkCommandBuffer commands = host.begin(frame);
        const double start = processor_milliseconds();
        const nearfield::Ticket ticket =
            take(context.record(batch, {.commands = commands, .frame = frame}));
        const double end = processor_milliseconds();
        host.submit(frame);
        host.wait(frame);
        context.frame_completed(frame);
        if (const nearfield::Status status = context.collect(ticket, results); !status.ok()) {
            throw std::runtime_error(status.text());
        }
        if (frame >= warm_up) {
            whole.push_back(end - start);
        }
    }
    std::sort(whole.begin(), whole.end());
    const nearfield::Timings& last = results.timings;
    std::printf("| %s | %s | %.2f | %.2f | %.2f | %.2f | %.2f |\n",
                points == PenetrationPoints::vertices ? "vertices" : "boundary samples",
                to_string(technique), whole.front(), whole[frames / 2], last.localize, last.plan,
                last.record);
    std::fflush(stdout);
}

}  // namespace

int main() {
    try {
        const nearfield::gpu::HeadlessDevice device({});
        std::puts(
            "| 1,000 pairs, penetration | technique | record(), least ms | median | localize | "
            "plan | record |\n|---|---|---|---|---|---|---|");
        for (const PenetrationPoints points :
             {PenetrationPoints::vertices, PenetrationPoints::boundary}) {
            for (const Technique technique :
                 {Technique::raster, Technique::compute, Technique::cpu}) {
                measure(device.host(), technique, points);
            }
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_recording: %s\n", error.what());
        return 1;
    }
}
