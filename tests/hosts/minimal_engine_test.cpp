#include "minimal_engine.hpp"

#include <nearfield/vulkan.hpp>

#include <gtest/gtest.h>
#include <tests/query/all_numbers.hpp>
#include <tests/query/every_query.hpp>
#include <tests/support/polygons.hpp>
#include <tests/support/vulkan_host.hpp>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t seed = 9100;
constexpr std::uint64_t all_frames = 9;
constexpr std::uint64_t resized_frame = 5;
constexpr std::uint64_t shared_queue_frame = 7;
constexpr VkExtent2D small{160, 120};
constexpr VkExtent2D large{200, 150};
constexpr int batches = 2;

/// A context with the shapes of the test.
class Guest {
public:
    explicit Guest(Expected<Context> context) {
        if (!context) {
            throw std::runtime_error(context.error().text());
        }
        context_.emplace(std::move(*context));
        Random random(seed);
        a_ = *context_->add_shape(coast(random, 100, 0.5));
        b_ = *context_->add_shape(with_holes(random, 3));
    }

    [[nodiscard]] Context& context() { return *context_; }
    [[nodiscard]] Batch batch(std::uint64_t frame) const {
        return every_query(a_, b_, static_cast<int>(frame % batches));
    }
    [[nodiscard]] std::vector<double> run(std::uint64_t frame) {
        Results results;
        const Status status = context_->run(batch(frame), results);
        EXPECT_TRUE(status.ok()) << status.text();
        return all_numbers(results);
    }
    [[nodiscard]] std::vector<double> collect(Ticket ticket) {
        Results results;
        const Status status = context_->collect(ticket, results);
        EXPECT_TRUE(status.ok()) << status.text();
        return all_numbers(results);
    }

private:
    std::optional<Context> context_;
    ShapeHandle a_;
    ShapeHandle b_;
};

/// The results of an engine's frames: the images and the guest's answers in each.
struct FramesDrawn {
    std::vector<EngineFrame> looks;
    std::vector<std::vector<double>> answers;
    std::vector<double> submitted_in_between;  ///< with the batch of `shared_queue_frame`
};

/// Draws all frames, with or without a guest; each is read back before its slot is used again.
FramesDrawn draw_frames(MinimalEngine& engine, Guest* guest) {
    FramesDrawn drawn;
    std::vector<Ticket> tickets;
    const auto record = [&](std::uint64_t frame, VkCommandBuffer commands) {
        if (guest == nullptr) {
            return;
        }
        if (frame == shared_queue_frame) {
            drawn.submitted_in_between = guest->run(frame);
        }
        const Expected<Ticket> ticket =
            guest->context().record(guest->batch(frame), {.commands = commands, .frame = frame});
        EXPECT_TRUE(ticket.has_value()) << ticket.error().text();
        tickets.push_back(ticket.has_value() ? *ticket : Ticket{});
    };
    const auto finish_until = [&](std::uint64_t end) {
        for (std::uint64_t frame = drawn.looks.size(); frame < end; ++frame) {
            drawn.looks.push_back(engine.look_at(frame));
            if (guest != nullptr) {
                guest->context().frame_completed(frame);
                drawn.answers.push_back(guest->collect(tickets[frame]));
            }
        }
    };
    for (std::uint64_t frame = 0; frame < all_frames; ++frame) {
        if (frame >= MinimalEngine::frames_in_flight) {
            finish_until(frame - MinimalEngine::frames_in_flight + 1);
        }
        if (frame == resized_frame) {
            finish_until(frame);
            engine.resize(large);
        }
        engine.draw(frame, [&](VkCommandBuffer commands) { record(frame, commands); });
    }
    finish_until(all_frames);
    return drawn;
}

/// The same frames without a guest.
std::vector<EngineFrame> frames_without_guest() {
    test_support::VulkanHost host;
    std::optional<MinimalEngine> engine(std::in_place, host.device(), small);
    std::vector<EngineFrame> looks = draw_frames(*engine, nullptr).looks;
    engine.reset();
    EXPECT_EQ(host.close(), std::vector<std::string>{});
    return looks;
}

TEST(MinimalEngine, LooksAsItShouldWithoutAGuest) {
    const std::vector<EngineFrame> looks = frames_without_guest();
    ASSERT_EQ(looks.size(), all_frames);
    for (std::uint64_t frame = 0; frame < all_frames; ++frame) {
        const VkExtent2D extent = frame < resized_frame ? small : large;
        const EngineFrame& look = looks[frame];
        const std::size_t pixels = std::size_t{extent.width} * extent.height;
        ASSERT_EQ(look.color.size(), pixels);
        ASSERT_EQ(look.depth.size(), pixels);
        EXPECT_TRUE(frame == 0 || look.color != looks[frame - 1].color);
        // From both passes: a square of depth each, a triangle each over the clear colour.
        EXPECT_EQ(std::count(look.depth.begin(), look.depth.end(), 0xBFFF), 2 * 16);
        const std::set<std::uint32_t> colors(look.color.begin(), look.color.end());
        EXPECT_EQ(colors, (std::set<std::uint32_t>{0xFFBF8040, 0xFF3C28C8, 0xFF28C83C}));
    }
}

// Under validation and synchronisation validation: the engine's images are the same with and
// without the guest, and the guest's answers are the same as in its own submissions, on one device
// and then on another.
TEST(MinimalEngine, AndItsGuestLeaveEachOtherAloneOnADeviceAndOnTheNext) {
    const std::vector<EngineFrame> alone = frames_without_guest();
    for (int device = 0; device < 2; ++device) {
        SCOPED_TRACE("device " + std::to_string(device));
        test_support::VulkanHost host;
        std::optional<MinimalEngine> engine(std::in_place, host.device(), small);
        Settings settings;
        settings.batches_in_flight = MinimalEngine::frames_in_flight;
        std::optional<Guest> guest(std::in_place, Context::create(host.device(), settings));
        const FramesDrawn drawn = draw_frames(*engine, &*guest);
        EXPECT_TRUE(drawn.looks == alone);

        const std::string name = guest->context().device_name();
        HeadlessOptions same_kind;
        same_kind.device_name = name.c_str();
        Guest at_home(Context::create_headless(same_kind));
        std::vector<std::vector<double>> expected;
        for (std::uint64_t frame = 0; frame < batches; ++frame) {
            expected.push_back(at_home.run(frame));
            EXPECT_GT(expected.back().size(), 3000U);
        }
        ASSERT_NE(expected[0], expected[1]);
        ASSERT_EQ(drawn.answers.size(), all_frames);
        for (std::uint64_t frame = 0; frame < all_frames; ++frame) {
            EXPECT_TRUE(drawn.answers[frame] == expected[frame % batches]) << "frame " << frame;
        }
        EXPECT_TRUE(drawn.submitted_in_between == expected[shared_queue_frame % batches]);
        guest.reset();
        engine.reset();
        EXPECT_EQ(host.close(), std::vector<std::string>{});
    }
}

}  // namespace
}  // namespace nearfield::test
