#include <tests/query/counted_context.hpp>
#include <tests/query/device_offers.hpp>
#include <tests/query/every_query.hpp>
#include <tests/support/host_frames.hpp>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

using test_support::HostFrames;

class Recorded : public CountedContext {
protected:
    [[nodiscard]] Batch batch(int number) const { return every_query(a_, b_, number); }
    [[nodiscard]] Batch small() const {
        Batch batch;
        batch.add(drawn(IntersectionQuery{{a_, {}}, {b_, {}}, 0.1}));
        return batch;
    }
};

TEST_F(Recorded, AnswersAreThoseOfRunForEveryNumberOfFramesInFlight) {
    for (const std::uint32_t frames : {1U, 2U, 3U, max_batches_in_flight}) {
        SCOPED_TRACE(frames);
        make(frames);
        HostFrames host(host_device(), frames);
        const std::array<std::vector<double>, 2> expected{run(batch(0)), run(batch(1))};
        ASSERT_GT(expected[0].size(), 3000U);
        ASSERT_NE(expected[0], expected[1]);
        calls = {};
        std::vector<Ticket> tickets(frames);
        const std::uint64_t last = 2 * frames + 2;
        for (std::uint64_t frame = 0; frame < last + frames; ++frame) {
            VkCommandBuffer commands = host.begin(frame);  // so frame - frames is complete
            Ticket& ticket = tickets[frame % frames];
            if (frame >= frames) {
                counted().frame_completed(frame - frames);
                EXPECT_EQ(collect(ticket), expected[(frame - frames) % 2]) << "frame " << frame;
            }
            if (frame < last) {
                ticket = record(batch(static_cast<int>(frame % 2)), commands, frame);
            }
            host.submit(frame);
        }
        EXPECT_EQ(calls.submissions + calls.waits, 0);
        EXPECT_GT(calls.recordings, 0);
    }
}

TEST_F(Recorded, TicketsAreReadyWhenTheHostSaysSo) {
    make(3);
    HostFrames host(host_device(), 3);
    const std::vector<double> expected = run(batch(0));
    Ticket tickets[3];
    for (const std::uint64_t frame : {10U, 11U, 12U}) {
        tickets[frame - 10] = record(batch(0), host.begin(frame), frame);
        host.submit(frame);
    }
    Results results;
    for (int i = 0; i < 2; ++i) {  // and the ticket stays valid
        EXPECT_FALSE(counted().is_ready(tickets[1]));
        const Status status = counted().collect(tickets[1], results);
        EXPECT_EQ(status.code(), StatusCode::not_ready);
        EXPECT_NE(status.message().find("frame 11"), std::string::npos) << status.message();
    }
    EXPECT_EQ(counted().record(small(), {.commands = host.begin(13), .frame = 12}).error().code(),
              StatusCode::ring_full);
    host.abandon(13);
    host.wait(12);
    counted().frame_completed(11);
    counted().frame_completed(3);  // the number cannot decrease
    EXPECT_TRUE(counted().is_ready(tickets[0]));
    EXPECT_TRUE(counted().is_ready(tickets[1]));
    EXPECT_FALSE(counted().is_ready(tickets[2]));
    EXPECT_EQ(collect(tickets[1]), expected);
    EXPECT_EQ(collect(tickets[0]), expected);
    EXPECT_EQ(counted().collect(tickets[0], results).code(), StatusCode::unknown_ticket);
    // Recording for a later frame completes none.
    const Expected<Ticket> next =
        counted().record(small(), {.commands = host.begin(15), .frame = 15});
    EXPECT_TRUE(next.has_value()) << next.error().text();
    host.submit(15);
    EXPECT_FALSE(counted().is_ready(tickets[2]));
    counted().frame_completed(12);
    EXPECT_EQ(collect(tickets[2]), expected);
}

TEST_F(Recorded, TimesOfPassesComeBack) {
    make(2);
    HostFrames host(host_device(), 1);
    const Ticket ticket = record(batch(0), host.begin(0), 0);
    host.submit(0);
    host.wait(0);
    counted().frame_completed(0);
    Results results;
    ASSERT_TRUE(counted().collect(ticket, results).ok());
    Results expected;
    ASSERT_TRUE(counted().run(batch(0), expected).ok());
    ASSERT_EQ(results.timings.passes.size(), expected.timings.passes.size());
    const bool timed = offers(host_device(), "timestamps");
    EXPECT_TRUE(timed ? results.timings.passes.size() > 10U : results.timings.passes.empty());
    for (std::size_t i = 0; i < results.timings.passes.size(); ++i) {
        EXPECT_EQ(results.timings.passes[i].name, expected.timings.passes[i].name);
        EXPECT_GE(results.timings.passes[i].milliseconds, 0.0);
    }
    EXPECT_EQ(results.timings.device, 0.0);
}

TEST_F(Recorded, CommandsThatWereNeverSubmittedSaySo) {
    make(1);
    HostFrames host(host_device(), 1);
    const std::vector<double> expected = run(batch(0));
    for (std::uint64_t frame = 0; frame < 4; ++frame) {
        SCOPED_TRACE(frame);
        const Ticket ticket = record(batch(0), host.begin(frame), frame);
        const bool submitted = frame % 2 == 1;
        if (submitted) {
            host.submit(frame);
        } else {
            host.abandon(frame);
        }
        host.wait(frame);
        counted().frame_completed(frame);
        EXPECT_TRUE(counted().is_ready(ticket));
        if (submitted) {
            EXPECT_EQ(collect(ticket), expected);
            continue;
        }
        Results results;
        const Status status = counted().collect(ticket, results);
        EXPECT_EQ(status.code(), StatusCode::not_executed) << status.text();
        EXPECT_EQ(counted().collect(ticket, results).code(), StatusCode::unknown_ticket);
    }
    EXPECT_EQ(run(batch(0)), expected);
}

TEST_F(Recorded, BatchesAndSubmittedOnesShareImagesInAnyOrder) {
    make(4);
    HostFrames host(host_device(), 2);
    const std::vector<double> expected[] = {run(batch(0)), run(batch(1)), run(batch(2)),
                                            run(batch(3))};
    // Recorded first, submitted last; and two in one command buffer.
    VkCommandBuffer commands = host.begin(0);
    const Ticket first = record(batch(0), commands, 0);
    const Ticket second = record(batch(1), commands, 0);
    const Expected<Ticket> between = counted().submit(batch(2));
    const Ticket third = record(batch(3), host.begin(1), 1);
    ASSERT_TRUE(between.has_value()) << between.error().text();
    host.submit(1);
    host.submit(0);
    EXPECT_EQ(collect(*between), expected[2]);
    host.wait(0);
    host.wait(1);
    counted().frame_completed(1);
    EXPECT_EQ(collect(third), expected[3]);
    EXPECT_EQ(collect(first), expected[0]);
    EXPECT_EQ(collect(second), expected[1]);
}

TEST_F(Recorded, SamplesHaveRoomHoweverMany) {
    make(1);
    HostFrames host(host_device(), 1);
    Batch dense;
    for (const Technique technique : device_techniques) {
        // Most of the box is in both shapes, which exceeds the capacity of a first submission.
        dense.add(IntersectionQuery{{a_, {}},
                                    {a_, {}},
                                    0.004,
                                    IntersectionKind::volume_volume,
                                    false,
                                    IntersectionStrategy::stencil,
                                    technique});
    }
    const Ticket ticket = record(dense, host.begin(0), 0);
    host.submit(0);
    host.wait(0);
    counted().frame_completed(0);
    const std::vector<double> numbers = collect(ticket);
    EXPECT_EQ(calls.submissions, 0);
    EXPECT_EQ(numbers, run(dense));
    EXPECT_GT(numbers.size(), 50000U);
}

TEST_F(Recorded, NothingIsRecordedWhereItIsRefused) {
    Settings settings;
    settings.memory_limit = 16U << 20U;
    settings.batches_in_flight = 1;
    make(settings);
    HostFrames host(host_device(), 1);
    VkCommandBuffer commands = host.begin(5);
    const auto code = [&](const Batch& batch, const Recording& where) {
        return counted().record(batch, where).error().code();
    };
    DistanceFieldQuery field;
    field.technique = Technique::raster;
    field.b = {b_, {}};
    field.tolerance = 1e-4;
    field.rectangle = Rectangle{{-1, -1}, {1, 1}};
    Batch too_large;
    too_large.add(field);
    EXPECT_EQ(code(too_large, {.commands = commands, .frame = 5}), StatusCode::too_large);
    EXPECT_EQ(code(small(), {.commands = VK_NULL_HANDLE, .frame = 5}),
              StatusCode::invalid_submission);
    counted().frame_completed(5);
    EXPECT_EQ(code(small(), {.commands = commands, .frame = 5}), StatusCode::invalid_submission);
    // Queries that only the CPU answers need no commands.
    Batch by_cpu;
    by_cpu.add(SeparationQuery{{a_, {}}, {b_, {{3.0, 0.0}, 0.0}}, 0.04, Technique::cpu});
    const Ticket ticket = record(by_cpu, commands, 6);
    EXPECT_TRUE(counted().is_ready(ticket));
    EXPECT_GT(collect(ticket).size(), 5U);
    EXPECT_EQ(calls.recordings, 0);
    host.abandon(5);
}

TEST_F(Recorded, BatchesDoNotKeepAContextFromGoing) {
    make(3);
    HostFrames host(host_device(), 2);
    (void)record(batch(0), host.begin(0), 0);
    host.submit(0);
    host.wait(0);  // complete, but neither reported nor collected
    (void)record(batch(1), host.begin(1), 1);
    host.abandon(1);  // never begun
    counted().frame_completed(1);
    destroy();
    EXPECT_EQ(calls.submissions + calls.waits, 0);
}

TEST_F(Recorded, OpenFramesAreNamedWhenTheContextGoes) {
    std::vector<std::string> errors;
    HostDevice device = host_device();
    device.log = {&errors, [](void* user, LogLevel level, const char* message) {
                      if (level == LogLevel::error) {
                          static_cast<std::vector<std::string>*>(user)->emplace_back(message);
                      }
                  }};
    HostFrames host(host_device(), 3);
    Settings settings;
    settings.batches_in_flight = 4;
    for (const bool told : {true, false}) {
        auto going = std::make_optional(*Context::create(device, on_demand(settings)));
        a_ = *going->add_shape(regular(5));
        b_ = *going->add_shape(regular(7));
        const auto record = [&](std::uint64_t frame) {
            return *going->record(small(), {.commands = host.begin(frame), .frame = frame});
        };
        const Ticket collected = record(7);
        host.submit(7);
        host.wait(7);
        going->frame_completed(7);
        Results results;
        ASSERT_TRUE(going->collect(collected, results).ok());
        for (const std::uint64_t frame : {8U, 9U}) {
            (void)record(frame);
            host.submit(frame);
            host.wait(frame);
        }
        ASSERT_TRUE(going->submit(small()).has_value());  // waited for, not one of the host's
        if (told) {
            going->frame_completed(9);
            going.reset();
            EXPECT_EQ(errors, std::vector<std::string>{});
            continue;
        }
#ifdef NDEBUG
        going.reset();
        ASSERT_EQ(errors.size(), 1U);
        EXPECT_NE(errors[0].find("frames may still run: 8, 9;"), std::string::npos) << errors[0];
#else
        EXPECT_DEATH(going.reset(), "before its frames were complete");
        going->frame_completed(9);
#endif
    }
}

TEST_F(Recorded, AHostThatOnlyRecordsNeedsNoQueue) {
    HostDevice without_queue = host_device();
    without_queue.queue = VK_NULL_HANDLE;
    Expected<Context> made = Context::create(without_queue, on_demand({}));
    ASSERT_TRUE(made.has_value()) << made.error().text();
    a_ = *made->add_shape(regular(5));
    b_ = *made->add_shape(regular(7));
    HostFrames host(host_device(), 1);
    Results results;
    const Expected<Ticket> ticket = made->record(batch(1), {.commands = host.begin(0), .frame = 0});
    ASSERT_TRUE(ticket.has_value()) << ticket.error().text();
    host.submit(0);
    host.wait(0);
    made->frame_completed(0);
    ASSERT_TRUE(made->collect(*ticket, results).ok());
    EXPECT_EQ(results.results.size(), batch(1).queries().size());
    for (const AnyResult& any : results.results) {
        std::visit([](const auto& result) { EXPECT_TRUE(result.status.ok()); }, any);
    }
    const Status refused = made->run(small(), results);
    EXPECT_EQ(refused.code(), StatusCode::invalid_submission);
    EXPECT_NE(refused.message().find("HostDevice::queue is null"), std::string::npos);
    Batch on_cpu;
    on_cpu.add(PenetrationQuery{.a = {a_, {}}, .b = {b_, {}}, .tolerance = 0.1});
    EXPECT_TRUE(made->run(on_cpu, results).ok());
}

TEST_F(Recorded, FramesThatAreCompleteSaySo) {
    make(3);
    HostFrames host(host_device(), 1);
    const VkCommandBuffer commands = host.begin(0);
    (void)record(small(), commands, 11);
    counted().frame_completed(9);
    const Status said = counted().record(small(), {.commands = commands, .frame = 9}).error();
    EXPECT_EQ(said.code(), StatusCode::invalid_submission);
    EXPECT_NE(said.message().find("frame 9 and all before"), std::string::npos) << said.message();
    host.abandon(0);
    counted().frame_completed(11);
}

TEST_F(Recorded, ComputeBatchesRunInSecondaryCommandBuffers) {
    // A host that records into secondary command buffers leaves out the raster, so no technique
    // begins a render pass.
    Settings settings;
    settings.techniques = {.raster = false};
    make(settings);
    Batch batch;
    const Instance here{a_, {}};
    const Instance there{b_, {{0.4, 0.1}, 0.3}};
    for (const Technique technique : {Technique::compute, Technique::automatic}) {
        PenetrationQuery depths{here, there, 0.03};
        ContactQuery contacts{here, there, 0.03, 0.05};
        IntersectionQuery overlap{here, there, 0.03};
        DistanceFieldQuery field{here, there, 0.03};
        depths.technique = contacts.technique = overlap.technique = field.technique = technique;
        contacts.on_device = overlap.on_device = field.on_device = true;
        batch.add(depths);
        batch.add(contacts);
        batch.add(overlap);
        batch.add(field);
    }
    const std::vector<double> expected = run(batch);
    ASSERT_GT(expected.size(), 1000U);
    calls = {};
    HostFrames host(host_device(), 1);
    const test_support::SecondaryCommands secondary(host_device());
    const Ticket ticket = record(batch, secondary.begin(), 0);
    secondary.execute_in(host.begin(0));
    host.submit(0);
    host.wait(0);
    counted().frame_completed(0);
    EXPECT_EQ(collect(ticket), expected);
    EXPECT_EQ(calls.render_passes, 0);
    EXPECT_GT(calls.recordings, 0);
}

}  // namespace
}  // namespace nearfield::test
