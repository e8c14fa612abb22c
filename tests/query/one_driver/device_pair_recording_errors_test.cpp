#include <tests/limits/cut.hpp>
#include <tests/query/device_poses.hpp>
#include <tests/support/host_frames.hpp>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::test {
namespace {

using test_support::HostFrames;
using test_support::KeptCommands;

/// Recorded tables of pairs that go wrong, each with a context of its own, so that frames start
/// at 0.
class DevicePairRecordingErrors : public DevicePosesTest {
protected:
    void SetUp() override {
        DevicePosesTest::SetUp();
        HostDevice host = host_device();
        host.log = {&errors_, [](void* errors, LogLevel level, const char* message) {
                        if (level == LogLevel::error) {
                            static_cast<std::vector<std::string>*>(errors)->emplace_back(message);
                        }
                    }};
        Settings settings;
        settings.pipelines_on_demand = true;
        Expected<Context> made = Context::create(host, settings);
        ASSERT_TRUE(made.has_value()) << made.error().text();
        own_.emplace(std::move(*made));
        square_ = *own_->add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
        own_world_.emplace(std::move(*World::create(*own_)));
        frames_.emplace(host_device(), 1);
    }
    void TearDown() override {
        frames_.reset();
        own_world_.reset();
        own_.reset();
        DevicePosesTest::TearDown();
    }

    /// Squares that all overlap.
    void crowd(int count) {
        for (; count > 0; --count) {
            const double i = 1.0 * static_cast<double>(added_.size());
            const auto handle =
                own_world_->add({.shape = square_, .pose = {{0.01 * i, 0.005 * i}, 0.1 * i}});
            ASSERT_TRUE(handle.has_value()) << handle.error().text();
            added_.push_back(*handle);
        }
    }
    Status record(PairTableBase& table, std::uint64_t frame, const Limits& limits = {}) {
        return own_world_->record(table, {.commands = frames_->begin(frame), .frame = frame}, {},
                                  limits);
    }
    void execute(std::uint64_t frame) {
        frames_->submit(frame);
        frames_->wait(frame);
        own_->frame_completed(frame);
    }
    Status run(PairTableBase& table, std::uint64_t frame) {
        Status status = record(table, frame);
        EXPECT_TRUE(status.ok()) << status.text();
        execute(frame);
        return table.collect();
    }
    static void expect(const Status& status, StatusCode code, const std::string& words) {
        EXPECT_EQ(status.code(), code) << status.text();
        EXPECT_NE(status.message().find(words), std::string::npos) << status.text();
    }

    std::optional<Context> own_;
    std::optional<World> own_world_;
    std::optional<HostFrames> frames_;
    std::vector<std::string> errors_;  // that the context logged
    ShapeHandle square_;
};

/// There is room for some thousand pairs and points at first.
TEST_F(DevicePairRecordingErrors, SayThatThereWasNoRoomAndMakeIt) {
    crowd(120);
    const PenetrationQuery query{.tolerance = 0.05, .on_device = true};
    PairTable reference(query, on_device);
    ASSERT_TRUE(own_world_->update(reference).ok());
    for (const bool is_collected : {true, false}) {
        PairTable table(query, on_device);
        const std::uint64_t first = is_collected ? 0 : 100;
        const Status status = run(table, first);
        expect(status, StatusCode::overflow, "if they are recorded anew");
        ASSERT_FALSE(status.reasons().empty());
        EXPECT_EQ(status.reasons()[0], "14280 pairs, and room for 4096");
        EXPECT_EQ(table.size(), 0U);
        EXPECT_EQ(table.candidates(), 0U);
        EXPECT_FALSE(own_world_->is_recorded(table));
        expect(table.collect(), StatusCode::overflow, "");  // as often as it is called
        std::uint64_t frame = first + 1;
        for (; frame < first + 5; ++frame) {
            const Status recorded = record(table, frame);
            ASSERT_TRUE(recorded.ok()) << recorded.text();
            execute(frame);
            if (is_collected && table.collect().ok()) {
                break;
            }
        }
        EXPECT_LE(frame - first, is_collected ? 2U : 5U);
        const Status last = table.collect();
        ASSERT_TRUE(last.ok()) << last.text();
        EXPECT_TRUE(own_world_->is_recorded(table));
        EXPECT_EQ(table.size(), 120U * 119U);
        ASSERT_EQ(table.size(), reference.size());
        for (std::uint32_t i = 0; i < table.size(); i += 100) {
            EXPECT_EQ(table.row(i)->deepest.position, reference.row(i)->deepest.position);
        }
        EXPECT_TRUE(own_world_->update(table).ok());
        EXPECT_EQ(table.size(), 120U * 119U);
    }
}

TEST_F(DevicePairRecordingErrors, OfMemoryThatIsNeverEnough) {
    Settings settings;
    settings.memory_limit = 1U << 20U;
    Expected<Context> small = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(small.has_value()) << small.error().text();
    const ShapeHandle square = *small->add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    World world = std::move(*World::create(*small));
    for (int i = 0; i < 400; ++i) {
        ASSERT_TRUE(world.add({.shape = square, .pose = {{0.001 * i, 0.0}}}).has_value());
    }
    PairTable table(IntersectionTestQuery{}, on_device);
    std::uint64_t frame = 0;
    Status status;
    for (; status.ok() && frame < 10; ++frame) {
        status = world.record(table, {.commands = frames_->begin(frame), .frame = frame});
        if (status.ok()) {
            frames_->submit(frame);
            frames_->wait(frame);
            small->frame_completed(frame);
            EXPECT_EQ(table.collect().code(), StatusCode::overflow);
        }
    }
    expect(status, StatusCode::too_large, "Settings::memory_limit");
    EXPECT_GT(frame, 1U);
    frames_->abandon(frame - 1);
    EXPECT_EQ(table.collect().code(), StatusCode::not_ready);
}

TEST_F(DevicePairRecordingErrors, OfCommandsAndFramesThatCannotBeUsed) {
    crowd(3);
    PairTable table(IntersectionTestQuery{}, on_device);
    ASSERT_TRUE(own_world_->update(table).ok());
    expect(own_world_->record(table, {}), StatusCode::invalid_submission,
           "Recording::commands is null");
    EXPECT_EQ(table.size(), 3U);
    own_->frame_completed(7);
    const VkCommandBuffer commands = frames_->begin(7);
    expect(own_world_->record(table, {.commands = commands, .frame = 7}),
           StatusCode::invalid_submission, "Recording::frame is 7");
    EXPECT_EQ(table.size(), 3U);
    EXPECT_FALSE(own_world_->is_recorded(table));
    PairTable<PenetrationQuery> bad({.tolerance = -1.0}, on_device);
    expect(own_world_->record(bad, {.commands = commands, .frame = 8}), StatusCode::invalid_query,
           "record: ");
    expect(own_world_->record(bad, {.commands = commands, .frame = 8}, at_poses(DevicePoses{})),
           StatusCode::invalid_query, "record: ");
    EXPECT_EQ(bad.collect().code(), StatusCode::not_ready);
    frames_->abandon(7);

    Expected<Context> without_device = Context::create_cpu();
    World other = std::move(*World::create(*without_device));
    expect(other.record(table, {.commands = commands, .frame = 8}),
           StatusCode::unsupported_technique, "record: ");
    EXPECT_FALSE(other.is_recorded(table));
    table = PairTable(IntersectionTestQuery{}, on_device);
}

TEST_F(DevicePairRecordingErrors, OfFramesThatAreNotComplete) {
    crowd(3);
    PairTable table(IntersectionTestQuery{}, on_device);
    EXPECT_FALSE(table.is_ready());
    ASSERT_TRUE(record(table, 4).ok());
    frames_->submit(4);
    EXPECT_FALSE(table.is_ready());
    const VkCommandBuffer commands = frames_->begin(5);
    for (const Status& status :
         {own_world_->update(table), own_world_->submit(table), table.collect(),
          own_world_->record(table, {.commands = commands, .frame = 5})}) {
        expect(status, StatusCode::not_ready, "the table was recorded for frame 4, which is not");
    }
    EXPECT_TRUE(own_world_->is_recorded(table));
    own_->frame_completed(4);
    EXPECT_TRUE(table.is_ready());
    ASSERT_TRUE(table.collect().ok());
    EXPECT_EQ(table.size(), 3U);
    // What is recorded for later frames completes none: not of tables, and not of batches.
    ASSERT_TRUE(own_world_->record(table, {.commands = commands, .frame = 5}).ok());
    frames_->submit(5);
    PairTable other(IntersectionTestQuery{}, on_device);
    ASSERT_TRUE(record(other, 9).ok());
    EXPECT_FALSE(table.is_ready());
    expect(own_world_->update(table), StatusCode::not_ready, "for frame 5, which is not");
    own_->frame_completed(5);
    ASSERT_TRUE(own_world_->update(table).ok());
    EXPECT_EQ(table.size(), 3U);
    EXPECT_EQ(table.collect().code(), StatusCode::not_ready);
    frames_->abandon(9);
    own_->frame_completed(9);
}

TEST_F(DevicePairRecordingErrors, OfCommandsThatWereNotExecuted) {
    crowd(120);
    PairTable table(PenetrationQuery{.tolerance = 0.05}, on_device);
    ASSERT_TRUE(own_world_->update(table).ok());
    for (const std::uint64_t frame : {0U, 1U}) {
        ASSERT_TRUE(record(table, frame).ok());
        frames_->abandon(frame);
        own_->frame_completed(frame);
        for (int i = 0; i < 2; ++i) {
            expect(table.collect(), StatusCode::not_executed, "was the command buffer submitted?");
            EXPECT_EQ(table.size(), 0U);
        }
    }
    const Status status = run(table, 2);
    EXPECT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(table.size(), 120U * 119U);
}

TEST_F(DevicePairRecordingErrors, OfPosesThatAreNoneLeaveWhatWasRecorded) {
    crowd(3);
    const std::vector<HostPose> good(3, {1.0F, 2.0F, -0.6F, 0.8F});
    std::vector<HostPose> bad = good;
    bad[1][0] = std::numeric_limits<float>::quiet_NaN();
    PoseBuffer buffer = make_buffer();
    PairTable table(IntersectionTestQuery{}, on_device);
    KeptCommands kept(host_device());
    const VkCommandBuffer search = kept.begin();
    ASSERT_TRUE(own_world_->record(table, {.commands = search}, at_poses(buffer.poses())).ok());
    kept.end(search);
    own_->frame_completed(0);
    for (int i = 0; i < 2; ++i) {
        for (const bool is_good : {false, true}) {
            buffer.write(is_good ? good : bad);
            kept.run(std::array{search});
            gpu().finish();
            const Status status = table.collect();
            if (is_good) {
                EXPECT_TRUE(status.ok()) << status.text();
            } else {
                expect(status, StatusCode::invalid_query, "of the instance with index 1 is (");
            }
            EXPECT_EQ(table.size(), is_good ? 3U : 0U);
            EXPECT_TRUE(own_world_->is_recorded(table));
        }
    }
}

TEST_F(DevicePairRecordingErrors, CutByLimitsLeaveWhatWasRecorded) {
    for (int i = 0; i < 4; ++i) {  // single precision cannot tell how deep the corners are
        ASSERT_TRUE(own_world_->add({.shape = square_, .pose = {{2.0 * i, 0.5 * i}}}).has_value());
    }
    PairTable table(PenetrationQuery{.tolerance = 1e-5, .points = PenetrationPoints::vertices},
                    on_device);
    ASSERT_TRUE(own_world_->update(table).ok());
    ASSERT_GT(table.left_to_cpu(), 0U);
    const std::uint32_t size = table.size();
    ASSERT_TRUE(record(table, 0).ok());
    execute(0);
    const std::uint64_t cuts = cut_everywhere(dense, [&](std::uint64_t n) {
        const Cut cut(n);
        const Status status = table.collect(cut.limits());
        EXPECT_EQ(status.code(), cut.has_cut() ? StatusCode::cancelled : StatusCode::ok)
            << status.text();
        EXPECT_EQ(table.left_to_cpu() > 0, !cut.has_cut());
        return cut.has_cut() && !HasFailure();
    });
    EXPECT_GE(cuts, 1U);
    EXPECT_TRUE(table.collect().ok());
    EXPECT_EQ(table.size(), size);
    const Cut cut(1);
    EXPECT_EQ(record(table, 1, cut.limits()).code(), StatusCode::cancelled);
    frames_->abandon(1);
    EXPECT_FALSE(own_world_->is_recorded(table));
}

TEST_F(DevicePairRecordingErrors, TellWhatIsStillAboutTheWorld) {
    crowd(3);
    const ShapeHandle other = *own_->add_shape(rectangle({0.0, 0.0}, {9.0, 1.0}));
    PairTable table(IntersectionTestQuery{}, on_device);
    EXPECT_FALSE(own_world_->is_recorded(table));
    std::uint64_t frame = 0;
    const auto expect_anew = [&](const char* change, bool is_anew) {
        SCOPED_TRACE(change);
        EXPECT_EQ(own_world_->is_recorded(table), !is_anew);
        const Status status = run(table, frame++);
        EXPECT_TRUE(status.ok()) << status.text();
        EXPECT_TRUE(own_world_->is_recorded(table));
    };
    expect_anew("nothing yet", true);
    ASSERT_TRUE(own_world_->move(added_[0], {{3.0, 3.0}, 1.0}).ok());
    expect_anew("poses are not compared", false);
    ASSERT_TRUE(own_world_->set_filter(added_[0], 2, 2).ok());
    expect_anew("a filter", true);
    ASSERT_TRUE(own_world_->set_filter(added_[0], 2, 2).ok());
    expect_anew("a filter as it was", false);
    ASSERT_TRUE(own_world_->set_filter(added_[0], 3, 2).ok());
    ASSERT_TRUE(own_world_->set_filter(added_[0], 2, 2).ok());
    expect_anew("a filter and back", false);
    ASSERT_TRUE(own_world_->remove(added_[0]).ok());
    expect_anew("removed", true);
    ASSERT_TRUE(own_world_->add({.shape = square_}).has_value());
    expect_anew("added", true);
    const Expected<InstanceHandle> passing = own_world_->add({.shape = square_});
    ASSERT_TRUE(passing.has_value() && own_world_->remove(*passing).ok());
    expect_anew("added and removed", false);
    ASSERT_TRUE(own_->update_shape(square_, rectangle({-2.0, -1.0}, {1.0, 1.0})).ok());
    expect_anew("a shape", true);
    ASSERT_TRUE(own_->update_shape(other, rectangle({0.0, 0.0}, {8.0, 1.0})).ok());
    expect_anew("a shape without instances", false);
    ASSERT_TRUE(own_->remove_shape(other).ok());
    expect_anew("a shape without instances is gone", false);
    const ShapeHandle short_lived = *own_->add_shape(rectangle({0.0, 0.0}, {9.0, 1.0}));
    ASSERT_TRUE(own_world_->add({.shape = short_lived}).has_value());
    expect_anew("an instance of another shape", true);
    ASSERT_TRUE(own_->remove_shape(short_lived).ok());
    expect_anew("the shape of an instance is gone", true);
    own_->trim();
    own_world_->trim();
    expect_anew("trimmed", false);
    ASSERT_TRUE(own_world_->update(table).ok());
    expect_anew("updated", true);
    World second = std::move(*World::create(*own_));
    EXPECT_FALSE(second.is_recorded(table));
    ASSERT_TRUE(second.update(table).ok());
    expect_anew("of another world", true);
}

TEST_F(DevicePairRecordingErrors, OfWorldsWithoutPairsAreNone) {
    PairTable table(PenetrationQuery{.tolerance = 0.1, .on_device = true}, on_device);
    for (std::uint64_t frame = 0; frame < 2; ++frame) {
        const Status status = run(table, frame);
        EXPECT_TRUE(status.ok()) << status.text();
        EXPECT_EQ(table.size(), 0U);
        EXPECT_TRUE(own_world_->is_recorded(table));
        EXPECT_EQ(table.on_device().error().code(), StatusCode::not_ready);
        crowd(1);
    }
    crowd(1);
    EXPECT_TRUE(run(table, 2).ok());
    EXPECT_GT(table.size(), 0U);
}

TEST_F(DevicePairRecordingErrors, AreLoggedWhereATableGoesTooEarly) {
    crowd(3);
    for (const bool is_complete : {true, false}) {
        PairTable table(IntersectionTestQuery{}, on_device);
        const std::uint64_t frame = is_complete ? 0 : 1;
        ASSERT_TRUE(record(table, frame).ok());
        frames_->submit(frame);
        frames_->wait(frame);
        if (is_complete) {
            own_->frame_completed(frame);
        }
        EXPECT_EQ(errors_.size(), 0U);
    }
    ASSERT_EQ(errors_.size(), 1U);
    EXPECT_NE(errors_[0].find("recorded of it for frame 1 may still run"), std::string::npos);
}

}  // namespace
}  // namespace nearfield::test
