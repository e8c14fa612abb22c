#include <tests/query/counted_context.hpp>
#include <tests/support/host_frames.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

class HostFramesInFlight : public CountedContext {
protected:
    [[nodiscard]] Batch batch() const {
        Batch batch;
        batch.add(drawn(IntersectionQuery{{a_, {}}, {b_, {}}, 0.1}));
        return batch;
    }
};

TEST_F(HostFramesInFlight, AreCompleteOnceTheHostSaysSoAndNoSooner) {
    for (std::uint32_t frames = 1; frames <= max_batches_in_flight; ++frames) {
        SCOPED_TRACE(std::to_string(frames) + " frames in flight");
        make(frames);
        test_support::HostFrames host(host_device(), 16);
        const std::vector<double> expected = run(batch());
        std::vector<Ticket> tickets;
        for (std::uint64_t frame = 100; frame < 100 + frames; ++frame) {
            tickets.push_back(record(batch(), host.begin(frame), frame));
            host.submit(frame);
        }
        // One more than there is room for is an error, and completes none.
        const std::uint64_t next = 100 + frames;
        const Status full =
            counted().record(batch(), {.commands = host.begin(next), .frame = next}).error();
        EXPECT_EQ(full.code(), StatusCode::ring_full);
        EXPECT_NE(full.message().find("(100"), std::string::npos) << full.message();
        host.abandon(next);
        Results results;
        for (std::uint64_t frame = 100; frame < next; ++frame) {
            const Ticket ticket = tickets[frame - 100];
            EXPECT_FALSE(counted().is_ready(ticket));
            EXPECT_EQ(counted().collect(ticket, results).code(), StatusCode::not_ready);
            host.wait(frame);
            counted().frame_completed(frame);
            EXPECT_TRUE(counted().is_ready(ticket));
            EXPECT_EQ(collect(ticket), expected);
        }
    }
}

}  // namespace
}  // namespace nearfield::test
