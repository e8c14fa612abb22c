// Context::record() of 1,000 pairs, from the queries to the recorded commands.

#include <engine/gpu/headless.hpp>
#include <nearfield/vulkan.hpp>

#include <tests/bench/bench.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/polygons.hpp>

#include <cstdint>
#include <string>

namespace nearfield::bench {
namespace {

/// 1,000 pairs of stars of 50 vertices, 32 x 32 cells each.
Batch pairs(Context& context, Technique technique, PenetrationPoints points) {
    Batch batch;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        test::Random random(i);
        PenetrationQuery query;
        query.a = {take(context.add_shape(test::star(random, 50, 0.5))), {}};
        query.b = {take(context.add_shape(test::star(random, 50, 0.5))),
                   {{0.9, 0.2}, random.between(0.0, 6.0)}};
        query.tolerance = 1.4 / 32.0 / 1.414;
        query.points = points;
        query.technique = technique;
        batch.add(query);
    }
    return batch;
}

void measure(State& state, Technique technique, PenetrationPoints points) {
    const gpu::HeadlessDevice device({});
    Context context = take(Context::create(device.host()));
    const Batch batch = pairs(context, technique, points);
    test_support::HostFrames host(device.host(), 1);
    Results results;
    std::uint64_t frame = 0;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    Ticket ticket;
    const auto finish = [&] {
        if (commands != VK_NULL_HANDLE) {
            host.submit(frame);
            host.wait(frame);
            context.frame_completed(frame);
            require(context.collect(ticket, results));
            ++frame;
        }
    };
    const auto begin_next = [&] {
        finish();
        commands = host.begin(frame);
    };
    run(state, begin_next, [&]() -> Numbers {
        ticket = take(context.record(batch, {.commands = commands, .frame = frame}));
        return {{"localize ms", results.timings.localize},  // of the frame before
                {"plan ms", results.timings.plan},
                {"record ms", results.timings.record}};
    });
    finish();
}

const bool recordings_are_added = [] {
    for (const bool vertices : {true, false}) {
        for (const Technique technique : {Technique::raster, Technique::compute, Technique::cpu}) {
            add(std::string("record/1,000 pairs, ") + (vertices ? "vertices/" : "samples/") +
                    to_string(technique),
                10, [=](State& state) {
                    measure(state, technique,
                            vertices ? PenetrationPoints::vertices : PenetrationPoints::boundary);
                });
        }
    }
    return true;
}();

}  // namespace
}  // namespace nearfield::bench
