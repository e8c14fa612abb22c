#include <tests/query/counted_context.hpp>
#include <tests/support/host_frames.hpp>

#include <cstdint>
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

TEST_F(HostFramesInFlight, CompleteWhenAsManyLaterOnesAreRecordedAndNoSooner) {
    for (std::uint32_t frames = 2; frames <= max_batches_in_flight; ++frames) {
        SCOPED_TRACE(std::to_string(frames) + " frames in flight");
        make(frames);
        test_support::HostFrames host(host_device(), 16);
        const std::vector<double> expected = run(batch());
        constexpr std::uint64_t first = 100;
        const Ticket ticket = record(batch(), host.begin(first), first);
        host.submit(first);
        // The last frame that the device may work on while it still works on the first.
        const std::uint64_t last = first + frames - 1;
        const Ticket next = record(batch(), host.begin(last), last);
        host.submit(last);
        EXPECT_FALSE(counted().is_ready(ticket));
        Results results;
        EXPECT_EQ(counted().collect(ticket, results).code(), StatusCode::not_ready);
        host.wait(first);
        // One more, and the first is complete, even where the ring has no room for it.
        const VkCommandBuffer commands = host.begin(last + 1);
        EXPECT_EQ(counted().record(batch(), {.commands = commands, .frame = last + 1}).has_value(),
                  frames > 2);
        host.submit(last + 1);
        EXPECT_TRUE(counted().is_ready(ticket));
        EXPECT_FALSE(counted().is_ready(next));
        EXPECT_EQ(collect(ticket), expected);
        host.wait(last + 1);
    }
}

}  // namespace
}  // namespace nearfield::test
