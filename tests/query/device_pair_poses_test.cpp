#include <tests/query/device_poses.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t device_pair_poses_seed = 27000;

/// Tables of pairs at poses that commands of the host write.
class DevicePairPoses : public DevicePosesTest {
protected:
    /// The same poses, as the world has them.
    void move_to(const std::vector<HostPose>& poses, const Vector2& origin) {
        for (const InstanceHandle handle : added_) {
            const auto [x, y, cosine, sine] = poses[handle.index];
            const Pose pose{
                .translation = {origin.x + static_cast<double>(x),
                                origin.y + static_cast<double>(y)},
                .angle = arc_tangent(static_cast<double>(sine), static_cast<double>(cosine))};
            ASSERT_TRUE(world().move(handle, pose).ok());
        }
    }
    /// All instances far from each other.
    void scatter() {
        for (std::size_t i = 0; i < added_.size(); ++i) {
            ASSERT_TRUE(world().move(added_[i], {{1000.0 * static_cast<double>(i), 0.0}}).ok());
        }
    }

    /// Rows at the host's poses are those of the CPU at the same poses of the world.
    template <class Query>
    void compare(PairTable<Query>& table, PairTable<Query>& cpu, PoseBuffer& buffer,
                 const std::vector<HostPose>& poses) {
        ASSERT_NO_FATAL_FAILURE(move_to(poses, buffer.poses().origin));
        ASSERT_TRUE(world().update(cpu).ok());
        ASSERT_NO_FATAL_FAILURE(scatter());
        buffer.write(poses);
        const Status status = world().update(table, at_poses(buffer.poses()));
        gpu().finish();
        ASSERT_TRUE(status.ok()) << status.text();
        expect_rows_of_cpu(table, cpu);
        rows_ += table.size();
    }

    std::uint32_t rows_ = 0;  // that were compared
};

TEST_F(DevicePairPoses, GiveTheRowsOfTheSamePosesOfTheWorld) {
    Random shapes(device_pair_poses_seed);
    add_some(shapes, 2);
    const auto compare_all = [&]<class Query>(const Query& query, const auto&... reach) {
        PairTable<Query> table(query, within((0.0 + ... + reach), on_device));
        PairTable<Query> cpu(query, within((0.0 + ... + reach), on_cpu));
        std::vector<PoseBuffer> buffers{make_buffer(), make_buffer(28, 256)};
        buffers[1].poses().origin = {3e4, -1e4};
        for_each_case(device_pair_poses_seed, 4, [&](Random& random) {
            for (PoseBuffer& buffer : buffers) {
                ASSERT_NO_FATAL_FAILURE(compare(table, cpu, buffer, any_poses(random)));
            }
        });
    };
    compare_all(PenetrationQuery{.tolerance = 0.01, .points = PenetrationPoints::vertices});
    compare_all(PenetrationQuery{.tolerance = 0.03});
    compare_all(PenetrationQuery{.tolerance = 1e-6, .points = PenetrationPoints::vertices});
    compare_all(ContactQuery{.tolerance = 0.02, .contact_distance = 0.05});
    compare_all(IntersectionTestQuery{});
    compare_all(SeparationQuery{.tolerance = 0.01}, 0.2);
    compare_all(ClosestPointQuery{.tolerance = 0.01}, 0.2);
    EXPECT_GT(rows_, 2000U);
}

/// The device's turns are near enough to true ones: squares that touch, or nearly, around their
/// own (0, 0) and far from it, where turns move them more.
TEST_F(DevicePairPoses, TellWhatTouchesFromWhatDoesNot) {
    for (const double centre : {0.0, 3.0, 1000.0}) {
        SCOPED_TRACE(centre);
        remove(std::exchange(added_, {}));
        add_squares(60, centre);
        PairTable table(IntersectionTestQuery{}, on_device);
        PairTable cpu(IntersectionTestQuery{}, on_cpu);
        PoseBuffer buffer = make_buffer();
        rows_ = 0;
        for_each_case(device_pair_poses_seed, 12, [&](Random& random) {
            std::vector<HostPose> poses(60);
            for (std::size_t i = 0; i < 60; i += 2) {
                const double angle = random.between(-4.0, 4.0);
                const Vector2 turn{std::cos(angle), std::sin(angle)};
                // Two units along the x axis of the square, or a little more or less.
                const double apart = 2.0 + random.whole(-1, 1) * (1.5e-7 + 1e-7 * centre);
                for (std::size_t k = 0; k < 2; ++k) {
                    // The other one by a quarter turn more.
                    const Vector2 own = k == 0 ? turn : Vector2{-turn.y, turn.x};
                    const double along = apart * static_cast<double>(k);
                    poses[added_[i + k].index] = {
                        static_cast<float>(along * turn.x - centre * own.x),
                        static_cast<float>(10.0 * static_cast<double>(i) + along * turn.y -
                                           centre * own.y),
                        static_cast<float>(own.x), static_cast<float>(own.y)};
                }
            }
            ASSERT_NO_FATAL_FAILURE(compare(table, cpu, buffer, poses));
        });
        EXPECT_GT(rows_, 50U);
        EXPECT_LT(rows_, 310U);
    }
    added_.clear();
}

/// Coordinates that double precision does not resolve to the tolerance: the CPU says so.
TEST_F(DevicePairPoses, TooFarAwayAreRefusedPairByPair) {
    add_squares(6);
    PairTable<PenetrationQuery> table({.tolerance = 1e-4, .points = PenetrationPoints::vertices},
                                      on_device);
    PairTable<PenetrationQuery> cpu(table.query(), on_cpu);
    PoseBuffer buffer = make_buffer();
    const std::vector<HostPose> poses(6, {0.5F, 0.0F, 0.8F, 0.6F});
    for (const double x : {1e7, 1.2e9}) {
        buffer.poses().origin = {x, 0.0};
        ASSERT_NO_FATAL_FAILURE(compare(table, cpu, buffer, poses));
        EXPECT_EQ(table.size() == 0, x < 1e8);
    }
    EXPECT_EQ(table.row(0)->status, StatusCode::invalid_query);
}

/// Whatever the host does with the buffer afterwards; there is room for some thousand pairs at
/// first, so that the search is submitted again.
TEST_F(DevicePairPoses, AreReadOnce) {
    add_squares(120);
    std::vector<HostPose> together;
    std::vector<HostPose> apart;
    for (int i = 0; i < 120; ++i) {
        const auto place = static_cast<float>(i);
        together.push_back({0.01F * place, 0.005F * place, 0.8F, 0.6F});
        apart.push_back({10.0F * place, 0.0F, 1.0F, 0.0F});
    }
    PoseBuffer buffer = make_buffer();
    PairTable table(PenetrationQuery{.tolerance = 0.05}, on_device);
    buffer.write(together);
    ASSERT_TRUE(world().submit(table, at_poses(buffer.poses())).ok());
    gpu().finish();
    buffer.write(apart);
    gpu().finish();
    const Status status = table.collect();
    ASSERT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(table.candidates(), 120U * 119U);
    EXPECT_EQ(table.size(), 120U * 119U);
    EXPECT_NEAR(table.row(0)->deepest.depth, 0.011, 1e-6);  // turned by 0.8, 0.6
    PoseBuffer other = make_buffer();
    for (const bool is_apart : {false, true}) {
        other.write(is_apart ? apart : together);
        gpu().finish();
        ASSERT_TRUE(world().update(table, at_poses(other.poses())).ok());
        EXPECT_EQ(table.size() == 0, is_apart);
        ASSERT_TRUE(world().update(table, at_poses(buffer.poses())).ok());
        EXPECT_EQ(table.size(), 0U);
    }
}

/// Poses of the world and of the host in turns, and members and shapes that change.
TEST_F(DevicePairPoses, AreNotKept) {
    add_squares(3);
    PairTable table(IntersectionTestQuery{}, on_device);
    const std::vector<HostPose> poses{
        {0.0F, 0.0F, 1.0F, 0.0F}, {1.5F, 0.0F, 1.0F, 0.0F}, {9.0F, 0.0F, 1.0F, 0.0F}, {}, {}};
    ASSERT_NO_FATAL_FAILURE(scatter());
    PoseBuffer buffer(gpu(), 5, 16, 0);
    buffer.write(poses);
    ASSERT_TRUE(world().update(table, at_poses(buffer.poses())).ok());
    gpu().finish();
    ASSERT_EQ(table.size(), 1U);
    EXPECT_EQ(table.row(0)->a, added_[0]);
    EXPECT_EQ(table.row(0)->b, added_[1]);
    ASSERT_TRUE(world().update(table).ok());
    EXPECT_EQ(table.size(), 0U);
    ASSERT_TRUE(world().update(table, at_poses(buffer.poses())).ok());
    EXPECT_EQ(table.size(), 1U);
    buffer.poses().origin = {4.0, 4.0};
    ASSERT_TRUE(world().update(table, at_poses(buffer.poses())).ok());
    EXPECT_EQ(table.size(), 1U);
    ASSERT_TRUE(world().remove(added_[0]).ok());
    ASSERT_TRUE(world().update(table, at_poses(buffer.poses())).ok());
    EXPECT_EQ(table.size(), 0U);
    added_[0] = add(world().instance(added_[1])->shape, {});
    ASSERT_EQ(added_[0].index, 0U);
    ASSERT_TRUE(world().update(table, at_poses(buffer.poses())).ok());
    ASSERT_EQ(table.size(), 1U);
    EXPECT_EQ(table.row(0)->a, added_[1]);
    EXPECT_EQ(table.row(0)->b, added_[0]);
    const Rings large = rectangle({-4.0, -4.0}, {4.0, 4.0});
    ASSERT_TRUE(context().update_shape(world().instance(added_[1])->shape, large).ok());
    ASSERT_TRUE(world().update(table, at_poses(buffer.poses())).ok());
    EXPECT_EQ(table.size(), 2U);
    ASSERT_TRUE(world().set_filter(added_[2], 1, 0).ok());
    ASSERT_TRUE(world().update(table, at_poses(buffer.poses())).ok());
    EXPECT_EQ(table.size(), 1U);
}

TEST_F(DevicePairPoses, ThatAreNoneAreNamed) {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    constexpr float no_number = std::numeric_limits<float>::quiet_NaN();
    add_squares(100);
    const std::vector<HostPose> usable(100, {1.0F, 2.0F, -0.6F, 0.8F});
    PoseBuffer buffer = make_buffer();
    PairTable table(IntersectionTestQuery{}, on_device);
    buffer.poses().origin = {1e11, 0.0};
    for (const HostPose& bad :
         {HostPose{no_number, 0.0F, 1.0F, 0.0F}, HostPose{0.0F, infinite, 1.0F, 0.0F},
          HostPose{0.0F, -infinite, 1.0F, 0.0F}, HostPose{0.95e12F, 0.0F, 1.0F, 0.0F},
          HostPose{0.0F, 0.0F, 0.0F, 0.0F}, HostPose{0.0F, 0.0F, 1.0F, no_number},
          HostPose{0.0F, 0.0F, 1.01F, 0.0F}, HostPose{0.0F, 0.0F, 0.0F, 0.99F},
          HostPose{0.0F, 0.0F, infinite, 0.0F}, HostPose{0.0F, 0.0F, 1e30F, 0.0F}}) {
        std::vector<HostPose> poses = usable;
        poses[71] = poses[93] = bad;
        buffer.write(poses);
        const Status status = world().update(table, at_poses(buffer.poses()));
        gpu().finish();
        EXPECT_EQ(status.code(), StatusCode::invalid_query) << bad[0] << " " << bad[2];
        EXPECT_NE(status.message().find("of the instance with index 71 is ("), std::string::npos)
            << status.text();
        EXPECT_EQ(table.size(), 0U);
        buffer.write(usable);
        const Status good = world().update(table, at_poses(buffer.poses()));
        gpu().finish();
        ASSERT_TRUE(good.ok()) << good.text();
        EXPECT_EQ(table.size(), 100U * 99U / 2U);
    }
}

TEST_F(DevicePairPoses, OfBadBuffersAreRefused) {
    add_squares(3);
    PoseBuffer buffer(gpu(), 3, 20, 0);
    buffer.write({{0.0F, 0.0F, 1.0F, 0.0F}, {5.0F, 0.0F, 1.0F, 0.0F}, {0.5F, 0.0F, 1.0F, 0.0F}});
    gpu().finish();
    PairTable table(IntersectionTestQuery{}, on_device);
    const auto expect_refusal = [&](const char* why, const auto& change) {
        DevicePoses poses = buffer.poses();
        change(poses);
        const Status status = world().submit(table, at_poses(poses));
        EXPECT_EQ(status.code(), StatusCode::invalid_query);
        EXPECT_EQ(status.message().find("submit: the buffer of the poses "), 0U) << status.text();
        EXPECT_NE(status.message().find(why), std::string::npos) << status.text();
        EXPECT_EQ(world().update(table, at_poses(poses)).code(), StatusCode::invalid_query);
        EXPECT_EQ(table.size(), 0U);
    };
    expect_refusal("is null", [](DevicePoses& poses) { poses.buffer = VK_NULL_HANDLE; });
    expect_refusal("lacks VK_BUFFER_USAGE_STORAGE_BUFFER_BIT",
                   [](DevicePoses& poses) { poses.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT; });
    expect_refusal("at the offset 2", [](DevicePoses& poses) { poses.offset = 2; });
    for (const std::uint32_t stride : {0U, 12U, 18U}) {
        expect_refusal("an element every", [=](DevicePoses& poses) { poses.stride = stride; });
    }
    expect_refusal("need elements up to 2, which is 56 bytes",
                   [](DevicePoses& poses) { poses.size = 55; });
    expect_refusal("has the origin (nan, 0)", [](DevicePoses& poses) {
        poses.origin.x = std::numeric_limits<double>::quiet_NaN();
    });
    expect_refusal("has the origin (0, -2e+12)",
                   [](DevicePoses& poses) { poses.origin.y = -2e12; });
    expect_refusal("no stages that make them", [](DevicePoses& poses) { poses.before.stages = 0; });
    DevicePoses least = buffer.poses();
    least.size = 56;
    const Status status = world().update(table, at_poses(least));
    ASSERT_TRUE(status.ok()) << status.text();
    EXPECT_EQ(table.size(), 1U);
}

}  // namespace
}  // namespace nearfield::test
