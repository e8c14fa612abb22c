#include <tests/query/steady_state.hpp>
#include <tests/support/host_frames.hpp>
#include <tests/support/host_gpu.hpp>

#include <array>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace nearfield::test {
namespace {

using SteadyState = SteadyStateTest;

/// Queries with resident outputs: fields first, then penetration, contacts and intersections.
Batch resident_batch(ShapeHandle a, ShapeHandle b) {
    Batch batch;
    DistanceFieldQuery field;
    field.b = {b, {{5.7, 5.1}, 0.3}};
    field.tolerance = 0.1;
    field.rectangle = Rectangle{{4.0, 4.0}, {6.0, 6.0}};
    field.on_device = true;
    field.technique = Technique::compute;
    batch.add(field);
    const Instance here{a, {{5.0, 5.0}, 0.0}};
    batch.add(PenetrationQuery{here, field.b, 0.08, {}, false, Technique::compute, true});
    batch.add(ContactQuery{here, field.b, 0.08, 0.05, {}, false, Technique::compute, true});
    for (const IntersectionKind kind :
         {IntersectionKind::volume_volume, IntersectionKind::boundary_boundary}) {
        batch.add(IntersectionQuery{here, field.b, 0.08, kind, false, IntersectionStrategy::stencil,
                                    Technique::compute, true});
    }
    return batch;
}

TEST_F(SteadyState, FramesInFlightAllocateAndCreateNothing) {
    Results results;
    Ticket former;
    expect_nothing_made(250, [&](int number) {
        // The previous frame is still in flight when the shapes deform and this one is submitted.
        if (!deform(number)) {
            return false;
        }
        const Expected<Ticket> ticket = watched().submit(batch());
        const bool ok =
            ticket.has_value() && (former == Ticket{} || watched().collect(former, results).ok());
        former = ticket.has_value() ? *ticket : Ticket{};
        return ok;
    });
    expect_answers(results);
    EXPECT_EQ(results.results.size(), batch().queries().size());
}

TEST_F(SteadyState, RecordedFramesAllocateAndCreateNothing) {
    constexpr std::uint64_t frames = 2;
    test_support::HostFrames host(host_device(), frames);
    Results results;
    Ticket tickets[frames];
    std::uint64_t number = 0;
    expect_nothing_made(250, [&](int form) {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        by_others([&] { commands = host.begin(number); });
        Ticket& ticket = tickets[number % frames];
        bool ok = deform(form);
        if (number >= frames) {
            watched().frame_completed(number - frames);
            ok = ok && watched().collect(ticket, results).ok();
        }
        const Expected<Ticket> next =
            watched().record(batch(), {.commands = commands, .frame = number});
        ok = ok && next.has_value();
        ticket = next.has_value() ? *next : Ticket{};
        by_others([&] { host.submit(number++); });
        return ok;
    });
    expect_answers(results);
    EXPECT_EQ(results.results.size(), batch().queries().size());
    host.wait(number - 1);
}

TEST_F(SteadyState, FramesThatAreWaitedForAllocateAndCreateNothing) {
    Results results;
    expect_nothing_made(
        50, [&](int number) { return deform(number) && watched().run(batch(), results).ok(); });
    expect_answers(results);
}

TEST_F(SteadyState, WhatStaysOnTheDeviceAllocatesAndCreatesNothing) {
    const Batch batch = resident_batch(shapes_of_frame()[0], shapes_of_frame()[1]);
    Results results;
    Ticket former;
    expect_nothing_made(100, [&](int number) {
        if (!deform(number)) {
            return false;
        }
        const Expected<Ticket> ticket = watched().submit(batch);
        const bool exported =
            ticket.has_value() &&
            watched().on_device(*ticket, QueryHandle<DistanceFieldQuery>{0}).has_value() &&
            watched().on_device(*ticket, QueryHandle<PenetrationQuery>{1}).has_value() &&
            watched().on_device(*ticket, QueryHandle<IntersectionQuery>{3}).has_value();
        const bool ok = exported && (former == Ticket{} || watched().collect(former, results).ok());
        former = ticket.has_value() ? *ticket : Ticket{};
        return ok;
    });
    expect_answers(results);
    EXPECT_EQ(results.results.size(), batch.queries().size());
}

/// Images and buffers of a host that takes turns with three of each.
struct TakenInTurns {
    explicit TakenInTurns(test_support::HostGpu& gpu) {
        const VkExtent2D extent{64, 64};
        const VkImageUsageFlags usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        for (std::size_t i = 0; i < images.size(); ++i) {
            for (auto [image, format] :
                 {std::pair{&images[i].signed_distance, VK_FORMAT_R32_SFLOAT},
                  std::pair{&images[i].feature, VK_FORMAT_R32_UINT}}) {
                const test_support::HostGpu::Image made = gpu.make_image(format, extent, usage);
                image->image = made.image;
                image->view = made.view;
                image->format = format;
                image->extent = extent;
                image->usage = usage;
            }
            buffers[i].usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
            buffers[i].size = 1 << 18;
            buffers[i].buffer = gpu.make_buffer(buffers[i].size, buffers[i].usage).buffer;
        }
    }

    std::array<FieldTarget, 3> images;
    std::array<BufferTarget, 3> buffers;
};

TEST_F(SteadyState, TargetsThatTakeTurnsAllocateAndCreateNothing) {
    test_support::HostGpu gpu(host_device());
    const TakenInTurns targets(gpu);
    const Batch all = resident_batch(shapes_of_frame()[0], shapes_of_frame()[1]);
    Batch batch;
    Results results;
    Ticket former;
    expect_nothing_made(100, [&](int number) {
        if (!deform(number)) {
            return false;
        }
        const std::size_t turn = static_cast<std::size_t>(number) % targets.images.size();
        auto field = std::get<DistanceFieldQuery>(all.queries()[0]);
        auto depths = std::get<PenetrationQuery>(all.queries()[1]);
        field.target = &targets.images[turn];
        depths.target = &targets.buffers[turn];
        batch.clear();
        batch.time_queries(true);
        batch.add(field);
        batch.add(depths);
        const Expected<Ticket> ticket = watched().submit(batch);
        const bool ok =
            ticket.has_value() && (former == Ticket{} || watched().collect(former, results).ok());
        former = ticket.has_value() ? *ticket : Ticket{};
        return ok;
    });
    expect_answers(results);
    EXPECT_TRUE(watched().collect(former, results).ok());
}

}  // namespace
}  // namespace nearfield::test
