#include <tests/limits/cut.hpp>
#include <tests/query/device_pairs.hpp>

#include <array>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t device_pair_submissions_seed = 25000;
constexpr PenetrationQuery submitted_penetrations{.tolerance = 0.02};
/// For the pairs of crowd(): single precision cannot tell how deep some points are.
constexpr PenetrationQuery close_calls{.tolerance = 1e-5, .points = PenetrationPoints::vertices};

/// Tables of pairs that are submitted, and collected while the world has changed.
class DevicePairSubmissions : public DevicePairsTest {
protected:
    void TearDown() override {
        if (square_ != ShapeHandle{}) {
            EXPECT_TRUE(context().remove_shape(square_).ok());
        }
        DevicePairsTest::TearDown();
    }

    /// Squares that overlap, of which some pairs are the CPU's.
    void crowd() {
        square_ = *context().add_shape(rectangle({0.0, 0.0}, {1.0, 1.0}));
        for (int i = 0; i < 8; ++i) {
            added_.push_back(add(square_, {.translation = {i / 3.0 + i, 0.0}}));
            added_.push_back(add(square_, {.translation = {i / 3.0 + i + 1.0, 0.5}}));
        }
    }
    /// Changes all that a table could look at.
    void change(int number) {
        ASSERT_TRUE(world().move(added_.front(), {{0.1 * number, 0.2}, 0.3}).ok());
        const double size = 1.0 + 0.25 * number;
        ASSERT_TRUE(context().update_shape(square_, rectangle({0.0, 0.0}, {size, size})).ok());
        ASSERT_TRUE(world().remove(added_.back()).ok());
        added_.back() = add(square_, {.translation = {2.5, 0.25}});
    }

    ShapeHandle square_;
    std::vector<InstanceHandle> added_;
};

TEST_F(DevicePairSubmissions, TellOfTheWorldAsItWas) {
    crowd();
    PairTable at_once(close_calls, on_device);
    PairTable by_halves(close_calls, on_device);
    for (int i = 0; i < 4; ++i) {
        ASSERT_TRUE(world().update(at_once).ok());
        const std::vector<double> expected = numbers_of_table(at_once);
        EXPECT_GT(at_once.size(), 4U);
        EXPECT_TRUE(i > 0 || at_once.left_to_cpu() > 0);
        ASSERT_TRUE(world().submit(by_halves).ok());
        EXPECT_EQ(by_halves.size(), 0U);
        EXPECT_EQ(by_halves.candidates(), 0U);
        change(i + 1);
        const Status status = by_halves.collect();
        ASSERT_TRUE(status.ok()) << status.text();
        EXPECT_EQ(numbers_of_table(by_halves), expected);
        EXPECT_GT(by_halves.timings().total, 0.0);
    }
    ASSERT_TRUE(world().update(at_once).ok());
    const std::vector<double> expected = numbers_of_table(at_once);
    ASSERT_TRUE(world().submit(by_halves).ok());
    for (const InstanceHandle instance : std::exchange(added_, {})) {
        ASSERT_TRUE(world().remove(instance).ok());
    }
    ASSERT_TRUE(context().remove_shape(std::exchange(square_, {})).ok());
    ASSERT_TRUE(by_halves.collect().ok());
    EXPECT_EQ(numbers_of_table(by_halves), expected);
}

/// Where a few shapes of many deform, only these are uploaded.
TEST_F(DevicePairSubmissions, OfShapesThatDeformAreThoseOfANewTable) {
    Random random(device_pair_submissions_seed);
    std::vector<ShapeHandle> shapes;
    for (int i = 0; i < 30; ++i) {
        shapes.push_back(*context().add_shape(star(random, 20, 0.5)));
        for (int j = 0; j < 3; ++j) {
            add(shapes.back(),
                {.translation = {random.between(0.0, 6.0), random.between(0.0, 6.0)}});
        }
    }
    PairTable kept(submitted_penetrations, on_device);
    for (int frame = 0; frame < 12; ++frame) {
        SCOPED_TRACE(frame);
        for (int i = 0; i < frame % 4; ++i) {
            const ShapeHandle shape = shapes[static_cast<std::size_t>(random.whole(0, 29))];
            const Rings rings = star(random, random.whole(5, 60), 0.5);
            const Status status = context().update_shape(shape, rings);
            ASSERT_TRUE(status.ok()) << status.text();
        }
        ASSERT_TRUE(world().update(kept).ok());
        PairTable fresh(submitted_penetrations, on_device);
        ASSERT_TRUE(world().update(fresh).ok());
        EXPECT_GT(fresh.size(), 50U);
        EXPECT_EQ(numbers_of_table(kept), numbers_of_table(fresh));
    }
    for (const ShapeHandle shape : shapes) {
        ASSERT_TRUE(context().remove_shape(shape).ok());
    }
}

/// The rows of the frame before can be read while the device works at the next.
TEST_F(DevicePairSubmissions, TakeTurns) {
    Random random(device_pair_submissions_seed);
    std::vector<InstanceHandle> instances;
    for (const Rings& rings : some_shapes(random)) {
        instances.push_back(add(add_shape(rings), any_pose(random, 3.0)));
        instances.push_back(add(world().instance(instances.back())->shape, any_pose(random, 3.0)));
    }
    PairTable reference(submitted_penetrations, on_device);
    std::array<PairTable<PenetrationQuery>, 2> tables{PairTable(submitted_penetrations, on_device),
                                                      PairTable(submitted_penetrations, on_device)};
    std::vector<double> before;
    for (std::size_t frame = 0; frame < 8; ++frame) {
        for (const InstanceHandle instance : instances) {
            ASSERT_TRUE(world().move(instance, any_pose(random, 3.0)).ok());
        }
        ASSERT_TRUE(world().submit(tables[frame % 2]).ok());
        if (frame > 0) {
            PairTable<PenetrationQuery>& last = tables[(frame + 1) % 2];
            ASSERT_TRUE(last.collect().ok());
            EXPECT_EQ(numbers_of_table(last), before);
        }
        ASSERT_TRUE(world().update(reference).ok());
        before = numbers_of_table(reference);
    }
    EXPECT_GT(reference.size(), 3U);
}

/// There is room for some thousand pairs at first.
TEST_F(DevicePairSubmissions, GrowWhenTheyAreCollected) {
    const ShapeHandle square = add_shape(rectangle({-1.0, -1.0}, {1.0, 1.0}));
    for (int i = 0; i < 120; ++i) {
        add(square, {.translation = {0.01 * i, 0.005 * i}, .angle = 0.1 * i});
    }
    PairTable reference(IntersectionTestQuery{}, on_device);
    ASSERT_TRUE(world().update(reference).ok());
    PairTable table(IntersectionTestQuery{}, on_device);
    ASSERT_TRUE(world().submit(table).ok());
    ASSERT_TRUE(table.collect().ok());
    EXPECT_EQ(table.size(), 120U * 119U / 2U);
    EXPECT_EQ(table.size(), reference.size());
}

TEST_F(DevicePairSubmissions, AreReadyOnceTheDeviceIsDone) {
    crowd();
    PairTable table(submitted_penetrations, on_device);
    EXPECT_FALSE(table.is_ready());
    ASSERT_TRUE(world().submit(table).ok());
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!table.is_ready() && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::yield();
    }
    EXPECT_TRUE(table.is_ready());
    ASSERT_TRUE(table.collect().ok());
    EXPECT_FALSE(table.is_ready());
    EXPECT_GT(table.size(), 0U);
}

TEST_F(DevicePairSubmissions, AreCollectedOnce) {
    crowd();
    PairTable table(submitted_penetrations, on_device);
    const Status early = table.collect();
    EXPECT_EQ(early.code(), StatusCode::not_ready) << early.text();
    ASSERT_TRUE(world().submit(table).ok());
    for (const Status& status : {world().submit(table), world().update(table)}) {
        EXPECT_EQ(status.code(), StatusCode::not_ready) << status.text();
        EXPECT_NE(status.message().find("has not been collected"), std::string::npos);
    }
    EXPECT_EQ(table.row(0).error().code(), StatusCode::invalid_query);
    ASSERT_TRUE(table.collect().ok());
    EXPECT_GT(table.size(), 0U);
    EXPECT_EQ(table.collect().code(), StatusCode::not_ready);
    EXPECT_GT(table.size(), 0U);
}

TEST_F(DevicePairSubmissions, OfBadQueriesAreRefused) {
    crowd();
    PairTable<PenetrationQuery> table({.tolerance = -1.0}, on_device);
    const Status status = world().submit(table);
    EXPECT_EQ(status.code(), StatusCode::invalid_query);
    EXPECT_EQ(status.message().find("submit: "), 0U) << status.text();
    EXPECT_EQ(table.collect().code(), StatusCode::not_ready);
}

TEST_F(DevicePairSubmissions, OfAnEmptyWorldAreReadyAtOnce) {
    PairTable table(submitted_penetrations, on_device);
    ASSERT_TRUE(world().submit(table).ok());
    EXPECT_TRUE(table.is_ready());
    ASSERT_TRUE(table.collect().ok());
    EXPECT_EQ(table.size(), 0U);
}

TEST_F(DevicePairSubmissions, CutByLimitsAreNone) {
    crowd();
    PairTable reference(close_calls, on_device);
    ASSERT_TRUE(world().update(reference).ok());
    const std::vector<double> expected = numbers_of_table(reference);
    PairTable table(close_calls, on_device);
    const std::uint64_t cuts = cut_everywhere(dense, [&](std::uint64_t n) {
        SCOPED_TRACE("cut at checkpoint " + std::to_string(n));
        EXPECT_TRUE(world().submit(table).ok());
        const Cut cut(n);
        const Status status = table.collect(cut.limits());
        EXPECT_EQ(status.code(), cut.has_cut() ? StatusCode::cancelled : StatusCode::ok)
            << status.text();
        EXPECT_EQ(table.size() > 0, !cut.has_cut());
        EXPECT_TRUE(world().update(table).ok());
        EXPECT_EQ(numbers_of_table(table), expected);
        return cut.has_cut() && !HasFailure();
    });
    EXPECT_GE(cuts, 2U);
}

/// A table that is not collected waits for the device, and takes nothing with it.
TEST_F(DevicePairSubmissions, MayBeGivenUp) {
    crowd();
    {
        PairTable given_up(submitted_penetrations, on_device);
        ASSERT_TRUE(world().submit(given_up).ok());
    }
    PairTable replaced(submitted_penetrations, on_device);
    ASSERT_TRUE(world().submit(replaced).ok());
    replaced = PairTable(submitted_penetrations, on_device);
    EXPECT_EQ(replaced.collect().code(), StatusCode::not_ready);
    PairTable moved(submitted_penetrations, on_device);
    ASSERT_TRUE(world().submit(moved).ok());
    PairTable table = std::move(moved);
    ASSERT_TRUE(table.collect().ok());
    EXPECT_GT(table.size(), 0U);
}

}  // namespace
}  // namespace nearfield::test
